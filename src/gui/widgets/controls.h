#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gui/widgets/theme.h"

/// The widgets that panels are made of: Dear ImGui's, in the studio's dress. Each has an id under
/// which scripts find it, and a tooltip where a newcomer would hesitate.
namespace winslow::gui::ui {

/// Remembers where the last item is under an id.
void note(std::string_view id);
/// The same for any rectangle.
void note(std::string_view id, const ImVec2& min, const ImVec2& max);
/// note() of the last item whose label, `label` pixels wide, has `room` of them.
void note_label(std::string_view id, float label, float room);
/// Shown when the mouse rests on the last item; wrapped; nothing if empty.
void tooltip(std::string_view text);

enum class ButtonStyle { normal, primary, danger, flat };
struct ButtonOptions {
  std::string tooltip;
  ButtonStyle style = ButtonStyle::normal;
  bool enabled = true;
  float width = 0;  ///< pixels; 0: as wide as the label, -1: the rest of the row
};
bool button(std::string_view id, const std::string& label, const ButtonOptions& options = {});

bool checkbox(std::string_view id, const std::string& label, bool& value,
              std::string_view tip = {});

/// Starts a row "label   control": the control takes the rest of the row.
void row(const std::string& label, std::string_view tip = {}, float label_share = 0.42f);
/// Fields for numbers, as wide as set before. True when the value has changed.
bool number(std::string_view id, double& value, std::string_view tip = {},
            const char* format = "%.6g");
bool number(std::string_view id, int& value, std::string_view tip = {});
/// What the letter before a component of a vector takes, pixels.
float letter_width();
/// Two fields for the components of a vector, labelled x and y, side by side in the rest of the
/// row.
struct VectorField {
  std::string_view x, y;  ///< ids
  std::string_view tooltip;
};
/// True when the value has changed. entered: set if Enter was pressed in one of them.
bool vector_field(const VectorField& field, Vec2& value, bool* entered = nullptr);
/// Three fields, of a vector in space, in a row without a label; z may be as narrow as the others.
struct SpaceVectorField {
  std::string_view id;  ///< of the fields: with "_x", "_y", "_z" after it
  std::string_view tooltip;
};
bool space_vector_field(const SpaceVectorField& field, Vec3& value, bool* entered = nullptr);
/// Enter was pressed in the last field, which ends the typing there.
bool entered();
/// For the callback of a text field that has put another text in place of what was typed: the undo
/// steps of Dear ImGui belong to the old one.
void forget_typed_steps();
bool combo(std::string_view id, const std::vector<std::string>& items, std::size_t& chosen,
           std::string_view tip = {});

/// A row with such a list: "label   control". True when another item was chosen.
bool choice(std::string_view id, const std::string& label, const std::vector<std::string>& items,
            std::size_t& chosen, std::string_view tip = {}, float label_share = 0.42f);
/// The same for an enumeration, a switch or a number that counts the items from 0.
template <class T>
requires std::is_enum_v<T> || std::integral<T>
bool choice(std::string_view id, const std::string& label, const std::vector<std::string>& items,
            T& value, std::string_view tip = {}, float label_share = 0.42f) {
  auto chosen = static_cast<std::size_t>(value);
  const bool changed = choice(id, label, items, chosen, tip, label_share);
  if (changed) value = static_cast<T>(chosen);
  return changed;
}
/// The same for a value of a list; one that is not in it is shown as the item `otherwise`.
template <class T>
struct Named {
  T value;
  const char* name;
};
template <class T, std::size_t count>
bool choice(std::string_view id, const std::string& label, const std::array<Named<T>, count>& items,
            T& value, std::string_view tip = {}, float label_share = 0.42f,
            std::size_t otherwise = 0) {
  std::vector<std::string> names;
  std::size_t chosen = otherwise;
  for (const auto& [each, name] : items) {
    if (each == value) chosen = names.size();
    names.emplace_back(name);
  }
  const bool changed = choice(id, label, names, chosen, tip, label_share);
  if (changed) value = items[chosen].value;
  return changed;
}

/// A strip of tabs across the row; tab k has the id "ID/k's name in lower case". True when another
/// one was chosen.
struct Tab {
  std::string label, tooltip;
};
bool tabs(std::string_view id, const std::vector<Tab>& items, std::size_t& chosen);

/// Header of a part of a panel. False if it is folded.
bool section(std::string_view id, const std::string& title);
/// A smaller one within a part, folded at first.
bool fold(std::string_view id, const std::string& title, std::string_view tip = {});
/// Opens a section that is folded.
void unfold(std::string_view id);
/// The same, and scrolls to it when it is drawn next.
void reveal(std::string_view id);

/// Text in another colour or font.
void text_dim(std::string_view text);
void text_colored(ImU32 color, std::string_view text);
void text_in(ImFont* font, std::string_view text);
void text_wrapped(std::string_view text, ImU32 color = palette().text);
/// The next checkbox stands in the second column, beside the last one, where both have room.
void second_column(std::string_view label);
/// A name at the left, what belongs to it at the right, cut where there is no room.
void figure(std::string_view name, const std::string& value, std::string_view tip,
            ImU32 color = palette().text);
/// Right-aligned in what is left of the row or cell.
void text_right(std::string_view text, ImU32 color);

/// Text cut to a width with "..." in its middle, so that the end of a file name stays.
std::string elided(const std::string& text, float width);

/// The text on lines of that width (pixels) in the present font, broken at spaces alone: Dear ImGui
/// also breaks after a point, amid a number. A word that is longer keeps its line.
std::string with_line_breaks(std::string_view text, float width);

}  // namespace winslow::gui::ui
