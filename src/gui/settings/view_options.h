#pragma once

#include "core/inspect/element_field.h"
#include "gui/render/color_scale.h"

namespace winslow::gui {

/// How a marker of a volume mesh is drawn; automatic: a body as a surface, what encloses bodies as
/// an outline.
enum class MarkerDrawing { automatic, surface, outline };

/// How one marker is shown, and whether the mouse may take it.
struct MarkerLook {
  bool hidden = false;                        ///< not drawn; the mouse passes through it
  bool locked = false;                        ///< drawn, but neither selected nor moved
  std::optional<std::array<float, 3>> color;  ///< red, green, blue, 0 to 1; none: by its number
  // In space.
  MarkerDrawing drawing = MarkerDrawing::automatic;
  double opacity = 1;  ///< of its surface, 0.1 to 1

  bool operator==(const MarkerLook&) const = default;
};

/// The looks of the markers of one mesh; those as designed are left out.
struct MarkerLooks {
  std::string mesh;  ///< file of that mesh
  std::map<std::string, MarkerLook> by_name;

  bool operator==(const MarkerLooks&) const = default;

  /// As designed where nothing else was chosen.
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

/// A plane that cuts a volume mesh; what its normal points to is taken away.
struct CutPlane {
  std::array<double, 3> point{0, 0, 0};
  std::array<double, 3> normal{0, 0, 1};  ///< of any length but 0
  bool on = true;

  bool operator==(const CutPlane&) const = default;
};

/// Elements by how deep they lie below a marker: layer 1 has a node of it, layer 2 lies beside
/// layer 1, and so on. Those of some layers are shown alone, whole.
struct Peel {
  bool on = false;
  std::string marker;
  int from = 1, to = 3;  ///< layers that are shown

  bool operator==(const Peel&) const = default;
};

/// How volume meshes are shown, beside what they have in common with plane ones.
struct SpaceOptions {
  std::vector<CutPlane> cuts;  ///< of the open mesh
  bool crinkle = false;        ///< cuts leave whole elements
  bool perspective = false;
  int up = 2;               ///< the axis that is up on screen, 0 to 2
  bool axes = true;         ///< a small cross of axes in the corner
  bool worst = false;       ///< the worst elements are seen through what hides them
  bool free_orbit = false;  ///< the mouse turns the view about any axis, not as a turntable
  Peel peel;                ///< of the open mesh

  bool operator==(const SpaceOptions&) const = default;
};

/// From where a volume mesh is looked at, at what, and how it is cut.
struct SpaceLook {
  double azimuth = 0, elevation = 0;  ///< degrees, as ViewDirection has them
  int up = 2;
  std::array<double, 3> centre{0, 0, 0};
  double radius = 1;  ///< shown around the centre
  std::vector<CutPlane> cuts;

  bool operator==(const SpaceLook&) const = default;
};

/// The cuts that are on can be six.
inline constexpr std::size_t most_cuts = 6;

/// What the column on the right shows.
enum class SideTab { quality, view, vcv, history };

/// Light or dark interface.
enum class Lightness { light, dark };

/// What lies behind the mesh; automatic: white or nearly black, as the interface is.
enum class Backdrop { automatic, white, grey, gradient, black };

/// The state with which the present mesh is compared.
enum class BeforeState { loaded, last_command };

/// How the state before is shown in the viewport: not, as edges under the mesh, or left of a
/// divider.
enum class Comparison { none, ghost, split };

/// Elements of one side of a threshold drawn in full, the others faint.
struct Isolation {
  bool on = false;
  double threshold = 0.5;  ///< of the metric that is shown
  bool above = false;      ///< the elements above it stay; else those below
  double rest = 0.12;      ///< opacity of the others; 0 hides them

  bool operator==(const Isolation&) const = default;
};

/// Where the legend stands: in a strip of its own beside the mesh, or over a corner of it.
enum class LegendPlace { right, left, top_right, bottom_right, bottom_left, top_left };
inline bool docked(LegendPlace place) {
  return place == LegendPlace::right || place == LegendPlace::left;
}

/// An inset that shows a place at a larger scale.
struct Magnifier {
  bool on = false;
  double factor = 6;                         ///< scale of the inset over that of the viewport
  std::optional<std::array<double, 2>> pin;  ///< place that it shows; none: under the mouse

  bool operator==(const Magnifier&) const = default;
};

/// How the mesh is shown; no part of the document.
struct ViewOptions {
  std::optional<ElementField> color = Metric::normalized_jacobian;  ///< none: plain
  std::string color_map = "automatic";  ///< see ColorChoice, and the next four
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
  bool roles = false;       ///< what nodes do while the mesh is smoothed, in colours
  bool directions = false;  ///< arrows along markers, the mesh on their left
  MarkerLooks markers;      ///< what is hidden, locked or has another colour
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
  /// What the list of worst elements goes by; none: as coloured.
  std::optional<ElementField> worst_by;
  int worst_count = 20;  ///< length of that list
  Lightness lightness = Lightness::light;
  Backdrop backdrop = Backdrop::automatic;
  double scale = 0;         ///< pixels per unit of the layout; 0: as the screen wants it
  bool left_panel = true;   ///< the column on the left; false: folded to icons
  bool right_panel = true;  ///< the column on the right; false: folded to icons
  SideTab side_tab = SideTab::quality;
  bool plot_panel = true;

  bool operator==(const ViewOptions&) const = default;
};

/// The ways to draw elements, in the order in which one steps through them.
enum class ElementStyle { both, surfaces, edges };
inline ElementStyle style_of(const ViewOptions& view) {
  if (!view.fill) return ElementStyle::edges;
  return view.wireframe ? ElementStyle::both : ElementStyle::surfaces;
}
inline void set_style(ViewOptions& view, ElementStyle style) {
  view.fill = style != ElementStyle::edges;
  view.wireframe = style != ElementStyle::surfaces;
}
/// The next way.
inline void step_style(ViewOptions& view) {
  set_style(view, static_cast<ElementStyle>((static_cast<int>(style_of(view)) + 1) % 3));
}

/// The legend has a strip beside the mesh: also while edges alone are drawn, so that the mesh stays
/// where it is as one steps through the styles.
inline bool legend_has_strip(const ViewOptions& view) {
  return view.legend && view.color && docked(view.legend_place);
}

/// Scales of the interface that one can step through, pixels per unit of the layout.
inline constexpr std::array<double, 10> scales{0.75, 0.9, 1, 1.1, 1.25, 1.5, 1.75, 2, 2.5, 3};

/// How a volume mesh was looked at last, for when it is opened again.
struct KeptView {
  std::string mesh;  ///< its file, absolute
  std::array<double, 3> centre{0, 0, 0};
  double height = 1;  ///< of what is seen around the centre, units of the mesh
  double azimuth = 0, elevation = 0, roll = 0;
  int up = 2;
  std::vector<CutPlane> cuts;
  Peel peel;

  bool operator==(const KeptView&) const = default;
};

/// Meshes whose views are kept, the last first.
inline constexpr std::size_t most_kept_views = 50;

}  // namespace winslow::gui
