#pragma once

#include <string>
#include <vector>

namespace winslow::gui {

/// Keys pressed together: one key with Control, Alt or Shift held, or a character however the
/// keyboard types it.
struct Chord {
  int key = 0;  ///< GLFW key code; 0: a character
  bool control = false;
  bool shift = false;
  char32_t character = 0;
  bool alt = false;

  bool operator==(const Chord&) const = default;
};

/// "Ctrl+Shift+S", "F2", "?".
std::string chord_text(const Chord& chord);
/// "Ctrl+Shift+Z, Ctrl+Y"; empty for none.
std::string chords_text(const std::vector<Chord>& chords);
/// Went down in this frame, with just these modifiers. Super stands in for Control where keyboards
/// have it.
bool pressed(const Chord& chord);

/// How tables of commands write chords: key('F'), shift(key('F')), control(key('S')).
Chord key(int glfw_key);
Chord control(Chord chord);
Chord shift(Chord chord);
Chord alt(Chord chord);
Chord typed(char32_t character);

}  // namespace winslow::gui
