#pragma once

#include <filesystem>

struct ImFont;

namespace winslow::gui {

enum class FontWeight { regular, semibold };

/// The file of Inter; empty where it is not installed (Debian: fonts-inter).
std::filesystem::path font_file(FontWeight weight);

/// Adds Inter to the current ImGui context's fonts if it is installed (Debian: fonts-inter), else
/// ImGui's own font. `pixels`: height of the letters. The glyphs cover Latin-1, Greek and the
/// punctuation and mathematical signs that the program uses.
ImFont* add_font(FontWeight weight, float pixels);

}  // namespace winslow::gui
