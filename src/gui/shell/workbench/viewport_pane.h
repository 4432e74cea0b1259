#pragma once

#include <imgui.h>

#include "gui/base/input.h"
#include "gui/menu/panel_context.h"
#include "gui/panels/layout.h"
#include "gui/panels/legend_card.h"
#include "gui/view/mesh/mesh_layer.h"
#include "gui/view/mesh/mesh_view.h"
#include "gui/view/navigation/view_control.h"
#include "gui/view/overlays/foot_overlay.h"
#include "gui/view/overlays/id_labels.h"
#include "gui/view/overlays/role_overlay.h"
#include "gui/view/overlays/view_overlay.h"
#include "gui/view/tools/ruler.h"
#include "gui/view/tools/viewport.h"

namespace winslow::gui {

/// The part of a frame that shows the mesh, in the window or in a picture.
struct MeshFrame {
  const PanelContext& context;
  const View& view;
  const Layout& layout;
  Lens& lens;
  const SpaceCamera* space = nullptr;  ///< the view of a volume mesh
  bool mesh_alone = false;             ///< without elements for mouse input
};

/// The part of the window that shows the mesh: draws the mesh and its overlays, and handles the
/// mouse over it.
class ViewportPane {
 public:
  ViewportPane(const Session& session, ViewControl& control)
      : session_(session), control_(control) {}

  /// Collects the threads' results. True if a new frame would look different.
  bool poll();
  /// True until the picture shows the present mesh.
  bool busy() const { return mesh_view_.busy() || before_.busy(); }
  /// Updates the mesh and its colours. scale: of the interface.
  void follow_mesh(const ViewOptions& options, float scale);
  /// The same, and updates the view.
  void update(const ViewOptions& options, const View& view, float scale);
  /// Measures the selection for the gizmo; not during motions, so that the ring keeps its size.
  void measure_selection();

  /// Passes the mouse to the object under it.
  void drive(const InputState& input, const PanelContext& context, const Layout& layout);
  void draw_overlays(ImDrawList& list, const MeshFrame& frame);

  /// The scene on which the mouse acts. scale: of the interface.
  ViewportScene scene(double scale) const;
  const Viewport& viewport() const { return viewport_; }
  /// True while the mouse changes the view or drags something.
  bool mouse_busy() const { return viewport_.gesture() != Viewport::Gesture::none; }
  /// A body, a handle or a piece of boundary is being dragged.
  bool dragging() const { return viewport_.dragging(); }
  const Ruler& ruler() const { return ruler_; }
  /// The state with which the mesh is compared, as of the last frame.
  const BeforeMesh& before() const { return before_; }
  MeshView& mesh_view() { return mesh_view_; }
  const MeshView& mesh_view() const { return mesh_view_; }
  /// The magnifier of the window.
  Lens& lens() { return lens_; }
  /// Shape of the mouse cursor over the mesh (ImGuiMouseCursor); none: that of the interface.
  std::optional<int> cursor() const;

 private:
  void draw_marks(ImDrawList& list, const MeshFrame& frame, const ViewOverlay& overlay);
  void draw_space_mode(ImDrawList& list, const ViewOverlay& overlay) const;
  bool take_from_beside(PointerState& pointer);
  void take_for_legend(PointerState& pointer, const PanelContext& context, const Layout& layout);
  void take_for_lens(PointerState& pointer, const PanelContext& context);
  void measure(const PointerFrame& frame, bool beside);
  void zoom_to_double_click(const PointerState& pointer, const PanelContext& context);
  void draw_legend(ImDrawList& list, const MeshFrame& frame, LegendCard& card) const;
  /// The part of the viewport that no banner covers.
  Area room_under_banner(const MeshFrame& frame) const;
  void draw_foot(ImDrawList& list, const MeshFrame& frame, const ViewOverlay& overlay,
                 const LegendCard& card) const;

  const Session& session_;
  ViewControl& control_;
  BeforeMesh before_;
  MeshView mesh_view_;
  Lens lens_{mesh_view_};
  Viewport viewport_;
  ContextClick context_click_;
  Ruler ruler_;
  bool beside_held_ = false;  // the mouse is over the previous mesh, or its gesture began there
  IdLabels id_labels_;
  RoleOverlay roles_;
  LegendCard legend_card_;
  std::vector<Index> double_click_;  // markers of the body under a double click
  double reach_ = 0;                 // of the selection, measured without motion
};

/// The magnifier for a picture: one that follows the mouse is omitted.
std::optional<Inset> pinned_inset(const Session& session, const ViewOptions& view,
                                  const Camera& camera, double scale);

}  // namespace winslow::gui
