#pragma once

#include "gui/render/draw_list.h"
#include "gui/render/gl.h"
#include "gui/render/mesh_renderer.h"

namespace winslow::gui {

/// A DrawList on the graphics card, and the draw calls for its parts.
class MeshBuffers {
 public:
  MeshBuffers();
  ~MeshBuffers();
  MeshBuffers(const MeshBuffers&) = delete;
  MeshBuffers& operator=(const MeshBuffers&) = delete;

  /// Uploads what differs from the present list: if the mesh only moved, its positions and the
  /// order of its lines. True if the triangles are those of other elements than before, so that
  /// their colours must be set again.
  bool upload(DrawList list);
  const DrawList& list() const { return list_; }

  /// One colour per element, spread over the list's triangles; empty: none.
  void set_element_colors(std::span<const std::uint32_t> rgba);
  /// One opacity per interior line; empty: all are drawn in full.
  void set_line_opacity(std::span<const float> opacity);

  /// How lines are drawn; fade: thin them out where they are denser than a few pixels.
  struct LineStyle {
    Rgba color;
    float width;
    bool round_caps;
    bool fade;
  };
  /// Draws with this camera until end(), with a depth test if the list asks for it.
  void begin(const Camera& camera);
  void end();
  /// color: of elements without colours; null: the surface is not drawn. merged: interior lines
  /// whose faintest are drawn as part of the triangles, see merges(); null: none. below_inverted:
  /// draw_inverted_fill() follows, and what it hides need not be drawn.
  void draw_fill(const Rgba* color, const LineStyle* merged, bool below_inverted);
  /// True if there are so many faint lines that draw_fill() draws them instead of
  /// draw_interior_lines().
  bool merges(const LineStyle& style) const { return merging_below(style) > 0; }
  void draw_inverted_fill(const Rgba& color);
  void draw_inverted_outlines(const LineStyle& style);
  void draw_interior_lines(const LineStyle& style);
  void draw_lines(const DrawList::Range& range, const LineStyle& style);
  void draw_nodes(const Rgba& color, float size);

 private:
  void upload_seen_through(std::span<const std::uint32_t> rgba);
  float merging_below(const LineStyle& style) const;
  DrawList::Range triangles_seen(bool below_inverted) const;
  void prepare_merged(const LineStyle& style);
  void prepare_lines(const LineStyle& style, std::size_t first_line, bool use_opacity = false,
                     float merge_below = 0);

  DrawList list_;
  GLuint vertex_array_ = 0;
  GlBuffer positions_{GL_ARRAY_BUFFER}, heights_{GL_ARRAY_BUFFER}, node_spacing_{GL_ARRAY_BUFFER};
  GlBuffer triangles_{GL_ELEMENT_ARRAY_BUFFER}, lines_{GL_ELEMENT_ARRAY_BUFFER};
  GlBuffer inverted_triangles_{GL_ELEMENT_ARRAY_BUFFER}, inverted_lines_{GL_ELEMENT_ARRAY_BUFFER};
  GlTextureBuffer triangle_colors_{GL_RGBA8}, line_spacing_{GL_R32F}, line_opacity_{GL_R32F},
      triangle_lines_{GL_RG32F};
  bool has_colors_ = false, has_opacity_ = false;
  bool see_through_ = false;  // some of the colours are
  bool triangle_lines_stale_ = true;
  Shader fill_{"fill.vert", "fill.frag"};
  Shader line_{"fill.vert", "line.geom", "line.frag"};
  Shader node_{"node.vert", "node.frag"};
  std::array<float, 16> to_clip_{};
  float viewport_[2] = {1, 1};
  float pixels_per_unit_ = 1;
};

}  // namespace winslow::gui
