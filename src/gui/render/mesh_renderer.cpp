#include "gui/render/mesh_renderer.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "gui/render/mesh_buffers.h"

namespace winslow::gui {
namespace {

/// Above this many pixels from end to end, single precision would displace the ends of long edges
/// visibly (2^19 pixels: by 0.03 of one); the mesh is then cut to the view in double precision.
constexpr double most_pixels = 524288;
/// The view is cut with room around it, so that panning does not cut again at once ...
constexpr double room = 1.5;
/// ... and again when the view has shrunk to this share of what was cut.
constexpr double smallest_share = 1.0 / 64.0;

std::uint32_t pack(const Rgb& color) {
  const auto byte = [](float c) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(c, 0.0f, 1.0f) * 255.0f));
  };
  return byte(color[0]) | (byte(color[1]) << 8U) | (byte(color[2]) << 16U) | 0xFF000000U;
}

/// Colours of all values. Sampling the map per element would dominate the update of a large mesh:
/// a table of 1024 colours is finer than 8 bits can show.
std::vector<std::uint32_t> pack_colors(std::span<const double> values, const ColorScale& scale) {
  constexpr std::size_t size = 1024;
  const double span = scale.high - scale.low;
  std::vector<std::uint32_t> table(size);
  for (std::size_t k = 0; k < size; ++k) {
    table[k] = pack(scale.color(scale.low + span * (static_cast<double>(k) + 0.5) / size));
  }
  std::vector<std::uint32_t> colors;
  colors.reserve(values.size());
  for (const double value : values) {
    if (std::isnan(value) || !(span > 0)) {
      colors.push_back(pack(scale.color(value)));
      continue;
    }
    const double t = std::clamp((value - scale.low) / span, 0.0, 1.0);
    colors.push_back(table[std::min(static_cast<std::size_t>(t * size), size - 1)]);
  }
  return colors;
}

bool contains(const Bounds& outer, const Bounds& inner) {
  return (inner.min.array() >= outer.min.array()).all() &&
         (inner.max.array() <= outer.max.array()).all();
}

}  // namespace

class MeshRenderer::Impl {
 public:
  void set_mesh(const std::shared_ptr<const Topology>& topology, const Coordinates& coordinates) {
    if (topology_ != topology) {
      groups_ = group_edges(*topology);
      clear_values();
    }
    topology_ = topology;
    coordinates_ = coordinates;
    extent_ = bounds(Mesh{topology, coordinates});
    stale_ = true;
  }

  void set_values(std::span<const double> values, const ColorScale& scale) {
    if (topology_ == nullptr ||
        values.size() != static_cast<std::size_t>(topology_->element_count())) {
      throw UsageError("colours need one value for each element");
    }
    colors_ = pack_colors(values, scale);
    colors_stale_ = true;
  }

  void clear_values() {
    colors_.clear();
    colors_stale_ = true;
  }

  void set_marker_styles(std::vector<MarkerStyle> styles) { marker_styles_ = std::move(styles); }

  void draw(const Camera& camera, const MeshStyle& style, int framebuffer_height) {
    if (topology_ == nullptr) return;
    prepare(camera);
    const auto x = static_cast<GLint>(std::lround(camera.viewport_origin().x()));
    const auto width = static_cast<GLsizei>(std::lround(camera.viewport_width()));
    const auto height = static_cast<GLsizei>(std::lround(camera.viewport_height()));
    const auto y =
        framebuffer_height - static_cast<GLint>(std::lround(camera.viewport_origin().y())) - height;
    glViewport(x, y, width, height);
    glScissor(x, y, width, height);
    glEnable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    buffers_.begin(camera);
    draw_surface(style);
    draw_lines(style);
    if (style.node_size > 0) buffers_.draw_nodes(style.edge_color, style.node_size);
    glBindVertexArray(0);
    glDisable(GL_SCISSOR_TEST);
  }

 private:
  /// Brings the draw list up to date with the mesh and with how deep the camera looks into it.
  void prepare(const Camera& camera) {
    const bool deep = extent_.size().maxCoeff() / camera.units_per_pixel() > most_pixels;
    const Bounds view = camera.visible();
    const bool outside = deep && (!contains(cut_, view) ||
                                  view.size().maxCoeff() < smallest_share * cut_.size().maxCoeff());
    if (stale_ || deep != deep_ || outside) {
      deep_ = deep;
      if (deep) {
        cut_ = {view.min - room * view.size(), view.max + room * view.size()};
        buffers_.upload(clipped_draw_list(*topology_, groups_, coordinates_, cut_));
      } else {
        buffers_.upload(whole_draw_list(*topology_, groups_, coordinates_, extent_.centre()));
      }
      stale_ = false;
      colors_stale_ = true;
    }
    if (colors_stale_) buffers_.set_element_colors(colors_);
    colors_stale_ = false;
  }

  void draw_surface(const MeshStyle& style) {
    if (style.fill) buffers_.draw_fill(style.fill_color, true);
    if (style.show_inverted) buffers_.draw_inverted_fill(style.inverted_color);
  }

  void draw_lines(const MeshStyle& style) {
    const auto& list = buffers_.list();
    if (style.wireframe) {
      buffers_.draw_interior_lines({style.edge_color, style.edge_width, false, true});
    }
    if (style.show_inverted) {
      Rgba outline = style.inverted_color;
      for (std::size_t c = 0; c < 3; ++c) outline[c] *= 0.7f;
      buffers_.draw_inverted_outlines({outline, std::max(style.edge_width, 1.5f), true, false});
    }
    buffers_.draw_lines(list.boundary, {style.edge_color, style.boundary_width, true, false});
    for (std::size_t m = 0; m < list.markers.size(); ++m) {
      MarkerStyle marker{style.edge_color, style.boundary_width};
      if (m < marker_styles_.size()) marker = marker_styles_[m];
      buffers_.draw_lines(list.markers[m], {marker.color, marker.width, true, false});
    }
  }

  std::shared_ptr<const Topology> topology_;
  Coordinates coordinates_;
  Bounds extent_;
  EdgeGroups groups_;
  std::vector<std::uint32_t> colors_;
  std::vector<MarkerStyle> marker_styles_;
  bool stale_ = true, colors_stale_ = true, deep_ = false;
  Bounds cut_;
  MeshBuffers buffers_;
};

MeshRenderer::MeshRenderer() : impl_(std::make_unique<Impl>()) {}
MeshRenderer::~MeshRenderer() = default;

void MeshRenderer::set_mesh(const std::shared_ptr<const Topology>& topology,
                            const Coordinates& coordinates) {
  impl_->set_mesh(topology, coordinates);
}
void MeshRenderer::set_values(std::span<const double> values, const ColorScale& scale) {
  impl_->set_values(values, scale);
}
void MeshRenderer::clear_values() { impl_->clear_values(); }
void MeshRenderer::set_marker_styles(std::vector<MarkerStyle> styles) {
  impl_->set_marker_styles(std::move(styles));
}
void MeshRenderer::draw(const Camera& camera, const MeshStyle& style, int /*framebuffer_width*/,
                        int framebuffer_height) {
  impl_->draw(camera, style, framebuffer_height);
}

}  // namespace winslow::gui
