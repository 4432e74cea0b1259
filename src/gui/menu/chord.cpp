#include "gui/menu/chord.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <utility>

namespace winslow::gui {

namespace {

std::string key_name(int key) {
  constexpr std::array<std::pair<int, const char*>, 20> names{
      {{GLFW_KEY_SPACE, "Space"},
       {GLFW_KEY_ESCAPE, "Esc"},
       {GLFW_KEY_ENTER, "Enter"},
       {GLFW_KEY_TAB, "Tab"},
       {GLFW_KEY_BACKSPACE, "Backspace"},
       {GLFW_KEY_DELETE, "Delete"},
       {GLFW_KEY_INSERT, "Insert"},
       {GLFW_KEY_LEFT, "Left"},
       {GLFW_KEY_RIGHT, "Right"},
       {GLFW_KEY_UP, "Up"},
       {GLFW_KEY_DOWN, "Down"},
       {GLFW_KEY_HOME, "Home"},
       {GLFW_KEY_END, "End"},
       {GLFW_KEY_PAGE_UP, "Page Up"},
       {GLFW_KEY_PAGE_DOWN, "Page Down"},
       {GLFW_KEY_EQUAL, "plus"},
       {GLFW_KEY_MINUS, "minus"},
       {GLFW_KEY_KP_ADD, "keypad plus"},
       {GLFW_KEY_KP_SUBTRACT, "keypad minus"},
       {GLFW_KEY_KP_0, "keypad 0"}}};
  for (const auto& [code, name] : names)
    if (code == key) return name;
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25) return "F" + std::to_string(key - GLFW_KEY_F1 + 1);
  return {static_cast<char>(key)};  // letters, digits and signs have the codes of ASCII
}

}  // namespace

std::string chord_text(const Chord& chord) {
  if (chord.key == 0) return {static_cast<char>(chord.character)};
  return std::string(chord.control ? "Ctrl+" : "") + (chord.alt ? "Alt+" : "") +
         (chord.shift ? "Shift+" : "") + key_name(chord.key);
}

std::string chords_text(const std::vector<Chord>& chords) {
  std::string text;
  for (const Chord& chord : chords) text += (text.empty() ? "" : ", ") + chord_text(chord);
  return text;
}

bool pressed(const Chord& chord) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool control_held = io.KeyCtrl || io.KeySuper;
  if (chord.key == 0) {
    const auto& typed = io.InputQueueCharacters;
    return !control_held && std::find(typed.begin(), typed.end(),
                                      static_cast<ImWchar>(chord.character)) != typed.end();
  }
  // On many keyboards "+" is the key "=" with Shift.
  const bool shift_fits = io.KeyShift == chord.shift || chord.key == GLFW_KEY_EQUAL;
  return ImGui::IsKeyPressed(chord.key, false) && control_held == chord.control && shift_fits &&
         io.KeyAlt == chord.alt;
}

Chord key(int glfw_key) { return {glfw_key}; }

Chord control(Chord chord) {
  chord.control = true;
  return chord;
}

Chord shift(Chord chord) {
  chord.shift = true;
  return chord;
}

Chord alt(Chord chord) {
  chord.alt = true;
  return chord;
}

Chord typed(char32_t character) { return {0, false, false, character}; }

}  // namespace winslow::gui
