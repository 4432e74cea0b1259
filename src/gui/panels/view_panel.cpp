#include "gui/panels/view_panel.h"

#include "gui/render/color_scale.h"
#include "gui/view/mesh/mesh_colors.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// Labels are short here, and what is chosen has long names.
void row(const char* label, const char* tip = "") { ui::row(label, tip, 0.32f); }

constexpr std::array<double, 5> line_widths{0.5, 1, 1.5, 2, 3};

template <std::size_t count>
std::size_t nearest(const std::array<double, count>& values, double value) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < count; ++k)
    if (std::abs(values[k] - value) < std::abs(values[best] - value)) best = k;
  return best;
}

struct Spread {
  const char* name;
  std::array<double, 2> percentiles;
};
constexpr std::array spreads{Spread{"All values", {0, 100}}, Spread{"1 to 99 %", {1, 99}},
                             Spread{"5 to 95 %", {5, 95}}};

/// Ends of the colours as they are now: a range that is to be set begins there.
std::array<double, 2> ends_of(const PanelContext& context, const ViewOptions& view) {
  const auto& measured = context.session.quality().latest();
  if (!measured || measured->field != view.color) return {0, 1};
  const ColorScale scale = color_scale(*view.color, measured->values, color_choice(view));
  return {scale.low, scale.high};
}

}  // namespace

void ViewPanel::draw(const PanelContext& context) {
  ViewOptions view = context.view;
  bool changed = draw_color(context, view);
  if (view.color) {
    changed |= draw_map(view);
    changed |= draw_range(context, view);
  }
  const bool in_space = context.session.in_space();
  changed |= draw_elements(view, in_space);
  if (in_space) {
    changed |= draw_space(view);
    changed |= draw_comparison(view);
  } else {
    changed |= draw_boundary(view);
    changed |= draw_comparison(view);
    changed |= draw_magnifier(context, view);
  }
  changed |= draw_appearance(view);
  if (changed) context.emit(action::EditView{difference(context.view, view)});
}

bool ViewPanel::draw_color(const PanelContext& context, ViewOptions& view) {
  std::vector<std::string> names{"None"};
  std::vector<ElementField> fields;
  std::size_t chosen = 0;
  for (const ElementField& field : all_element_fields(context.session.kind())) {
    // Of layers there is nothing to see where there are none.
    if (field.layer() && !context.session.mesh().layers() && view.color != field) continue;
    fields.push_back(field);
    names.emplace_back(field_info(field).label);
    if (view.color == field) chosen = fields.size();
  }
  constexpr const char* tip =
      "Colour each element by its quality, or by what the virtual control volumes of its nodes say "
      "(the worst of them).";
  row("Metric", tip);
  if (!ui::combo("view/color", names, chosen, tip)) return false;
  view.color = chosen == 0 ? std::nullopt : std::optional<ElementField>(fields[chosen - 1]);
  // Of the metric before.
  view.range.reset();
  view.percentiles.reset();
  view.color_axis = ColorAxis::automatic;
  if (view.color) {
    Isolation isolation = isolation_for(*view.color);
    isolation.on = view.isolation.on;
    isolation.rest = view.isolation.rest;
    view.isolation = isolation;
  }
  return true;
}

bool ViewPanel::draw_map(ViewOptions& view) {
  bool changed = false;
  const auto maps = color_map_choices();
  std::vector<std::string> names = maps;
  names.front() = "Automatic";
  auto map =
      static_cast<std::size_t>(std::find(maps.begin(), maps.end(), view.color_map) - maps.begin());
  constexpr const char* map_tip =
      "Automatic is neutral for measures of quality, where good elements recede and bad ones catch "
      "the eye, and viridis for others and on logarithmic scales. The colour-blind can read every "
      "map, too. Most go from "
      "dark "
      "to bright in even steps to the eye; puor is orange below zero and purple above it: for "
      "fields with a sign, such as the smallest weight. Plasma, magma and inferno contain red, "
      "which inverted elements wear.";
  row("Colour map", map_tip);
  if (ui::combo("view/map", names, map, map_tip)) {
    view.color_map = maps[map];
    changed = true;
  }
  constexpr std::array<int, 7> band_counts{0, 4, 5, 8, 10, 16, 20};
  const std::vector<std::string> band_names{"Continuous", "4 bands",  "5 bands", "8 bands",
                                            "10 bands",   "16 bands", "20 bands"};
  auto bands =
      static_cast<std::size_t>(std::ranges::find(band_counts, view.bands) - band_counts.begin());
  constexpr const char* bands_tip = "Colours run into each other, or come in steps.";
  row("Bands", bands_tip);
  if (ui::combo("view/bands", band_names, bands, bands_tip)) {
    view.bands = band_counts[bands];
    changed = true;
  }
  return changed;
}

bool ViewPanel::draw_range(const PanelContext& context, ViewOptions& view) {
  bool changed = false;
  constexpr const char* axis_tip =
      "Linear: equal differences of values are equal steps of colour. Logarithmic: equal ratios "
      "are, for positive values that span decades. Automatic takes the one that shows more: "
      "logarithmic for aspect ratio, condition number and area of a mesh with boundary layers.";
  auto axis = static_cast<std::size_t>(view.color_axis);
  row("Scale", axis_tip);
  if (ui::combo("view/axis", {"Automatic", "Linear", "Logarithmic"}, axis, axis_tip)) {
    view.color_axis = static_cast<ColorAxis>(axis);
    changed = true;
  }
  constexpr const char* tip =
      "Values at the ends of the colours. Automatic leaves out the few most extreme values; "
      "percentiles leave out as many as they say; a range from a value to another stays whatever "
      "the mesh does.";
  const std::size_t fixed = spreads.size() + 1;
  std::vector<std::string> names{"Automatic"};
  for (const Spread& spread : spreads) names.emplace_back(spread.name);
  names.emplace_back("From value to value");
  std::size_t chosen = view.range ? fixed : 0;
  for (std::size_t k = 0; k < spreads.size() && !view.range; ++k)
    if (view.percentiles == spreads[k].percentiles) chosen = k + 1;
  row("Range", tip);
  if (ui::combo("view/range", names, chosen, tip)) {
    const std::array<double, 2> ends = ends_of(context, view);
    view.range.reset();
    view.percentiles.reset();
    if (chosen == fixed) view.range = ends;
    if (chosen > 0 && chosen < fixed) view.percentiles = spreads[chosen - 1].percentiles;
    changed = true;
  }
  if (view.range) {
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    row("");
    const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
    ImGui::SetNextItemWidth(width);
    changed |= ui::number("view/range_low", (*view.range)[0], "Value of the low end");
    ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(width);
    changed |= ui::number("view/range_high", (*view.range)[1], "Value of the high end");
  }
  return changed;
}

bool ViewPanel::draw_elements(ViewOptions& view, bool in_space) {
  if (!ui::section("section/elements", "Elements")) return false;
  constexpr const char* tip = "Draw surfaces, edges or both (W).";
  auto style = static_cast<std::size_t>(style_of(view));
  row("Show", tip);
  bool changed = ui::combo("view/style", {"Surfaces and edges", "Surfaces", "Edges"}, style, tip);
  if (changed) set_style(view, static_cast<ElementStyle>(style));
  constexpr const char* width_tip =
      "Of edges. Where elements are smaller than a few pixels, edges fade so that the picture does "
      "not turn black.";
  row("Line width", width_tip);
  std::size_t width = nearest(line_widths, view.line_width);
  if (ui::combo("view/line_width", {"0.5", "1", "1.5", "2", "3"}, width, width_tip)) {
    view.line_width = line_widths[width];
    changed = true;
  }
  changed |= ui::checkbox("view/inverted", "Inverted in red", view.mark_inverted,
                          "Draw inverted elements in red above all others.");
  ui::second_column("Legend");
  changed |= ui::checkbox("view/legend", "Legend", view.legend, "Colours and their values (L).");
  if (!in_space) changed |= ui::checkbox("view/nodes", "Nodes", view.nodes, "A dot on every node.");
  if (in_space) {
    changed |= draw_ids(view);
    changed |= draw_roles(view);
  }
  return changed;
}

bool ViewPanel::draw_space(ViewOptions& view) {
  if (!ui::section("section/space", "Space")) return false;
  constexpr const char* tip =
      "Parallel: lengths can be compared, and there is a bar that shows one. In perspective what "
      "is "
      "nearer is larger (P).";
  std::size_t how = view.space.perspective ? 1 : 0;
  row("Projection", tip);
  bool changed = ui::combo("view/projection", {"Parallel", "Perspective"}, how, tip);
  view.space.perspective = how == 1;
  constexpr const char* up_tip = "The axis that stays upright while the view is turned.";
  auto up = static_cast<std::size_t>(view.space.up);
  row("Upright", up_tip);
  changed |= ui::combo("view/up", {"x axis", "y axis", "z axis"}, up, up_tip);
  view.space.up = static_cast<int>(up);
  constexpr const char* turn_tip =
      "As on a turntable: the upright axis stays upright. Freely: about any axis, so that the mesh "
      "may lie on its side (T).";
  std::size_t turn = view.space.free_orbit ? 1 : 0;
  row("Turned", turn_tip);
  changed |= ui::combo("view/turn", {"As on a turntable", "Freely"}, turn, turn_tip);
  view.space.free_orbit = turn == 1;
  changed |= ui::checkbox("view/axes", "Axes", view.space.axes,
                          "Where the axes point, in the corner of the picture.");
  ui::second_column("Scale bar");
  changed |= ui::checkbox("view/scale_bar", "Scale bar", view.scale_bar,
                          "A bar of a round length; not in perspective.");
  return changed;
}

bool ViewPanel::draw_boundary(ViewOptions& view) {
  if (!ui::section("section/boundary", "Boundary and IDs")) return false;
  bool changed = ui::checkbox("view/rim_nodes", "Boundary nodes", view.rim_nodes,
                              "Dots along the boundary, as close as there is room for.");
  ui::second_column("Directions");
  changed |= ui::checkbox("view/directions", "Directions", view.directions,
                          "Arrows along the boundary, with the mesh on their left.");
  changed |= draw_roles(view);
  return draw_ids(view) || changed;
}

bool ViewPanel::draw_roles(ViewOptions& view) {
  return ui::checkbox(
      "view/roles", "What nodes do", view.roles,
      "Nodes in colours by what they do while the mesh is smoothed: stay at a "
      "corner, slide along a curve or on a surface, move as one of a periodic pair, "
      "are free. A key says which is which.");
}

bool ViewPanel::draw_ids(ViewOptions& view) {
  bool changed =
      ui::checkbox("view/node_ids", "Node IDs", view.node_ids,
                   "Numbers of the nodes that are far enough apart on screen (Shift+I).");
  ui::second_column("Element IDs");
  changed |= ui::checkbox("view/element_ids", "Element IDs", view.element_ids,
                          "Numbers of the elements that are large enough on screen (Shift+E).");
  return changed;
}

bool ViewPanel::draw_comparison(ViewOptions& view) {
  if (!ui::section("section/comparison", "Before and after")) return false;
  constexpr const char* tip =
      "Lay the edges of the state before over the mesh (G), or show it left of a divider that the "
      "mouse drags (Shift+G).";
  auto how = static_cast<std::size_t>(view.comparison);
  row("Show", tip);
  bool changed = ui::combo("view/comparison",
                           {"The mesh now", "Ghost of previous mesh", "Side by side"}, how, tip);
  view.comparison = static_cast<Comparison>(how);
  auto which = static_cast<std::size_t>(view.before);
  constexpr const char* before_tip = "The same state as in the table of the quality.";
  row("Previous is", before_tip);
  changed |= ui::combo("view/before", {"As opened", "Before last command"}, which, before_tip);
  view.before = static_cast<BeforeState>(which);
  return changed;
}

bool ViewPanel::draw_magnifier(const PanelContext& context, ViewOptions& view) {
  if (!ui::section("section/magnifier", "Magnifier")) return false;
  bool changed = ui::checkbox("view/magnifier", "Show", view.magnifier.on,
                              "A lens under the mouse (M; held down, for as long).");
  if (changed && !view.magnifier.on) view.magnifier.pin.reset();
  ui::second_column("Pinned");
  bool pinned = view.magnifier.pin.has_value();
  if (ui::checkbox("view/pinned", "Pinned", pinned,
                   "Goes on showing the middle of the viewport; Shift+M pins what is under the "
                   "mouse."))
    context.emit(action::PinMagnifier{});
  constexpr const char* tip = "How much larger; the wheel over the magnifier sets it, too.";
  row("Factor", tip);
  changed |= ui::number("view/magnification", view.magnifier.factor, tip, "%.4g");
  if (!(view.magnifier.factor >= 2 && view.magnifier.factor <= 1000))
    view.magnifier.factor = context.view.magnifier.factor;
  return changed;
}

bool ViewPanel::draw_appearance(ViewOptions& view) {
  if (!ui::section("section/appearance", "Appearance")) return false;
  auto look = static_cast<std::size_t>(view.lightness);
  constexpr const char* look_tip = "Light or dark, for the interface and the mesh (Ctrl+D).";
  row("Theme", look_tip);
  bool changed = ui::combo("view/look", {"Light", "Dark"}, look, look_tip);
  auto backdrop = static_cast<std::size_t>(view.backdrop);
  constexpr const char* backdrop_tip = "What lies behind the mesh. Automatic goes with the theme.";
  row("Background", backdrop_tip);
  changed |= ui::combo("view/backdrop", {"Automatic", "White", "Grey", "Gradient", "Black"},
                       backdrop, backdrop_tip);
  std::vector<std::string> names{"Automatic"};
  for (double s : scales) names.push_back(std::to_string(std::lround(100 * s)) + " %");
  std::size_t scale = view.scale > 0 ? nearest(scales, view.scale) + 1 : 0;
  constexpr const char* scale_tip =
      "Size of the interface. Automatic is what the screen asks for. Ctrl+plus and Ctrl+minus step "
      "it, Ctrl+0 goes back to automatic.";
  row("Scale", scale_tip);
  if (ui::combo("view/scale", names, scale, scale_tip)) {
    view.scale = scale == 0 ? 0 : scales[scale - 1];
    changed = true;
  }
  view.lightness = static_cast<Lightness>(look);
  view.backdrop = static_cast<Backdrop>(backdrop);
  return changed;
}

}  // namespace winslow::gui
