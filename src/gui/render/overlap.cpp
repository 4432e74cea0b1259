#include "gui/render/overlap.h"

#include <bit>

#include "core/mesh/mesh.h"

namespace winslow::gui {

using Triangle = std::array<Vec2, 3>;

/// A grid of cells over a box that records which cells a triangle covers completely: what lies only
/// behind covered cells is invisible.
class CellCover {
 public:
  explicit CellCover(const Bounds& box)
      : origin_(box.min), size_((box.size().array() / count).matrix()) {}

  /// Receives the visible part of a triangle: all of it, or convex pieces (counter-clockwise or in
  /// the orientation of the triangle).
  using Piece = std::function<void(const std::vector<Vec2>& polygon)>;

  /// Passes on what of a triangle is not behind covered cells. add: the triangle then covers cells,
  /// too.
  void cut(const Triangle& triangle, bool add, const Piece& piece);
  /// Passes on the parts of a line that are not behind covered cells.
  void cut_line(const Vec2& a, const Vec2& b, const Piece& piece) const;

 private:
  static constexpr int count = 128;
  static constexpr double slack = 1e-4;  // of a cell: single precision moves corners

  /// Cells of a row, from the left, 64 a word.
  using Mask = std::array<std::uint64_t, 2>;
  /// A triangle in a row: the cells that it touches, and those that it covers.
  struct Row {
    Mask touched{}, covered{};
  };
  static Mask mask(int begin, int end);
  static Row row_of(const Triangle& p, int row);
  static int cell(double x);
  bool outside(const Triangle& p) const;
  Vec2 to_cells(const Vec2& p) const { return (p - origin_).cwiseQuotient(size_); }
  Vec2 from_cells(const Vec2& p) const { return origin_ + p.cwiseProduct(size_); }
  void hand_over(const std::vector<Vec2>& cells, const Piece& piece) const;
  void emit_runs(const Mask& cells, int row, const Triangle* cut, const Piece& piece) const;

  Vec2 origin_, size_;
  std::array<Mask, count> covered_{};
};

namespace {

/// If a part of a mesh covers its own bounding box so many times, some of it is hidden.
constexpr double many_layers = 4;
/// Number of outlines kept in the covered region: more would make one dark patch.
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

/// The areas of a list's triangles, and the box around them.
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

  /// Indices of the triangles, the largest first.
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

/// Adds a convex polygon as a fan. Returns the number of triangles.
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

/// Pieces of the list's triangles, each with the attributes of its triangle.
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

  /// Inserts the pieces before the list's triangles.
  void prepend() {
    put([](auto& pieces, auto& all) { all.insert(all.begin(), pieces.begin(), pieces.end()); });
  }
  /// Appends the pieces.
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

/// Keeps outlines where no other inverted element covers them, and some of the others.
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

/// Divides the spacing of lines in overlapping layers by the number of layers: they are as dense as
/// lines of smaller cells.
void fade_lines(DrawList& list, const Extent& all) {
  // The mean size of elements if they lay side by side; smaller ones are not part of the pile.
  const double pile = all.box.size().prod() / static_cast<double>(all.areas.size());
  for (std::size_t k = 0; k < list.line_spacing.size(); ++k) {
    const Vec2 along = vertex(list, list.lines[2 * k + 1]) - vertex(list, list.lines[2 * k]);
    const double size = along.norm() * static_cast<double>(list.line_spacing[k]);
    if (size > pile) list.line_spacing[k] /= static_cast<float>(all.layers);
  }
}

/// Removes what seen_through() has added.
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
  // Triangles without pieces are drawn whole.
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
  // A mesh without overlaps has no pile to see through.
  if (!list.seen || list.seen->alone.first == list.seen->whole.first) return false;
  DrawList::Seen& seen = *list.seen;
  if (seen.vertices == 0) seen.vertices = list.node_spacing.size();
  forget_through(list);
  // Elements at the same place are ordered by size, as everywhere in this file.
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

namespace {

/// Range of x in which something is met.
struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

bool empty(const std::array<std::uint64_t, 2>& m) { return (m[0] | m[1]) == 0; }

}  // namespace

std::vector<Vec2> cut_side(const std::vector<Vec2>& polygon, int axis, double limit, double sign) {
  std::vector<Vec2> kept;
  const auto beyond = [&](const Vec2& p) { return sign * (p[axis] - limit); };
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2& a = polygon[k];
    const Vec2& b = polygon[(k + 1) % polygon.size()];
    if (beyond(a) <= 0) kept.push_back(a);
    if ((beyond(a) <= 0) == (beyond(b) <= 0)) continue;
    Vec2 at = a + (b - a) * ((limit - a[axis]) / (b[axis] - a[axis]));
    at[axis] = limit;
    kept.push_back(at);
  }
  return kept;
}

int CellCover::cell(double x) { return std::clamp(static_cast<int>(std::floor(x)), 0, count - 1); }

CellCover::Mask CellCover::mask(int begin, int end) {
  Mask m{};
  for (int word = 0; word < 2; ++word) {
    const int from = std::clamp(begin - 64 * word, 0, 64);
    const int to = std::clamp(end - 64 * word, 0, 64);
    if (from >= to) continue;
    const std::uint64_t upper = to == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << to) - 1;
    m[static_cast<std::size_t>(word)] = upper & ~((std::uint64_t{1} << from) - 1);
  }
  return m;
}

CellCover::Row CellCover::row_of(const Triangle& p, int row) {
  const double bottom = row, top = row + 1;
  Span all, at_bottom, at_top;
  for (std::size_t k = 0; k < 3; ++k) {
    const bool rising = p[k].y() < p[(k + 1) % 3].y();
    const Vec2& a = rising ? p[k] : p[(k + 1) % 3];
    const Vec2& b = rising ? p[(k + 1) % 3] : p[k];
    if (b.y() < bottom - slack || a.y() > top + slack) continue;
    const double rise = b.y() - a.y();
    const auto x_at = [&](double y) {
      const double t = rise > 0 ? std::clamp((y - a.y()) / rise, 0.0, 1.0) : 0.0;
      return a.x() + t * (b.x() - a.x());
    };
    all.include(x_at(bottom));
    all.include(rise > 0 ? x_at(top) : b.x());
    if (a.y() <= bottom && b.y() >= bottom) at_bottom.include(x_at(bottom));
    if (a.y() <= top && b.y() >= top) at_top.include(x_at(top));
  }
  Row result;
  if (all.high < all.low) return result;
  result.touched = mask(cell(all.low - slack), cell(all.high + slack) + 1);
  const double from = std::max(at_bottom.low, at_top.low) + slack;
  const double to = std::min(at_bottom.high, at_top.high) - slack;
  if (from < to) {
    const double begin = std::max(std::ceil(from), 0.0);
    const double end = std::min(std::floor(to), static_cast<double>(count));
    if (begin < end) result.covered = mask(static_cast<int>(begin), static_cast<int>(end));
  }
  return result;
}

bool CellCover::outside(const Triangle& p) const {
  return std::ranges::any_of(p, [](const Vec2& corner) {
    return !(corner.minCoeff() >= -slack && corner.maxCoeff() <= count + slack);
  });
}

void CellCover::hand_over(const std::vector<Vec2>& cells, const Piece& piece) const {
  if (cells.size() < 2) return;
  std::vector<Vec2> polygon;
  polygon.reserve(cells.size());
  for (const Vec2& p : cells) polygon.push_back(from_cells(p));
  piece(polygon);
}

/// Passes on rectangles of neighbouring cells of a row, or the part of a triangle in them.
void CellCover::emit_runs(const Mask& cells, int row, const Triangle* cut,
                          const Piece& piece) const {
  const auto set = [&](int x) {
    return x < count && ((cells[static_cast<std::size_t>(x / 64)] >> (x % 64)) & 1U) != 0;
  };
  for (int x = 0; x < count;) {
    if (!set(x)) {
      ++x;
      continue;
    }
    int end = x;
    while (set(end)) ++end;
    std::vector<Vec2> polygon{{x, row}, {end, row}, {end, row + 1}, {x, row + 1}};
    if (cut) {
      polygon.assign(cut->begin(), cut->end());
      for (const int axis : {0, 1}) {
        polygon = cut_side(polygon, axis, axis == 0 ? x : row, -1);
        polygon = cut_side(polygon, axis, axis == 0 ? end : row + 1, 1);
      }
    }
    if (polygon.size() > 2) hand_over(polygon, piece);
    x = end;
  }
}

void CellCover::cut(const Triangle& triangle, bool add, const Piece& piece) {
  const Triangle p{to_cells(triangle[0]), to_cells(triangle[1]), to_cells(triangle[2])};
  const Vec2 low = p[0].cwiseMin(p[1]).cwiseMin(p[2]);
  const Vec2 high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
  const Mask width = mask(cell(low.x() - slack), cell(high.x() + slack) + 1);
  const int first = cell(low.y() - slack), last = cell(high.y() + slack);
  // Cutting small triangles saves nothing.
  const bool small = (high - low).maxCoeff() < 2;
  if (outside(p)) return piece({triangle.begin(), triangle.end()});
  for (int row = first; row <= last; ++row) {
    Mask& covered = covered_[static_cast<std::size_t>(row)];
    const Mask open{width[0] & ~covered[0], width[1] & ~covered[1]};
    if (empty(open)) continue;
    const Row r = row_of(p, row);
    Mask fresh{}, rim{};
    for (std::size_t w = 0; w < 2; ++w) {
      const std::uint64_t full = add ? r.covered[w] : 0;
      fresh[w] = full & open[w];
      rim[w] = r.touched[w] & ~full & open[w];
    }
    if (small && !empty(rim)) return piece({triangle.begin(), triangle.end()});
    emit_runs(fresh, row, nullptr, piece);
    emit_runs(rim, row, &p, piece);
    for (std::size_t w = 0; w < 2; ++w) covered[w] |= fresh[w];
  }
}

void CellCover::cut_line(const Vec2& a, const Vec2& b, const Piece& piece) const {
  const Triangle p{to_cells(a), to_cells(b), to_cells(b)};
  if (outside(p)) return piece({a, b});
  const int first = cell(std::min(p[0].y(), p[1].y()) - slack);
  const int last = cell(std::max(p[0].y(), p[1].y()) + slack);
  for (int row = first; row <= last; ++row) {
    const Mask& covered = covered_[static_cast<std::size_t>(row)];
    const Row r = row_of(p, row);
    const Mask open{r.touched[0] & ~covered[0], r.touched[1] & ~covered[1]};
    if (empty(open)) continue;
    const int begin = open[0] ? std::countr_zero(open[0]) : 64 + std::countr_zero(open[1]);
    const int end = open[1] ? 128 - std::countl_zero(open[1]) : 64 - std::countl_zero(open[0]);
    std::vector<Vec2> line{p[0], p[1]};
    line = cut_side(cut_side(line, 1, row, -1), 1, row + 1, 1);
    line = cut_side(cut_side(line, 0, begin, -1), 0, end, 1);
    if (line.size() < 2) continue;
    const auto far = std::ranges::max_element(
        line, {}, [&](const Vec2& q) { return (q - line.front()).squaredNorm(); });
    hand_over({line.front(), *far}, piece);
  }
}

}  // namespace winslow::gui
