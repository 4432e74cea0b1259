#pragma once

#include <imgui.h>

#include <filesystem>

#include "core/types.h"

struct ImFont;

/// Colours, fonts and sizes of the studio, all defined here.
namespace winslow::gui {

/// The colours of one look. IM_COL32 values; the renderer chooses the colours of overlays on the
/// mesh.
struct Palette {
  bool dark = false;
  ImU32 accent = IM_COL32(37, 99, 235, 255);
  ImU32 accent_soft = IM_COL32(37, 99, 235, 36);
  ImU32 on_accent = IM_COL32(255, 255, 255, 255);  ///< text on accent and danger
  ImU32 text = IM_COL32(31, 41, 55, 255);
  ImU32 text_dim = IM_COL32(96, 107, 123, 255);
  ImU32 text_faint = IM_COL32(148, 158, 172, 255);
  ImU32 panel = IM_COL32(247, 248, 250, 255);
  ImU32 card = IM_COL32(255, 255, 255, 255);
  ImU32 border = IM_COL32(221, 226, 233, 255);
  ImU32 grid = IM_COL32(232, 236, 241, 255);
  ImU32 danger = IM_COL32(201, 34, 43, 255);
  ImU32 danger_soft = IM_COL32(254, 236, 236, 255);
  ImU32 warning = IM_COL32(161, 98, 7, 255);
  ImU32 warning_soft = IM_COL32(255, 247, 224, 255);
  ImU32 success = IM_COL32(21, 128, 61, 255);
  ImU32 move_line = IM_COL32(13, 148, 136, 255);  ///< "largest move" of the plot
  ImU32 axis_x = IM_COL32(206, 60, 48, 255);
  ImU32 axis_y = IM_COL32(32, 138, 66, 255);
  ImU32 axis_z = IM_COL32(36, 96, 214, 255);
};
const Palette& light_palette();
const Palette& dark_palette();
/// The palette of the interface being drawn.
const Palette& palette();

/// The channels of a colour, 0 to 1.
ImVec4 rgba(ImU32 color);

/// A colour with its opacity multiplied by a factor from 0 to 1.
ImU32 faded(ImU32 color, float share);

/// Icons by code point. Fork Awesome uses those of Font Awesome 4.
enum class Icon {
  open = 0xF07C,
  save = 0xF0C7,
  undo = 0xF0E2,
  redo = 0xF01E,
  fit = 0xF0B2,
  run = 0xF04B,
  pause = 0xF04C,
  step = 0xF051,
  stop = 0xF04D,
  reset = 0xF048,
  camera = 0xF030,
  warning = 0xF071,
  folder = 0xF07B,
  file = 0xF016,
  up = 0xF062,
  random = 0xF074,
  search = 0xF00E,
  bodies = 0xF05B,
  motion = 0xF047,
  solver = 0xF1DE,
  quality = 0xF080,
  history = 0xF1DA,
  view = 0xF06E,
  target = 0xF05B,
  record = 0xF03D,
  back = 0xF060,
  forward = 0xF061,
  hide = 0xF070,
  lock = 0xF023,
  unlock = 0xF09C,
  shape = 0xF040,
  layers = 0xF0C9,
  nodes = 0xF1E0,
  mesh = 0xF0CE
};

/// Fonts of one ImGui context.
struct Theme {
  float scale = 1;  ///< pixels per unit of the layout
  ImFont* regular = nullptr;
  ImFont* bold = nullptr;
  ImFont* small = nullptr;
  ImFont* title = nullptr;
  bool has_icons = false;

  float px(float size) const { return size * scale; }
  /// UTF-8 of an icon; "" where the icon font is not installed.
  std::string icon(Icon icon) const;
};

/// Loads fonts into the current ImGui context and sets its style. Uses ImGui's own font if Inter is
/// not installed.
Theme make_theme(float scale, const Palette& colors = light_palette());
/// Applies a palette to the current ImGui context, and makes palette() return it.
void use_palette(const Palette& colors);

enum class FontWeight { regular, semibold };

/// The file of the font Inter; empty if it is not installed (Debian: fonts-inter).
std::filesystem::path font_file(FontWeight weight);

/// Adds Inter to the current ImGui context's fonts if it is installed (Debian: fonts-inter), else
/// ImGui's own font. `pixels`: height of the letters. The glyphs cover Latin-1, Greek and the
/// punctuation and mathematical signs that the program uses.
ImFont* add_font(FontWeight weight, float pixels);

}  // namespace winslow::gui
