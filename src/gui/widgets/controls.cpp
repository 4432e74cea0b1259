#include "gui/widgets/controls.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <cctype>

#include "gui/widgets/ui_layer.h"

namespace winslow::gui::ui {

namespace {

ImVec4 shaded(ImU32 c, float factor) {
  const ImVec4 v = rgba(c);
  return {v.x * factor, v.y * factor, v.z * factor, v.w};
}

std::string hidden(std::string_view id) { return "##" + std::string(id); }

bool disabled_now() {
  return (ImGui::GetCurrentContext()->CurrentItemFlags & ImGuiItemFlags_Disabled) != 0;
}

bool in_sight(const ImVec2& min, const ImVec2& max) {
  const ImGuiWindow* window = ImGui::GetCurrentContext()->CurrentWindow;
  // Items drawn over the mesh are in ImGui's fallback window, which does not clip them.
  if (window->IsFallbackWindow) return true;
  const ImVec2 centre((min.x + max.x) / 2, (min.y + max.y) / 2);
  if (window->ClipRect.Contains(centre)) return true;
  // A row of a table is wider than the column that it is drawn in.
  if (!ImGui::GetCurrentTable()) return false;
  for (; window;
       window = window->Flags & ImGuiWindowFlags_ChildWindow ? window->ParentWindow : nullptr)
    if (!window->InnerClipRect.Contains(centre)) return false;
  return true;
}

/// Gives a field the keyboard focus if requested. Call it before the field is drawn.
void take_keyboard(std::string_view id) {
  UiLayer& layer = UiLayer::current();
  if (layer.keyboard_wanted() != id || disabled_now()) return;
  ImGui::SetKeyboardFocusHere();
  ImGui::SetScrollHereY(0.3f);
  layer.keyboard_taken();
}

/// A field of "section/motion" begins with "motion/".
bool holds_wanted_field(std::string_view section) {
  constexpr std::string_view prefix = "section/";
  const std::string& wanted = UiLayer::current().keyboard_wanted();
  return section.starts_with(prefix) &&
         wanted.starts_with(std::string(section.substr(prefix.size())) + '/');
}

/// Position of a tooltip: beside a column, so that adjacent rows remain visible; below a wide bar.
ImVec2 tooltip_place(const ImVec2& min, const ImVec2& max, const ImVec2& size) {
  const ImGuiWindow* window = ImGui::GetCurrentContext()->CurrentWindow;
  while ((window->Flags & ImGuiWindowFlags_ChildWindow) && window->ParentWindow)
    window = window->ParentWindow;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float gap = 0.5f * ImGui::GetFontSize();
  const float left = window->Pos.x, right = window->Pos.x + window->Size.x;
  ImVec2 at(min.x, max.y + gap);
  if (right + gap + size.x <= display.x && left < display.x / 2 && right < 0.75f * display.x) {
    at = ImVec2(right + gap, min.y);
  } else if (left - gap - size.x >= 0 && left > 0.25f * display.x) {
    at = ImVec2(left - gap - size.x, min.y);
  } else if (at.y + size.y > display.y) {
    at.y = min.y - gap - size.y;
  }
  at.x = std::clamp(at.x, 0.0f, std::max(0.0f, display.x - size.x));
  at.y = std::clamp(at.y, 0.0f, std::max(0.0f, display.y - size.y));
  return at;
}

int push_button_style(ButtonStyle style, bool enabled) {
  // Disabled buttons are grey in every style.
  if (!enabled && style != ButtonStyle::flat) style = ButtonStyle::normal;
  if (style == ButtonStyle::normal) return 0;
  if (style == ButtonStyle::flat) {
    ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0, 0, 0, 0));
    ImGui::PushStyleColor(ImGuiCol_Border, ImVec4(0, 0, 0, 0));
    return 2;
  }
  const ImU32 base = style == ButtonStyle::primary ? palette().accent : palette().danger;
  ImGui::PushStyleColor(ImGuiCol_Button, rgba(base));
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, shaded(base, 0.9f));
  ImGui::PushStyleColor(ImGuiCol_ButtonActive, shaded(base, 0.8f));
  ImGui::PushStyleColor(ImGuiCol_Border, ImVec4(0, 0, 0, 0));
  ImGui::PushStyleColor(ImGuiCol_Text, palette().on_accent);
  return 5;
}

}  // namespace

void note(std::string_view id) { note(id, ImGui::GetItemRectMin(), ImGui::GetItemRectMax()); }

void note(std::string_view id, const ImVec2& min, const ImVec2& max) {
  WidgetMap& widgets = UiLayer::current().widgets();
  widgets.note(id, {ScreenPoint(min), ScreenPoint(max), !disabled_now(), in_sight(min, max)});
  if (widgets.wanted(id))
    ImGui::ScrollToBringRectIntoView(ImGui::GetCurrentContext()->CurrentWindow, ImRect(min, max));
}

void note_label(std::string_view id, float label, float room) {
  note(id);
  if (label > room + 0.5f) UiLayer::current().widgets().mark_cut(id);
}

void tooltip(std::string_view text) {
  if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  if (!UiLayer::current().rested_on(ScreenBox{ScreenPoint(min), ScreenPoint(max)})) return;
  const ImVec2 padding(10, 8);
  const float wrap = ImGui::GetFontSize() * 22.0f;
  const std::string broken = with_line_breaks(readable(text), wrap);
  const ImVec2 inner = ImGui::CalcTextSize(broken.c_str(), nullptr, false, wrap);
  const ImVec2 size(inner.x + 2 * padding.x, inner.y + 2 * padding.y);
  ImGui::SetNextWindowPos(tooltip_place(min, max, size));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ImGui::GetStyle().PopupRounding);
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(wrap + padding.x);
  ImGui::TextUnformatted(broken.c_str());
  ImGui::PopTextWrapPos();
  const ImVec2 at = ImGui::GetWindowPos(), extent = ImGui::GetWindowSize();
  ImGui::EndTooltip();
  ImGui::PopStyleVar(2);
  note("tooltip", at, ImVec2(at.x + extent.x, at.y + extent.y));
}

bool button(std::string_view id, const std::string& label, const ButtonOptions& options) {
  const int colors = push_button_style(options.style, options.enabled && !disabled_now());
  ImGui::BeginDisabled(!options.enabled);
  const bool pressed = ImGui::Button((label + "###" + std::string(id)).c_str(),
                                     ImVec2(options.width < 0 ? -FLT_MIN : options.width, 0));
  note_label(id, ImGui::CalcTextSize(label.c_str()).x, ImGui::GetItemRectSize().x);
  ImGui::EndDisabled();
  ImGui::PopStyleColor(colors);
  tooltip(options.tooltip);
  return pressed;
}

bool checkbox(std::string_view id, const std::string& label, bool& value, std::string_view tip) {
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(3, 3));
  ImGui::PushStyleColor(ImGuiCol_CheckMark,
                        disabled_now() ? palette().text_faint : palette().accent);
  const bool changed = ImGui::Checkbox((label + "###" + std::string(id)).c_str(), &value);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  note_label(id, ImGui::GetItemRectMax().x,
             ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x);
  tooltip(tip);
  return changed;
}

void row(const std::string& label, std::string_view tip, float label_share) {
  const float start = ImGui::GetCursorPosX();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::AlignTextToFramePadding();
  ImGui::PushStyleColor(ImGuiCol_Text, palette().text_dim);
  ImGui::TextUnformatted(label.c_str());
  ImGui::PopStyleColor();
  tooltip(tip);
  // A label wider than its column moves the control to the right.
  const float end =
      ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + ImGui::GetStyle().ItemInnerSpacing.x;
  ImGui::SameLine(std::max(start + width * label_share, label.empty() ? 0 : end));
  ImGui::SetNextItemWidth(-FLT_MIN);
}

bool number(std::string_view id, double& value, std::string_view tip, const char* format) {
  take_keyboard(id);
  const bool changed = ImGui::InputDouble(hidden(id).c_str(), &value, 0, 0, format);
  note(id);
  tooltip(tip);
  return changed;
}

bool number(std::string_view id, int& value, std::string_view tip) {
  take_keyboard(id);
  const bool changed = ImGui::InputInt(hidden(id).c_str(), &value, 0, 0);
  note(id);
  tooltip(tip);
  return changed;
}

float letter_width() { return ImGui::CalcTextSize("x").x + ImGui::GetStyle().ItemInnerSpacing.x; }

bool vector_field(const VectorField& field, Vec2& value, bool* enter) {
  // Six digits are too few on a mesh far from the origin.
  const char* format = value.cwiseAbs().maxCoeff() < 1e5 ? "%.6g" : "%.12g";
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float letter = letter_width();
  const float width = (ImGui::GetContentRegionAvail().x - 2 * letter - gap) / 2;
  bool changed = false;
  for (const int axis : {0, 1}) {
    if (axis == 1) ImGui::SameLine(0, gap);
    ImGui::AlignTextToFramePadding();
    text_dim(axis == 0 ? "x" : "y");
    note(std::string(axis == 0 ? field.x : field.y) + "/label");
    ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(width);
    double component = value[axis];
    if (number(axis == 0 ? field.x : field.y, component, field.tooltip, format)) {
      value[axis] = component;
      changed = true;
    }
    if (enter && entered()) *enter = true;
  }
  return changed;
}

namespace {

/// Draws a letter at the right end of the previous field, if its number leaves room.
void letter_within(const char* letter, double value, const char* format) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), format, value);
  const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
  const ImVec2 pad = ImGui::GetStyle().FramePadding;
  const float left = max.x - pad.x - ImGui::CalcTextSize(letter).x;
  if (ImGui::IsItemActive() || min.x + 2 * pad.x + ImGui::CalcTextSize(text.data()).x > left)
    return;
  ImGui::GetWindowDrawList()->AddText({left, min.y + pad.y}, palette().text_faint, letter);
}

}  // namespace

bool space_vector_field(const SpaceVectorField& field, Vec3& value, bool* enter) {
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
  constexpr std::array<const char*, 3> letters{"x", "y", "z"};
  bool changed = false;
  for (Index axis = 0; axis < 3; ++axis) {
    if (axis > 0) ImGui::SameLine(0, gap);
    const char* letter = letters[static_cast<std::size_t>(axis)];
    const std::string id = std::string(field.id) + "_" + letter;
    ImGui::SetNextItemWidth(width);
    double component = value[axis];
    constexpr const char* format = "%.5g";
    if (number(id, component, std::string(letter) + ": " + std::string(field.tooltip), format)) {
      value[axis] = component;
      changed = true;
    }
    // The letter is inside the field, since beside it there would be no room for digits.
    letter_within(letter, component, format);
    if (enter && entered()) *enter = true;
  }
  return changed;
}

bool entered() {
  return ImGui::IsItemDeactivated() && (ImGui::IsKeyPressed(GLFW_KEY_ENTER, false) ||
                                        ImGui::IsKeyPressed(GLFW_KEY_KP_ENTER, false));
}

void forget_typed_steps() {
  auto& undo = ImGui::GetCurrentContext()->InputTextState.Stb.undostate;
  undo.undo_point = 0;
  undo.undo_char_point = 0;
  undo.redo_point = IM_ARRAYSIZE(undo.undo_rec);
  undo.redo_char_point = IM_ARRAYSIZE(undo.undo_char);
}

bool section(std::string_view id, const std::string& title) {
  const Theme& theme = UiLayer::current().theme();
  std::set<std::string>& folded = UiLayer::current().folded();
  const std::string name(id);
  const bool first = ImGui::GetCursorPosY() < ImGui::GetStyle().WindowPadding.y + 1;
  if (!first) ImGui::Dummy(ImVec2(0, theme.px(6)));
  const ImVec2 min = ImGui::GetCursorScreenPos();
  const ImVec2 size(std::max(ImGui::GetContentRegionAvail().x, 1.0f), theme.px(24));
  const bool wanted = holds_wanted_field(id);
  if (wanted) folded.erase(name);
  bool open = !folded.contains(name);
  if (ImGui::InvisibleButton(name.c_str(), size)) {
    open = !open;
    if (open)
      folded.erase(name);
    else
      folded.insert(name);
  }
  note(id);
  if (wanted) ImGui::SetScrollHereY(0.1f);
  if (UiLayer::current().take_reveal(id)) ImGui::SetScrollHereY(0);
  const bool over = ImGui::IsItemHovered();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (!first)
    list.AddLine(ImVec2(min.x, min.y - theme.px(4)), ImVec2(min.x + size.x, min.y - theme.px(4)),
                 palette().border);
  const float font = theme.bold->FontSize;
  list.AddText(theme.bold, font, ImVec2(min.x, min.y + (size.y - font) / 2), palette().text,
               title.c_str());
  ImGui::RenderArrow(&list, ImVec2(min.x + size.x - font, min.y + (size.y - 0.7f * font) / 2),
                     over ? palette().text : palette().text_faint,
                     open ? ImGuiDir_Down : ImGuiDir_Right, 0.7f);
  return open;
}

bool fold(std::string_view id, const std::string& title, std::string_view tip) {
  ImGuiStorage& state = *ImGui::GetStateStorage();
  const std::string name(id);
  const ImGuiID key = ImGui::GetID(name.c_str());
  const ImVec2 min = ImGui::GetCursorScreenPos();
  const ImVec2 size(std::max(ImGui::GetContentRegionAvail().x, 1.0f), ImGui::GetFrameHeight());
  bool open = state.GetBool(key, false);
  if (ImGui::InvisibleButton(name.c_str(), size)) state.SetBool(key, open = !open);
  note(id);
  tooltip(tip);
  const bool over = ImGui::IsItemHovered();
  const float font = ImGui::GetFontSize();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = over ? palette().text : palette().text_dim;
  ImGui::RenderArrow(&list, ImVec2(min.x, min.y + (size.y - 0.7f * font) / 2), ink,
                     open ? ImGuiDir_Down : ImGuiDir_Right, 0.7f);
  list.AddText(ImVec2(min.x + 1.1f * font, min.y + (size.y - font) / 2), ink, title.c_str());
  return open;
}

void reveal(std::string_view id) {
  unfold(id);
  UiLayer::current().reveal(id);
}

void unfold(std::string_view id) { UiLayer::current().folded().erase(std::string(id)); }

void text_dim(std::string_view text) { text_colored(palette().text_dim, text); }

void text_colored(ImU32 c, std::string_view text) {
  const std::string shown = readable(text);
  ImGui::PushStyleColor(ImGuiCol_Text, c);
  ImGui::TextUnformatted(shown.c_str());
  ImGui::PopStyleColor();
}

void second_column(std::string_view label) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float end = ImGui::GetWindowContentRegionMax().x;
  const float half = 0.5f * end;
  const float last = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x;
  const float text = ImGui::CalcTextSize(label.data(), label.data() + label.size()).x;
  const float box = ImGui::GetFrameHeight() + style.ItemInnerSpacing.x;
  if (last + style.ItemSpacing.x <= half && half + box + text <= end) ImGui::SameLine(half);
}

void text_in(ImFont* font, std::string_view text) {
  const std::string shown = readable(text);
  ImGui::PushFont(font);
  ImGui::TextUnformatted(shown.c_str());
  ImGui::PopFont();
}

void text_wrapped(std::string_view text, ImU32 color) {
  const std::string broken = with_line_breaks(readable(text), ImGui::GetContentRegionAvail().x);
  ImGui::PushTextWrapPos(0);
  text_colored(color, broken);
  ImGui::PopTextWrapPos();
}

void text_right(std::string_view text, ImU32 c) {
  const float width = ImGui::CalcTextSize(text.data(), text.data() + text.size()).x;
  const float room = ImGui::GetContentRegionAvail().x;
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0f, room - width));
  text_colored(c, text);
}

void figure(std::string_view name, const std::string& value, std::string_view tip, ImU32 color) {
  text_dim(name);
  tooltip(tip);
  ImGui::SameLine();
  text_right(elided(value, ImGui::GetContentRegionAvail().x), color);
  tooltip(value + "\n" + std::string(tip));
}

namespace {

/// The text without its middle; keep: bytes of it that stay.
std::string without_middle(std::string_view text, std::size_t keep) {
  const std::size_t head = keep / 2;
  std::string cut(text.substr(0, head));
  return cut.append("...").append(text.substr(text.size() - (keep - head)));
}

}  // namespace

std::string readable(std::string_view text) {
  constexpr std::size_t longest = 2000;
  return text.size() <= longest ? std::string(text) : without_middle(text, longest);
}

std::string elided(const std::string& text, float width) {
  constexpr std::size_t longest = 4000, shortest = 4;  // no row has room for more
  const auto fits = [width](const std::string& shown) {
    return ImGui::CalcTextSize(shown.c_str()).x <= width;
  };
  if (text.size() <= longest && fits(text)) return text;
  // What is kept is searched between a number that fits and one that does not.
  std::size_t few = shortest, many = std::min(text.size(), longest);
  while (many > few + 1) {
    const std::size_t keep = few + (many - few) / 2;
    (fits(without_middle(text, keep)) ? few : many) = keep;
  }
  return few > shortest ? without_middle(text, few) : "...";
}

/// Widgets that choose one of several items: lists and tabs.

namespace {

/// The item of an open list reached with the arrow keys, and whether Enter chooses it.
struct ListKeys {
  std::size_t at = 0;
  bool moved = false, taken = false;
};
ListKeys follow_keys(std::size_t count, std::size_t chosen) {
  ImGuiStorage& state = *ImGui::GetStateStorage();
  const ImGuiID key = ImGui::GetID("list_keys");
  if (ImGui::IsWindowAppearing()) state.SetInt(key, static_cast<int>(chosen));
  const int last = static_cast<int>(count) - 1;
  const int before = std::clamp(state.GetInt(key, 0), 0, std::max(last, 0));
  int at = before;
  if (ImGui::IsKeyPressed(GLFW_KEY_DOWN)) at = std::min(at + 1, last);
  if (ImGui::IsKeyPressed(GLFW_KEY_UP)) at = std::max(at - 1, 0);
  if (ImGui::IsKeyPressed(GLFW_KEY_HOME)) at = 0;
  if (ImGui::IsKeyPressed(GLFW_KEY_END)) at = last;
  state.SetInt(key, at);
  return {
      static_cast<std::size_t>(std::max(at, 0)), at != before,
      ImGui::IsKeyPressed(GLFW_KEY_ENTER, false) || ImGui::IsKeyPressed(GLFW_KEY_KP_ENTER, false)};
}

float widest(const std::vector<std::string>& items) {
  float width = 0;
  for (const std::string& item : items)
    width = std::max(width, ImGui::CalcTextSize(item.c_str()).x);
  return width;
}

/// Starts a list that fills the rest of a row, or a separate line below the label if its longest
/// item does not fit. Returns the width for an item.
float room_for_items(float wanted) {
  const float frame = ImGui::GetStyle().FramePadding.x + ImGui::GetFrameHeight();
  const auto& next = ImGui::GetCurrentContext()->NextItemData;
  const bool fills = (next.Flags & ImGuiNextItemDataFlags_HasWidth) != 0 && next.Width < 0;
  if (!fills) return ImGui::CalcItemWidth() - frame;
  // An auto-sized window initially has no width.
  const auto* window = ImGui::GetCurrentContext()->CurrentWindow;
  const bool grows = (window->Flags & ImGuiWindowFlags_AlwaysAutoResize) != 0;
  const bool beside = !grows && ImGui::GetCursorPosX() > ImGui::GetCursorStartPos().x + 1;
  if (beside && wanted + frame > ImGui::GetContentRegionAvail().x) {
    ImGui::NewLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
  }
  return ImGui::GetContentRegionAvail().x - frame;
}

}  // namespace

bool combo(std::string_view id, const std::vector<std::string>& items, std::size_t& chosen,
           std::string_view tip) {
  const std::string preview = chosen < items.size() ? items[chosen] : std::string();
  const float wanted = widest(items);
  const float room = room_for_items(wanted);
  // Large enough to show all formats without scrolling.
  const bool open = ImGui::BeginCombo(("##" + std::string(id)).c_str(), preview.c_str(),
                                      ImGuiComboFlags_HeightLarge);
  note_label(id, wanted, room);
  if (!open) {
    tooltip(tip);
    return false;
  }
  const std::size_t before = chosen;
  const ListKeys keys = follow_keys(items.size(), chosen);
  for (std::size_t i = 0; i < items.size(); ++i) {
    // Highlight the item reached with the keys; ImGui highlights the item under the mouse.
    if (ImGui::Selectable(items[i].c_str(), i == keys.at)) chosen = i;
    note(std::string(id) + "/" + items[i]);
    if (i == before && ImGui::IsWindowAppearing()) ImGui::SetItemDefaultFocus();
    if (i == keys.at && keys.moved) ImGui::SetScrollHereY();
  }
  if (keys.taken && keys.at < items.size()) {
    chosen = keys.at;
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndCombo();
  return chosen != before;
}

bool choice(std::string_view id, const std::string& label, const std::vector<std::string>& items,
            std::size_t& chosen, std::string_view tip, float label_share) {
  row(label, tip, label_share);
  return combo(id, items, chosen, tip);
}

bool tabs(std::string_view id, const std::vector<Tab>& items, std::size_t& chosen) {
  const Theme& theme = UiLayer::current().theme();
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x / static_cast<float>(items.size());
  const float height = theme.px(28);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddLine(ImVec2(start.x, start.y + height),
               ImVec2(start.x + width * static_cast<float>(items.size()), start.y + height),
               palette().border);
  bool changed = false;
  for (std::size_t k = 0; k < items.size(); ++k) {
    std::string name(id);
    name += '/';
    for (char c : items[k].label)
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const ImVec2 min(start.x + width * static_cast<float>(k), start.y);
    ImGui::SetCursorScreenPos(min);
    if (ImGui::InvisibleButton(name.c_str(), ImVec2(std::max(width, 1.0f), height)) &&
        k != chosen) {
      chosen = k;
      changed = true;
    }
    note(name);
    const bool over = ImGui::IsItemHovered();
    tooltip(items[k].tooltip);
    const bool present = k == chosen;
    ImFont* font = present ? theme.bold : theme.regular;
    const ImVec2 size = font->CalcTextSizeA(font->FontSize, 1e6f, 0, items[k].label.c_str());
    list.AddText(font, font->FontSize,
                 ImVec2(min.x + (width - size.x) / 2, min.y + (height - size.y) / 2),
                 present || over ? palette().text : palette().text_dim, items[k].label.c_str());
    if (present)
      list.AddRectFilled(ImVec2(min.x, min.y + height - theme.px(2)),
                         ImVec2(min.x + width, min.y + height), palette().accent);
  }
  ImGui::SetCursorScreenPos(ImVec2(start.x, start.y + height + theme.px(8)));
  return changed;
}

std::string with_line_breaks(std::string_view text, float width) {
  std::string broken;
  std::size_t line = 0;  // start of the line in `broken`
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
    const std::string word(text.substr(at, end - at));
    const std::string longer = broken.substr(line) + word;
    const bool fits = ImGui::CalcTextSize(longer.c_str()).x <= width;
    if (!fits && broken.size() > line && broken.back() == ' ') {
      broken.back() = '\n';
      line = broken.size();
    }
    broken += word;
    if (end < text.size()) broken += text[end];
    if (end < text.size() && text[end] == '\n') line = broken.size();
    at = end + 1;
  }
  return broken;
}

}  // namespace winslow::gui::ui
