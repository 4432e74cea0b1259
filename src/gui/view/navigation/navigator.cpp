#include "gui/view/navigation/navigator.h"

#include "gui/render/space/space_view.h"

namespace winslow::gui {

void Navigator::set_viewport(const ScreenBox& area) {
  plane_.view().camera().set_viewport(area.min.x(), area.min.y(), area.size().x(), area.size().y());
  ScreenBox space = area;
  if (options_.comparison == Comparison::split) space = side_by_side(space, options_.divider).now;
  space_.view().camera().set_viewport(space.min.x(), space.min.y(), space.size().x(),
                                      space.size().y());
}

void Navigator::leave_mesh() {
  history_.clear();
  space_.leave(options_);
}

void Navigator::begin_mesh() {
  if (session_.document()) camera_control().begin(options_);
}

void Navigator::on(const action::FitView&) {
  if (!session_.document()) return;
  leave();
  camera_control().fit_all();
}

void Navigator::on(const action::FitSelection&) {
  on(action::FitMarkers{session_.selection().markers()});
}

void Navigator::on(const action::FitMarkers& a) {
  if (!session_.document()) return;
  leave();
  camera_control().fit_markers(a.markers);
}

void Navigator::on(const action::FitBodies&) {
  if (!session_.document()) return;
  leave();
  camera_control().fit_bodies();
}

void Navigator::on(const action::LookAt& a) {
  if (!session_.document()) return;
  leave();
  camera_control().look_around(a.point, a.radius);
  stay_above_card();
}

void Navigator::on(const action::ZoomToScreen& a) {
  if (!session_.document()) return;
  leave();
  camera_control().zoom_to(a.box, a.depth);
}

void Navigator::on(const action::LookFrom& a) {
  if (!session_.in_space()) return;
  leave();
  space_.look_from(named_view(a.name, options_.space.up));
}

void Navigator::go_to(const MeshItem& item) {
  leave();
  camera_control().go_to(item);
  stay_above_card();
}

void Navigator::show(const SpaceLook& look) {
  leave();
  space_.look_from({look.azimuth, look.elevation, look.up});
  space_.look_around(Vec3(look.centre.data()), look.radius);
  stay_above_card();
}

}  // namespace winslow::gui
