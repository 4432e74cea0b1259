#include "gui/render/backdrop.h"

#include <algorithm>
#include <cmath>

#include "gui/render/gl.h"

namespace winslow::gui {

namespace {

// Finer than 8 bits can show between colours this close.
constexpr int steps = 64;

float luminance(const Rgba& c) { return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2]; }

}  // namespace

bool BackdropColors::dark() const { return 0.5f * (luminance(top) + luminance(bottom)) < 0.4f; }

void draw_backdrop(const Camera& camera, const Camera& whole, const BackdropColors& colors,
                   int framebuffer_height) {
  const auto x = static_cast<GLint>(std::lround(camera.viewport_origin().x()));
  const auto y = static_cast<GLint>(std::lround(camera.viewport_origin().y()));
  const auto width = static_cast<GLsizei>(std::lround(camera.viewport_width()));
  const auto height = static_cast<GLsizei>(std::lround(camera.viewport_height()));
  const double start = camera.to_screen(whole.to_world(whole.viewport_origin())).y();
  const auto top = static_cast<int>(std::lround(start)) - y;
  const auto full = static_cast<int>(std::lround(whole.viewport_height()));
  const int strips = colors.top == colors.bottom ? 1 : std::min(steps, full);
  glEnable(GL_SCISSOR_TEST);
  for (int k = 0; k < strips; ++k) {
    // The first and the last go on to the rim: rounding must leave no gap.
    const int from = k == 0 ? 0 : std::clamp(top + full * k / strips, 0, height);
    const int to = k + 1 == strips ? height : std::clamp(top + full * (k + 1) / strips, 0, height);
    if (to <= from) continue;
    const float t = strips > 1 ? static_cast<float>(k) / static_cast<float>(strips - 1) : 0;
    Rgba c{};
    for (std::size_t i = 0; i < 4; ++i)
      c[i] = colors.top[i] + t * (colors.bottom[i] - colors.top[i]);
    glScissor(x, framebuffer_height - y - to, width, to - from);
    glClearColor(c[0], c[1], c[2], c[3]);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace winslow::gui
