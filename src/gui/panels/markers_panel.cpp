#include "gui/panels/panels.h"

#include "gui/base/text.h"
#include "gui/menu/bodies.h"
#include "gui/panels/marker_roles.h"
#include "gui/settings/option_edits.h"
#include "gui/view/mesh/mesh_colors.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

constexpr const char* colors_popup = "###marker_colors";
constexpr const char* other_popup = "###other_marker_color";

ImU32 color_u32(const Rgb& c) {
  return ImGui::ColorConvertFloat4ToU32(ImVec4(c[0], c[1], c[2], 1));
}

/// A square button of a row.
struct RowButton {
  std::string id;
  std::string glyph;
  std::string tooltip;
  bool lit = false;    ///< its state is not the default
  float x = 0, y = 0;  ///< top left corner, pixels
  float side = 0;
};
bool row_button(const RowButton& button) {
  ImGui::SetCursorScreenPos(ImVec2(button.x, button.y));
  const bool pressed = ImGui::InvisibleButton(button.id.c_str(), ImVec2(button.side, button.side));
  ui::note(button.id);
  const bool over = ImGui::IsItemHovered();
  ui::tooltip(button.tooltip);
  const ImVec2 size = ImGui::CalcTextSize(button.glyph.c_str());
  const ImU32 ink = over ? palette().accent : button.lit ? palette().text : palette().text_faint;
  ImGui::GetWindowDrawList()->AddText(
      ImVec2(button.x + (button.side - size.x) / 2, button.y + (button.side - size.y) / 2), ink,
      button.glyph.c_str());
  return pressed;
}

std::string glyph_of(const Theme& theme, Icon icon, const char* letter) {
  const std::string glyph = theme.icon(icon);
  return glyph.empty() ? letter : glyph;
}

/// Draws eye and padlock at the end of a row. Returns their left end.
float draw_row_buttons(const PanelContext& context, Index marker, const ImVec2& start,
                       const ImVec2& end) {
  const std::string& name = context.topology()->markers()[static_cast<std::size_t>(marker)].name;
  const MarkerLook look = context.view.markers.of(name);
  const float side = end.y - start.y;
  const auto button = [&](const char* id, Icon icon, const char* letter, const std::string& tip,
                          bool lit, float x) {
    return row_button(
        {id + name, glyph_of(context.theme, icon, letter), tip, lit, x, start.y, side});
  };
  if (button("marker_hide/", look.hidden ? Icon::hide : Icon::view, "v",
             look.hidden ? "Draw " + name + " again."
                         : "Hide " + name + ": it is not drawn, and the mouse passes through it.",
             look.hidden, end.x - 2 * side))
    change_looks(context, {marker}, [](MarkerLook& l) { l.hidden = !l.hidden; });
  if (button("marker_lock/", look.locked ? Icon::lock : Icon::unlock, "l",
             look.locked ? "Unlock " + name + "."
                         : "Lock " + name + ": the mouse neither selects nor moves it.",
             look.locked, end.x - side))
    change_looks(context, {marker}, [](MarkerLook& l) { l.locked = !l.locked; });
  return end.x - 2 * side;
}

struct RowRect {
  ImVec2 min, max;
};
void draw_name(const std::string& name, bool hidden, const Theme& theme, const RowRect& rect) {
  const std::string text = ui::elided(name, rect.max.x - theme.px(6) - rect.min.x);
  ImGui::GetWindowDrawList()->AddText(ImVec2(rect.min.x, rect.min.y + theme.px(6)),
                                      hidden ? palette().text_faint : palette().text, text.c_str());
}

std::string tip_of_row(const PanelContext& context, const Marker& marker, bool locked) {
  const MeshKind kind = context.session.kind();
  std::string tip = "Click to select " + marker.name;
  if (locked)
    tip = marker.name + " is locked: unlock it to select it.";
  else if (kind == MeshKind::surface)
    tip += ". A double click looks at it, a right click offers more.";
  else
    tip +=
        ": selected bodies move, the others stay. Ctrl+click adds or removes, a double click looks "
        "at it, a right click offers more.";
  return tip + "\n" + counted(marker.faces.size(), kind == MeshKind::volume ? "face" : "edge") +
         ", tag " + std::to_string(marker.tag);
}

/// The list of markers with their colours, visibility, locks and roles.
class MarkersPanel {
 public:
  void draw(const PanelContext& context) {
    const bool surface = context.session.kind() == MeshKind::surface;
    if (!ui::section("section/markers", surface ? "Borders and features" : "Bodies and markers"))
      return;
    const Topology* topology = context.topology();
    if (!topology) return ui::text_dim("No mesh is open.");
    const auto count = static_cast<Index>(topology->markers().size());
    if (count == 0 && surface) {
      ui::text_wrapped("The surface is closed: it has no border.");
      ui::note("markers/closed");
      return draw_role_settings(context, roles_previewed_);
    }
    if (!topology->markers().from_file())
      ui::text_wrapped("The file names no markers; each boundary loop is listed as one.");
    const float row = ImGui::GetTextLineHeight() + 2 * context.theme.px(6);
    const float height = row * static_cast<float>(std::clamp(count, 1, 8)) + context.theme.px(4);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(2, 2));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
    ImGui::BeginChild("markers", ImVec2(0, height), true);
    for (Index m = 0; m < count; ++m) draw_row(context, m);
    ImGui::PopStyleVar(2);
    // Open the second popup after the first has closed, so that it is placed separately.
    if (draw_colors(context)) ImGui::OpenPopup(other_popup);
    draw_other_color(context);
    ImGui::EndChild();
    draw_role_settings(context, roles_previewed_);
  }

 private:
  void draw_row(const PanelContext& context, Index marker) {
    const Marker& data = context.topology()->markers()[static_cast<std::size_t>(marker)];
    const MarkerLook look = context.view.markers.of(data.name);
    const bool selected = context.session.selection().contains(marker);
    const auto& hovered = context.session.selection().hovered();
    const bool lit = std::find(hovered.begin(), hovered.end(), marker) != hovered.end();
    const float pad = context.theme.px(6);
    const ImVec2 start = ImGui::GetCursorScreenPos();
    const ImVec2 end(start.x + ImGui::GetContentRegionAvail().x,
                     start.y + ImGui::GetTextLineHeight() + 2 * pad);
    const float side = end.y - start.y;

    ImGui::PushID(marker);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float round = context.theme.px(4);
    if (selected) list.AddRectFilled(start, end, palette().accent_soft, round);

    const bool recolour = row_button({"marker_color/" + data.name, "",
                                      "The colour of " + data.name + ": click to choose another.",
                                      false, start.x, start.y, side});
    if (recolour) {
      coloured_ = data.name;
      ImGui::PopID();
      ImGui::OpenPopup(colors_popup);
      ImGui::PushID(marker);
    }
    const ImVec2 middle(start.x + side / 2, start.y + side / 2);
    const float half = context.theme.px(6);
    list.AddRectFilled(ImVec2(middle.x - half, middle.y - half),
                       ImVec2(middle.x + half, middle.y + half),
                       color_u32(color_of_marker(context.view, data.name, marker, palette().dark)),
                       context.theme.px(3));

    const float tools = draw_row_buttons(context, marker, start, end);
    // Markers of a surface mesh have no role: features determine the roles of their nodes.
    const bool surface = context.session.kind() == MeshKind::surface;
    const float role = surface ? tools : tools - role_width(context.theme);
    if (!surface) draw_role(context, marker, ImVec2(role, start.y), ImVec2(tools, end.y));
    ImGui::SetCursorScreenPos(ImVec2(start.x + side, start.y));
    const bool pressed = ImGui::InvisibleButton("row", ImVec2(role - start.x - side, side));
    ui::note("marker/" + data.name);
    const bool over = ImGui::IsItemHovered();
    ui::tooltip(tip_of_row(context, data, look.locked));
    const bool asked = ImGui::IsItemClicked(ImGuiMouseButton_Right);
    ImGui::PopID();
    if (asked) context.emit(action::ShowContextMenu{PickedPlace{{}, {marker}, {}, {}}});
    if (pressed && !look.locked)
      context.emit(action::SelectMarkers{{marker}, ImGui::GetIO().KeyCtrl});
    if (over && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
      context.emit(action::FitMarkers{{marker}});
    if (over || lit) list.AddRectFilled(start, end, faded(palette().accent, 0.07f), round);

    draw_name(data.name, look.hidden, context.theme,
              {ImVec2(start.x + side + context.theme.px(2), start.y), ImVec2(role, end.y)});
    ImGui::SetCursorScreenPos(ImVec2(start.x, end.y));
  }

  /// Begins the popup that sets a marker's colour. Returns the marker; none: it is not open.
  std::optional<Index> begin_popup(const PanelContext& context, const char* popup) const {
    const float pad = context.theme.px(8);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(pad, pad));
    const bool open = ImGui::BeginPopup(popup);
    ImGui::PopStyleVar();
    if (!open) return std::nullopt;
    const auto marker = context.topology()->markers().find(coloured_);
    if (!marker || ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) {
      ImGui::CloseCurrentPopup();
      ImGui::EndPopup();
      return std::nullopt;
    }
    ui::text_dim("Colour of " + coloured_);
    return marker;
  }

  /// Draws colours that are distinguishable on light and dark backgrounds. True if the user wants
  /// another colour.
  bool draw_colors(const PanelContext& context) {
    static constexpr std::array<std::pair<const char*, Rgb>, 10> choices{
        {{"Blue", {0.15f, 0.39f, 0.92f}},
         {"Sky", {0.20f, 0.65f, 0.90f}},
         {"Green", {0.10f, 0.62f, 0.35f}},
         {"Teal", {0.05f, 0.58f, 0.55f}},
         {"Orange", {0.92f, 0.45f, 0.10f}},
         {"Gold", {0.80f, 0.62f, 0.05f}},
         {"Red", {0.85f, 0.18f, 0.20f}},
         {"Magenta", {0.80f, 0.25f, 0.62f}},
         {"Violet", {0.48f, 0.32f, 0.88f}},
         {"Grey", {0.50f, 0.53f, 0.58f}}}};
    const auto marker = begin_popup(context, colors_popup);
    if (!marker) return false;
    const auto paint = [&](const std::optional<Rgb>& color) {
      change_looks(context, {*marker}, [&](MarkerLook& look) { look.color = color; });
      ImGui::CloseCurrentPopup();
    };
    const float side = context.theme.px(26);
    for (std::size_t k = 0; k < choices.size(); ++k) {
      if (k % 5 != 0) ImGui::SameLine(0, context.theme.px(6));
      const auto& [name, color] = choices[k];
      if (ImGui::InvisibleButton(name, ImVec2(side, side))) paint(color);
      ui::note(std::string("marker_color/choice/") + name);
      const ImVec2 min = ImGui::GetItemRectMin();
      const ImVec2 max = ImGui::GetItemRectMax();
      ImDrawList& list = *ImGui::GetWindowDrawList();
      list.AddRectFilled(min, max, color_u32(color), context.theme.px(4));
      if (ImGui::IsItemHovered())
        list.AddRect(min, max, palette().text, context.theme.px(4), 0, context.theme.px(2));
      ui::tooltip(name);
    }
    const bool other =
        ui::button("marker_color/other", "Other colour...",
                   {"Any colour, by hue or as #rrggbb.", ui::ButtonStyle::normal, true, -1});
    if (other) ImGui::CloseCurrentPopup();
    if (ui::button("marker_color/automatic", "Automatic colour",
                   {"The colour that it has by its place in the list.", ui::ButtonStyle::normal,
                    true, -1}))
      paint({});
    if (context.session.kind() == MeshKind::volume) draw_surface(context, *marker);
    ImGui::EndPopup();
    return other;
  }

  /// Draws a picker for any colour, previewed on the marker.
  void draw_other_color(const PanelContext& context) {
    const auto marker = begin_popup(context, other_popup);
    if (!marker) return;
    Rgb color = color_of_marker(context.view, coloured_, *marker, palette().dark);
    constexpr auto flags = ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoSmallPreview |
                           ImGuiColorEditFlags_NoLabel | ImGuiColorEditFlags_NoOptions |
                           ImGuiColorEditFlags_NoAlpha | ImGuiColorEditFlags_DisplayHex |
                           ImGuiColorEditFlags_InputRGB | ImGuiColorEditFlags_PickerHueBar;
    ImGui::BeginGroup();
    ImGui::SetNextItemWidth(context.theme.px(200));
    if (ImGui::ColorPicker3("##other", color.data(), flags))
      change_looks(context, {*marker}, [&](MarkerLook& look) { look.color = color; });
    ImGui::EndGroup();
    ui::note("marker_color/picker");
    if (ui::button("marker_color/done", "Done",
                   {"Keep this colour.", ui::ButtonStyle::primary, true, -1}))
      ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
  }

  /// Draws the options for the marker's surface in space.
  void draw_surface(const PanelContext& context, Index marker) const {
    const MarkerLook look = context.view.markers.of(coloured_);
    constexpr const char* tip =
        "By its role: a body as a surface, what encloses bodies as an outline.";
    auto drawing = static_cast<std::size_t>(look.drawing);
    ImGui::SetNextItemWidth(context.theme.px(162));
    if (ui::combo("marker_color/drawing", {"Drawn by its role", "As a surface", "As an outline"},
                  drawing, tip))
      change_looks(context, {marker},
                   [&](MarkerLook& l) { l.drawing = static_cast<MarkerDrawing>(drawing); });
    int percent = static_cast<int>(std::lround(100 * look.opacity));
    ImGui::SetNextItemWidth(context.theme.px(162));
    if (ImGui::SliderInt("##marker_color/opacity", &percent, 10, 100, "%d %% opaque"))
      change_looks(context, {marker}, [&](MarkerLook& l) {
        l.opacity = percent / 100.0;
        if (l.drawing == MarkerDrawing::outline) l.drawing = MarkerDrawing::surface;
      });
    ui::note("marker_color/opacity");
    ui::tooltip("How much of what lies behind the surface it hides.");
  }

  bool roles_previewed_ = false;  // by settings edited below the list
  std::string coloured_;          // marker whose colour is being chosen
};

}  // namespace

DrawPanel markers_panel() { return panel_of<MarkersPanel>(); }

}  // namespace winslow::gui
