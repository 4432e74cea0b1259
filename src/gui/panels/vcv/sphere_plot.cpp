#include "gui/panels/vcv/sphere_plot.h"

#include "gui/base/input.h"
#include "gui/panels/vcv/sphere_drawing.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

constexpr double sphere_filling = 0.8;  // the longest edge, over half of the picture
constexpr std::array<const char*, 2> titles{"Star", "VCV"};
constexpr std::array<const char*, 2> ids{"vcv/star", "vcv"};

double longest_of(const SphereStar& star) {
  const double longest = *std::max_element(star.lengths.begin(), star.lengths.end());
  return longest > 0 ? longest : 1;
}

ScreenBox box_of(const ImVec2& min, const ImVec2& size) {
  return {ScreenPoint(min), ScreenPoint(ImVec2(min.x + size.x, min.y + size.y))};
}

std::optional<std::size_t> point_at(const SpaceCamera& camera, const SphereLink& link,
                                    const SphereStar& star, const Theme& theme) {
  const ScreenPoint mouse(ImGui::GetIO().MousePos);
  double best = static_cast<double>(theme.px(disc_size) + theme.px(3));
  std::optional<std::size_t> nearest;
  const std::vector<bool> front = points_in_front(camera, link, star);
  for (std::size_t k = 0; k < star.points.size(); ++k) {
    const double distance = (camera.project(star.points[k]).at - mouse).norm();
    if (!front[k] || distance > best) continue;
    best = distance;
    nearest = k;
  }
  return nearest;
}

}  // namespace

ColorScale SpherePlot::colors_of(const VolumeNodalView& view) {
  const double equal = 4 * pi / view.link.triangle_count();
  double low = equal / 1.1, high = 1.1 * equal;  // rounding errors must not be coloured
  for (const SphereStar* star : {&view.physical, &view.vcv})
    for (const double angle : star->solid_angles) {
      low = std::min(low, std::max(angle, 0.0));
      high = std::max(high, angle);
    }
  ColorScale scale;
  scale.map = "viridis";
  scale.low = low;
  scale.high = high;
  return scale;
}

void SpherePlot::link(bool linked) {
  linked_ = linked;
  if (linked_) from_[1] = from_[0];
}

void SpherePlot::look_from(const ViewDirection& direction) { from_ = {direction, direction}; }

const std::optional<Index>& SpherePlot::stopped_by() const {
  static const std::optional<Index> nothing;
  return drag_ ? drag_->stopped_by() : nothing;
}

SpaceCamera SpherePlot::camera_of(std::size_t which, const ScreenBox& area,
                                  const SphereStar& star) const {
  SpaceCamera camera;
  const ScreenVector size = area.size();
  camera.set_viewport(area.min.x(), area.min.y(), size.x(), size.y());
  camera.look_from(from_[which]);
  const double longest = longest_of(star);
  camera.set_content({Vec3::Constant(-longest), Vec3::Constant(longest)});
  camera.look_at(Vec3(0, 0, 0), longest / (sphere_filling * 0.5 * std::min(size.x(), size.y())));
  return camera;
}

void SpherePlot::turn(std::size_t which, const SpaceCamera& camera) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.MouseDelta.x == 0 && io.MouseDelta.y == 0) return;
  SpaceCamera turned = camera;
  turned.turn(Vec3(0, 0, 0), ScreenVector(io.MouseDelta), false);
  from_[which] = turned.direction();
  if (linked_) from_[1 - which] = from_[which];
}

/// True if the VCV has changed.
bool SpherePlot::drag(const Theme& theme) {
  const ImGuiIO& io = ImGui::GetIO();
  const ScreenPoint mouse(io.MousePos);
  const SpaceCamera& camera = drag_camera_;
  const Vec3 at = drag_->points()[drag_->edge()];
  if (io.KeyCtrl) {
    // Drag along the edge on screen; an edge that points at the viewer is lengthened by dragging
    // upwards.
    const double unit = camera.units_per_pixel();
    const Vec3 direction = at.normalized();
    const double right = direction.dot(camera.right()), up = direction.dot(camera.up());
    const double share = std::hypot(right, up);
    const ScreenVector to = mouse - camera.viewport().centre();
    const double length = share > 0.2 ? unit * (to.x() * right - to.y() * up) / (share * share)
                                      : at.norm() - unit * static_cast<double>(io.MouseDelta.y);
    const ScreenVector size = camera.viewport().size();
    const double room =
        0.5 * std::min(size.x(), size.y()) - static_cast<double>(theme.px(disc_size) + theme.px(2));
    drag_->stretch_to(length, unit * room / std::max(share, 0.2));
  } else {
    // Drag over the sphere through the point; outside it, along its outline.
    const Ray<3> ray = camera.unproject(mouse);
    const Vec3 toward = ray.direction.normalized();
    const double radius = at.norm();
    const Vec3 foot = ray.origin - ray.origin.dot(toward) * toward;
    const double square = radius * radius - foot.squaredNorm();
    drag_->turn_to(square > 0 ? Vec3(foot - std::sqrt(square) * toward) : foot);
  }
  return drag_->edit() != sent_;
}

void SpherePlot::drive(const VolumeNodalView& view, const SpaceCamera& camera, const Theme& theme,
                       Outcome& outcome) {
  const ImGuiIO& io = ImGui::GetIO();
  if (!ImGui::IsItemActive()) {
    if (drag_) outcome.ended = true;
    drag_.reset();
    if (turning_ == 1) turning_.reset();
    let_go_ = true;
    return;
  }
  if (ImGui::IsItemActivated() && let_go_) {
    const auto under = point_at(camera, view.link, view.vcv, theme);
    if (under) {
      drag_.emplace(view, *under);
      drag_camera_ = camera;
      sent_ = drag_->edit();
    } else {
      turning_ = 1;
    }
  }
  if (drag_ && ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) {
    drag_.reset();
    let_go_ = false;
    outcome.cancelled = true;
    return;
  }
  if (turning_ == 1) turn(1, camera);
  if (!drag_ || (io.MouseDelta.x == 0 && io.MouseDelta.y == 0)) return;
  if (!drag(theme)) return;
  sent_ = drag_->edit();
  outcome.edit = sent_;
}

SpherePlot::Outcome SpherePlot::draw(const VolumeNodalView& view, const Look& look,
                                     const Theme& theme) {
  Outcome outcome;
  const float width = std::max(ImGui::GetContentRegionAvail().x, theme.px(120));
  const float gap = theme.px(6);
  const float side = look.large ? width : (width - gap) / 2;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ColorScale colors = colors_of(view);
  SphereStar shown = view.vcv;
  std::array<SpaceCamera, 2> cameras;
  std::array<bool, 2> over{};
  for (std::size_t which = 0; which < 2; ++which) {
    const ImVec2 min = ImGui::GetCursorScreenPos();
    const ImVec2 size(side, look.large ? 0.86f * side : side);
    ImGui::InvisibleButton(titles[which], size);
    ui::note(which == 0 ? "vcv/star" : "vcv/plot");
    over[which] = ImGui::IsItemHovered();
    cameras[which] = camera_of(which, box_of(min, size), which == 0 ? view.physical : view.vcv);
    if (which == 0) {
      if (ImGui::IsItemActivated()) turning_ = 0;
      if (!ImGui::IsItemActive() && turning_ == 0) turning_.reset();
      if (turning_ == 0) turn(0, cameras[0]);
      if (!look.large) ImGui::SameLine(0, gap);
    } else {
      drive(view, cameras[1], theme, outcome);
    }
    const ImVec2 max(min.x + size.x, min.y + size.y);
    list.AddRectFilled(min, max, palette().card, theme.px(4));
    list.AddRect(min, max, palette().border, theme.px(4));
  }
  if (!turning_ && !drag_) {
    if (over[0]) outcome.hovered = point_at(cameras[0], view.link, view.physical, theme);
    if (over[1]) outcome.hovered = point_at(cameras[1], view.link, view.vcv, theme);
  }
  if (drag_) {
    // During a drag only the dragged point moves in the picture.
    outcome.hovered = drag_->edge();
    shown = make_sphere_star(view.link, drag_->points());
    cameras[1] = drag_camera_;
  }
  const auto lit = outcome.hovered ? outcome.hovered : look.lit;
  const auto lit_face =
      stopped_by() ? std::optional(static_cast<std::size_t>(*stopped_by())) : look.lit_face;
  draw_sphere(list, theme, cameras[0],
              {titles[0], ids[0], view.link, view.physical, colors, {}, &view, lit, lit_face});
  draw_sphere(list, theme, cameras[1],
              {titles[1], ids[1], view.link, shown, colors, view.weights, nullptr, lit, lit_face});
  if ((over[1] && outcome.hovered) || drag_) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  return outcome;
}

}  // namespace winslow::gui
