#include "gui/render/mesh_buffers.h"

#include "gui/render/draw_list.h"
#include "gui/render/overlap.h"

namespace winslow::gui {
namespace {

template <class T>
std::span<const T> view(const std::vector<T>& values) {
  return values;
}

/// Attribute locations in the vertex shaders.
constexpr GLuint position_attribute = 0, spacing_attribute = 1, height_attribute = 2;

void draw_elements(GLenum mode, std::size_t first, std::size_t count) {
  if (count == 0) return;
  glDrawElements(mode, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(first * sizeof(std::uint32_t)));
}

}  // namespace

MeshBuffers::MeshBuffers() {
  glGenVertexArrays(1, &vertex_array_);
  glBindVertexArray(vertex_array_);
  positions_.bind();
  glEnableVertexAttribArray(position_attribute);
  glVertexAttribPointer(position_attribute, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
  node_spacing_.bind();
  glEnableVertexAttribArray(spacing_attribute);
  glVertexAttribPointer(spacing_attribute, 1, GL_FLOAT, GL_FALSE, 0, nullptr);
  heights_.bind();
  glVertexAttribPointer(height_attribute, 1, GL_FLOAT, GL_FALSE, 0, nullptr);
  glBindVertexArray(0);
}

MeshBuffers::~MeshBuffers() { glDeleteVertexArrays(1, &vertex_array_); }

bool MeshBuffers::upload(DrawList list) {
  glBindVertexArray(vertex_array_);
  positions_.upload(view(list.positions));
  if (list.heights.empty()) {
    glDisableVertexAttribArray(height_attribute);
  } else {
    heights_.upload(view(list.heights));
    glEnableVertexAttribArray(height_attribute);
  }
  node_spacing_.upload(view(list.node_spacing));
  line_spacing_.upload(view(list.line_spacing));
  if (list.triangles != list_.triangles) triangles_.upload(view(list.triangles));
  if (list.lines != list_.lines) lines_.upload(view(list.lines));
  if (list.inverted_triangles != list_.inverted_triangles) {
    inverted_triangles_.upload(view(list.inverted_triangles));
  }
  if (list.inverted_lines != list_.inverted_lines) {
    inverted_lines_.upload(view(list.inverted_lines));
  }
  const bool others = list.triangle_element != list_.triangle_element;
  list_ = std::move(list);
  triangle_lines_stale_ = true;
  glBindVertexArray(0);
  return others;
}

void MeshBuffers::set_element_colors(std::span<const std::uint32_t> rgba) {
  has_colors_ = !rgba.empty();
  see_through_ = std::ranges::any_of(rgba, [](std::uint32_t c) { return c < 0xFF000000U; });
  if (!has_colors_) return;
  if (see_through_) upload_seen_through(rgba);
  std::vector<std::uint32_t> colors;
  colors.reserve(list_.triangle_element.size());
  for (const Index e : list_.triangle_element) {
    colors.push_back(rgba[at(e)]);
  }
  triangle_colors_.upload(view(colors));
}

/// The visible parts of a mesh that overlaps itself depend on which elements are see-through.
void MeshBuffers::upload_seen_through(std::span<const std::uint32_t> rgba) {
  if (!seen_through(list_, rgba)) return;
  glBindVertexArray(vertex_array_);
  positions_.upload(view(list_.positions));
  node_spacing_.upload(view(list_.node_spacing));
  triangles_.upload(view(list_.triangles));
  triangle_lines_stale_ = true;
  glBindVertexArray(0);
}

void MeshBuffers::set_line_opacity(std::span<const float> opacity) {
  has_opacity_ = !opacity.empty();
  if (has_opacity_) line_opacity_.upload(opacity);
}

void MeshBuffers::begin(const Camera& camera) {
  glBindVertexArray(vertex_array_);
  to_clip_ = camera.matrix(list_.origin);
  viewport_[0] = static_cast<float>(camera.viewport_width());
  viewport_[1] = static_cast<float>(camera.viewport_height());
  pixels_per_unit_ = static_cast<float>(1.0 / camera.units_per_pixel());
  glVertexAttrib1f(height_attribute, 0);  // of lists without heights
  if (!list_.depth_test) return glDisable(GL_DEPTH_TEST);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glClear(GL_DEPTH_BUFFER_BIT);
  // Nothing is clipped for being too near or too far; edges lie above the faces that they bound.
  glEnable(GL_DEPTH_CLAMP);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1, 1);
}

void MeshBuffers::end() {
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_DEPTH_CLAMP);
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(0);
}

float MeshBuffers::merging_below(const LineStyle& style) const {
  return style.fade ? merging_spacing(list_, style.width, pixels_per_unit_) : 0;
}

void MeshBuffers::prepare_merged(const LineStyle& style) {
  if (triangle_lines_stale_) triangle_lines_.upload(view(list_.triangle_lines));
  triangle_lines_stale_ = false;
  fill_.set("line_color", style.color);
  fill_.set("line_width", style.width);
  fill_.set("pixels_per_unit", pixels_per_unit_);
  fill_.set("merge_below", merging_below(style));
  fill_.set("fade_below", fade_distance * style.width);
  fill_.set("vanishing_share", vanishing_share);
  fill_.set("triangle_lines", 1);
  triangle_lines_.bind(1);
}

DrawList::Range MeshBuffers::triangles_seen(bool below_inverted) const {
  if (!list_.seen) return {0, list_.triangle_element.size()};
  const DrawList::Seen& seen = *list_.seen;
  const bool cut = seen.beside_inverted.first != seen.alone.first ||
                   seen.beside_inverted.count != seen.alone.count;
  if (below_inverted && cut) return seen.beside_inverted;
  if (!see_through_) return seen.alone;
  // A mesh without overlaps needs no triangles of `through`.
  return seen.alone.first == seen.whole.first ? seen.whole : seen.through;
}

void MeshBuffers::draw_fill(const Rgba* color, const LineStyle* merged, bool below_inverted) {
  fill_.use();
  fill_.set("to_clip", to_clip_);
  fill_.set("color", color ? *color : Rgba{0, 0, 0, 1});
  fill_.set("draw_surface", color ? 1 : 0);
  fill_.set("use_triangle_colors", has_colors_ ? 1 : 0);
  fill_.set("triangle_colors", 0);
  fill_.set("merge_lines", merged ? 1 : 0);
  if (merged) prepare_merged(*merged);
  triangle_colors_.bind(0);
  triangles_.bind();
  const DrawList::Range seen = triangles_seen(below_inverted);
  fill_.set("first_triangle", static_cast<int>(seen.first));
  draw_elements(GL_TRIANGLES, 3 * seen.first, 3 * seen.count);
}

void MeshBuffers::draw_inverted_fill(const Rgba& color) {
  fill_.use();
  fill_.set("to_clip", to_clip_);
  fill_.set("color", color);
  fill_.set("draw_surface", 1);
  fill_.set("merge_lines", 0);
  fill_.set("use_triangle_colors", 0);
  fill_.set("first_triangle", 0);
  fill_.set("triangle_colors", 0);
  inverted_triangles_.bind();
  draw_elements(GL_TRIANGLES, 0, list_.inverted_triangles.size());
}

void MeshBuffers::prepare_lines(const LineStyle& style, std::size_t first_line, bool use_opacity,
                                float merge_below) {
  line_.use();
  line_.set("to_clip", to_clip_);
  line_.set("viewport", viewport_[0], viewport_[1]);
  line_.set("width", style.width);
  line_.set("round_caps", style.round_caps ? 1.0f : 0.0f);
  line_.set("pixels_per_unit", pixels_per_unit_);
  line_.set("fade_below", style.fade ? fade_distance * style.width : 0.0f);
  line_.set("vanishing_share", vanishing_share);
  line_.set("merge_below", merge_below);
  line_.set("first_line", static_cast<int>(first_line));
  line_.set("line_spacing", 0);
  line_.set("color", style.color);
  line_.set("use_line_opacity", use_opacity && has_opacity_ ? 1 : 0);
  line_.set("line_opacity", 1);
  if (use_opacity && has_opacity_) line_opacity_.bind(1);
  line_spacing_.bind(0);
}

void MeshBuffers::draw_lines(const DrawList::Range& range, const LineStyle& style) {
  if (range.count == 0 || style.width <= 0) return;
  prepare_lines(style, range.first);
  lines_.bind();
  draw_elements(GL_LINES, 2 * range.first, 2 * range.count);
}

void MeshBuffers::draw_interior_lines(const LineStyle& style) {
  DrawList::Range range = list_.interior;
  const float merging = merging_below(style);
  if (style.fade) {
    const float vanishing = vanishing_share * fade_distance * style.width / pixels_per_unit_;
    range.count = std::min(range.count, lines_spaced(list_, std::max(vanishing, merging)));
  }
  if (range.count == 0 || style.width <= 0) return;
  prepare_lines(style, range.first, true, merging);
  lines_.bind();
  draw_elements(GL_LINES, 2 * range.first, 2 * range.count);
}

void MeshBuffers::draw_inverted_outlines(const LineStyle& style) {
  prepare_lines(style, 0);
  inverted_lines_.bind();
  draw_elements(GL_LINES, 0, list_.inverted_lines.size());
}

void MeshBuffers::draw_nodes(const Rgba& color, float size) {
  node_.use();
  node_.set("to_clip", to_clip_);
  node_.set("size", size);
  node_.set("pixels_per_unit", pixels_per_unit_);
  node_.set("color", color);
  glEnable(GL_PROGRAM_POINT_SIZE);
  glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(list_.node_spacing.size()));
  glDisable(GL_PROGRAM_POINT_SIZE);
}

}  // namespace winslow::gui
