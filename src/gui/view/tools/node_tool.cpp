#include "gui/view/tools/node_tool.h"

namespace winslow::gui {

namespace {

// Framebuffer pixels at scale 1.
constexpr double node_pick_radius = 10;
constexpr double click_slack = 4;

}  // namespace

std::optional<Index> NodeTool::node_at(const PointerState& pointer, double scale,
                                       const Session& session, const View& view) {
  // The coordinates are looked at, not copied, unless they are to be indexed anew.
  if (!session.in_motion())
    picker_.prepare(session.shape(), session.topology(), session.coordinates());
  const Vec2 point = view.to_plane(pointer.position);
  return picker_.pick(session.shape(), *session.topology(), session.coordinates(), point,
                      node_pick_radius * scale * view.pixel_size(point));
}

bool NodeTool::update(const PointerState& pointer, bool active, double scale,
                      const Session& session, const View& view, ActionQueue& actions) {
  const bool pressed_now = pointer.left && !was_down_;
  const bool released_now = !pointer.left && was_down_;
  was_down_ = pointer.left;
  if (!session.document()) {
    hovered_.reset();
    pressed_.reset();
    return false;
  }
  if (!pointer.left && !released_now) {
    const std::optional<Index> now =
        active && pointer.over ? node_at(pointer, scale, session, view) : std::nullopt;
    if (now != hovered_) actions.emplace_back(action::HoverNode{now});
    hovered_ = now;
  }
  if (pressed_now) {
    pressed_ = active && pointer.over ? node_at(pointer, scale, session, view) : std::nullopt;
    press_ = pointer.position;
  }
  const bool mine = pressed_.has_value();
  if (released_now && mine) {
    if ((pointer.position - press_).norm() <= click_slack * scale)
      actions.emplace_back(action::InspectNode{*pressed_});
    pressed_.reset();
  }
  return mine;
}

}  // namespace winslow::gui
