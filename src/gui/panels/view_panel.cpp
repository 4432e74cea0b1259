#include "gui/panels/panels.h"

#include "gui/render/color_scale.h"
#include "gui/view/mesh/mesh_colors.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

/// The labels' share of a row: labels are short, list entries long.
constexpr float view_label_share = 0.32f;

template <class T>
bool choose(const char* id, const char* label, const std::vector<std::string>& names, T& value,
            const char* tip) {
  return ui::choice(id, label, names, value, tip, view_label_share);
}

template <std::size_t count>
double nearest(const std::array<double, count>& values, double value) {
  return *std::ranges::min_element(values, {}, [&](double v) { return std::abs(v - value); });
}

struct Spread {
  const char* name;
  std::array<double, 2> percentiles;
};
constexpr std::array spreads{Spread{"All values", {0, 100}}, Spread{"1 to 99 %", {1, 99}},
                             Spread{"5 to 95 %", {5, 95}}};

/// Present ends of the colours, the initial values of a range to be set.
std::array<double, 2> ends_of(const PanelContext& context, const ViewOptions& view) {
  const auto& measured = context.session.quality().latest();
  if (!measured || measured->field != view.color) return {0, 1};
  const ColorScale scale = color_scale(*view.color, measured->values, color_choice(view));
  return {scale.low, scale.high};
}

void draw_color(const PanelContext& context, ViewOptions& view) {
  std::vector<std::string> names{"None"};
  std::vector<ElementField> fields;
  std::size_t chosen = 0;
  for (const ElementField& field : all_element_fields(context.session.kind())) {
    // Omit fields of layers for a mesh without layers.
    if (field.layer() && !context.session.mesh().layers() && view.color != field) continue;
    fields.push_back(field);
    names.emplace_back(field_info(field).label);
    if (view.color == field) chosen = fields.size();
  }
  if (!ui::choice("view/color", "Metric", names, chosen,
                  "Colour each element by its quality, or by what the virtual control volumes of "
                  "its nodes say (the worst of them).",
                  view_label_share))
    return;
  view.color = chosen == 0 ? std::nullopt : std::optional<ElementField>(fields[chosen - 1]);
  // These belong to the previous metric.
  view.range.reset();
  view.percentiles.reset();
  view.color_axis = ColorAxis::automatic;
  if (view.color) {
    Isolation isolation = isolation_for(*view.color);
    isolation.on = view.isolation.on;
    isolation.rest = view.isolation.rest;
    view.isolation = isolation;
  }
}

void draw_map(ViewOptions& view) {
  const auto maps = color_map_choices();
  std::vector<std::string> names = maps;
  names.front() = "Automatic";
  auto map = static_cast<std::size_t>(std::ranges::find(maps, view.color_map) - maps.begin());
  if (ui::choice("view/map", "Colour map", names, map,
                 "Automatic is neutral for measures of quality, where good elements recede and bad "
                 "ones catch the eye, and viridis for others and on logarithmic scales. The "
                 "colour-blind can read every map, too. Most go from dark to bright in even steps "
                 "to the eye; puor is orange below zero and purple above it: for fields with a "
                 "sign, such as the smallest weight. Plasma, magma and inferno contain red, which "
                 "inverted elements wear.",
                 view_label_share))
    view.color_map = maps[map];
  static constexpr std::array<ui::Named<int>, 7> bands{{{0, "Continuous"},
                                                        {4, "4 bands"},
                                                        {5, "5 bands"},
                                                        {8, "8 bands"},
                                                        {10, "10 bands"},
                                                        {16, "16 bands"},
                                                        {20, "20 bands"}}};
  ui::choice("view/bands", "Bands", bands, view.bands,
             "Colours run into each other, or come in steps.", view_label_share);
}

void draw_range(const PanelContext& context, ViewOptions& view) {
  choose("view/axis", "Scale", {"Automatic", "Linear", "Logarithmic"}, view.color_axis,
         "Linear: equal differences of values are equal steps of colour. Logarithmic: equal ratios "
         "are, for positive values that span decades. Automatic takes the one that shows more: "
         "logarithmic for aspect ratio, condition number and area of a mesh with boundary layers.");
  const std::size_t fixed = spreads.size() + 1;
  std::vector<std::string> names{"Automatic"};
  for (const Spread& spread : spreads) names.emplace_back(spread.name);
  names.emplace_back("From value to value");
  std::size_t chosen = view.range ? fixed : 0;
  for (std::size_t k = 0; k < spreads.size() && !view.range; ++k)
    if (view.percentiles == spreads[k].percentiles) chosen = k + 1;
  if (ui::choice("view/range", "Range", names, chosen,
                 "Values at the ends of the colours. Automatic leaves out the few most extreme "
                 "values; percentiles leave out as many as they say; a range from a value to "
                 "another stays whatever the mesh does.",
                 view_label_share)) {
    const std::array<double, 2> ends = ends_of(context, view);
    view.range.reset();
    view.percentiles.reset();
    if (chosen == fixed) view.range = ends;
    if (chosen > 0 && chosen < fixed) view.percentiles = spreads[chosen - 1].percentiles;
  }
  if (!view.range) return;
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  ui::row("", "", view_label_share);
  const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
  const auto end = [&](const char* id, double& value, const char* tip) {
    ImGui::SetNextItemWidth(width);
    double typed = value;
    if (ui::number(id, typed, tip) && std::isfinite(typed)) value = typed;
  };
  end("view/range_low", (*view.range)[0], "Value of the low end");
  ImGui::SameLine(0, gap);
  end("view/range_high", (*view.range)[1], "Value of the high end");
}

void draw_ids(ViewOptions& view) {
  ui::checkbox("view/node_ids", "Node IDs", view.node_ids,
               "Numbers of the nodes that are far enough apart on screen (Shift+I).");
  ui::second_column("Element IDs");
  ui::checkbox("view/element_ids", "Element IDs", view.element_ids,
               "Numbers of the elements that are large enough on screen (Shift+E).");
}

void draw_roles(ViewOptions& view) {
  ui::checkbox("view/roles", "What nodes do", view.roles,
               "Nodes in colours by what they do while the mesh is smoothed: stay at a corner, "
               "slide along a curve or on a surface, move as one of a periodic pair, are free. A "
               "key says which is which.");
}

void draw_elements(const PanelContext& context, ViewOptions& view) {
  ElementStyle style = style_of(view);
  if (choose("view/style", "Show", {"Surfaces and edges", "Surfaces", "Edges"}, style,
             "Draw surfaces, edges or both (W)."))
    set_style(view, style);
  constexpr std::array<double, 5> widths{0.5, 1, 1.5, 2, 3};
  static constexpr std::array<ui::Named<double>, 5> names{
      {{0.5, "0.5"}, {1, "1"}, {1.5, "1.5"}, {2, "2"}, {3, "3"}}};
  double width = nearest(widths, view.line_width);
  if (ui::choice("view/line_width", "Line width", names, width,
                 "Of edges. Where elements are smaller than a few pixels, edges fade so that the "
                 "picture does not turn black.",
                 view_label_share))
    view.line_width = width;
  ui::checkbox("view/inverted", "Inverted in red", view.mark_inverted,
               "Draw inverted elements in red above all others.");
  ui::second_column("Legend");
  ui::checkbox("view/legend", "Legend", view.legend, "Colours and their values (L).");
  if (plane_meshes.contains(context.session.kind())) {
    ui::checkbox("view/nodes", "Nodes", view.nodes, "A dot on every node.");
    return;
  }
  draw_ids(view);
  draw_roles(view);
}

void draw_boundary(const PanelContext&, ViewOptions& view) {
  ui::checkbox("view/rim_nodes", "Boundary nodes", view.rim_nodes,
               "Dots along the boundary, as close as there is room for.");
  ui::second_column("Directions");
  ui::checkbox("view/directions", "Directions", view.directions,
               "Arrows along the boundary, with the mesh on their left.");
  draw_roles(view);
  draw_ids(view);
}

void draw_space(const PanelContext&, ViewOptions& view) {
  choose("view/projection", "Projection", {"Parallel", "Perspective"}, view.space.perspective,
         "Parallel: lengths can be compared, and there is a bar that shows one. In perspective "
         "what is nearer is larger (P).");
  choose("view/up", "Upright", {"x axis", "y axis", "z axis"}, view.space.up,
         "The axis that stays upright while the view is turned.");
  choose("view/turn", "Turned", {"As on a turntable", "Freely"}, view.space.free_orbit,
         "As on a turntable: the upright axis stays upright. Freely: about any axis, so that the "
         "mesh may lie on its side (T).");
  ui::checkbox("view/axes", "Axes", view.space.axes,
               "Where the axes point, in the corner of the picture.");
  ui::second_column("Scale bar");
  ui::checkbox("view/scale_bar", "Scale bar", view.scale_bar,
               "A bar of a round length; not in perspective.");
}

void draw_comparison(const PanelContext&, ViewOptions& view) {
  choose("view/comparison", "Show", {"The mesh now", "Ghost of previous mesh", "Side by side"},
         view.comparison,
         "Lay the edges of the state before over the mesh (G), or show it left of a divider that "
         "the mouse drags (Shift+G).");
  choose("view/before", "Previous is", {"As opened", "Before last command"}, view.before,
         "The same state as in the table of the quality.");
}

void draw_magnifier(const PanelContext& context, ViewOptions& view) {
  if (ui::checkbox("view/magnifier", "Show", view.magnifier.on,
                   "A lens under the mouse (M; held down, for as long).") &&
      !view.magnifier.on)
    view.magnifier.pin.reset();
  ui::second_column("Pinned");
  bool pinned = view.magnifier.pin.has_value();
  if (ui::checkbox(
          "view/pinned", "Pinned", pinned,
          "Goes on showing the middle of the viewport; Shift+M pins what is under the mouse."))
    context.emit(action::PinMagnifier{});
  constexpr const char* tip = "How much larger; the wheel over the magnifier sets it, too.";
  ui::row("Factor", tip, view_label_share);
  ui::number("view/magnification", view.magnifier.factor, tip, "%.4g");
  if (!(view.magnifier.factor >= 2 && view.magnifier.factor <= 1000))
    view.magnifier.factor = context.view.magnifier.factor;
}

void draw_appearance(const PanelContext&, ViewOptions& view) {
  choose("view/look", "Theme", {"Light", "Dark"}, view.lightness,
         "Light or dark, for the interface and the mesh (Ctrl+D).");
  choose("view/backdrop", "Background", {"Automatic", "White", "Grey", "Gradient", "Black"},
         view.backdrop, "What lies behind the mesh. Automatic goes with the theme.");
  std::vector<std::string> names{"Automatic"};
  std::size_t scale = 0;
  for (const double s : scales) {
    if (view.scale > 0 && s == nearest(scales, view.scale)) scale = names.size();
    names.push_back(std::to_string(std::lround(100 * s)) + " %");
  }
  if (ui::choice("view/scale", "Scale", names, scale,
                 "Size of the interface. Automatic is what the screen asks for. Ctrl+plus and "
                 "Ctrl+minus step it, Ctrl+0 goes back to automatic.",
                 view_label_share))
    view.scale = scale == 0 ? 0 : scales[scale - 1];
}

/// A foldable part of the panel.
struct Part {
  const char *id, *title;
  MeshKinds serves;
  void (*draw)(const PanelContext&, ViewOptions&);
};
constexpr std::array parts{
    Part{"section/elements", "Elements", all_meshes, draw_elements},
    Part{"section/boundary", "Boundary and IDs", plane_meshes, draw_boundary},
    Part{"section/space", "Space", meshes_in_space, draw_space},
    Part{"section/comparison", "Before and after", all_meshes, draw_comparison},
    Part{"section/magnifier", "Magnifier", plane_meshes, draw_magnifier},
    Part{"section/appearance", "Appearance", all_meshes, draw_appearance}};

}  // namespace

/// How the mesh is coloured and drawn.
void draw_view(const PanelContext& context) {
  ViewOptions view = context.view;
  draw_color(context, view);
  if (view.color) {
    draw_map(view);
    draw_range(context, view);
  }
  for (const Part& part : parts)
    if (part.serves.contains(context.session.kind()) && ui::section(part.id, part.title))
      part.draw(context, view);
  context.edit(view);
}

}  // namespace winslow::gui
