#include "gui/picture/picture.h"

#include "core/command/command.h"
#include "core/error.h"
#include "core/inspect/nodal_view.h"
#include "gui/picture/frame/picture_frame.h"
#include "gui/render/color_scale.h"
#include "gui/render/gl_context.h"
#include "gui/view/overlays/vcv_overlay.h"

namespace winslow::gui {
namespace {

void check(const PictureOptions& options) {
  if (options.bounds && !((options.bounds->max - options.bounds->min).array() > 0).all()) {
    throw UsageError("the bounds of a picture are x0 y0 x1 y1 with x0 < x1 and y0 < y1");
  }
  check_colors(options.color, options.colors);
}

/// Of what elements are coloured by.
std::vector<double> field_values(const VirtualControlVolumes& vcv, const Mesh& mesh,
                                 const PictureOptions& options) {
  return element_values(vcv, mesh.coordinates, *options.color, 0, {.before = options.before.get()});
}

std::vector<NodalView> inspect_nodes(const VirtualControlVolumes& vcv, const Coordinates& x,
                                     std::span<const Index> nodes) {
  std::vector<NodalView> views;
  for (const Index node : nodes) views.push_back(inspect_node(vcv, x, node));
  return views;
}

MeshStyle mesh_style(const PictureOptions& options, const PictureTheme& theme, float unit) {
  MeshStyle style;
  style.wireframe = options.wireframe;
  style.edge_width = 0.05f * unit;
  style.boundary_width = 0.11f * unit;
  style.fill_color = theme.fill;
  style.edge_color = theme.edge;
  if (options.color)
    style.edge_color = edges_on_colors(*options.color, options.colors, options.dark);
  return style;
}

}  // namespace

Image draw_picture(const Mesh& mesh, const PictureOptions& options) {
  check(options);
  const std::shared_ptr<const VirtualControlVolumes> vcv = make_state(mesh).vcvs.plane();
  const std::vector<NodalView> nodes = inspect_nodes(*vcv, mesh.coordinates, options.vcvs);
  const std::unique_ptr<HeadlessContext> context = make_headless_context();
  const FrameBuffer target(options.width, options.height, options.samples);
  const PictureTheme& theme = picture_theme(options.dark);

  std::vector<double> values;
  ColorScale scale;
  PictureText text;
  text.title = options.title;
  text.warning = inverted_text(check_validity(*mesh.topology, mesh.coordinates).inverted);
  if (options.color) {
    values = field_values(*vcv, mesh, options);
    scale = picture_colors(*options.color, options.colors, options.dark, values);
    if (options.legend)
      text.legend = picture_legend(*options.color, values, scale, !text.warning.empty());
  }
  const auto& markers = mesh.topology->markers();
  for (std::size_t m = 0; m < markers.size() && options.marker_key; ++m) {
    text.key.emplace_back(markers[m].name, marker_color(static_cast<Index>(m), options.dark));
  }

  PictureFrame frame(options.width, options.height, std::move(text), theme);
  const auto& area = frame.mesh_area();
  Camera camera;
  camera.set_viewport(area[0], area[1], area[2], area[3]);
  camera.fit(options.bounds.value_or(bounds(mesh)), options.bounds ? 0.0 : 0.01);

  MeshRenderer renderer;
  renderer.set_mesh(mesh.topology, mesh.coordinates);
  if (options.color) renderer.set_values(values, scale);
  std::vector<MeshRenderer::MarkerStyle> styles;
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const Rgb c = marker_color(static_cast<Index>(m), options.dark);
    styles.push_back({{c[0], c[1], c[2], 1}, 0.13f * frame.font_size()});
  }
  renderer.set_marker_styles(std::move(styles));

  target.clear(theme.paper);
  renderer.draw(camera, mesh_style(options, theme, frame.font_size()), options.width,
                options.height);
  frame.draw(options.bounds.has_value(), [&](ImDrawList& list, ImFont* font) {
    draw_vcvs(list, PlaneView(camera), nodes, 0.06f * frame.font_size(), font);
  });
  return target.read();
}

VectorFigure picture_figure(const Mesh& mesh, const PictureOptions& options) {
  check(options);
  VectorFigure figure;
  figure.mesh = mesh;
  figure.title = options.title;
  figure.warning = inverted_text(check_validity(*mesh.topology, mesh.coordinates).inverted);
  figure.wireframe = options.wireframe;
  figure.dark = options.dark;
  figure.framed = options.bounds.has_value();
  figure.font_size = std::clamp(0.02 * std::min(options.width, options.height), 8.0, 40.0);
  figure.edge_width = 0.05 * figure.font_size;
  figure.boundary_width = 0.13 * figure.font_size;
  const std::shared_ptr<const VirtualControlVolumes> vcv = make_state(mesh).vcvs.plane();
  figure.vcvs = inspect_nodes(*vcv, mesh.coordinates, options.vcvs);
  if (options.color) {
    figure.values = field_values(*vcv, mesh, options);
    figure.scale = picture_colors(*options.color, options.colors, options.dark, figure.values);
    if (options.legend)
      figure.legend =
          picture_legend(*options.color, figure.values, *figure.scale, !figure.warning.empty());
  }
  const auto& markers = mesh.topology->markers();
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const Rgb color = marker_color(static_cast<Index>(m), options.dark);
    figure.marker_colors.emplace_back(color);
    if (options.marker_key) figure.key.emplace_back(markers[m].name, color);
  }
  const FigureMargins m = figure_margins(figure);
  figure.camera.set_viewport(0, 0, std::max(options.width - m.left - m.right, 1.0),
                             std::max(options.height - m.top - m.bottom, 1.0));
  figure.camera.fit(options.bounds.value_or(bounds(mesh)), options.bounds ? 0.0 : 0.01);
  return figure;
}

ColorScale picture_scale(const Mesh& mesh, const PictureOptions& options) {
  return picture_colors(*options.color, options.colors, options.dark,
                        field_values(*make_state(mesh).vcvs.plane(), mesh, options));
}

Image side_by_side(const Image& left, const Image& right) {
  if (left.height != right.height) throw UsageError("pictures side by side have one height");
  Image both{left.width + right.width, left.height, {}};
  both.rgba.reserve(left.rgba.size() + right.rgba.size());
  for (int y = 0; y < both.height; ++y)
    for (const Image* part : {&left, &right})
      both.rgba.insert(both.rgba.end(), part->pixel(0, y),
                       part->pixel(0, y) + 4 * static_cast<std::size_t>(part->width));
  return both;
}

}  // namespace winslow::gui
