#include "gui/view/overlays/space_id_labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "gui/view/overlays/hidden_places.h"

namespace winslow::gui {

namespace {

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
      if (!cut_away(middle, fill.clipped_by, scenes.planes))
        add_label(o, middle, {fill.elements[first], false}, 4 * area / girth);
    }
  }
  for (const auto& [node, place] : nodes.found())
    if (!cut_away(place.at, place.clipped_by, scenes.planes))
      add_label(o, place.at, {node, true}, place.room);
}

void SpaceIdLabels::add_label(const SpaceOverlay& o, const Vec3& point, const Item& item,
                              double room) {
  const std::string text = std::to_string(item.id);
  const ImVec2 size = id_label_size(o.theme, text);
  const float wanted = item.node ? size.x + o.theme.px(10) : std::hypot(size.x, size.y);
  if (room < static_cast<double>(wanted)) return;
  const auto [at, depth] = o.view.project(point);
  if (o.view.viewport().contains(at)) labels_.push_back({{at, text, item.node}, depth, false});
}

void SpaceIdLabels::hide_what_lies_behind(const SpaceOverlay& o, const VolumeScenes& scenes) {
  std::vector<DeepPlace> places;
  for (const Label& label : labels_) places.push_back({label.drawn.at, label.depth});
  hide_behind(o.view, scenes, places);
  for (std::size_t k = 0; k < places.size(); ++k) labels_[k].hidden = places[k].hidden;
  std::erase_if(labels_, [](const Label& label) { return label.hidden; });
}

void SpaceIdLabels::find(const SpaceOverlay& o, const VolumeScenes& scenes) {
  labels_.clear();
  for (const auto& part : scenes.parts) find_in(o, *part, scenes);
  hide_what_lies_behind(o, scenes);
  // A node may be in several parts.
  std::set<std::pair<bool, std::string>> there;
  std::erase_if(labels_, [&](const Label& label) {
    return !there.insert({label.drawn.node, label.drawn.text}).second;
  });
  if (labels_.size() > most_id_labels) labels_.resize(most_id_labels);
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
  for (const Label& label : labels_) draw_id_label(list, o.theme, label.drawn);
  if (!labels_.empty()) return;
  const ScreenPoint top = o.view.viewport().min;
  draw_no_id_labels(list, o.theme,
                    ImVec2(static_cast<float>(top.x()) + o.theme.px(12),
                           static_cast<float>(top.y()) + o.theme.px(12)));
}

}  // namespace winslow::gui
