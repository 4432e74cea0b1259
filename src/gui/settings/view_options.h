#pragma once

#include "core/inspect/element_field.h"
#include "gui/render/color_scale.h"

namespace winslow::gui {

/// How a marker of a volume mesh is drawn; automatic: bodies as surfaces, outer boundaries as
/// outlines.
enum class MarkerDrawing { automatic, surface, outline };

/// How one marker is shown, and whether the mouse can select it.
struct MarkerLook {
  bool hidden = false;  ///< not drawn; the mouse ignores it
  bool locked = false;  ///< drawn, but neither selected nor moved
  std::optional<std::array<float, 3>>
      color;  ///< red, green, blue, 0 to 1; none: by the marker's number
  // For meshes in space only.
  MarkerDrawing drawing = MarkerDrawing::automatic;
  double opacity = 1;  ///< of its surface, 0.1 to 1

  bool operator==(const MarkerLook&) const = default;
};

/// The looks of the markers of one mesh; default looks are omitted.
struct MarkerLooks {
  std::string mesh;  ///< file of that mesh
  std::map<std::string, MarkerLook> by_name;

  bool operator==(const MarkerLooks&) const = default;

  /// The look of a marker, by default MarkerLook().
  MarkerLook of(const std::string& marker) const {
    const auto it = by_name.find(marker);
    return it == by_name.end() ? MarkerLook() : it->second;
  }
  void set(const std::string& marker, const MarkerLook& look) {
    if (look == MarkerLook())
      by_name.erase(marker);
    else
      by_name[marker] = look;
  }
};

/// A cutting plane of a volume mesh; the side that its normal points to is removed.
struct CutPlane {
  std::array<double, 3> point{0, 0, 0};
  std::array<double, 3> normal{0, 0, 1};  ///< of any length but 0
  bool on = true;

  bool operator==(const CutPlane&) const = default;
};

/// Shows only whole elements of some layers below a marker: elements of layer 1 have a node on the
/// marker, those of layer 2 are adjacent to layer 1, and so on.
struct Peel {
  bool on = false;
  std::string marker;
  int from = 1, to = 3;  ///< layers that are shown

  bool operator==(const Peel&) const = default;
};

/// View options of volume meshes only.
struct SpaceOptions {
  std::vector<CutPlane> cuts;  ///< of the open mesh
  bool crinkle = false;        ///< cuts show whole elements
  bool perspective = false;
  int up = 2;               ///< the axis that points up on screen, 0 to 2
  bool axes = true;         ///< a small cross of axes in the corner
  bool worst = false;       ///< the worst elements are visible through other ones
  bool free_orbit = false;  ///< the mouse rotates freely, not as a turntable
  Peel peel;                ///< of the open mesh

  bool operator==(const SpaceOptions&) const = default;
};

/// Direction, centre and cuts of a view of a volume mesh.
struct SpaceLook {
  double azimuth = 0, elevation = 0;  ///< degrees, see ViewDirection
  int up = 2;
  std::array<double, 3> centre{0, 0, 0};
  double radius = 1;  ///< of the region shown around the centre
  std::vector<CutPlane> cuts;

  bool operator==(const SpaceLook&) const = default;
};

/// Largest number of cuts.
inline constexpr std::size_t most_cuts = 6;

/// The tab shown in the right column.
enum class SideTab { quality, view, vcv, history };

/// Light or dark interface.
enum class Lightness { light, dark };

/// The background of the mesh; automatic: white or nearly black, according to the interface.
enum class Backdrop { automatic, white, grey, gradient, black };

/// The state with which the present mesh is compared.
enum class BeforeState { loaded, last_command };

/// How the earlier state is shown in the viewport: not at all, as edges under the mesh, or left of
/// a divider.
enum class Comparison { none, ghost, split };

/// Draws elements on one side of a threshold normally, the others faintly.
struct Isolation {
  bool on = false;
  double threshold = 0.5;  ///< of the shown metric
  bool above = false;      ///< true: keeps the elements above it; false: those below
  double rest = 0.12;      ///< opacity of the others; 0 hides them

  bool operator==(const Isolation&) const = default;
};

/// The place of the legend: in a strip beside the mesh, or over a corner of it.
enum class LegendPlace { right, left, top_right, bottom_right, bottom_left, top_left };
inline bool docked(LegendPlace place) {
  return place == LegendPlace::right || place == LegendPlace::left;
}

/// An inset that shows a place at a larger scale.
struct Magnifier {
  bool on = false;
  double factor = 6;                         ///< scale of the inset over that of the viewport
  std::optional<std::array<double, 2>> pin;  ///< place shown; none: under the mouse

  bool operator==(const Magnifier&) const = default;
};

/// How the mesh is shown; not part of the document.
struct ViewOptions {
  std::optional<ElementField> color = Metric::normalized_jacobian;  ///< none: plain
  std::string color_map = "automatic";  ///< for this and the next four see ColorChoice
  ColorAxis color_axis = ColorAxis::automatic;
  std::optional<std::array<double, 2>> percentiles;
  std::optional<std::array<double, 2>> range;
  int bands = 0;
  Isolation isolation;
  bool fill = true;         ///< surfaces of the elements
  bool wireframe = true;    ///< edges of the elements
  double line_width = 1;    ///< of edges, units of the layout
  bool nodes = false;       ///< of the whole mesh
  bool rim_nodes = false;   ///< of the markers
  bool roles = false;       ///< roles of nodes in smoothing, as colours
  bool directions = false;  ///< arrows along markers, the mesh on their left
  MarkerLooks markers;      ///< hidden, locked or recoloured markers
  bool node_ids = false;
  bool element_ids = false;
  bool legend = true;
  LegendPlace legend_place = LegendPlace::right;
  bool scale_bar = true;
  bool mark_inverted = true;
  Comparison comparison = Comparison::none;
  double divider = 0.5;  ///< share of the viewport left of the divider
  BeforeState before = BeforeState::loaded;
  Magnifier magnifier;
  SpaceOptions space;
  /// The field that ranks the worst elements; none: that of the colours.
  std::optional<ElementField> worst_by;
  int worst_count = 20;  ///< length of that list
  Lightness lightness = Lightness::light;
  Backdrop backdrop = Backdrop::automatic;
  double scale = 0;         ///< pixels per unit of the layout; 0: that of the screen
  bool left_panel = true;   ///< the column on the left; false: folded to icons
  bool right_panel = true;  ///< the column on the right; false: folded to icons
  SideTab side_tab = SideTab::quality;
  bool plot_panel = true;

  bool operator==(const ViewOptions&) const = default;
};

/// The styles of drawing elements, in the order of step_style().
enum class ElementStyle { both, surfaces, edges };
inline ElementStyle style_of(const ViewOptions& view) {
  if (!view.fill) return ElementStyle::edges;
  return view.wireframe ? ElementStyle::both : ElementStyle::surfaces;
}
inline void set_style(ViewOptions& view, ElementStyle style) {
  view.fill = style != ElementStyle::edges;
  view.wireframe = style != ElementStyle::surfaces;
}
/// Selects the next style.
inline void step_style(ViewOptions& view) {
  set_style(view, static_cast<ElementStyle>((static_cast<int>(style_of(view)) + 1) % 3));
}

/// True if the legend has a strip beside the mesh. It is kept while only edges are drawn, so that
/// the mesh does not move when the style changes.
inline bool legend_has_strip(const ViewOptions& view) {
  return view.legend && view.color && docked(view.legend_place);
}

/// Available scales of the interface, pixels per unit of the layout.
inline constexpr std::array<double, 10> scales{0.75, 0.9, 1, 1.1, 1.25, 1.5, 1.75, 2, 2.5, 3};

/// The last view of a volume mesh, restored when it is opened again.
struct KeptView {
  std::string mesh;  ///< its file, absolute
  std::array<double, 3> centre{0, 0, 0};
  double height = 1;  ///< of the region around the centre, units of the mesh
  double azimuth = 0, elevation = 0, roll = 0;
  int up = 2;
  std::vector<CutPlane> cuts;
  Peel peel;

  bool operator==(const KeptView&) const = default;
};

/// Largest number of meshes whose views are kept.
inline constexpr std::size_t most_kept_views = 50;

}  // namespace winslow::gui
