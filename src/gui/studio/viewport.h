#pragma once

#include <optional>
#include <vector>

#include "gui/render/camera.h"
#include "gui/studio/actions.h"
#include "gui/studio/boundary_index.h"

namespace winslow::gui {

/// The mouse over the mesh, in framebuffer pixels.
struct PointerState {
  Vec2 position{0, 0};
  bool over = false;  ///< over the viewport, with nothing of the interface in between
  bool left = false, middle = false, right = false;
  double wheel = 0;  ///< notches; up zooms in
  bool shift = false, control = false;
  bool cancel = false;  ///< Esc
  /// The click under way is another tool's: it selects nothing. A drag is the viewport's still.
  bool click_taken = false;
};

/// Where the handles of the selection are on screen.
struct Handles {
  Vec2 pivot{0, 0};   ///< pixels
  double radius = 0;  ///< of the ring, pixels
  double angle = 0;   ///< of the knob on the ring, radians, counter-clockwise on screen
  Vec2 knob() const;
};
enum class Handle { none, pivot, ring };

/// What the viewport shows, as far as the mouse is concerned.
struct ViewportScene {
  const BoundaryIndex* boundary = nullptr;  ///< null: no mesh
  std::vector<Index> selection;
  Vec2 pivot{0, 0};
  double reach = 0;            ///< of the selection around the pivot, in units of the mesh
  double turned = 0;           ///< degrees by which a drag has turned the selection so far
  double scale = 1;            ///< of the interface; sizes of handles and tolerances grow with it
  bool box_zoom = false;       ///< the next drag draws the box to zoom to
  bool wheel_is_lens = false;  ///< the wheel belongs to the magnifier
};

/// Turns the mouse into actions: select, drag, rotate, set the pivot; pans and zooms the camera.
/// Knows nothing of OpenGL or of widgets.
class Viewport {
 public:
  void update(const PointerState& pointer, const ViewportScene& scene, Camera& camera,
              ActionQueue& actions);

  enum class Gesture { none, press_body, press_empty, pan, box, move, rotate, pivot };
  Gesture gesture() const { return gesture_; }
  /// A body or a handle is being dragged.
  bool dragging() const { return gesture_ == Gesture::move || gesture_ == Gesture::rotate; }
  Handle hovered_handle() const { return hovered_handle_; }
  bool over_body() const { return hit_.has_value(); }
  /// The box being drawn to zoom to, in pixels.
  std::optional<Bounds> box() const;
  /// Motion of the drag so far.
  const RigidMotion& motion() const { return motion_; }

  /// None if nothing is selected.
  static std::optional<Handles> handles(const ViewportScene& scene, const Camera& camera);

 private:
  void hover(const PointerState& p, const ViewportScene& scene, const Camera& camera,
             ActionQueue& actions);
  void press(const PointerState& p, const ViewportScene& scene, const Camera& camera,
             ActionQueue& actions);
  void follow(const PointerState& p, const ViewportScene& scene, Camera& camera,
              ActionQueue& actions);
  bool start_box(const PointerState& p, const ViewportScene& scene);
  void release(const PointerState& p, const Camera& camera, ActionQueue& actions);
  void begin_move(const ViewportScene& scene, ActionQueue& actions);
  void rotate_to(const PointerState& p, const Camera& camera, ActionQueue& actions);
  void end(ActionQueue& actions, bool cancelled);

  Gesture gesture_ = Gesture::none;
  bool pan_button_ = false;  // the pan is held by the middle or right button
  PointerState last_;
  Vec2 press_{0, 0};        // pixels
  Vec2 press_world_{0, 0};  // units of the mesh
  std::optional<BoundaryIndex::Hit> hit_;
  Handle hovered_handle_ = Handle::none;
  RigidMotion motion_;
  double turned_ = 0;      // degrees, unwrapped
  double last_angle_ = 0;  // of the mouse about the pivot, radians
  std::vector<Index> last_hover_;
};

}  // namespace winslow::gui
