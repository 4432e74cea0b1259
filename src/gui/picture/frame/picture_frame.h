#pragma once

#include "core/inspect/element_field.h"
#include "gui/render/color_scale.h"
#include "gui/render/frame_buffer.h"
#include "gui/render/mesh_renderer.h"
#include "gui/render/view.h"
#include "gui/widgets/legend.h"

struct ImGuiContext;
struct ImFont;

namespace winslow::gui {

/// Texts around the mesh in a picture. Internal to the picture.
struct PictureText {
  std::string title;                             ///< top left; empty: none
  std::string warning;                           ///< bottom left, in red; empty: none
  std::string note;                              ///< bottom left; empty: none
  std::vector<std::pair<std::string, Rgb>> key;  ///< names and colours, bottom left
  std::optional<Legend> legend;                  ///< on the right
};

/// Colours of paper and ink.
struct PictureTheme {
  std::array<float, 4> paper, ink, frame, warning;
  Rgba fill, edge;
};
const PictureTheme& picture_theme(bool dark);

/// Places title, legend and key around the mesh, and draws them with an ImGui context of its own.
/// Needs a current OpenGL context. What a small picture has no room for is left out.
class PictureFrame {
 public:
  PictureFrame(int width, int height, PictureText text, const PictureTheme& theme);
  ~PictureFrame();
  PictureFrame(const PictureFrame&) = delete;
  PictureFrame& operator=(const PictureFrame&) = delete;

  /// Size of the letters in pixels; lines and margins scale with it.
  float font_size() const { return font_size_; }
  /// Place of the mesh: left, top, width, height in pixels.
  const std::array<double, 4>& mesh_area() const { return area_; }
  /// True if there is room for letters at all.
  bool has_room_for_text() const;
  /// Draws over the mesh, within its area; font: for labels.
  using OverMesh = std::function<void(ImDrawList& list, ImFont* font)>;
  /// Draws into the bound framebuffer. framed: a thin line around the mesh's area.
  void draw(bool framed, const OverMesh& over_mesh = {});

 private:
  void place();
  void draw_bottom_line(ImDrawList& list) const;

  int width_, height_;
  PictureText text_;
  const PictureTheme& theme_;
  float font_size_;
  ImGuiContext* context_ = nullptr;
  ImGuiContext* previous_ = nullptr;
  ImFont* font_ = nullptr;
  ImFont* strong_ = nullptr;
  LegendStyle legend_style_;
  std::array<double, 4> area_{};
};

/// Words and colours that pictures of plane and of volume meshes have in common.

/// "12 345 inverted elements"; empty if there are none.
std::string inverted_text(Index inverted);

/// Throws UsageError for a range without extent and, of a field, an unknown colour map.
void check_colors(const std::optional<ElementField>& field, const ColorChoice& choice);

ColorScale picture_colors(const ElementField& field, ColorChoice choice, bool dark,
                          std::span<const double> values);
/// Sets range and axis of `colors` to those of a scale.
void use_scale(ColorChoice& colors, const ColorScale& scale);
/// The common scale of two pictures to compare: from the lower end to the higher one.
ColorScale joined(ColorScale a, const ColorScale& b);

/// with_inverted: lists inverted elements, which are red.
Legend picture_legend(const ElementField& field, std::span<const double> values,
                      const ColorScale& scale, bool with_inverted);

/// Colour of the lines between coloured elements.
Rgba edges_on_colors(const ElementField& field, const ColorChoice& choice, bool dark);

}  // namespace winslow::gui
