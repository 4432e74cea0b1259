#include "gui/picture/picture.h"

#include "core/command/command.h"
#include "core/error.h"
#include "core/inspect/nodal_view.h"
#include "gui/picture/frame/picture_frame.h"
#include "gui/render/color_scale.h"
#include "gui/render/gl.h"
#include "gui/view/overlays/vcv_overlay.h"

namespace winslow::gui {
namespace {

void check(const PictureOptions& options) {
  if (options.bounds && !((options.bounds->max - options.bounds->min).array() > 0).all()) {
    throw UsageError("the bounds of a picture are x0 y0 x1 y1 with x0 < x1 and y0 < y1");
  }
  check_colors(options.color, options.colors);
}

/// Values of the field by which elements are coloured.
std::vector<double> field_values(const VirtualControlVolumes& vcv, const Mesh& mesh,
                                 const PictureOptions& options) {
  return element_values(vcv, mesh.coordinates, *options.color, 0, {.before = options.before.get()});
}

/// What a picture of a mesh shows, as pixels or as vector graphics.
struct Content {
  std::vector<NodalView> nodes;
  std::vector<double> values;
  ColorScale scale;  // of the values
  std::vector<Rgb> marker_colors;
  PictureText text;
};

Content content_of(const Mesh& mesh, const PictureOptions& options) {
  check(options);
  Content content;
  const std::shared_ptr<const VirtualControlVolumes> vcv = make_state(mesh).vcvs.plane();
  for (const Index node : options.vcvs)
    content.nodes.push_back(inspect_node(*vcv, mesh.coordinates, node));
  content.text.title = options.title;
  content.text.warning = inverted_text(check_validity(*mesh.topology, mesh.coordinates).inverted);
  if (options.color) {
    content.values = field_values(*vcv, mesh, options);
    content.scale = picture_colors(*options.color, options.colors, options.dark, content.values);
    if (options.legend)
      content.text.legend = picture_legend(*options.color, content.values, content.scale,
                                           !content.text.warning.empty());
  }
  for (const Marker& marker : mesh.topology->markers()) {
    const auto number = static_cast<Index>(content.marker_colors.size());
    const Rgb color = content.marker_colors.emplace_back(marker_color(number, options.dark));
    if (options.marker_key) content.text.key.emplace_back(marker.name, color);
  }
  return content;
}

void place_camera(Camera& camera, const Mesh& mesh, const PictureOptions& options) {
  camera.fit(options.bounds.value_or(bounds(mesh)), options.bounds ? 0.0 : 0.01);
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
  const Content content = content_of(mesh, options);
  const std::unique_ptr<HeadlessContext> context = make_headless_context();
  const FrameBuffer target(options.width, options.height, options.samples);
  const PictureTheme& theme = picture_theme(options.dark);
  PictureFrame frame(options.width, options.height, content.text, theme);
  const auto& area = frame.mesh_area();
  Camera camera;
  camera.set_viewport(area[0], area[1], area[2], area[3]);
  place_camera(camera, mesh, options);

  MeshRenderer renderer;
  renderer.set_mesh(mesh.topology, mesh.coordinates);
  if (options.color) renderer.set_values(content.values, content.scale);
  std::vector<MeshRenderer::MarkerStyle> styles;
  for (const Rgb& c : content.marker_colors)
    styles.push_back({{c[0], c[1], c[2], 1}, 0.13f * frame.font_size()});
  renderer.set_marker_styles(std::move(styles));

  target.clear(theme.paper);
  renderer.draw(camera, mesh_style(options, theme, frame.font_size()), options.height);
  frame.draw(options.bounds.has_value(), [&](ImDrawList& list, ImFont* font) {
    draw_vcvs(list, camera, content.nodes, 0.06f * frame.font_size(), font);
  });
  return target.read();
}

VectorFigure picture_figure(const Mesh& mesh, const PictureOptions& options) {
  Content content = content_of(mesh, options);
  VectorFigure figure = begin_figure(content.text, options.dark, options.width, options.height);
  figure.mesh = mesh;
  figure.wireframe = options.wireframe;
  figure.framed = options.bounds.has_value();
  figure.edge_width = 0.05 * figure.font_size;
  figure.boundary_width = 0.13 * figure.font_size;
  figure.vcvs = std::move(content.nodes);
  figure.values = std::move(content.values);
  if (options.color) figure.scale = content.scale;
  figure.marker_colors.assign(content.marker_colors.begin(), content.marker_colors.end());
  place_camera(figure.camera, mesh, options);
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
