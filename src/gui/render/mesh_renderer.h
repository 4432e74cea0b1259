#pragma once

#include "core/mesh/mesh.h"
#include "gui/render/color_scale.h"
#include "gui/render/draw_list.h"
#include "gui/render/view.h"

namespace winslow::gui {

using Rgba = std::array<float, 4>;

/// How the mesh is drawn. Sizes are in framebuffer pixels.
struct MeshStyle {
  bool fill = true;
  bool wireframe = true;
  float edge_width = 1.0f;
  float boundary_width = 2.0f;
  float node_size = 0;                      ///< 0: no nodes
  Rgba fill_color{0.93f, 0.94f, 0.96f, 1};  ///< where no values are set
  Rgba edge_color{0.25f, 0.28f, 0.33f, 1};
  Rgba inverted_color{0.90f, 0.10f, 0.12f, 1};
  bool show_inverted = true;  ///< inverted elements in inverted_color, above the others
  bool markers = true;        ///< edges of the boundary
  /// Part of the framebuffer to draw in; none: all of the camera's viewport.
  std::optional<ScreenBox> clip;

  bool operator==(const MeshStyle&) const = default;
};

/// A mesh prepared for drawing, which takes long and can be done on any thread.
struct PreparedMesh {
  std::shared_ptr<const Topology> topology;
  std::shared_ptr<const EdgeGroups> groups;
  Coordinates coordinates;
  Bounds extent;
  DrawList whole;
};
/// groups: those of an earlier mesh of the same topology, which saves the time to find them; null:
/// they are found.
PreparedMesh prepare_mesh(const std::shared_ptr<const Topology>& topology,
                          const Coordinates& coordinates,
                          std::shared_ptr<const EdgeGroups> groups = nullptr);

/// Packs a colour for the renderer: RGBA, 8 bits each, opaque.
std::uint32_t pack_color(const Rgb& color);

/// Colours of values, packed for the renderer (RGBA, 8 bits each). opacity: one per value; none:
/// opaque.
std::vector<std::uint32_t> element_colors(std::span<const double> values, const ColorScale& scale,
                                          std::span<const float> opacity = {});

/// Draws one mesh into the bound framebuffer with the bound GL context. Buffers are updated, not
/// rebuilt, when only positions or values change. Where cells are smaller than a pixel, edges fade
/// so that the picture does not turn black.
class MeshRenderer {
 public:
  MeshRenderer();
  ~MeshRenderer();
  MeshRenderer(const MeshRenderer&) = delete;
  MeshRenderer& operator=(const MeshRenderer&) = delete;

  /// Sets the mesh; cheap if its topology is the one already held.
  void set_mesh(const std::shared_ptr<const Topology>& topology, const Coordinates& coordinates);
  /// Topology of the mesh held; null before the first.
  const std::shared_ptr<const Topology>& topology() const { return mesh_.topology; }
  void set_mesh(PreparedMesh mesh);
  /// Edge groups of the mesh held; null without one.
  std::shared_ptr<const EdgeGroups> edge_groups() const { return mesh_.groups; }

  /// Grows with every change of mesh or colours.
  std::uint64_t revision() const { return revision_; }

  /// Colours elements by one value each; none: style.fill_color.
  void set_values(std::span<const double> values, const ColorScale& scale);
  /// The same with colours of element_colors(). opacity: of the edges between elements, one per
  /// element; an edge has the larger one of its elements; none: opaque.
  void set_colors(std::vector<std::uint32_t> colors, std::vector<float> opacity);
  void clear_values();
  /// Colour of each marker (index into Topology::markers()) and how strongly it is emphasised.
  struct MarkerStyle {
    Rgba color{0, 0, 0, 1};
    float width = 2.0f;

    bool operator==(const MarkerStyle&) const = default;
  };
  void set_marker_styles(std::vector<MarkerStyle> styles) { marker_styles_ = std::move(styles); }

  /// view: 0 or 1; the number of the camera where several draw the mesh in a frame (a magnifier).
  /// Each keeps its own clipped part of the mesh.
  void draw(const Camera& camera, const MeshStyle& style, int framebuffer_height, int view = 0);

 private:
  struct Part;
  Part& prepare(const Camera& camera, int view);
  std::vector<float> line_opacity(const DrawList& list) const;
  void recolor();

  std::uint64_t revision_ = 0;
  PreparedMesh mesh_;
  std::vector<std::uint32_t> colors_;
  std::vector<float> opacity_;
  std::vector<MarkerStyle> marker_styles_;
  std::unique_ptr<Part> whole_;
  std::array<std::unique_ptr<Part>, 2> cuts_;
};

/// The background of a mesh: one colour, or a gradient of two.
struct BackdropColors {
  Rgba top{1, 1, 1, 1}, bottom{1, 1, 1, 1};
  /// True if lines on it must be light.
  bool dark() const;
  bool operator==(const BackdropColors&) const = default;
};

/// Fills the camera's part of the bound framebuffer, `framebuffer_height` pixels high. whole: the
/// view of which the camera sees a part; the gradient spans all of it.
void draw_backdrop(const Camera& camera, const Camera& whole, const BackdropColors& colors,
                   int framebuffer_height);

}  // namespace winslow::gui
