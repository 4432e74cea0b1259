#include "gui/view/overlays/id_labels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace winslow::gui {

namespace {

bool within(const Bounds& box, const Vec2& p) {
  return (p.array() >= box.min.array()).all() && (p.array() <= box.max.array()).all();
}

}  // namespace

IdLabels::Key IdLabels::key_of(const ViewOverlay& o) {
  return {o.session.generation(), o.session.shape(),  o.view.visible(),     o.view.viewport(),
          o.theme.scale,          o.options.node_ids, o.options.element_ids};
}

void IdLabels::find(const ViewOverlay& o) {
  labels_.clear();
  if (o.options.element_ids) find_elements(o);
  if (o.options.node_ids) find_nodes(o);
}

void IdLabels::find_nodes(const ViewOverlay& o) {
  const Topology& topology = *o.session.topology();
  const Coordinates& x = o.session.coordinates();
  const Bounds seen = o.view.visible();
  for (Index i = 0; i < x.size() && labels_.size() < most_id_labels; ++i) {
    const Vec2 p = x.xy(i);
    if (!within(seen, p) || !topology.used(i)) continue;
    double shortest = std::numeric_limits<double>::infinity();
    for (const Index j : topology.neighbours(i))
      shortest = std::min(shortest, (x.xy(j) - p).norm());
    const std::string text = std::to_string(i);
    // Half of an edge belongs to each of its ends.
    const double room = shortest / o.view.pixel_size(p);
    if (room < static_cast<double>(id_label_size(o.theme, text).x + o.theme.px(10))) continue;
    labels_.push_back({o.view.to_screen(p), text, true});
  }
}

void IdLabels::find_elements(const ViewOverlay& o) {
  const Topology& topology = *o.session.topology();
  const Coordinates& x = o.session.coordinates();
  const Bounds seen = o.view.visible();
  for (Index e = 0; e < topology.element_count() && labels_.size() < most_id_labels; ++e) {
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
    // Twice the area over the girth is the radius of a circle inside.
    const double radius = std::abs(twice_area) / around / o.view.pixel_size(middle);
    const std::string text = std::to_string(e);
    const ImVec2 size = id_label_size(o.theme, text);
    if (2 * radius < static_cast<double>(std::hypot(size.x, size.y))) continue;
    labels_.push_back({o.view.to_screen(middle), text, false});
  }
}

void IdLabels::draw(ImDrawList& list, const ViewOverlay& o) {
  if (!o.options.node_ids && !o.options.element_ids) {
    key_ = Key();
    return;
  }
  if (const Key now = key_of(o); key_ != now) {
    key_ = now;
    find(o);
  }
  for (const IdLabel& label : labels_) draw_id_label(list, o.theme, label);
  if (!labels_.empty()) return;
  const ScreenBox seen = o.view.viewport();
  draw_no_id_labels(list, o.theme,
                    ImVec2(static_cast<float>(seen.min.x()) + o.theme.px(12),
                           static_cast<float>(seen.max.y()) - o.theme.px(36)));
}

}  // namespace winslow::gui
