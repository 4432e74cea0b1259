#include "gui/render/fonts.h"

#include <imgui.h>

#include <array>
#include <filesystem>
#include <string>

namespace winslow::gui {
std::filesystem::path font_file(FontWeight weight) {
  const std::string style = weight == FontWeight::semibold ? "SemiBold" : "Regular";
  const std::array<std::string, 4> candidates{
      "/usr/share/fonts/opentype/inter/Inter-" + style + ".otf",
      "/usr/share/fonts/truetype/inter/Inter-" + style + ".ttf",
      "/usr/share/fonts/inter/Inter-" + style + ".otf",
      "/usr/share/fonts/TTF/Inter-" + style + ".ttf"};
  for (const std::string& candidate : candidates) {
    std::error_code error;
    if (std::filesystem::is_regular_file(candidate, error)) return candidate;
  }
  return {};
}

ImFont* add_font(FontWeight weight, float pixels) {
  // Latin-1, Greek, general punctuation, arrows, mathematical signs, geometric shapes; the atlas
  // keeps the pointer.
  static constexpr std::array<ImWchar, 15> ranges{0x0020, 0x00FF, 0x0391, 0x03C9, 0x2010,
                                                  0x2044, 0x2070, 0x207F, 0x2190, 0x2199,
                                                  0x2200, 0x2265, 0x25A0, 0x25FF, 0};
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  ImFontConfig config;
  // Large letters, of pictures at several times the window's size, need no finer grid.
  const bool large = pixels > 28;
  config.OversampleH = large ? 1 : 3;
  config.OversampleV = large ? 1 : 2;
  const std::filesystem::path path = font_file(weight);
  if (!path.empty()) {
    ImFont* font = atlas.AddFontFromFileTTF(path.c_str(), pixels, &config, ranges.data());
    if (font != nullptr) return font;
  }
  config.SizePixels = pixels;
  return atlas.AddFontDefault(&config);
}

}  // namespace winslow::gui
