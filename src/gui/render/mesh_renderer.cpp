#include "gui/render/mesh_renderer.h"

#include "core/error.h"
#include "gui/render/gl.h"
#include "gui/render/mesh_buffers.h"

namespace winslow::gui {
namespace {

/// Above this size of the mesh in pixels, single precision would displace the ends of long edges
/// visibly (2^19 pixels: by 0.03 of one); the mesh is then clipped to the view in double precision.
constexpr double most_pixels = 524288;
/// The mesh is clipped with room around the view, so that panning does not clip again at once ...
constexpr double room = 1.5;
/// ... and again when the view has shrunk to this share of the clipped part.
constexpr double smallest_share = 1.0 / 64.0;

bool contains(const Bounds& outer, const Bounds& inner) {
  return (inner.min.array() >= outer.min.array()).all() &&
         (inner.max.array() <= outer.max.array()).all();
}

/// Pixels of the framebuffer as OpenGL counts them, y up.
struct PixelBox {
  GLint x, y;
  GLsizei width, height;
};

PixelBox pixel_box(const ScreenBox& box, int framebuffer_height) {
  const auto x = static_cast<GLint>(std::lround(box.min.x()));
  const auto top = static_cast<GLint>(std::lround(box.min.y()));
  const auto width = static_cast<GLsizei>(std::lround(box.max.x())) - x;
  const auto height = static_cast<GLsizei>(std::lround(box.max.y())) - top;
  return {x, framebuffer_height - top - height, std::max(width, 0), std::max(height, 0)};
}

}  // namespace

PreparedMesh prepare_mesh(const std::shared_ptr<const Topology>& topology,
                          const Coordinates& coordinates,
                          std::shared_ptr<const EdgeGroups> groups) {
  if (!groups) groups = std::make_shared<const EdgeGroups>(group_edges(*topology));
  const Bounds extent = bounds(Mesh{topology, coordinates});
  DrawList whole = whole_draw_list(*topology, *groups, coordinates, extent.centre());
  return {topology, std::move(groups), coordinates, extent, std::move(whole)};
}

std::uint32_t pack_color(const Rgb& color) {
  const auto byte = [](float c) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(c, 0.0f, 1.0f) * 255.0f));
  };
  return byte(color[0]) | (byte(color[1]) << 8U) | (byte(color[2]) << 16U) | 0xFF000000U;
}

/// Uses a table of 1024 colours, finer than 8 bits can show: sampling the map per element would
/// dominate the update of a large mesh.
std::vector<std::uint32_t> element_colors(std::span<const double> values, const ColorScale& scale,
                                          std::span<const float> opacity) {
  constexpr std::size_t size = 1024;
  std::vector<std::uint32_t> table(size);
  for (std::size_t k = 0; k < size; ++k)
    table[k] = pack_color(scale.color(scale.value_at((static_cast<double>(k) + 0.5) / size)));
  std::vector<std::uint32_t> colors;
  colors.reserve(values.size());
  for (const double value : values) {
    if (std::isnan(value) || !(scale.high > scale.low)) {
      colors.push_back(pack_color(scale.color(value)));
      continue;
    }
    const auto k = static_cast<std::size_t>(scale.share(value) * size);
    colors.push_back(table[std::min(k, size - 1)]);
  }
  for (std::size_t e = 0; e < std::min(opacity.size(), colors.size()); ++e) {
    const auto alpha = static_cast<std::uint32_t>(std::lround(255.0f * opacity[e]));
    colors[e] = (colors[e] & 0x00FFFFFFU) | (alpha << 24U);
  }
  return colors;
}

/// A part of the mesh on the graphics card: all of it, or what was clipped to one view.
struct MeshRenderer::Part {
  MeshBuffers buffers;
  Bounds cut;
  bool stale = true, colors_stale = true, opacity_stale = true;
};

MeshRenderer::MeshRenderer() : whole_(std::make_unique<Part>()) {}
MeshRenderer::~MeshRenderer() = default;

void MeshRenderer::set_mesh(PreparedMesh mesh) {
  if (mesh_.topology != mesh.topology) clear_values();
  mesh_ = std::move(mesh);
  ++revision_;
  whole_->stale = true;
  for (auto& cut : cuts_)
    if (cut) cut->stale = true;
}

void MeshRenderer::set_mesh(const std::shared_ptr<const Topology>& topology,
                            const Coordinates& coordinates) {
  set_mesh(
      prepare_mesh(topology, coordinates, topology == mesh_.topology ? mesh_.groups : nullptr));
}

void MeshRenderer::set_values(std::span<const double> values, const ColorScale& scale) {
  set_colors(element_colors(values, scale), {});
}

void MeshRenderer::set_colors(std::vector<std::uint32_t> colors, std::vector<float> opacity) {
  const auto count = static_cast<std::size_t>(mesh_.topology ? mesh_.topology->element_count() : 0);
  if (colors.size() != count || (!opacity.empty() && opacity.size() != count))
    throw UsageError("colours need one value for each element");
  colors_ = std::move(colors);
  opacity_ = std::move(opacity);
  recolor();
}

void MeshRenderer::clear_values() {
  colors_.clear();
  opacity_.clear();
  recolor();
}

void MeshRenderer::recolor() {
  ++revision_;
  whole_->colors_stale = whole_->opacity_stale = true;
  for (auto& cut : cuts_)
    if (cut) cut->colors_stale = cut->opacity_stale = true;
}

/// Brings a part up to date with the mesh and the zoom of the camera.
MeshRenderer::Part& MeshRenderer::prepare(const Camera& camera, int view) {
  const bool deep = mesh_.extent.size().maxCoeff() / camera.units_per_pixel() > most_pixels;
  auto& own = cuts_[static_cast<std::size_t>(std::clamp(view, 0, 1))];
  if (deep && !own) own = std::make_unique<Part>();
  Part& part = deep ? *own : *whole_;
  if (deep) {
    const Bounds seen = camera.visible();
    if (part.stale || !contains(part.cut, seen) ||
        seen.size().maxCoeff() < smallest_share * part.cut.size().maxCoeff()) {
      part.cut = {seen.min - room * seen.size(), seen.max + room * seen.size()};
      part.colors_stale |= part.buffers.upload(
          clipped_draw_list(*mesh_.topology, *mesh_.groups, mesh_.coordinates, part.cut));
      part.opacity_stale = true;
    }
  } else if (part.stale) {
    part.colors_stale |= part.buffers.upload(std::move(mesh_.whole));
    part.opacity_stale = true;  // the order of lines changes
  }
  part.stale = false;
  if (part.colors_stale) part.buffers.set_element_colors(colors_);
  if (part.opacity_stale) part.buffers.set_line_opacity(line_opacity(part.buffers.list()));
  part.colors_stale = part.opacity_stale = false;
  return part;
}

/// Opacity of the interior lines; empty: all are drawn in full.
std::vector<float> MeshRenderer::line_opacity(const DrawList& list) const {
  std::vector<float> lines;
  if (opacity_.empty()) return lines;
  lines.reserve(list.line_edge.size());
  for (const Index index : list.line_edge) {
    float clearest = 0;
    for (const Index e : mesh_.topology->edges()[at(index)].elements)
      if (e >= 0) clearest = std::max(clearest, opacity_[at(e)]);
    lines.push_back(clearest);
  }
  return lines;
}

namespace {

MeshBuffers::LineStyle interior_style(const MeshStyle& style) {
  return {style.edge_color, style.edge_width, false, true};
}

void draw_surface(MeshBuffers& buffers, const MeshStyle& style) {
  const MeshBuffers::LineStyle lines = interior_style(style);
  const bool merges = style.wireframe && buffers.merges(lines);
  if (style.fill || merges)
    buffers.draw_fill(style.fill ? &style.fill_color : nullptr, merges ? &lines : nullptr,
                      style.show_inverted);
  if (style.show_inverted) buffers.draw_inverted_fill(style.inverted_color);
}

void draw_lines(MeshBuffers& buffers, const MeshStyle& style,
                std::span<const MeshRenderer::MarkerStyle> markers) {
  const auto& list = buffers.list();
  if (style.wireframe) buffers.draw_interior_lines(interior_style(style));
  if (style.show_inverted) {
    Rgba outline = style.inverted_color;
    for (std::size_t c = 0; c < 3; ++c) outline[c] *= 0.7f;
    buffers.draw_inverted_outlines({outline, std::max(style.edge_width, 1.5f), true, false});
  }
  if (!style.markers) return;
  buffers.draw_lines(list.boundary, {style.edge_color, style.boundary_width, true, false});
  for (std::size_t m = 0; m < list.markers.size(); ++m) {
    MeshRenderer::MarkerStyle marker{style.edge_color, style.boundary_width};
    if (m < markers.size()) marker = markers[m];
    if (marker.width <= 0) continue;
    buffers.draw_lines(list.markers[m], {marker.color, marker.width, true, false});
  }
}

}  // namespace

void MeshRenderer::draw(const Camera& camera, const MeshStyle& style, int framebuffer_height,
                        int view) {
  if (mesh_.topology == nullptr) return;
  MeshBuffers& buffers = prepare(camera, view).buffers;
  const ScreenBox seen = camera.viewport();
  const PixelBox port = pixel_box(seen, framebuffer_height);
  const PixelBox part = pixel_box(style.clip.value_or(seen), framebuffer_height);
  glViewport(port.x, port.y, port.width, port.height);
  glScissor(part.x, part.y, part.width, part.height);
  glEnable(GL_SCISSOR_TEST);
  draw_over();
  buffers.begin(camera);
  draw_surface(buffers, style);
  draw_lines(buffers, style, marker_styles_);
  if (style.node_size > 0) buffers.draw_nodes(style.edge_color, style.node_size);
  buffers.end();
  glDisable(GL_SCISSOR_TEST);
}

namespace {

// More steps than 8 bits can show between colours so close.
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
    // The first and the last strip extend to the rim: rounding must leave no gap.
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
