#pragma once

#include "core/types.h"
#include "gui/render/space/space_view.h"
#include "gui/settings/view_options.h"

namespace winslow::gui {

/// A node or an element of the open mesh, or a face of a volume mesh, numbered as in Topology.
struct MeshItem {
  enum class Kind { node, element, face };
  Kind kind = Kind::element;
  Index id = 0;

  bool operator==(const MeshItem&) const = default;
};

/// State of the columns beside the mesh in the present window.
struct ColumnState {
  bool left_open = true, right_open = true;  ///< false: folded to icons
  bool both_fit = true;                      ///< the window has room for both

  bool operator==(const ColumnState&) const = default;
};
/// Opens a column; the other one folds if there is no room for both.
void open_left(ViewOptions& view, const ColumnState& columns);
void open_right(ViewOptions& view, const ColumnState& columns);
/// Folds an open column; does not open the other one instead.
void fold_left(ViewOptions& view, const ColumnState& columns);
void fold_right(ViewOptions& view, const ColumnState& columns);

/// The visible part of a volume mesh at a place of the screen.
struct SeenPlace {
  Vec3 point{0, 0, 0};
  Vec3 normal{0, 0, 1};  ///< of the surface there, towards the viewer
  Index element = -1;
  Index marker = -1;          ///< of the boundary; -1: none
  std::optional<Index> node;  ///< node of the element, near enough to the mouse
};

/// The momentary state of the view; unlike ViewOptions it is not saved.
struct ViewState {
  std::optional<MeshItem> focus;  ///< target of "Go to": highlighted and described
  bool go_to_wanted = false;      ///< the field "Go to" gets the keyboard focus in this frame
  bool roles_previewed = false;   ///< roles are shown while their settings are edited
  bool box_zoom_armed = false;    ///< the next drag draws the box to zoom to
  bool can_go_back = false;       ///< to an earlier view
  bool can_go_forward = false;
  bool ruler = false;                       ///< clicks measure
  std::optional<Vec2> cursor;               ///< mouse position, units of the mesh; none: no mesh
  std::optional<SeenPlace> seen;            ///< place of a volume mesh under the mouse
  std::optional<ViewDirection> looks_from;  ///< direction of the view of a volume mesh
  std::optional<std::size_t> cut;           ///< cut that has a handle in the picture
  double pixel = 1;                         ///< width of a pixel, in units of the mesh
  ColumnState columns;
};

/// Pixels per unit of the layout: the user's choice or the screen's preference, limited by the size
/// of the window.
class InterfaceScale {
 public:
  /// screen: the screen's preferred scale.
  explicit InterfaceScale(float screen) : screen_(screen) {}
  void set_screen(float scale) { screen_ = scale; }
  float screen() const { return screen_; }
  /// Size of the window, pixels.
  void set_window(int width, int height);

  /// chosen: by the user; 0: that of the screen.
  float of(double chosen) const;
  /// `wanted`, or the largest of `scales` below it that fits the window.
  float fitting(double wanted) const;

 private:
  float screen_;
  int width_ = 1, height_ = 1;
};

}  // namespace winslow::gui
