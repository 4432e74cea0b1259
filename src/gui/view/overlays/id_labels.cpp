#include "gui/view/overlays/id_labels.h"

#include "gui/render/space/space_scene.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

// More labels would be slow and illegible.
constexpr std::size_t most_labels = 600;

ImVec2 size_of(const Theme& theme, const std::string& text) {
  return theme.small->CalcTextSizeA(theme.small->FontSize, 1e6f, 0, text.c_str());
}

/// The card of a number, and where its text begins.
struct Card {
  ImVec2 min, max, text;
  bool overlaps(const Card& other) const {
    return min.x < other.max.x && other.min.x < max.x && min.y < other.max.y && other.min.y < max.y;
  }
};

Card card_of(const Theme& theme, const IdLabel& label) {
  const float pad = theme.px(3);
  const ImVec2 size = size_of(theme, label.text);
  const ImVec2 at(std::round(static_cast<float>(label.at.x()) - size.x / 2),
                  std::round(static_cast<float>(label.at.y()) - size.y / 2));
  return {{at.x - pad, at.y}, {at.x + size.x + pad, at.y + size.y}, at};
}

/// Removes the numbers of elements that the card of a node would cover in part: they would be
/// illegible.
template <class Label>
void leave_out_covered(std::vector<Label>& labels, const Theme& theme) {
  std::vector<Card> nodes;
  for (const Label& label : labels)
    if (label.drawn.node) nodes.push_back(card_of(theme, label.drawn));
  std::erase_if(labels, [&](const Label& label) {
    if (label.drawn.node) return false;
    const Card own = card_of(theme, label.drawn);
    return std::ranges::any_of(nodes, [&](const Card& node) { return own.overlaps(node); });
  });
}

/// Numbers of nodes stand on cards, those of elements only on a faint one, so that the two can be
/// told apart.
void draw_label(ImDrawList& list, const Theme& theme, const IdLabel& label) {
  ImFont& font = *theme.small;
  const auto [min, max, at] = card_of(theme, label);
  list.AddRectFilled(min, max, label.node ? palette().text : faded(palette().card, 0.8f),
                     theme.px(3));
  list.AddText(&font, font.FontSize, at, label.node ? palette().card : palette().text,
               label.text.c_str());
  ui::note((label.node ? "id/n" : "id/e") + label.text, min, max);
}

bool within(const Bounds& box, const Vec2& p) {
  return (p.array() >= box.min.array()).all() && (p.array() <= box.max.array()).all();
}

/// The node of an element at a corner of a picture; none: the corner lies on an edge, as in a cut.
std::optional<Index> node_at(const SpaceCorner& corner, Index element, const Mesh& mesh,
                             const Vec3& origin) {
  for (const Index node : mesh.topology->element(element)) {
    const Eigen::Vector3f place = (mesh.coordinates.xyz(node) - origin).cast<float>();
    if (place == Eigen::Vector3f(corner.position.data())) return node;
  }
  return std::nullopt;
}

/// Collects the nodes of a picture, and the room around each.
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

  /// least: triangles with less room exclude their nodes, whatever lies on the nodes' other sides.
  void add(const Triangle& which, const SeenTriangle& triangle, double least) {
    // The room between the corners is about thrice the radius of the inscribed circle.
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

void IdLabels::find_nodes(const ViewOverlay& o) {
  const Topology& topology = *o.session.topology();
  const Coordinates& x = o.session.coordinates();
  const Bounds seen = o.view.visible();
  for (Index i = 0; i < x.size() && labels_.size() < most_labels; ++i) {
    const Vec2 p = x.xy(i);
    if (!within(seen, p) || !topology.used(i)) continue;
    double shortest = std::numeric_limits<double>::infinity();
    for (const Index j : topology.neighbours(i))
      shortest = std::min(shortest, (x.xy(j) - p).norm());
    // Half of an edge belongs to each of its ends.
    add_label(o, place_in_plane(p), {i, true}, shortest / o.view.pixel_size(p));
  }
}

void IdLabels::find_elements(const ViewOverlay& o) {
  const Topology& topology = *o.session.topology();
  const Coordinates& x = o.session.coordinates();
  const Bounds seen = o.view.visible();
  for (Index e = 0; e < topology.element_count() && labels_.size() < most_labels; ++e) {
    const auto nodes = topology.element(e);
    Vec2 middle(0, 0);
    for (const Index i : nodes) middle += x.xy(i);
    middle /= static_cast<double>(nodes.size());
    if (!within(seen, middle)) continue;
    double twice_area = 0;
    double around = 0;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Vec2 a = x.xy(nodes[k]);
      const Vec2 b = x.xy(nodes[(k + 1) % nodes.size()]);
      twice_area += a.x() * b.y() - a.y() * b.x();
      around += (b - a).norm();
    }
    // Twice the area over the perimeter is the radius of the inscribed circle.
    const double radius = std::abs(twice_area) / around / o.view.pixel_size(middle);
    add_label(o, place_in_plane(middle), {e, false}, 2 * radius);
  }
}

/// Labels nodes if the triangles at them have room for the number, elements if their visible part
/// has.
void IdLabels::find_in(const ViewOverlay& o, const SpaceScene& part, const VolumeScenes& scenes) {
  NodePlaces nodes(*scenes.of.mesh, part.origin);
  const ScreenBox seen = o.view.viewport();
  for (const SpaceFill& fill : part.fills) {
    if (fill.opacity < 1) continue;
    for (std::size_t t = 0; t < fill.elements.size();) {
      const std::size_t first = t;
      double area = 0, girth = 0;
      Vec3 middle(0, 0, 0);
      // The triangles of a polygon are consecutive.
      for (; t < fill.elements.size() && fill.elements[t] == fill.elements[first]; ++t) {
        const SeenTriangle triangle(fill, 3 * t, part, o.view);
        const double own = triangle.area();
        area += own;
        girth += triangle.girth();
        middle += own * (triangle.at[0] + triangle.at[1] + triangle.at[2]) / 3;
        if (o.options.node_ids && triangle.near(seen))
          nodes.add({fill, t}, triangle, static_cast<double>(o.theme.small->FontSize));
      }
      if (!o.options.element_ids || !(area > 0)) continue;
      middle /= area;
      // Width of the inscribed circle: four times the area over the perimeter.
      if (!cut_away(middle, fill.clipped_by, scenes.planes))
        add_label(o, middle, {fill.elements[first], false}, 4 * area / girth);
    }
  }
  for (const auto& [node, place] : nodes.found())
    if (!cut_away(place.at, place.clipped_by, scenes.planes))
      add_label(o, place.at, {node, true}, place.room);
}

void IdLabels::add_label(const ViewOverlay& o, const Vec3& point, const Item& item, double room) {
  const std::string text = std::to_string(item.id);
  const ImVec2 size = size_of(o.theme, text);
  const float wanted = item.node ? size.x + o.theme.px(10) : std::hypot(size.x, size.y);
  if (room < static_cast<double>(wanted)) return;
  const auto [at, depth] = o.view.project(point);
  if (o.view.viewport().contains(at)) labels_.push_back({{at, text, item.node}, depth, false});
}

void IdLabels::hide_what_lies_behind(const ViewOverlay& o, const VolumeScenes& scenes) {
  std::vector<DeepPlace> places;
  for (const Label& label : labels_) places.push_back({label.drawn.at, label.depth});
  hide_behind(o.view, scenes.parts, scenes.planes, places);
  for (std::size_t k = 0; k < places.size(); ++k) labels_[k].hidden = places[k].hidden;
  std::erase_if(labels_, [](const Label& label) { return label.hidden; });
}

void IdLabels::find_in_picture(const ViewOverlay& o, const VolumeScenes& scenes) {
  for (const auto& part : scenes.parts) find_in(o, *part, scenes);
  hide_what_lies_behind(o, scenes);
  // A node may be in several parts.
  std::set<std::pair<bool, std::string>> there;
  std::erase_if(labels_, [&](const Label& label) {
    return !there.insert({label.drawn.node, label.drawn.text}).second;
  });
  if (labels_.size() > most_labels) labels_.resize(most_labels);
}

void IdLabels::find(const ViewOverlay& o, const VolumeView& picture) {
  labels_.clear();
  if (const VolumeScenes* scenes = picture.scenes()) {
    find_in_picture(o, *scenes);
  } else {
    if (o.options.element_ids) find_elements(o);
    if (o.options.node_ids) find_nodes(o);
  }
  leave_out_covered(labels_, o.theme);
}

void IdLabels::draw(ImDrawList& list, const ViewOverlay& o, const VolumeView& picture,
                    const ScreenBox& room) {
  const bool no_picture =
      o.session.in_space() && (!picture.scenes() || picture.scenes()->parts.empty());
  if ((!o.options.node_ids && !o.options.element_ids) || no_picture) {
    key_ = Key();
    return;
  }
  const Key now{o.session.generation(), o.session.shape(),  picture.revision(),   ViewKey(o.view),
                o.theme.scale,          o.options.node_ids, o.options.element_ids};
  if (key_ != now) {
    key_ = now;
    find(o, picture);
  }
  for (const Label& label : labels_) draw_label(list, o.theme, label.drawn);
  if (!labels_.empty()) return;
  // Shown instead of numbers that have no room.
  const ImVec2 at(static_cast<float>(room.min.x()) + o.theme.px(12),
                  static_cast<float>(room.min.y()) + o.theme.px(12));
  draw_tag(list, o.theme, at, "Zoom in to see the numbers");
  ui::note("id/none", at, ImVec2(at.x + 1, at.y + 1));
}

}  // namespace winslow::gui
