#include "gui/view/tools/cut_handle.h"

namespace winslow::gui {

namespace {

// Framebuffer pixels at scale 1.
constexpr double arrow_length = 72;
constexpr double cut_knob_reach = 10, shaft_reach = 7, foot_reach = 13;
constexpr double seen_sideways = 16;  // a shorter arrow points at the viewer

void edit_cut(const PointerFrame& frame, const CutPlane& cut) {
  if (!held_cut(frame.scene)) return;
  const ViewOptions& before = frame.scene.options;
  ViewOptions after = before;
  after.space.cuts[*frame.scene.cut] = cut;
  frame.actions.emplace_back(action::EditView{difference(before, after)});
}

}  // namespace

const CutPlane* held_cut(const ViewportScene& scene) {
  const auto& cuts = scene.options.space.cuts;
  if (!scene.cut || *scene.cut >= cuts.size() || !cuts[*scene.cut].on) return nullptr;
  return Vec3(cuts[*scene.cut].normal.data()).norm() > 0 ? &cuts[*scene.cut] : nullptr;
}

CutPart CutHandle::part_at(const ScreenPoint& pixel) const {
  if ((pixel - tip).norm() <= cut_knob_reach * scale) return CutPart::knob;
  const bool on_foot = (pixel - foot).norm() <= foot_reach * scale;
  const bool on_shaft = distance_to_segment(pixel, foot, tip) <= shaft_reach * scale;
  return on_foot || on_shaft ? CutPart::shaft : CutPart::none;
}

CutHandle make_cut_handle(const CutPlane& cut, const View& view, double scale) {
  CutHandle handle;
  handle.scale = scale;
  handle.anchor = Vec3(cut.point.data());
  handle.normal = Vec3(cut.normal.data()).normalized();
  const ScreenBox box = view.viewport();
  if (!box.contains(view.project(handle.anchor).at)) {
    // The point of the plane in the middle of the view, or the nearest to it.
    const auto [origin, direction] = view.unproject(box.centre());
    const double slope = handle.normal.dot(direction);
    const double height = handle.normal.dot(handle.anchor - origin);
    const Vec3 met = std::abs(slope) > 0.05 ? Vec3(origin + height / slope * direction)
                                            : Vec3(origin + height * handle.normal);
    if (met.allFinite()) handle.anchor = met;
  }
  handle.length = arrow_length * scale * view.pixel_size(handle.anchor);
  handle.foot = view.project(handle.anchor).at;
  handle.tip = view.project(handle.anchor + handle.length * handle.normal).at;
  return handle;
}

CutPlane moved_cut(const CutPlane& cut, const CutHandle& handle, const View& view,
                   const ScreenVector& by) {
  const ScreenVector arrow = handle.tip - handle.foot;
  // If the arrow is seen end on, the vertical motion of the mouse moves it towards the viewer or
  // away.
  const double along = arrow.norm() > seen_sideways * handle.scale
                           ? by.dot(arrow) / arrow.squared_norm() * handle.length
                           : -by.y() * view.pixel_size(handle.anchor);
  return cut_through(Vec3(cut.point.data()) + along * handle.normal, Vec3(cut.normal.data()));
}

/// The arrow's tip stays on a sphere about its foot, on the side, near or far, on which it is.
CutPlane turned_cut(const CutPlane& cut, const CutHandle& handle, const View& view,
                    const ScreenPoint& to) {
  const Ray<3> ray = view.unproject(to);
  const Vec3 along = ray.direction.normalized();
  const Vec3 from = ray.origin - handle.anchor;
  const double middle = -from.dot(along);
  const Vec3 nearest = from + middle * along;
  const double inside = handle.length * handle.length - nearest.squaredNorm();
  const double side = handle.normal.dot(along) > 0 ? 1 : -1;
  const Vec3 tip = inside > 0 ? Vec3(nearest + side * std::sqrt(inside) * along) : nearest;
  return cut_through(handle.anchor,
                     tip.norm() > 0 ? Vec3(tip.normalized()) : Vec3(cut.normal.data()));
}

void CutTool::hover(const PointerFrame& frame) {
  part_ = CutPart::none;
  if (const CutPlane* cut = held_cut(frame.scene))
    part_ = make_cut_handle(*cut, frame.view, frame.scene.scale).part_at(frame.pointer.position);
}

bool CutTool::press(const PointerFrame& frame) {
  const CutPlane* cut = held_cut(frame.scene);
  if (!cut || part_ == CutPart::none) return false;
  before_ = *cut;
  handle_ = make_cut_handle(*cut, frame.view, frame.scene.scale);
  press_ = frame.pointer.position;
  return true;
}

void CutTool::drag(const PointerFrame& frame) const {
  const ScreenPoint& to = frame.pointer.position;
  edit_cut(frame, part_ == CutPart::knob ? turned_cut(before_, handle_, frame.view, to)
                                         : moved_cut(before_, handle_, frame.view, to - press_));
}

void CutTool::put_back(const PointerFrame& frame) const { edit_cut(frame, before_); }

}  // namespace winslow::gui
