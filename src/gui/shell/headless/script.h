#pragma once

#include "gui/shell/headless/headless_studio.h"

namespace winslow::gui {

/// A script of what a user does in the studio, line by line (docs/studio.md lists the words).
struct ScriptLine {
  int number = 0;                  ///< in the file, from 1
  std::vector<std::string> words;  ///< never empty; "quoted words" are one
};
struct Script {
  std::filesystem::path file;
  std::vector<ScriptLine> lines;
};

/// Throws InputError "FILE:LINE: ..." for a word that nothing is known of, too few or too many
/// words, or a quote that does not end.
Script read_script(const std::filesystem::path& file);

/// A key and those held with it, as GLFW numbers: of "F", "Ctrl+Shift+Z", "Escape". Throws
/// UsageError.
std::vector<int> parse_keys(const std::string& text);

/// Does what a script says. `folder`: where its pictures go; empty: the working folder. Tells `say`
/// what was written. Throws Error "FILE:LINE: ..." where something cannot be done.
void play_script(const Script& script, HeadlessStudio& studio, const std::filesystem::path& folder,
                 const std::function<void(const std::string&)>& say);

}  // namespace winslow::gui
