#include "gui/render/space/space_renderer.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "gui/render/line_density.h"
#include "gui/render/shader.h"
#include "gui/render/space/vertex_rows.h"

namespace winslow::gui {

namespace {

/// Opacity of what is emphasised where something hides it.
constexpr float hidden_opacity = 0.22f;
/// How far faces are set back behind their edges, in what they recede over a pixel: a line reaches
/// as far as that to either side of its axis.
constexpr float set_back = 1.5f;

Rgba as_float(const Vec3& v, double w) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()),
          static_cast<float>(w)};
}

}  // namespace

class SpaceRenderer::Impl {
 public:
  void set_scene(const SpaceScene& scene) {
    if (scene.planes.size() > most_clip_planes)
      throw UsageError("at most " + std::to_string(most_clip_planes) + " planes cut a scene");
    fills_.clear();
    lines_.clear();
    origin_ = scene.origin;
    planes_ = scene.planes;
    for (const SpaceFill& fill : scene.fills) {
      if (fill.corners.empty()) continue;
      Fill& made = *fills_.emplace_back(std::make_unique<Fill>());
      made.rows.upload(fill.corners, {{3, GL_FLOAT, GL_FALSE, offsetof(SpaceCorner, position)},
                                      {3, GL_FLOAT, GL_FALSE, offsetof(SpaceCorner, normal)},
                                      {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(SpaceCorner, rgba)}});
      made.style = {{}, fill.shading, fill.opacity, fill.emphasised, fill.clipped_by};
    }
    for (const SpaceLines& lines : scene.lines) {
      if (lines.ends.empty() || lines.width <= 0) continue;
      Lines& made = *lines_.emplace_back(std::make_unique<Lines>());
      made.rows.upload(lines.ends, {{3, GL_FLOAT, GL_FALSE, offsetof(SpaceLines::End, position)},
                                    {1, GL_FLOAT, GL_FALSE, offsetof(SpaceLines::End, spacing)}});
      made.style = {{}, lines.color, lines.width, lines.clipped_by};
    }
  }

  void draw(const SpaceCamera& camera, int framebuffer_height) {
    begin(camera, framebuffer_height);
    for (const bool see_through : {false, true}) {
      for (const auto& fill : fills_) {
        if ((fill->style.opacity < 1) != see_through) continue;
        see_through ? draw_see_through(*fill, camera) : draw_solid(*fill, camera);
      }
      if (!see_through) draw_lines(camera);
    }
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
    clip(false);
  }

 private:
  struct Fill {
    VertexRows rows;
    SpaceFill style;  // without corners
  };
  struct Lines {
    VertexRows rows;
    SpaceLines style;  // without ends
  };

  static void begin(const SpaceCamera& camera, int framebuffer_height) {
    const ScreenBox box = camera.viewport();
    const auto x = static_cast<GLint>(std::lround(box.min.x()));
    const auto y = framebuffer_height - static_cast<GLint>(std::lround(box.max.y()));
    const auto width = static_cast<GLsizei>(std::lround(box.size().x()));
    const auto height = static_cast<GLsizei>(std::lround(box.size().y()));
    glViewport(x, y, width, height);
    glScissor(x, y, width, height);
    glEnable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    clip(true);
  }

  static void clip(bool on) {
    for (std::size_t k = 0; k < most_clip_planes; ++k) {
      const auto which = static_cast<GLenum>(GL_CLIP_DISTANCE0 + k);
      on ? glEnable(which) : glDisable(which);
    }
  }

  void set_common(const Shader& shader, const SpaceCamera& camera, unsigned clipped_by) const {
    shader.use();
    shader.set("to_clip", camera.matrix(origin_));
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      const Vec3& n = planes_[k].normal();
      const std::string name = "planes[" + std::to_string(k) + "]";
      shader.set(name.c_str(),
                 Rgba{static_cast<float>(n.x()), static_cast<float>(n.y()),
                      static_cast<float>(n.z()), static_cast<float>(planes_[k].distance(origin_))});
    }
    shader.set("clipped_by", static_cast<int>(clipped_by));
  }

  void prepare(const Fill& fill, const SpaceCamera& camera, float opacity) const {
    set_common(fill_shader_, camera, fill.style.clipped_by);
    const Vec3 light = (camera.back() + 0.35 * camera.up() - 0.3 * camera.right()).normalized();
    fill_shader_.set("light", as_float(light, 0));
    fill_shader_.set("shading", fill.style.shading);
    fill_shader_.set("opacity", opacity);
    const auto pixel_depth = camera.pixel_depth();
    fill_shader_.set("pixel_depth", static_cast<float>(pixel_depth[0]),
                     static_cast<float>(pixel_depth[1]));
    const bool perspective = camera.in_perspective();
    fill_shader_.set("viewer", perspective ? as_float(camera.viewer() - origin_, 1)
                                           : as_float(camera.back(), 0));
    fill_shader_.set("set_back", fill.style.emphasised ? 0.5f * set_back : set_back);
  }

  void draw_solid(const Fill& fill, const SpaceCamera& camera) const {
    prepare(fill, camera, 1);
    fill.rows.draw(GL_TRIANGLES);
    if (!fill.style.emphasised) return;
    prepare(fill, camera, hidden_opacity);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_FALSE);
    fill.rows.draw(GL_TRIANGLES);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LEQUAL);
  }

  /// Its depth first, so that one layer of it is left.
  void draw_see_through(const Fill& fill, const SpaceCamera& camera) const {
    prepare(fill, camera, fill.style.opacity);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    fill.rows.draw(GL_TRIANGLES);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    fill.rows.draw(GL_TRIANGLES);
  }

  void draw_lines(const SpaceCamera& camera) const {
    glDepthMask(GL_FALSE);
    const ScreenVector size = camera.viewport().size();
    for (const auto& lines : lines_) {
      set_common(line_shader_, camera, lines->style.clipped_by);
      line_shader_.set("viewport", static_cast<float>(size.x()), static_cast<float>(size.y()));
      line_shader_.set("width", lines->style.width);
      line_shader_.set("color", lines->style.color);
      line_shader_.set("pixels_per_unit", static_cast<float>(1 / camera.units_per_pixel()));
      line_shader_.set("fade_below", fade_distance * lines->style.width);
      line_shader_.set("vanishing_share", vanishing_share);
      lines->rows.draw(GL_LINES);
    }
    glDepthMask(GL_TRUE);
  }

  Shader fill_shader_{"space_fill.vert", "space_fill.frag"};
  Shader line_shader_{"space_line.vert", "space_line.geom", "line.frag"};
  Vec3 origin_{0, 0, 0};
  std::vector<Plane> planes_;
  std::vector<std::unique_ptr<Fill>> fills_;
  std::vector<std::unique_ptr<Lines>> lines_;
};

SpaceRenderer::SpaceRenderer() : impl_(std::make_unique<Impl>()) {}
SpaceRenderer::~SpaceRenderer() = default;
void SpaceRenderer::set_scene(const SpaceScene& scene) { impl_->set_scene(scene); }
void SpaceRenderer::draw(const SpaceCamera& camera, int framebuffer_height) {
  impl_->draw(camera, framebuffer_height);
}

}  // namespace winslow::gui
