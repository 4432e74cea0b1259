#include "gui/studio/mesh_view.h"

#include <algorithm>
#include <string>

#include "gui/render/metric_scale.h"
#include "gui/studio/mesh_colors.h"

namespace winslow::gui {

namespace {

constexpr int histogram_bins = 40;

ColorScale scale_of(const QualityMonitor::Measured& measured, const ViewOptions& view) {
  ColorScale scale = automatic_scale(*measured.field, measured.values, view.color_map);
  if (view.range && (*view.range)[1] > (*view.range)[0]) {
    scale.low = (*view.range)[0];
    scale.high = (*view.range)[1];
  }
  scale.bands = view.bands;
  return scale;
}

Legend legend_of(const QualityMonitor::Measured& measured, const ColorScale& scale) {
  Legend legend;
  legend.title = std::string(field_label(*measured.field));
  legend.scale = scale;
  legend.histogram = histogram_over(measured.values, scale, histogram_bins);
  for (double v : measured.values) {
    legend.more_below |= v < scale.low;
    legend.more_above |= v > scale.high;
  }
  return legend;
}

bool same_colors(const ViewOptions& a, const ViewOptions& b) {
  return a.color == b.color && a.color_map == b.color_map && a.bands == b.bands &&
         a.range == b.range;
}

}  // namespace

void MeshView::update(const Session& session, const ViewOptions& view, float scale) {
  has_mesh_ = session.document() != nullptr;
  if (!has_mesh_) return;
  if (generation_ != session.generation()) {
    generation_ = session.generation();
    shape_ = 0;
    colored_.reset();
    legend_.reset();
    renderer_.clear_values();
  }
  if (shape_ != session.shape()) {
    shape_ = session.shape();
    renderer_.set_mesh(session.document()->topology(), session.coordinates());
  }
  update_colors(session, view);
  update_markers(session, view, scale);
  const MeshColors colors = mesh_colors(view);
  backdrop_ = backdrop_colors(view);
  style_.fill = view.fill;
  style_.wireframe = view.wireframe;
  style_.edge_width = scale * static_cast<float>(view.line_width);
  style_.boundary_width = 2 * scale;
  style_.node_size = view.nodes ? 4 * scale : 0;
  style_.show_inverted = view.mark_inverted;
  style_.fill_color = colors.fill;
  style_.edge_color = colors.edge;
  style_.inverted_color = colors.inverted;
}

void MeshView::update_colors(const Session& session, const ViewOptions& view) {
  const auto& measured = session.quality().latest();
  if (!view.color) {
    if (colored_) renderer_.clear_values();
    colored_.reset();
    legend_.reset();
    return;
  }
  // Until the field asked for is measured, the colours stay what they are.
  if (!measured || measured->field != view.color) return;
  if (colored_ == measured && same_colors(colored_view_, view)) return;
  colored_ = measured;
  colored_view_ = view;
  const ColorScale scale = scale_of(*measured, view);
  renderer_.set_values(measured->values, scale);
  legend_ = legend_of(*measured, scale);
}

void MeshView::update_markers(const Session& session, const ViewOptions& view, float scale) {
  const bool dark = mesh_colors(view).dark;
  const auto count = static_cast<Index>(session.document()->topology()->markers().size());
  std::vector<MeshRenderer::MarkerStyle> styles;
  for (Index m = 0; m < count; ++m) {
    const Rgb c = marker_color(m, dark);
    const auto& hovered = session.hovered();
    const bool lit = std::find(hovered.begin(), hovered.end(), m) != hovered.end();
    float width = 2.2f;
    if (lit) width = 4.0f;
    if (session.selected(m)) width = 4.5f;
    styles.push_back({{c[0], c[1], c[2], 1}, width * scale});
  }
  renderer_.set_marker_styles(std::move(styles));
}

void MeshView::draw(const Camera& camera, int width, int height, bool backdrop) {
  if (!has_mesh_) return;
  if (backdrop) draw_backdrop(camera, backdrop_, height);
  renderer_.draw(camera, style_, width, height);
}

}  // namespace winslow::gui
