#include "gui/render/space/space_renderer.h"

#include <initializer_list>
#include <utility>

#include "core/error.h"
#include "gui/render/draw_list.h"
#include "gui/render/gl.h"

namespace winslow::gui {

/// Vertices on the graphics card: rows of numbers, with the layout of their attributes.
class VertexRows {
 public:
  VertexRows() { glGenVertexArrays(1, &array_); }
  ~VertexRows() { glDeleteVertexArrays(1, &array_); }
  VertexRows(const VertexRows&) = delete;
  VertexRows& operator=(const VertexRows&) = delete;

  struct Column {
    GLint count;
    GLenum type;
    GLboolean normalised;
    std::size_t offset;
  };
  template <class Row>
  void upload(const std::vector<Row>& rows, std::initializer_list<Column> columns) {
    glBindVertexArray(array_);
    buffer_.upload(std::span<const Row>(rows));
    GLuint k = 0;
    for (const Column& c : columns) {
      glEnableVertexAttribArray(k);
      glVertexAttribPointer(k++, c.count, c.type, c.normalised, sizeof(Row),
                            reinterpret_cast<const void*>(c.offset));
    }
    glBindVertexArray(0);
    count_ = static_cast<GLsizei>(rows.size());
  }
  void draw(GLenum mode) const {
    glBindVertexArray(array_);
    glDrawArrays(mode, 0, count_);
    glBindVertexArray(0);
  }

 private:
  GLuint array_ = 0;
  GlBuffer buffer_{GL_ARRAY_BUFFER};
  GLsizei count_ = 0;
};

namespace {

/// Opacity of emphasised fills where something hides them.
constexpr float hidden_opacity = 0.22f;
/// Offset of faces behind their edges, as a multiple of their change of depth over a pixel: a line
/// extends as far as that to either side of its axis.
constexpr float set_back = 1.5f;
/// Factor on the width of tinted border lines.
constexpr float lit_width = 1.9f;

Rgba as_float(const Vec3& v, double w) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()),
          static_cast<float>(w)};
}

}  // namespace

class SpaceRenderer::Impl {
 public:
  void set_parts(const std::vector<std::shared_ptr<const SpaceScene>>& parts,
                 const std::vector<Plane>& planes) {
    if (planes.size() > most_clip_planes)
      throw UsageError("at most " + std::to_string(most_clip_planes) + " planes cut a scene");
    std::vector<std::unique_ptr<Part>> kept = std::move(parts_);
    parts_.clear();
    for (const auto& scene : parts) {
      const auto same =
          std::ranges::find_if(kept, [&](const auto& part) { return part && part->of == scene; });
      parts_.push_back(same == kept.end() ? uploaded(scene) : std::move(*same));
    }
    planes_ = planes;
  }
  void set_tints(std::vector<Rgba> tints) { tints_ = std::move(tints); }

  void draw(const SpaceCamera& camera, int framebuffer_height) {
    begin(camera, framebuffer_height);
    for (const auto& part : parts_)
      for (const auto& fill : part->fills)
        if (fill->style.opacity >= 1) draw_solid(*part, *fill, camera);
    draw_lines(camera);
    for (const auto& part : parts_)
      for (const auto& fill : part->fills)
        if (fill->style.opacity < 1) draw_see_through(*part, *fill, camera);
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
  struct Part {
    std::shared_ptr<const SpaceScene> of;
    std::vector<std::unique_ptr<Fill>> fills;
    std::vector<std::unique_ptr<Lines>> lines;
  };

  static std::unique_ptr<Part> uploaded(const std::shared_ptr<const SpaceScene>& scene) {
    auto part = std::make_unique<Part>();
    part->of = scene;
    for (const SpaceFill& fill : scene->fills) {
      if (fill.corners.empty()) continue;
      Fill& made = *part->fills.emplace_back(std::make_unique<Fill>());
      made.rows.upload(fill.corners, {{3, GL_FLOAT, GL_FALSE, offsetof(SpaceCorner, position)},
                                      {3, GL_FLOAT, GL_FALSE, offsetof(SpaceCorner, normal)},
                                      {4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(SpaceCorner, rgba)}});
      made.style = {
          {}, {}, fill.marker, fill.shading, fill.opacity, fill.emphasised, fill.clipped_by};
    }
    for (const SpaceLines& lines : scene->lines) {
      if (lines.ends.empty() || lines.width <= 0) continue;
      Lines& made = *part->lines.emplace_back(std::make_unique<Lines>());
      made.rows.upload(lines.ends, {{3, GL_FLOAT, GL_FALSE, offsetof(SpaceLines::End, position)},
                                    {1, GL_FLOAT, GL_FALSE, offsetof(SpaceLines::End, spacing)}});
      made.style = {{}, lines.color, lines.width, lines.clipped_by, lines.marker};
    }
    return part;
  }

  static void begin(const SpaceCamera& camera, int framebuffer_height) {
    const ScreenBox box = camera.viewport();
    const auto x = static_cast<GLint>(std::lround(box.min.x()));
    const auto y = framebuffer_height - static_cast<GLint>(std::lround(box.max.y()));
    const auto width = static_cast<GLsizei>(std::lround(box.size().x()));
    const auto height = static_cast<GLsizei>(std::lround(box.size().y()));
    glViewport(x, y, width, height);
    glScissor(x, y, width, height);
    glEnable(GL_SCISSOR_TEST);
    draw_over();
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

  void set_common(const Shader& shader, const SpaceCamera& camera, const Vec3& origin,
                  unsigned clipped_by) const {
    shader.use();
    shader.set("to_clip", camera.matrix(origin));
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      const Vec3& n = planes_[k].normal();
      const std::string name = "planes[" + std::to_string(k) + "]";
      shader.set(name.c_str(),
                 Rgba{static_cast<float>(n.x()), static_cast<float>(n.y()),
                      static_cast<float>(n.z()), static_cast<float>(planes_[k].distance(origin))});
    }
    const unsigned there = (1U << planes_.size()) - 1;
    shader.set("clipped_by", static_cast<int>(clipped_by & there));
  }

  void prepare(const Part& part, const Fill& fill, const SpaceCamera& camera, float opacity) const {
    set_common(fill_shader_, camera, part.of->origin, fill.style.clipped_by);
    const auto marker = static_cast<std::size_t>(fill.style.marker);
    const bool tinted = fill.style.marker >= 0 && marker < tints_.size();
    fill_shader_.set("tint", tinted ? tints_[marker] : Rgba{0, 0, 0, 0});
    const Vec3 light = (camera.back() + 0.35 * camera.up() - 0.3 * camera.right()).normalized();
    fill_shader_.set("light", as_float(light, 0));
    fill_shader_.set("shading", fill.style.shading);
    fill_shader_.set("opacity", opacity);
    const auto pixel_depth = camera.pixel_depth();
    fill_shader_.set("pixel_depth", static_cast<float>(pixel_depth[0]),
                     static_cast<float>(pixel_depth[1]));
    const bool perspective = camera.in_perspective();
    fill_shader_.set("viewer", perspective ? as_float(camera.viewer() - part.of->origin, 1)
                                           : as_float(camera.back(), 0));
    fill_shader_.set("set_back", fill.style.emphasised ? 0.5f * set_back : set_back);
  }

  void draw_solid(const Part& part, const Fill& fill, const SpaceCamera& camera) const {
    prepare(part, fill, camera, 1);
    fill.rows.draw(GL_TRIANGLES);
    if (!fill.style.emphasised) return;
    prepare(part, fill, camera, hidden_opacity);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_FALSE);
    fill.rows.draw(GL_TRIANGLES);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LEQUAL);
  }

  /// Draws the depth first, so that only one layer remains.
  void draw_see_through(const Part& part, const Fill& fill, const SpaceCamera& camera) const {
    prepare(part, fill, camera, fill.style.opacity);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    fill.rows.draw(GL_TRIANGLES);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    fill.rows.draw(GL_TRIANGLES);
  }

  /// Border lines of tinted markers are thicker, as in plane meshes.
  float width_of(const SpaceLines& lines) const {
    const auto marker = static_cast<std::size_t>(lines.marker);
    const bool lit = lines.marker >= 0 && marker < tints_.size() && tints_[marker][3] > 0;
    return (lit ? lit_width : 1.0f) * lines.width;
  }

  void draw_lines(const SpaceCamera& camera) const {
    glDepthMask(GL_FALSE);
    const ScreenVector size = camera.viewport().size();
    line_shader_.use();
    line_shader_.set("viewport", static_cast<float>(size.x()), static_cast<float>(size.y()));
    line_shader_.set("pixels_per_unit", static_cast<float>(1 / camera.units_per_pixel()));
    line_shader_.set("vanishing_share", vanishing_share);
    for (const auto& part : parts_)
      for (const auto& lines : part->lines) {
        set_common(line_shader_, camera, part->of->origin, lines->style.clipped_by);
        const float width = width_of(lines->style);
        line_shader_.set("width", width);
        line_shader_.set("color", lines->style.color);
        line_shader_.set("fade_below", fade_distance * width);
        lines->rows.draw(GL_LINES);
      }
    glDepthMask(GL_TRUE);
  }

  Shader fill_shader_{"space_fill.vert", "space_fill.frag"};
  Shader line_shader_{"space_line.vert", "space_line.geom", "line.frag"};
  std::vector<Plane> planes_;
  std::vector<Rgba> tints_;
  std::vector<std::unique_ptr<Part>> parts_;
};

SpaceRenderer::SpaceRenderer() : impl_(std::make_unique<Impl>()) {}
SpaceRenderer::~SpaceRenderer() = default;
void SpaceRenderer::set_parts(const std::vector<std::shared_ptr<const SpaceScene>>& parts,
                              const std::vector<Plane>& planes) {
  impl_->set_parts(parts, planes);
}
void SpaceRenderer::set_scene(const SpaceScene& scene) {
  impl_->set_parts({std::make_shared<const SpaceScene>(scene)}, scene.planes);
}
void SpaceRenderer::set_tints(std::vector<Rgba> tints) { impl_->set_tints(std::move(tints)); }
void SpaceRenderer::draw(const SpaceCamera& camera, int framebuffer_height) {
  impl_->draw(camera, framebuffer_height);
}

}  // namespace winslow::gui
