#pragma once

#include "core/types.h"
#include "gui/render/space/space_view.h"
#include "gui/settings/view_options.h"

namespace winslow::gui {

/// A node or an element of the open mesh, or a face of a volume mesh (as Topology numbers them).
struct MeshItem {
  enum class Kind { node, element, face };
  Kind kind = Kind::element;
  Index id = 0;

  bool operator==(const MeshItem&) const = default;
};

/// The columns beside the mesh, as the window has room for them.
struct ColumnState {
  bool left_open = true, right_open = true;  ///< false: folded to icons
  bool both_fit = true;                      ///< the window has room for both

  bool operator==(const ColumnState&) const = default;
};
/// Opens a column; the other one gives way where there is no room for both.
void open_left(ViewOptions& view, const ColumnState& columns);
void open_right(ViewOptions& view, const ColumnState& columns);
/// Folds the one that is open; where there is no room for both the other does not take its place.
void fold_left(ViewOptions& view, const ColumnState& columns);
void fold_right(ViewOptions& view, const ColumnState& columns);

/// What is seen at a place of a volume mesh.
struct SeenPlace {
  Vec3 point{0, 0, 0};
  Vec3 normal{0, 0, 1};  ///< of the surface there, towards the viewer
  Index element = -1;
  Index marker = -1;          ///< of the boundary; -1: none there
  std::optional<Index> node;  ///< of the element, near enough to be meant
};

/// What the view is doing at the moment; unlike ViewOptions nothing that one would keep.
struct ViewState {
  std::optional<MeshItem> focus;  ///< what was gone to: highlighted and described
  bool go_to_wanted = false;      ///< the field "Go to" takes the keyboard in this frame
  bool roles_previewed = false;   ///< roles of nodes are shown as long as what sets them is edited
  bool box_zoom_armed = false;    ///< the next drag draws the box to zoom to
  bool can_go_back = false;       ///< to an earlier view
  bool can_go_forward = false;
  bool ruler = false;             ///< clicks measure
  std::optional<Vec2> cursor;     ///< what the mouse is over, in units of the mesh; none: no mesh
  std::optional<SeenPlace> seen;  ///< what the mouse is over, of a volume mesh
  std::optional<ViewDirection> looks_from;  ///< from where a volume mesh is seen
  std::optional<std::size_t> cut;           ///< that has a handle in the picture
  double pixel = 1;                         ///< what a pixel is wide, in units of the mesh
  ColumnState columns;
};

/// Pixels per unit of the layout: what the user chose, or what the screen wants, as far as the
/// window has room for it.
class InterfaceScale {
 public:
  /// screen: what the screen wants.
  explicit InterfaceScale(float screen) : screen_(screen) {}
  void set_screen(float scale) { screen_ = scale; }
  float screen() const { return screen_; }
  /// Size of the window, pixels.
  void set_window(int width, int height);

  /// chosen: by the user; 0: as the screen wants it.
  float of(double chosen) const;
  /// `wanted`, or the largest step of `scales` below it that the window has room for.
  float fitting(double wanted) const;

 private:
  float screen_;
  int width_ = 1, height_ = 1;
};

}  // namespace winslow::gui
