#include "gui/render/overlap.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "gui/render/cell_cover.h"

namespace winslow::gui {
namespace {

/// Where a part of a mesh covers its own bounding box so many times, some of it is not seen.
constexpr double many_layers = 4;
/// Outlines within what is covered that are kept: more would make one dark patch.
constexpr std::size_t most_outlines = 300;

Vec2 vertex(const DrawList& list, std::uint32_t v) {
  return {static_cast<double>(list.positions[2 * static_cast<std::size_t>(v)]),
          static_cast<double>(list.positions[2 * static_cast<std::size_t>(v) + 1])};
}

Triangle triangle_at(const DrawList& list, const std::vector<std::uint32_t>& triangles,
                     std::size_t t) {
  return {vertex(list, triangles[3 * t]), vertex(list, triangles[3 * t + 1]),
          vertex(list, triangles[3 * t + 2])};
}

double area_of(const Triangle& p) {
  const Vec2 a = p[1] - p[0], b = p[2] - p[0];
  return 0.5 * std::abs(a.x() * b.y() - a.y() * b.x());
}

/// Triangles of a list: their areas, and the box around them.
struct Extent {
  std::vector<double> areas;
  Bounds box{Vec2::Constant(std::numeric_limits<double>::infinity()),
             Vec2::Constant(-std::numeric_limits<double>::infinity())};
  double layers = 0;  // their areas over that of the box

  Extent(const DrawList& list, const std::vector<std::uint32_t>& triangles) {
    areas.reserve(triangles.size() / 3);
    double sum = 0;
    for (std::size_t t = 0; 3 * t < triangles.size(); ++t) {
      const Triangle p = triangle_at(list, triangles, t);
      areas.push_back(area_of(p));
      sum += areas.back();
      for (const Vec2& corner : p) {
        box.min = box.min.cwiseMin(corner);
        box.max = box.max.cwiseMax(corner);
      }
    }
    if (sum > 0 && std::isfinite(sum)) layers = sum / box.size().prod();
  }

  bool lies_over_itself() const { return layers > many_layers; }

  /// The largest first.
  std::vector<std::size_t> order() const {
    std::vector<std::size_t> by_area(areas.size());
    std::iota(by_area.begin(), by_area.end(), std::size_t{0});
    std::ranges::sort(by_area, [&](std::size_t a, std::size_t b) {
      return areas[a] != areas[b] ? areas[a] > areas[b] : a < b;
    });
    return by_area;
  }
};

std::uint32_t add_vertex(DrawList& list, const Vec2& p) {
  list.positions.push_back(static_cast<float>(p.x()));
  list.positions.push_back(static_cast<float>(p.y()));
  list.node_spacing.push_back(0);  // no node
  return static_cast<std::uint32_t>(list.node_spacing.size() - 1);
}

/// A convex polygon as a fan. Returns the number of triangles.
std::size_t add_polygon(DrawList& list, const std::vector<Vec2>& polygon,
                        std::vector<std::uint32_t>& triangles) {
  const std::uint32_t first = add_vertex(list, polygon[0]);
  std::uint32_t before = add_vertex(list, polygon[1]);
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const std::uint32_t next = add_vertex(list, polygon[k]);
    triangles.insert(triangles.end(), {first, before, next});
    before = next;
  }
  return polygon.size() - 2;
}

/// Pieces of the list's triangles, each with what is known of its triangle.
class Pieces {
 public:
  explicit Pieces(DrawList& list) : list_(list) {}

  void add(const std::vector<Vec2>& polygon, std::size_t of) {
    const std::size_t count = add_polygon(list_, polygon, triangles_);
    for (std::size_t k = 0; k < count; ++k) {
      elements_.push_back(list_.triangle_element[of]);
      if (list_.triangle_lines.empty()) continue;
      lines_.push_back(list_.triangle_lines[2 * of]);
      lines_.push_back(list_.triangle_lines[2 * of + 1]);
    }
  }
  std::size_t size() const { return elements_.size(); }

  /// Puts them before the list's triangles.
  void prepend() {
    put([](auto& pieces, auto& all) { all.insert(all.begin(), pieces.begin(), pieces.end()); });
  }
  /// Puts them behind.
  void append() {
    put([](auto& pieces, auto& all) { all.insert(all.end(), pieces.begin(), pieces.end()); });
  }

 private:
  template <class Put>
  void put(Put&& insert) {
    insert(triangles_, list_.triangles);
    insert(elements_, list_.triangle_element);
    insert(lines_, list_.triangle_lines);
  }

  DrawList& list_;
  std::vector<std::uint32_t> triangles_;
  std::vector<Index> elements_;
  std::vector<float> lines_;
};

void cut_inverted(DrawList& list, CellCover& cover, const Extent& inverted) {
  std::vector<std::uint32_t> kept;
  for (const std::size_t t : inverted.order())
    cover.cut(triangle_at(list, list.inverted_triangles, t), true,
              [&](const std::vector<Vec2>& p) { add_polygon(list, p, kept); });
  list.inverted_triangles = std::move(kept);
}

/// Outlines where no other inverted element covers them, and some of the others.
void cut_outlines(DrawList& list, const CellCover& cover) {
  std::vector<std::uint32_t> kept;
  const std::vector<std::uint32_t> lines = std::move(list.inverted_lines);
  const std::size_t step = lines.size() / 2 / most_outlines + 1;
  for (std::size_t k = 0; 2 * k < lines.size(); ++k) {
    if (k % step == 0) {
      kept.insert(kept.end(), {lines[2 * k], lines[2 * k + 1]});
      continue;
    }
    cover.cut_line(vertex(list, lines[2 * k]), vertex(list, lines[2 * k + 1]),
                   [&](const std::vector<Vec2>& ends) {
                     const std::uint32_t from = add_vertex(list, ends[0]);
                     kept.insert(kept.end(), {from, add_vertex(list, ends[1])});
                   });
  }
  list.inverted_lines = std::move(kept);
}

/// Lines of what lies in many layers are as close together as those of cells as many times smaller.
void fade_lines(DrawList& list, const Extent& all) {
  // The mean size of elements that lie side by side: smaller ones are none of the pile.
  const double pile = all.box.size().prod() / static_cast<double>(all.areas.size());
  for (std::size_t k = 0; k < list.line_spacing.size(); ++k) {
    const Vec2 along = vertex(list, list.lines[2 * k + 1]) - vertex(list, list.lines[2 * k]);
    const double size = along.norm() * static_cast<double>(list.line_spacing[k]);
    if (size > pile) list.line_spacing[k] /= static_cast<float>(all.layers);
  }
}

/// What seen_through() has added.
void forget_through(DrawList& list) {
  DrawList::Seen& seen = *list.seen;
  const std::size_t triangles = seen.whole.first + seen.whole.count;
  list.positions.resize(2 * seen.vertices);
  list.node_spacing.resize(seen.vertices);
  list.triangles.resize(3 * triangles);
  list.triangle_element.resize(triangles);
  if (!list.triangle_lines.empty()) list.triangle_lines.resize(2 * triangles);
  seen.through = {};
}

}  // namespace

void hide_covered(DrawList& list) {
  const Extent all(list, list.triangles);
  const Extent inverted(list, list.inverted_triangles);
  if (!all.lies_over_itself() && !inverted.lies_over_itself()) return;
  Pieces beside(list), alone(list);
  if (inverted.lies_over_itself()) {
    CellCover cover(inverted.box);
    cut_inverted(list, cover, inverted);
    cut_outlines(list, cover);
    for (std::size_t t = 0; t < all.areas.size(); ++t)
      cover.cut(triangle_at(list, list.triangles, t), false,
                [&](const std::vector<Vec2>& p) { beside.add(p, t); });
  }
  if (all.lies_over_itself()) {
    CellCover cover(all.box);
    for (const std::size_t t : all.order())
      cover.cut(triangle_at(list, list.triangles, t), true,
                [&](const std::vector<Vec2>& p) { alone.add(p, t); });
    fade_lines(list, all);
  }
  // What is not in pieces is drawn whole.
  DrawList::Seen seen;
  const std::size_t pieces = beside.size() + alone.size();
  seen.whole = {pieces, all.areas.size()};
  seen.alone = all.lies_over_itself() ? DrawList::Range{beside.size(), alone.size()} : seen.whole;
  seen.beside_inverted =
      inverted.lies_over_itself() ? DrawList::Range{0, beside.size()} : seen.alone;
  alone.prepend();
  beside.prepend();
  list.seen = seen;
}

bool seen_through(DrawList& list, std::span<const std::uint32_t> rgba) {
  // Where elements lie side by side there is no pile to see through.
  if (!list.seen || list.seen->alone.first == list.seen->whole.first) return false;
  DrawList::Seen& seen = *list.seen;
  if (seen.vertices == 0) seen.vertices = list.node_spacing.size();
  forget_through(list);
  // Those that cover the same place are told apart by their size, as everywhere here.
  const std::vector<std::uint32_t> triangles(
      list.triangles.begin() + static_cast<std::ptrdiff_t>(3 * seen.whole.first),
      list.triangles.end());
  const Extent all(list, triangles);
  CellCover cover(all.box);
  Pieces faint(list), opaque(list);
  const std::vector<std::size_t> order = all.order();
  const auto cut = [&](bool solid, Pieces& pieces) {
    for (const std::size_t t : order) {
      const std::size_t of = seen.whole.first + t;
      const std::uint32_t alpha = rgba[static_cast<std::size_t>(list.triangle_element[of])] >> 24U;
      if (alpha == 0 || (alpha == 255) != solid) continue;
      cover.cut(triangle_at(list, triangles, t), true,
                [&](const std::vector<Vec2>& p) { pieces.add(p, of); });
    }
  };
  cut(true, opaque);
  cut(false, faint);
  seen.through = {list.triangle_element.size(), faint.size() + opaque.size()};
  faint.append();
  opaque.append();
  return true;
}

}  // namespace winslow::gui
