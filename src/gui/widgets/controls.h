#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gui/widgets/theme.h"

/// The widgets of the panels: Dear ImGui's in the studio's style. Each has an id for scripts, and a
/// tooltip if its purpose is not obvious to new users.
namespace winslow::gui::ui {

/// Records the position of the last item under an id.
void note(std::string_view id);
/// The same for any rectangle.
void note(std::string_view id, const ImVec2& min, const ImVec2& max);
/// Records the last item. label: width of its label. room: width available for it, both in pixels.
void note_label(std::string_view id, float label, float room);
/// Shows a wrapped text while the mouse rests on the last item; nothing if empty.
void tooltip(std::string_view text);

enum class ButtonStyle { normal, primary, danger, flat };
struct ButtonOptions {
  std::string tooltip;
  ButtonStyle style = ButtonStyle::normal;
  bool enabled = true;
  float width = 0;  ///< pixels; 0: width of the label; -1: the rest of the row
};
bool button(std::string_view id, const std::string& label, const ButtonOptions& options = {});

bool checkbox(std::string_view id, const std::string& label, bool& value,
              std::string_view tip = {});

/// Starts a row "label   control": the control fills the rest of the row.
void row(const std::string& label, std::string_view tip = {}, float label_share = 0.42f);
/// Fields for numbers, of the width set before. True if the value has changed.
bool number(std::string_view id, double& value, std::string_view tip = {},
            const char* format = "%.6g");
bool number(std::string_view id, int& value, std::string_view tip = {});
/// Width of the letter before a component of a vector, pixels.
float letter_width();
/// Two fields for the components of a vector, labelled x and y, side by side in the rest of the
/// row.
struct VectorField {
  std::string_view x, y;  ///< ids
  std::string_view tooltip;
};
/// True when the value has changed. entered: set to true if Enter was pressed in one of them.
bool vector_field(const VectorField& field, Vec2& value, bool* entered = nullptr);
/// Three fields for a vector in space, in a row without a label.
struct SpaceVectorField {
  std::string_view id;  ///< of the fields, with "_x", "_y", "_z" appended
  std::string_view tooltip;
};
bool space_vector_field(const SpaceVectorField& field, Vec3& value, bool* entered = nullptr);
/// True if Enter was pressed in the last field, which ends its editing.
bool entered();
/// Clears Dear ImGui's undo steps of a text field; to be called after its callback has replaced the
/// typed text.
void forget_typed_steps();
bool combo(std::string_view id, const std::vector<std::string>& items, std::size_t& chosen,
           std::string_view tip = {});

/// A row with such a list: "label   control". True if another item was chosen.
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
/// The same for a value of a list; a value not in the list is shown as the item `otherwise`.
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

/// A strip of tabs across the row; tab k has the id "ID/k's name in lower case". True if another
/// one was chosen.
struct Tab {
  std::string label, tooltip;
};
bool tabs(std::string_view id, const std::vector<Tab>& items, std::size_t& chosen);

/// Header of a part of a panel. False if it is folded.
bool section(std::string_view id, const std::string& title);
/// A smaller header within a part, initially folded.
bool fold(std::string_view id, const std::string& title, std::string_view tip = {});
/// Opens a section that is folded.
void unfold(std::string_view id);
/// Opens a section and scrolls to it when it is drawn next.
void reveal(std::string_view id);

/// Text in another colour or font.
void text_dim(std::string_view text);
void text_colored(ImU32 color, std::string_view text);
void text_in(ImFont* font, std::string_view text);
void text_wrapped(std::string_view text, ImU32 color = palette().text);
/// Places the next checkbox in a second column, beside the last one, if there is room for both.
void second_column(std::string_view label);
/// A name at the left and its value at the right, shortened if there is no room.
void figure(std::string_view name, const std::string& value, std::string_view tip,
            ImU32 color = palette().text);
/// Right-aligned text in the rest of the row or cell.
void text_right(std::string_view text, ImU32 color);

/// Text of any length, such as a name in a file, without its middle if it is longer than anybody
/// reads: Dear ImGui draws at most 16,384 characters at once.
std::string readable(std::string_view text);

/// Text shortened to a width with "..." in its middle, to keep the end of a file name.
std::string elided(const std::string& text, float width);

/// The text with line breaks for that width (pixels) in the present font, only at spaces: Dear
/// ImGui also breaks after a decimal point. A word longer than the width is not broken.
std::string with_line_breaks(std::string_view text, float width);

}  // namespace winslow::gui::ui
