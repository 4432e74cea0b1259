#include "gui/picture/frame/picture_frame.h"

#include <imgui.h>

#include "core/error.h"
#include "gui/render/imgui_renderer.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {
namespace {

constexpr float heading_scale = 1.2f;

ImU32 to_color(const std::array<float, 4>& c) {
  return ImGui::ColorConvertFloat4ToU32(ImVec4(c[0], c[1], c[2], c[3]));
}

ImVec2 text_size(const ImFont& font, float size, const std::string& text) {
  return font.CalcTextSizeA(size, 1e6f, 0, text.c_str());
}

}  // namespace

const PictureTheme& picture_theme(bool dark) {
  static const PictureTheme light{{1, 1, 1, 1},
                                  {0.13f, 0.15f, 0.18f, 1},
                                  {0.72f, 0.74f, 0.78f, 1},
                                  {0.78f, 0.06f, 0.10f, 1},
                                  {0.94f, 0.95f, 0.965f, 1},
                                  {0.20f, 0.23f, 0.28f, 1}};
  static const PictureTheme night{{0.09f, 0.10f, 0.12f, 1}, {0.88f, 0.90f, 0.93f, 1},
                                  {0.35f, 0.38f, 0.43f, 1}, {1.0f, 0.42f, 0.40f, 1},
                                  {0.15f, 0.17f, 0.20f, 1}, {0.62f, 0.66f, 0.72f, 1}};
  return dark ? night : light;
}

PictureFrame::PictureFrame(int width, int height, PictureText text, const PictureTheme& theme)
    : width_(width),
      height_(height),
      text_(std::move(text)),
      theme_(theme),
      font_size_(std::clamp(std::round(0.02f * static_cast<float>(std::min(width, height))), 12.0f,
                            40.0f)) {
  previous_ = ImGui::GetCurrentContext();
  context_ = ImGui::CreateContext();
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.DisplaySize = {static_cast<float>(width_), static_cast<float>(height_)};
  io.DeltaTime = 1.0f / 60;
  font_ = add_font(FontWeight::regular, font_size_);
  strong_ = add_font(FontWeight::semibold, heading_scale * font_size_);
  legend_style_.font_size = font_size_;
  legend_style_.bar_width = font_size_;
  legend_style_.histogram_width = 3 * font_size_;
  legend_style_.text_color = theme_.ink;
  legend_style_.line_color = theme_.frame;
  legend_style_.font = font_;
  legend_style_.title_font = strong_;
  io.Fonts->Build();
  place();
}

PictureFrame::~PictureFrame() {
  ImGui::DestroyContext(context_);
  ImGui::SetCurrentContext(previous_);
}

bool PictureFrame::has_room_for_text() const {
  return std::min(width_, height_) >= 14 * static_cast<double>(font_size_);
}

void PictureFrame::place() {
  const double em = font_size_;
  const double width = width_;
  const double height = height_;
  // Below a height of some twenty letters, there is room only for the mesh.
  if (!has_room_for_text()) text_ = {};
  if (text_.legend && width < 3 * legend_width(*text_.legend, legend_style_)) text_.legend.reset();
  const bool bottom_line = !text_.key.empty() || !text_.warning.empty() || !text_.note.empty();
  const bool bare = text_.title.empty() && !bottom_line && !text_.legend;
  const double margin = bare ? 0 : em;
  const double top = text_.title.empty() ? margin : 2.9 * em;
  const double bottom = bottom_line ? 2.6 * em : margin;
  double right = margin;
  if (text_.legend) right += legend_width(*text_.legend, legend_style_) + 1.5 * em;
  area_ = {margin, top, std::max(width - margin - right, 1.0),
           std::max(height - top - bottom, 1.0)};
}

void PictureFrame::draw(bool framed, const OverMesh& over_mesh) {
  ImGuiContext* const before = ImGui::GetCurrentContext();
  ImGui::SetCurrentContext(context_);
  ImGuiRenderer renderer;
  ImGui::NewFrame();
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const auto left = static_cast<float>(area_[0]);
  const auto top = static_cast<float>(area_[1]);
  const auto right = static_cast<float>(area_[0] + area_[2]);
  const auto bottom = static_cast<float>(area_[1] + area_[3]);
  if (over_mesh) {
    list.PushClipRect({left, top}, {right, bottom});
    over_mesh(list, font_);
    list.PopClipRect();
  }
  if (framed) list.AddRect({left, top}, {right, bottom}, to_color(theme_.frame));
  if (!text_.title.empty()) {
    list.AddText(strong_, heading_scale * font_size_, {left, std::round(0.85f * font_size_)},
                 to_color(theme_.ink), text_.title.c_str());
  }
  if (text_.legend) {
    const float x = right + 1.5f * font_size_;
    const float legend_height = std::min(bottom - top, 30 * font_size_);
    draw_legend(list, x, std::round(top + 0.5f * (bottom - top - legend_height)), legend_height,
                *text_.legend, legend_style_);
  }
  draw_bottom_line(list);
  ImGui::Render();
  renderer.draw(*ImGui::GetDrawData());
  ImGui::SetCurrentContext(before);
}

void PictureFrame::draw_bottom_line(ImDrawList& list) const {
  const float y = std::round(static_cast<float>(height_) - 1.75f * font_size_);
  auto x = static_cast<float>(area_[0]);
  const float limit = static_cast<float>(width_) - font_size_;
  if (!text_.warning.empty()) {
    list.AddText(strong_, font_size_, {x, y}, to_color(theme_.warning), text_.warning.c_str());
    x += text_size(*strong_, font_size_, text_.warning).x + 2 * font_size_;
  }
  if (const float width = text_size(*font_, font_size_, text_.note).x;
      !text_.note.empty() && x + width <= limit) {
    list.AddText(font_, font_size_, {x, y}, to_color(theme_.ink), text_.note.c_str());
    x += width + 2 * font_size_;
  }
  for (const auto& [name, color] : text_.key) {
    const float swatch = 1.4f * font_size_;
    const float needed = swatch + 0.5f * font_size_ + text_size(*font_, font_size_, name).x;
    if (x + needed > limit) break;
    const float middle = std::round(y + 0.5f * font_size_);
    list.AddLine({x, middle}, {x + swatch, middle}, to_color({color[0], color[1], color[2], 1}),
                 std::max(2.0f, 0.2f * font_size_));
    list.AddText(font_, font_size_, {x + swatch + 0.5f * font_size_, y}, to_color(theme_.ink),
                 name.c_str());
    x += needed + 1.5f * font_size_;
  }
}

namespace {

/// 12345 -> "12 345", with a space that does not break.
std::string with_fixed_spaces(Index number) {
  std::string digits = std::to_string(number);
  for (std::size_t end = digits.size(); end > 3; end -= 3) digits.insert(end - 3, "\u00a0");
  return digits;
}

}  // namespace

std::string inverted_text(Index inverted) {
  if (inverted == 0) return {};
  return with_fixed_spaces(inverted) + (inverted == 1 ? " inverted element" : " inverted elements");
}

void check_colors(const std::optional<ElementField>& field, const ColorChoice& choice) {
  if (choice.range && !((*choice.range)[0] < (*choice.range)[1])) {
    throw UsageError("the range of the colours is LOW HIGH with LOW < HIGH");
  }
  if (field) sample_color_map(color_map_for(*field, choice.map), 0);
}

ColorScale picture_colors(const ElementField& field, ColorChoice choice, bool dark,
                          std::span<const double> values) {
  choice.on_dark = dark;
  return color_scale(field, values, choice);
}

void use_scale(ColorChoice& colors, const ColorScale& scale) {
  colors.range = {scale.low, scale.high};
  colors.axis = scale.logarithmic ? ColorAxis::logarithmic : ColorAxis::linear;
}

ColorScale joined(ColorScale a, const ColorScale& b) {
  a.low = std::min(a.low, b.low);
  a.high = std::max(a.high, b.high);
  a.logarithmic = a.logarithmic && b.logarithmic;
  return a;
}

Legend picture_legend(const ElementField& field, std::span<const double> values,
                      const ColorScale& scale, bool with_inverted) {
  Legend legend = legend_of(field, values, scale);
  const Rgba red = MeshStyle{}.inverted_color;
  if (with_inverted) legend.inverted = Rgb{red[0], red[1], red[2]};
  return legend;
}

Rgba edges_on_colors(const ElementField& field, const ColorChoice& choice, bool dark) {
  // On colours, dark lines are legible in both themes, except on the map that recedes into the
  // dark.
  const bool neutral = color_map_for(field, choice.map) == "neutral";
  Rgba edge = picture_theme(dark && neutral).edge;
  edge[3] = 0.55f;
  return edge;
}

}  // namespace winslow::gui
