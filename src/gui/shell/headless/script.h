#pragma once

#include <filesystem>
#include <string>
#include <vector>

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

}  // namespace winslow::gui
