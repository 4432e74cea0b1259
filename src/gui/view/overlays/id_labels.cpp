#include "gui/view/overlays/id_labels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

// More would be no help to anyone, and slow.
constexpr std::size_t most_labels = 600;

ImVec2 size_of(const Theme& theme, const std::string& text) {
  return theme.small->CalcTextSizeA(theme.small->FontSize, 1e6f, 0, text.c_str());
}

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
  for (Index i = 0; i < x.size() && labels_.size() < most_labels; ++i) {
    const Vec2 p = x.xy(i);
    if (!within(seen, p) || !topology.used(i)) continue;
    double shortest = std::numeric_limits<double>::infinity();
    for (const Index j : topology.neighbours(i))
      shortest = std::min(shortest, (x.xy(j) - p).norm());
    const std::string text = std::to_string(i);
    // Half of an edge belongs to each of its ends.
    const double room = shortest / o.view.pixel_size(p);
    if (room < static_cast<double>(size_of(o.theme, text).x + o.theme.px(10))) continue;
    labels_.push_back({o.view.to_screen(p), text, true});
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
    // Twice the area over the girth is the radius of a circle inside.
    const double radius = std::abs(twice_area) / around / o.view.pixel_size(middle);
    const std::string text = std::to_string(e);
    const ImVec2 size = size_of(o.theme, text);
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
  ImFont& font = *o.theme.small;
  const float pad = o.theme.px(3);
  for (const Label& label : labels_) {
    const ImVec2 size = size_of(o.theme, label.text);
    const ImVec2 at(std::round(static_cast<float>(label.at.x()) - size.x / 2),
                    std::round(static_cast<float>(label.at.y()) - size.y / 2));
    const ImVec2 min(at.x - pad, at.y);
    const ImVec2 max(at.x + size.x + pad, at.y + size.y);
    // Nodes on cards, elements bare but for what sets them off: the two are told apart.
    list.AddRectFilled(min, max, label.node ? palette().text : faded(palette().card, 0.8f),
                       o.theme.px(3));
    list.AddText(&font, font.FontSize, at, label.node ? palette().card : palette().text,
                 label.text.c_str());
    ui::note((label.node ? "id/n" : "id/e") + label.text, min, max);
  }
  if (!labels_.empty()) return;
  const ScreenBox seen = o.view.viewport();
  const float y = static_cast<float>(seen.max.y()) - o.theme.px(36);
  draw_tag(list, o.theme, ImVec2(static_cast<float>(seen.min.x()) + o.theme.px(12), y),
           "Zoom in to see the ids");
  ui::note("id/none", ImVec2(0, y), ImVec2(1, y + 1));
}

}  // namespace winslow::gui
