#include "gui/view/mesh/mesh_view.h"

#include "gui/view/mesh/mesh_colors.h"

namespace winslow::gui {

namespace {

MeshStyle style_for(const ViewOptions& view, float scale) {
  const MeshColors colors = mesh_colors(view);
  MeshStyle style;
  style.fill = view.fill;
  style.wireframe = view.wireframe;
  style.edge_width = scale * static_cast<float>(view.line_width);
  style.boundary_width = 2 * scale;
  style.node_size = view.nodes ? 4 * scale : 0;
  style.show_inverted = view.mark_inverted;
  style.fill_color = colors.fill;
  style.edge_color = colors.edge;
  style.inverted_color = colors.inverted;
  return style;
}

}  // namespace

void MeshView::update(const Session& session, const BeforeMesh& before, const ViewOptions& view,
                      float scale) {
  in_space_ = session.in_space();
  has_mesh_ = session.document() != nullptr && !in_space_;
  if (in_space_) return volume_.update(session, before, view, scale);
  volume_.clear();
  if (!has_mesh_) return;
  backdrop_ = backdrop_colors(view);
  style_ = style_for(view, scale);
  comparison_ = view.comparison;
  poll();
  const auto& topology = session.topology();
  now_.update(topology, session.coordinates(), session.generation(), session.shape());
  now_.color(view.color ? session.quality().latest() : nullptr, view);
  if (comparison_ != Comparison::none) {
    before_.update(before.topology(), *before.coordinates(), session.generation(), before.shape());
    ViewOptions of_before = view;
    if (comparison_ == Comparison::ghost) of_before.color.reset();
    // The same colour means the same value on both sides.
    if (now_.legend()) {
      const ColorScale& scale = now_.legend()->scale;
      of_before.range = {{scale.low, scale.high}};
      of_before.color_axis = scale.logarithmic ? ColorAxis::logarithmic : ColorAxis::linear;
    }
    before_.color(before.measured(), of_before);
    ghost_ = style_;
    ghost_.fill = ghost_.show_inverted = false;
    ghost_.wireframe = true;
    ghost_.node_size = 0;
    ghost_.markers = false;
    ghost_.edge_color = mesh_colors(view).ghost;
  }
  update_markers(session, view, scale);
}

bool MeshView::poll() {
  const bool news = now_.poll();
  const bool in_space = volume_.poll();
  return before_.poll() || news || in_space;
}

void MeshView::update_markers(const Session& session, const ViewOptions& view, float scale) {
  const bool dark = mesh_colors(view).dark;
  const auto count = static_cast<Index>(session.topology()->markers().size());
  markers_.clear();
  for (Index m = 0; m < count; ++m) {
    const std::string& name = session.topology()->markers()[at(m)].name;
    if (view.markers.of(name).hidden) {
      markers_.push_back({{}, 0});
      continue;
    }
    const Rgb c = color_of_marker(view, name, m, dark);
    const auto& hovered = session.selection().hovered();
    const bool lit = std::find(hovered.begin(), hovered.end(), m) != hovered.end();
    float width = 2.2f;
    if (lit) width = 4.0f;
    if (session.selection().contains(m)) width = 4.5f;
    markers_.push_back({{c[0], c[1], c[2], 1}, width * scale});
  }
  now_.renderer().set_marker_styles(markers_);
  if (comparison_ == Comparison::split) before_.renderer().set_marker_styles(markers_);
}

void MeshView::draw(const Camera& camera, const Camera* whole, int height) {
  if (!has_mesh_) return;
  if (whole) draw_backdrop(camera, *whole, backdrop_, height);
  if (!now_.has_mesh()) return;
  if (comparison_ == Comparison::split && before_.has_mesh()) return draw_split(camera, height);
  now_.renderer().draw(camera, style_, height);
  // Drawn over the surfaces, which would hide it; its colour sets it apart from the present edges.
  if (comparison_ == Comparison::ghost && before_.has_mesh())
    before_.renderer().draw(camera, ghost_, height);
}

MeshView::PictureKey MeshView::picture_key(const Camera& camera, int width, int height) {
  PictureKey key{camera, width, height, style_, ghost_, backdrop_, comparison_, divider_, 0, 0, {}};
  key.now = now_.renderer().revision();
  if (comparison_ != Comparison::none) key.before = before_.renderer().revision();
  if (comparison_ != Comparison::split) key.divider = 0;
  if (style_.markers) key.markers = markers_;
  return key;
}

void MeshView::draw_kept(const Camera& camera, int width, int height) {
  if (!has_mesh_ || !now_.has_mesh() || now_.small()) {
    kept_.clear();
    return draw(camera, &camera, height);
  }
  // Markers light up under the mouse. If nothing of the picture lies above them, they are drawn
  // over it, so that it need not be redrawn.
  const bool markers_apart = comparison_ == Comparison::none && style_.node_size <= 0;
  const bool markers = style_.markers;
  style_.markers = markers && !markers_apart;
  kept_.show(picture_key(camera, width, height), FrameBuffer::part_of(camera.viewport(), height),
             width, height, [&] { draw(camera, &camera, height); });
  style_.markers = markers;
  if (!markers || !markers_apart) return;
  MeshStyle rim = style_;
  rim.fill = rim.wireframe = rim.show_inverted = false;
  now_.renderer().draw(camera, rim, height);
}

void MeshView::draw_split(const Camera& camera, int height) {
  const auto [from, to] = camera.viewport();
  const double middle = std::clamp(camera.to_screen(Vec2(divider_, 0)).x(), from.x(), to.x());
  MeshStyle left = style_;
  left.clip = ScreenBox{from, {middle, to.y()}};
  before_.renderer().draw(camera, left, height);
  MeshStyle right = style_;
  right.clip = ScreenBox{{middle, from.y()}, to};
  now_.renderer().draw(camera, right, height);
}

void MeshView::draw_magnified(const Camera& camera, const Camera& whole, int height) {
  if (!has_mesh_ || !now_.has_mesh()) return;
  draw_backdrop(camera, whole, backdrop_, height);
  now_.renderer().draw(camera, style_, height, 1);
  if (comparison_ == Comparison::ghost && before_.has_mesh())
    before_.renderer().draw(camera, ghost_, height, 1);
}

}  // namespace winslow::gui
