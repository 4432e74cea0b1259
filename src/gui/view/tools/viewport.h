#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gui/document/actions/actions.h"
#include "gui/document/selection/boundary_index.h"
#include "gui/render/view.h"
#include "gui/view/tools/gizmo.h"
#include "gui/view/tools/motion_gesture.h"
#include "gui/view/tools/typed_motion.h"

namespace winslow::gui {

/// The mouse over the mesh.
struct PointerState {
  ScreenPoint position;
  bool over = false;  ///< over the viewport, with nothing of the interface in between
  bool left = false, middle = false, right = false;
  double wheel = 0;  ///< notches; up zooms in
  bool shift = false, control = false, alt = false;
  bool cancel = false;                               ///< Esc
  bool accept = false;                               ///< Enter
  bool key_x = false, key_y = false, key_z = false;  ///< keep a drag to an axis
  std::u32string text;                               ///< typed since the last frame
  bool erase = false, next = false;                  ///< Backspace, Tab
  /// The click under way is another tool's: it selects nothing. A drag is the viewport's still.
  bool click_taken = false;
  bool picks_nodes = false;  ///< clicks are to pick nodes
};

/// What the viewport shows, as far as the mouse is concerned.
struct ViewportScene {
  const BoundaryIndex* boundary = nullptr;  ///< null: no mesh
  std::vector<Index> selection;
  std::vector<Index> taken_out;  ///< markers that the mouse passes through, ascending
  Vec2 pivot{0, 0};
  double reach = 0;            ///< of the selection around the pivot, in units of the mesh
  double turned = 0;           ///< degrees by which a drag has turned the selection so far
  double scale = 1;            ///< of the interface; sizes of handles and tolerances grow with it
  bool box_zoom = false;       ///< the next drag draws the box to zoom to
  bool look_only = false;      ///< a tool has the clicks: nothing is taken hold of
  bool wheel_is_lens = false;  ///< the wheel belongs to the magnifier
  std::vector<std::pair<Vec2, std::string>> snaps;  ///< where the pivot snaps to, by name
  ShapeEdit shape;
};

/// Turns the mouse into actions: select, drag, rotate, set the pivot, change shapes; pans and zooms
/// the view. Knows nothing of OpenGL or of widgets.
class Viewport {
 public:
  void update(const PointerState& pointer, const ViewportScene& scene, View& view,
              ActionQueue& actions);

  enum class Gesture {
    none,
    press_body,
    press_empty,
    press_node,
    pan,
    box,
    move,
    rotate,
    shape,
    pivot
  };
  Gesture gesture() const { return gesture_; }
  /// A body, a handle or a piece of boundary is being dragged.
  bool dragging() const {
    return gesture_ == Gesture::move || gesture_ == Gesture::rotate || gesture_ == Gesture::shape;
  }
  Handle hovered_handle() const { return hovered_handle_; }
  bool over_body() const { return hit_.has_value(); }
  /// The body under the mouse.
  const std::optional<BoundaryIndex::Hit>& body() const { return hit_; }
  /// The box being drawn to zoom to.
  std::optional<ScreenBox> box() const;
  /// Boundary node under the mouse while shapes are edited.
  const std::optional<BoundaryIndex::NodeHit>& hovered_node() const { return node_; }
  /// The drag so far.
  const MotionGesture& drag() const { return drag_; }
  /// Numbers typed during the drag, which count in place of the mouse.
  const TypedMotion& typed() const { return typed_; }
  /// What the pivot under the mouse has snapped to; empty: nothing.
  const std::string& snapped_to() const { return snapped_to_; }

  /// None if nothing is selected, or shapes are edited.
  static std::optional<Gizmo> gizmo(const ViewportScene& scene, const View& view);

 private:
  void hover(const PointerState& p, const ViewportScene& scene, const View& view,
             ActionQueue& actions);
  void press(const PointerState& p, const ViewportScene& scene, ActionQueue& actions);
  void press_handle(const PointerState& p, const ViewportScene& scene, ActionQueue& actions);
  void leave_press(const ViewportScene& scene, ActionQueue& actions);
  void follow(const PointerState& p, const ViewportScene& scene, View& view, ActionQueue& actions);
  bool start_box(const PointerState& p, const ViewportScene& scene);
  void follow_drag(const PointerState& p, const View& view, ActionQueue& actions);
  void take_typed(const PointerState& p, const View& view, ActionQueue& actions);
  void follow_pivot(const PointerState& p, const ViewportScene& scene, const View& view,
                    ActionQueue& actions);
  void wheel(const PointerState& p, const ViewportScene& scene, View& view, ActionQueue& actions);
  void release(const PointerState& p, const ViewportScene& scene, const View& view,
               ActionQueue& actions);
  void select_node(bool extend, const ViewportScene& scene, ActionQueue& actions);
  void begin(Gesture gesture, const ViewportScene& scene, ActionQueue& actions,
             std::optional<int> axis = {});
  static void click_beside_nodes(const ViewportScene& scene, ActionQueue& actions);
  void end(ActionQueue& actions, bool cancelled);

  Gesture gesture_ = Gesture::none;
  bool pan_button_ = false;  // the pan is held by the middle or right button
  PointerState last_;
  ScreenPoint press_;
  std::optional<BoundaryIndex::Hit> hit_;
  std::optional<BoundaryIndex::NodeHit> node_;
  Handle hovered_handle_ = Handle::none;
  MotionGesture drag_;
  TypedMotion typed_;
  Vec2 pivot_before_{0, 0};
  std::string snapped_to_;
  std::vector<Index> last_hover_;
};

}  // namespace winslow::gui
