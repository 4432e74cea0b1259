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

/// The mesh's part of a frame: of the window, or of a picture.
struct MeshFrame {
  const PanelContext& context;
  const View& view;
  const Layout& layout;
  Lens& lens;
  const SpaceCamera* space = nullptr;  ///< the view, of a volume mesh
  bool mesh_alone = false;             ///< nothing that is there for the mouse's sake
};

/// The part of the window that shows the mesh: the mesh itself, what is drawn over it, and the
/// mouse over it.
class ViewportPane {
 public:
  ViewportPane(const Session& session, ViewControl& control)
      : session_(session), control_(control) {}

  /// Takes what threads have done. True if a new frame would look different.
  bool poll();
  /// The picture is not that of the mesh yet.
  bool busy() const { return mesh_view_.busy() || before_.busy(); }
  /// Follows the mesh and its colours. scale: of the interface.
  void follow_mesh(const ViewOptions& options, float scale);
  /// The same, and the view that it is seen in.
  void update(const ViewOptions& options, const View& view, float scale);
  /// Measures what is selected, for the gizmo: not while it moves, so that the ring stays.
  void measure_selection();

  /// Hands the mouse to what it is over.
  void drive(const InputState& input, const PanelContext& context, const Layout& layout);
  void draw_overlays(ImDrawList& list, const MeshFrame& frame);

  /// What the mouse acts upon now. scale: of the interface.
  ViewportScene scene(double scale) const;
  const Viewport& viewport() const { return viewport_; }
  /// It changes the view, or drags something.
  bool mouse_busy() const { return viewport_.gesture() != Viewport::Gesture::none; }
  /// A body, a handle or a piece of boundary is being dragged.
  bool dragging() const { return viewport_.dragging(); }
  const Ruler& ruler() const { return ruler_; }
  /// What the mesh is compared with, as of the last frame.
  const BeforeMesh& before() const { return before_; }
  MeshView& mesh_view() { return mesh_view_; }
  const MeshView& mesh_view() const { return mesh_view_; }
  /// Of the window.
  Lens& lens() { return lens_; }
  /// Shape of the mouse cursor over the mesh (ImGuiMouseCursor); none: whatever the interface has.
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
  bool beside_held_ = false;  // the mouse is over the mesh before, or its gesture began there
  IdLabels id_labels_;
  RoleOverlay roles_;
  LegendCard legend_card_;
  std::vector<Index> double_click_;  // markers of the body that is clicked the second time
  double reach_ = 0;                 // of the selection, when nothing was moving
};

/// The magnifier as a picture has it: one that follows the mouse is none of the mesh's.
std::optional<Inset> pinned_inset(const Session& session, const ViewOptions& view,
                                  const Camera& camera, double scale);

}  // namespace winslow::gui
