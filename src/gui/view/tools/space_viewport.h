#pragma once

#include <optional>
#include <vector>

#include "gui/document/actions/actions.h"
#include "gui/document/session/session.h"
#include "gui/render/space/space_view.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"
#include "gui/view/mesh/volume_view.h"
#include "gui/view/tools/cut_handle.h"
#include "gui/view/tools/pivot_picker.h"
#include "gui/view/tools/space_mover.h"
#include "gui/view/tools/viewport.h"

namespace winslow::gui {

/// What the mouse acts upon in space.
struct SpaceSurroundings {
  const Session& session;
  const VolumeView& picture;
  const ViewOptions& options;
  std::optional<std::size_t> cut;  ///< that has a handle
  std::vector<Index> taken_out;    ///< markers that the mouse does not take, ascending
  double scale = 1;                ///< of the interface
  bool box_zoom = false;           ///< the next drag draws the box to zoom to
  bool inspects = false;           ///< a click on a node shows it in the tab VCV
};

/// Turns the mouse over a volume mesh into actions: orbits, pans, zooms, picks, drags cuts, bodies
/// and parts of the boundary. Knows nothing of OpenGL or of widgets.
class SpaceViewport {
 public:
  void update(const PointerState& pointer, const SpaceSurroundings& around, SpaceView& view,
              ActionQueue& actions);

  enum class Gesture { none, press, orbit, pan, box, move_cut, turn_cut, move };
  Gesture gesture() const { return gesture_; }
  /// The box being drawn to zoom to.
  std::optional<ScreenBox> box() const;
  /// What lies under the mouse, while nothing is dragged.
  const std::optional<SeenPlace>& seen() const { return seen_; }
  /// The part of a cut's handle that is under the mouse, or held.
  CutPart cut_part() const;
  /// The mouse is over the mesh, with nothing of the interface in between.
  bool over() const { return last_.over; }
  /// The handle of what is selected.
  const SpaceMover& mover() const { return mover_; }
  /// What a click would take the pivot from.
  const std::optional<PivotSource>& pivot_source() const { return pivot_source_; }
  /// Nodes that a click would hold while shapes are edited: one, or those of a face.
  const std::vector<Index>& held_by_click() const { return held_by_click_; }
  /// The point about which the view is turned just now.
  std::optional<Vec3> pivot() const;
  /// What lies at a place of the screen.
  static std::optional<SeenPlace> seen_at(const ScreenPoint& at, const SpaceSurroundings& around,
                                          const SpaceView& view);

 private:
  void hover(const PointerState& p, const SpaceSurroundings& around, const SpaceView& view,
             ActionQueue& actions);
  void press(const PointerState& p, const SpaceSurroundings& around, const SpaceView& view,
             ActionQueue& actions);
  void follow(const PointerState& p, const SpaceSurroundings& around, SpaceView& view,
              ActionQueue& actions);
  void turn(const SpaceSurroundings& around, SpaceView& view, const ScreenVector& by) const;
  void follow_cut(const PointerState& p, const SpaceSurroundings& around, const SpaceView& view,
                  ActionQueue& actions);
  void release(const PointerState& p, const SpaceSurroundings& around, ActionQueue& actions);
  void click(const PointerState& p, const SpaceSurroundings& around, ActionQueue& actions) const;
  void cancel(const SpaceSurroundings& around, SpaceView& view, ActionQueue& actions);
  void forget_seen(ActionQueue& actions);
  void hover_node(std::optional<Index> node, ActionQueue& actions);
  void look(const PointerState& p, const SpaceSurroundings& around, const SpaceView& view);
  std::optional<SeenPlace> surface_near(const ScreenPoint& at, const SpaceSurroundings& around,
                                        const SpaceView& view) const;
  bool follow_move(const PointerState& p, const SpaceSurroundings& around, const SpaceView& view,
                   ActionQueue& actions);
  void take_node(const SpaceSurroundings& around, const SpaceView& view, ActionQueue& actions);
  bool click_for_pivot(const SpaceSurroundings& around, ActionQueue& actions) const;
  void click_for_shape(bool add, const SpaceSurroundings& around, ActionQueue& actions) const;

  Gesture gesture_ = Gesture::none;
  bool other_button_ = false;  // the gesture is held by the middle or right button
  PointerState last_;
  ScreenPoint press_;
  std::optional<SeenPlace> seen_;
  CutPart hovered_part_ = CutPart::none;
  Vec3 pivot_{0, 0, 0};
  SpaceCamera camera_before_;  // when the gesture began
  CutHandle handle_;           // likewise
  CutPlane cut_before_;
  std::vector<Index> last_hover_;
  std::optional<Index> last_node_;
  SpaceMover mover_;
  PivotPicker pivot_picker_;
  std::optional<PivotSource> pivot_source_;
  std::vector<Index> held_by_click_;
  std::optional<SeenPlace> surface_;  // of which both are
  // What seen_ was found for.
  struct Looked {
    ScreenPoint at;
    SpaceCamera camera;
    const VolumeScenes* scenes = nullptr;
    bool operator==(const Looked&) const = default;
  };
  std::optional<Looked> looked_;
};

}  // namespace winslow::gui
