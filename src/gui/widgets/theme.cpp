#include "gui/widgets/theme.h"

#include <imgui_freetype.h>
#include <imgui_internal.h>

#include <array>
#include <string>

namespace winslow::gui {

namespace {

constexpr std::array<const char*, 2> icon_files{
    "/usr/share/fonts/truetype/fork-awesome/forkawesome-webfont.ttf",
    "/usr/share/fonts-fork-awesome/fonts/forkawesome-webfont.ttf"};

bool exists(const char* path) {
  std::error_code ignored;
  return std::filesystem::exists(std::filesystem::path(path), ignored);
}

bool merge_icons(float size) {
  static const ImWchar ranges[] = {0xF000, 0xF2FF, 0};
  for (const char* file : icon_files) {
    if (!exists(file)) continue;
    ImFontConfig config;
    config.MergeMode = true;
    config.GlyphMinAdvanceX = size * 1.1f;
    config.GlyphOffset = ImVec2(0, size * 0.06f);
    return ImGui::GetIO().Fonts->AddFontFromFileTTF(file, size * 0.95f, &config, ranges) != nullptr;
  }
  return false;
}

ImVec4 mix(ImU32 a, ImU32 b, float t) {
  const ImVec4 p = rgba(a);
  const ImVec4 q = rgba(b);
  return {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), p.z + t * (q.z - p.z), 1};
}

void set_sizes(ImGuiStyle& style) {
  style.WindowPadding = ImVec2(12, 10);
  style.FramePadding = ImVec2(8, 5);
  style.ItemSpacing = ImVec2(8, 7);
  style.ItemInnerSpacing = ImVec2(6, 5);
  style.CellPadding = ImVec2(5, 3);
  style.IndentSpacing = 16;
  style.ScrollbarSize = 11;
  style.GrabMinSize = 12;
  style.WindowRounding = 0;
  style.ChildRounding = 6;
  style.PopupRounding = 6;
  style.FrameRounding = 5;
  style.GrabRounding = 5;
  style.ScrollbarRounding = 6;
  style.TabRounding = 5;
  style.WindowBorderSize = 0;
  style.ChildBorderSize = 1;
  style.PopupBorderSize = 1;
  style.FrameBorderSize = 1;
  style.WindowTitleAlign = ImVec2(0.0f, 0.5f);
}

const Palette* current = nullptr;

void set_colors(ImGuiStyle& style) {
  if (palette().dark)
    ImGui::StyleColorsDark(&style);
  else
    ImGui::StyleColorsLight(&style);
  const auto set = [&style](ImGuiCol which, const ImVec4& c) { style.Colors[which] = c; };
  const ImVec4 hover = mix(palette().card, palette().accent, 0.08f);
  const ImVec4 active = mix(palette().card, palette().accent, 0.18f);
  set(ImGuiCol_Text, rgba(palette().text));
  set(ImGuiCol_TextDisabled, rgba(palette().text_faint));
  set(ImGuiCol_WindowBg, rgba(palette().panel));
  set(ImGuiCol_ChildBg, rgba(palette().card));
  set(ImGuiCol_PopupBg, rgba(palette().card));
  set(ImGuiCol_Border, rgba(palette().border));
  set(ImGuiCol_FrameBg, rgba(palette().card));
  set(ImGuiCol_FrameBgHovered, hover);
  set(ImGuiCol_FrameBgActive, active);
  set(ImGuiCol_TitleBg, rgba(palette().card));
  set(ImGuiCol_TitleBgActive, rgba(palette().card));
  set(ImGuiCol_MenuBarBg, rgba(palette().card));
  set(ImGuiCol_ScrollbarBg, ImVec4(0, 0, 0, 0));
  set(ImGuiCol_ScrollbarGrab, mix(palette().border, palette().text_faint, 0.3f));
  set(ImGuiCol_ScrollbarGrabHovered, rgba(palette().text_faint));
  set(ImGuiCol_ScrollbarGrabActive, rgba(palette().text_dim));
  set(ImGuiCol_CheckMark, rgba(palette().accent));
  set(ImGuiCol_SliderGrab, rgba(palette().accent));
  set(ImGuiCol_SliderGrabActive, mix(palette().accent, palette().text, 0.3f));
  set(ImGuiCol_Button, rgba(palette().card));
  set(ImGuiCol_ButtonHovered, hover);
  set(ImGuiCol_ButtonActive, active);
  set(ImGuiCol_Header, active);
  set(ImGuiCol_HeaderHovered, hover);
  set(ImGuiCol_HeaderActive, active);
  set(ImGuiCol_Separator, rgba(palette().border));
  set(ImGuiCol_SeparatorHovered, rgba(palette().accent));
  set(ImGuiCol_SeparatorActive, rgba(palette().accent));
  set(ImGuiCol_TableHeaderBg, rgba(palette().panel));
  set(ImGuiCol_TableBorderLight, rgba(palette().grid));
  set(ImGuiCol_TableBorderStrong, rgba(palette().border));
  set(ImGuiCol_TableRowBgAlt, mix(palette().card, palette().panel, 0.6f));
  set(ImGuiCol_TextSelectedBg, mix(palette().card, palette().accent, 0.25f));
  set(ImGuiCol_NavHighlight, rgba(palette().accent));
  set(ImGuiCol_ModalWindowDimBg, ImVec4(0.10f, 0.13f, 0.18f, 0.35f));
}

}  // namespace

const Palette& light_palette() {
  static const Palette light;
  return light;
}

const Palette& dark_palette() {
  static const Palette dark = [] {
    Palette p;
    p.dark = true;
    p.accent = IM_COL32(96, 156, 255, 255);
    p.accent_soft = IM_COL32(96, 156, 255, 48);
    p.on_accent = IM_COL32(15, 20, 30, 255);
    p.text = IM_COL32(226, 230, 236, 255);
    p.text_dim = IM_COL32(160, 168, 180, 255);
    p.text_faint = IM_COL32(112, 121, 135, 255);
    p.panel = IM_COL32(30, 33, 39, 255);
    p.card = IM_COL32(38, 42, 50, 255);
    p.border = IM_COL32(60, 66, 77, 255);
    p.grid = IM_COL32(52, 57, 67, 255);
    p.danger = IM_COL32(248, 113, 113, 255);
    p.danger_soft = IM_COL32(74, 33, 36, 255);
    p.warning = IM_COL32(240, 185, 80, 255);
    p.warning_soft = IM_COL32(70, 56, 26, 255);
    p.success = IM_COL32(86, 196, 124, 255);
    p.move_line = IM_COL32(45, 200, 184, 255);
    p.axis_x = IM_COL32(244, 112, 100, 255);
    p.axis_y = IM_COL32(98, 200, 124, 255);
    p.axis_z = IM_COL32(112, 166, 255, 255);
    return p;
  }();
  return dark;
}

const Palette& palette() { return current ? *current : light_palette(); }

void use_palette(const Palette& colors) {
  current = &colors;
  set_colors(ImGui::GetStyle());
}

ImVec4 rgba(ImU32 color) { return ImGui::ColorConvertU32ToFloat4(color); }

ImU32 faded(ImU32 color, float share) {
  ImVec4 c = rgba(color);
  c.w *= share;
  return ImGui::ColorConvertFloat4ToU32(c);
}

std::string Theme::icon(Icon icon) const {
  if (!has_icons) return {};
  std::array<char, 5> text{};
  ImTextCharToUtf8(text.data(), static_cast<unsigned>(icon));
  return text.data();
}

Theme make_theme(float scale, const Palette& colors) {
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
  io.Fonts->FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
  Theme theme;
  theme.scale = scale;
  theme.regular = add_font(FontWeight::regular, theme.px(15));
  theme.has_icons = merge_icons(theme.px(15));
  theme.bold = add_font(FontWeight::semibold, theme.px(15));
  merge_icons(theme.px(15));
  theme.small = add_font(FontWeight::regular, theme.px(13));
  merge_icons(theme.px(13));
  theme.title = add_font(FontWeight::semibold, theme.px(21));
  merge_icons(theme.px(21));
  io.FontDefault = theme.regular;
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  set_sizes(style);
  use_palette(colors);
  style.ScaleAllSizes(scale);
  return theme;
}

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
  // Latin-1, Greek, general punctuation, arrows, mathematical signs, geometric shapes; static,
  // since the atlas keeps the pointer.
  static constexpr std::array<ImWchar, 15> ranges{0x0020, 0x00FF, 0x0391, 0x03C9, 0x2010,
                                                  0x2044, 0x2070, 0x207F, 0x2190, 0x2199,
                                                  0x2200, 0x2265, 0x25A0, 0x25FF, 0};
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  ImFontConfig config;
  // Large letters, in enlarged pictures, need no oversampling.
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
