#include "gui/view/overlays/space_id_labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

// More would be no help to anyone, and slow.
constexpr std::size_t most_labels = 600;

ImVec2 size_of(const Theme& theme, const std::string& text) {
  return theme.small->CalcTextSizeA(theme.small->FontSize, 1e6f, 0, text.c_str());
}

bool clipped(const Vec3& point, unsigned by, const std::vector<Plane>& planes) {
  for (std::size_t k = 0; k < planes.size(); ++k)
    if ((by >> k & 1U) != 0 && planes[k].distance(point) > 0) return true;
  return false;
}

double doubled_area(const ScreenVector& a, const ScreenVector& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// A triangle of a fill on screen.
struct SeenTriangle {
  std::array<Vec3, 3> at;
  std::array<View::Projection, 3> seen;

  SeenTriangle(const SpaceFill& fill, std::size_t first, const Vec3& origin, const View& view) {
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = origin + Eigen::Vector3f(fill.corners[first + k].position.data()).cast<double>();
      seen[k] = view.project(at[k]);
    }
  }
  ScreenVector side(std::size_t k) const { return seen[(k + 1) % 3].at - seen[k].at; }
  double area() const { return 0.5 * std::abs(doubled_area(side(0), seen[2].at - seen[0].at)); }
  double girth() const { return side(0).norm() + side(1).norm() + side(2).norm(); }
  bool near(const ScreenBox& box) const {
    const auto out = [&](auto&& beyond) { return std::ranges::all_of(seen, beyond); };
    return !(out([&](const auto& p) { return p.at.x() < box.min.x(); }) ||
             out([&](const auto& p) { return p.at.x() > box.max.x(); }) ||
             out([&](const auto& p) { return p.at.y() < box.min.y(); }) ||
             out([&](const auto& p) { return p.at.y() > box.max.y(); }));
  }
  /// Weights of the corners at a place; negative ones outside.
  std::array<double, 3> weights(const ScreenPoint& p) const {
    const double whole = doubled_area(side(0), seen[2].at - seen[0].at);
    const double a = doubled_area(seen[1].at - p, seen[2].at - p) / whole;
    const double b = doubled_area(seen[2].at - p, seen[0].at - p) / whole;
    return {a, b, 1 - a - b};
  }
};

/// Places of the screen in a grid, to find those in a triangle.
class PlaceGrid {
 public:
  explicit PlaceGrid(const ScreenBox& box) : box_(box) {
    columns_ = std::max(1, static_cast<int>(box.size().x() / side) + 1);
    rows_ = std::max(1, static_cast<int>(box.size().y() / side) + 1);
    cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  }
  void add(const ScreenPoint& at, std::size_t label) {
    cells_[cell(column(at), row(at))].push_back(label);
  }

  template <class Visit>
  void around(const SeenTriangle& triangle, const Visit& visit) const {
    ScreenPoint low = triangle.seen[0].at, high = low;
    for (const auto& p : triangle.seen) {
      low = {std::min(low.x(), p.at.x()), std::min(low.y(), p.at.y())};
      high = {std::max(high.x(), p.at.x()), std::max(high.y(), p.at.y())};
    }
    for (int y = row(low); y <= row(high); ++y)
      for (int x = column(low); x <= column(high); ++x)
        for (const std::size_t label : cells_[cell(x, y)]) visit(label);
  }

 private:
  static constexpr double side = 32;  // pixels
  int column(const ScreenPoint& p) const {
    return static_cast<int>(std::clamp((p.x() - box_.min.x()) / side, 0.0, columns_ - 1.0));
  }
  int row(const ScreenPoint& p) const {
    return static_cast<int>(std::clamp((p.y() - box_.min.y()) / side, 0.0, rows_ - 1.0));
  }
  std::size_t cell(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(x);
  }

  ScreenBox box_;
  int columns_ = 1, rows_ = 1;
  std::vector<std::vector<std::size_t>> cells_;
};

/// The node of an element that a corner of a picture is; none: it lies on an edge, as of a cut.
std::optional<Index> node_at(const SpaceCorner& corner, Index element, const Mesh& mesh,
                             const Vec3& origin) {
  for (const Index node : mesh.topology->element(element)) {
    const Eigen::Vector3f place = (mesh.coordinates.xyz(node) - origin).cast<float>();
    if (place == Eigen::Vector3f(corner.position.data())) return node;
  }
  return std::nullopt;
}

/// Nodes of a picture, and how much room there is around each.
class NodePlaces {
 public:
  struct Place {
    Vec3 at{0, 0, 0};
    unsigned clipped_by = 0;
    double room = std::numeric_limits<double>::infinity();  // pixels
  };
  struct Triangle {
    const SpaceFill& fill;
    std::size_t number;
  };
  NodePlaces(const Mesh& mesh, const Vec3& origin) : mesh_(mesh), origin_(origin) {}

  /// least: the nodes of what has less room than that have none, whatever lies on their other
  /// sides.
  void add(const Triangle& which, const SeenTriangle& triangle, double least) {
    // Thrice the radius of the circle within is about what there is between its corners.
    const double room = triangle.girth() > 0 ? 6 * triangle.area() / triangle.girth() : 0;
    if (room < least) {
      small_.push_back({&which.fill, which.number});
      return;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const auto node = node_of({&which.fill, which.number}, k);
      if (!node) continue;
      Place& place = places_[*node];
      place.at = triangle.at[k];
      place.clipped_by = which.fill.clipped_by;
      place.room = std::min(place.room, room);
    }
  }

  const std::map<Index, Place>& found() {
    for (const Small& small : small_) {
      if (places_.empty()) break;
      for (std::size_t k = 0; k < 3; ++k)
        if (const auto node = node_of(small, k)) places_.erase(*node);
    }
    small_.clear();
    return places_;
  }

 private:
  struct Small {
    const SpaceFill* fill;
    std::size_t number;
  };
  std::optional<Index> node_of(const Small& triangle, std::size_t corner) const {
    return node_at(triangle.fill->corners[3 * triangle.number + corner],
                   triangle.fill->elements[triangle.number], mesh_, origin_);
  }

  const Mesh& mesh_;
  Vec3 origin_;
  std::map<Index, Place> places_;
  std::vector<Small> small_;
};

}  // namespace

/// Nodes where the triangles at them have room for their number, elements where what is seen of
/// them has.
void SpaceIdLabels::find_in(const SpaceOverlay& o, const SpaceScene& part,
                            const VolumeScenes& scenes) {
  NodePlaces nodes(*scenes.of.mesh, part.origin);
  const ScreenBox seen = o.view.viewport();
  for (const SpaceFill& fill : part.fills) {
    if (fill.opacity < 1) continue;
    for (std::size_t t = 0; t < fill.elements.size();) {
      const std::size_t first = t;
      double area = 0, girth = 0;
      Vec3 middle(0, 0, 0);
      // The triangles of one polygon follow one another.
      for (; t < fill.elements.size() && fill.elements[t] == fill.elements[first]; ++t) {
        const SeenTriangle triangle(fill, 3 * t, part.origin, o.view);
        const double own = triangle.area();
        area += own;
        girth += triangle.girth();
        middle += own * (triangle.at[0] + triangle.at[1] + triangle.at[2]) / 3;
        if (o.options.node_ids && triangle.near(seen))
          nodes.add({fill, t}, triangle, static_cast<double>(o.theme.small->FontSize));
      }
      if (!o.options.element_ids || !(area > 0)) continue;
      middle /= area;
      // As wide as the circle within, which is four times the area over the girth.
      if (!clipped(middle, fill.clipped_by, scenes.planes))
        add_label(o, middle, {fill.elements[first], false}, 4 * area / girth);
    }
  }
  for (const auto& [node, place] : nodes.found())
    if (!clipped(place.at, place.clipped_by, scenes.planes))
      add_label(o, place.at, {node, true}, place.room);
}

void SpaceIdLabels::add_label(const SpaceOverlay& o, const Vec3& point, const Item& item,
                              double room) {
  const std::string text = std::to_string(item.id);
  const ImVec2 size = size_of(o.theme, text);
  const float wanted = item.node ? size.x + o.theme.px(10) : std::hypot(size.x, size.y);
  if (room < static_cast<double>(wanted)) return;
  const auto [at, depth] = o.view.project(point);
  if (o.view.viewport().contains(at)) labels_.push_back({at, depth, text, item.node, false});
}

/// A label is hidden by a triangle over its middle that lies nearer to the viewer.
void SpaceIdLabels::hide_what_lies_behind(const SpaceOverlay& o, const VolumeScenes& scenes) {
  PlaceGrid grid(o.view.viewport());
  for (std::size_t k = 0; k < labels_.size(); ++k) grid.add(labels_[k].at, k);
  const double slack = 1e-4 * scenes.parts.front()->extent.size().norm();
  for (const auto& part : scenes.parts)
    for (const SpaceFill& fill : part->fills) {
      if (fill.opacity < 1) continue;
      for (std::size_t first = 0; first + 2 < fill.corners.size(); first += 3) {
        const SeenTriangle triangle(fill, first, part->origin, o.view);
        if (!triangle.near(o.view.viewport()) || !(triangle.area() > 0)) continue;
        grid.around(triangle, [&](std::size_t k) {
          Label& label = labels_[k];
          const auto w = triangle.weights(label.at);
          if (label.hidden || std::ranges::any_of(w, [](double v) { return v < 0; })) return;
          double depth = 0;
          Vec3 point(0, 0, 0);
          for (std::size_t c = 0; c < 3; ++c) {
            depth += w[c] * triangle.seen[c].depth;
            point += w[c] * triangle.at[c];
          }
          if (depth < label.depth - slack && !clipped(point, fill.clipped_by, scenes.planes))
            label.hidden = true;
        });
      }
    }
  std::erase_if(labels_, [](const Label& label) { return label.hidden; });
}

void SpaceIdLabels::find(const SpaceOverlay& o, const VolumeScenes& scenes) {
  labels_.clear();
  for (const auto& part : scenes.parts) find_in(o, *part, scenes);
  hide_what_lies_behind(o, scenes);
  // A node may be in several parts.
  std::set<std::pair<bool, std::string>> there;
  std::erase_if(labels_, [&](const Label& label) {
    return !there.insert({label.node, label.text}).second;
  });
  if (labels_.size() > most_labels) labels_.resize(most_labels);
}

void SpaceIdLabels::draw(ImDrawList& list, const SpaceOverlay& o, const VolumeView& picture) {
  const VolumeScenes* scenes = picture.scenes();
  if ((!o.options.node_ids && !o.options.element_ids) || !scenes || scenes->parts.empty()) {
    key_ = Key();
    return;
  }
  const Key now{o.view.camera(), picture.revision(), o.theme.scale, o.options.node_ids,
                o.options.element_ids};
  if (key_ != now) {
    key_ = now;
    find(o, *scenes);
  }
  ImFont& font = *o.theme.small;
  const float pad = o.theme.px(3);
  for (const Label& label : labels_) {
    const ImVec2 size = size_of(o.theme, label.text);
    const ImVec2 at(std::round(static_cast<float>(label.at.x()) - size.x / 2),
                    std::round(static_cast<float>(label.at.y()) - size.y / 2));
    const ImVec2 min(at.x - pad, at.y), max(at.x + size.x + pad, at.y + size.y);
    // Nodes on cards, elements bare but for what sets them off: the two are told apart.
    list.AddRectFilled(min, max, label.node ? palette().text : faded(palette().card, 0.8f),
                       o.theme.px(3));
    list.AddText(&font, font.FontSize, at, label.node ? palette().card : palette().text,
                 label.text.c_str());
    ui::note((label.node ? "id/n" : "id/e") + label.text, min, max);
  }
  if (!labels_.empty()) return;
  const ScreenPoint top = o.view.viewport().min;
  const ImVec2 at(static_cast<float>(top.x()) + o.theme.px(12),
                  static_cast<float>(top.y()) + o.theme.px(12));
  draw_tag(list, o.theme, at, "Zoom in to see the numbers");
  ui::note("id/none", at, ImVec2(at.x + 1, at.y + 1));
}

}  // namespace winslow::gui
