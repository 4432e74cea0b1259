#include "gui/picture/space/volume_picture.h"

#include "core/error.h"
#include "core/inspect/nodal_view.h"
#include "core/inspect/space/plane_section.h"
#include "core/inspect/space/surface_measures.h"
#include "core/parallel/parallel_for.h"
#include "core/quality/quality.h"
#include "core/quality/surface_distance.h"
#include "core/strategy/surface_shape.h"
#include "gui/base/text.h"
#include "gui/picture/figure/vector_figure.h"
#include "gui/picture/frame/picture_frame.h"
#include "gui/picture/space/scene_figure.h"
#include "gui/render/gl.h"
#include "gui/render/space/space_renderer.h"
#include "gui/view/overlays/foot_overlay.h"
#include "gui/view/overlays/vcv_overlay.h"

namespace winslow::gui {

namespace {

/// Normals of the correct side of a surface mesh's elements; empty for other meshes. given: the
/// surface mesh as given; null: `mesh` itself.
std::vector<Vec3> normals_of(const Mesh& mesh, const std::shared_ptr<const Mesh>& given) {
  const auto shape = own_shape(given ? *given : mesh);
  return shape ? shape->normals->of_elements(mesh.coordinates, 0) : std::vector<Vec3>();
}

/// Values of a field per element. given: as in the options; normals: see normals_of().
std::vector<double> values_of(const Mesh& mesh, const ElementField& field,
                              const std::shared_ptr<const Mesh>& given,
                              std::span<const Vec3> normals) {
  if (!is_surface(*mesh.topology))
    return volume_values(mesh, field, given ? &given->coordinates : nullptr);
  return surface_values(mesh, field, normals, SurfaceDistance(given ? *given : mesh));
}

/// Per element 1 if the value is worse than the threshold, or not a number. Elements that are not
/// at walls have no values of the fields for these, and are not worse.
std::vector<unsigned char> worse_than(double threshold, const ElementField& field,
                                      std::span<const double> values) {
  const bool larger = field_info(field).larger_is_better;
  std::vector<unsigned char> chosen;
  chosen.reserve(values.size());
  // A NaN fails either comparison, and so counts as worse.
  for (const double v : values) {
    const bool apart = field.wall() && std::isnan(v);
    chosen.push_back(apart || (larger ? v >= threshold : v <= threshold) ? 0 : 1);
  }
  return chosen;
}

/// Number of flags that are 1.
Index count_of(std::span<const unsigned char> flags) {
  return static_cast<Index>(std::ranges::count(flags, 1));
}

constexpr double opening = 30;  // degrees, of a perspective view

std::vector<MarkerShow> marker_shows(const Topology& topology,
                                     const VolumePictureOptions& options) {
  const Markers& markers = topology.markers();
  std::vector<MarkerShow> shows(markers.size(),
                                options.show.empty() ? MarkerShow::automatic : MarkerShow::hidden);
  const auto set = [&](const std::vector<std::string>& names, MarkerShow show) {
    markers.nodes_of(names);  // throws for unknown names
    for (const std::string& name : names) shows[at(*markers.find(name))] = show;
  };
  set(options.show, MarkerShow::surface);
  set(options.see_through, MarkerShow::see_through);
  set(options.hide, MarkerShow::hidden);
  return shows;
}

/// Colour of surfaces: paler than that of lines, so that edges stay visible on them.
Rgb surface_color(Index marker, const PictureTheme& theme, bool dark) {
  Rgb color = marker_color(marker, dark);
  const float share = dark ? 0.45f : 0.5f;
  for (std::size_t c = 0; c < 3; ++c) color[c] += share * (theme.fill[c] - color[c]);
  return color;
}

std::string number(double value) {
  return formatted(value == 0 ? 0.0 : value, "%.6g");  // no "-0"
}

/// "Cut at y = 0.5", or by point and normal.
std::string cut_text(const std::vector<Plane>& cuts) {
  std::string text;
  for (const Plane& cut : cuts) {
    text += text.empty() ? "Cut at " : ", ";
    Index axis = 0;
    const Vec3& n = cut.normal();
    const Vec3& p = cut.point();
    if (n.cwiseAbs().maxCoeff(&axis) > 1 - 1e-12) {
      text += std::string(1, "xyz"[axis]) + " = " + number(p[axis]);
      continue;
    }
    text += "(" + number(p.x()) + ", " + number(p.y()) + ", " + number(p.z()) + "), normal (" +
            number(n.x()) + ", " + number(n.y()) + ", " + number(n.z()) + ")";
  }
  return text;
}

void check_cuts(const Mesh& mesh, const std::vector<Plane>& cuts) {
  const SpacePoints x(mesh.coordinates);
  const Box<3> box = space_bounds(mesh);
  for (const Plane& cut : cuts) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (Index i = 0; i < mesh.coordinates.size(); ++i) {
      if (!mesh.topology->used(i)) continue;
      const double d = cut.distance(x[i]);
      low = std::min(low, d);
      high = std::max(high, d);
    }
    const double slack = 1e-9 * box.size().norm();
    if (low > slack || high < -slack)
      throw UsageError("the cut through (" + number(cut.point().x()) + ", " +
                       number(cut.point().y()) + ", " + number(cut.point().z()) +
                       ") misses the mesh, which lies from " + number(low) + " to " + number(high) +
                       " along the cut's normal from there");
  }
}

void check(const Mesh& mesh, const VolumePictureOptions& options) {
  const MeshKind kind = mesh.topology->kind();
  if (kind == MeshKind::plane)
    throw UsageError("a picture of a volume mesh or a surface mesh: this is a plane mesh");
  const std::vector<ElementField>& fields = all_element_fields(kind);
  if (options.color && std::ranges::find(fields, *options.color) == fields.end())
    throw UsageError("a picture of a " + std::string(mesh_kind(*mesh.topology)) +
                     ": its elements have no " + std::string(field_info(*options.color).name));
  const bool inside = (options.cuts && !options.cuts->empty()) || options.peel;
  if (kind == MeshKind::surface && (inside || !options.vcvs.empty()))
    throw UsageError("a picture of a surface mesh has no cuts, layers and VCVs");
  check_colors(options.color, options.colors);
  if (options.isolate && !options.color)
    throw UsageError("elements are isolated by what they are coloured by: give a metric");
  if (options.isolate && !std::isfinite(*options.isolate))
    throw UsageError("elements are isolated by a finite value");
  if (options.half_width && !(*options.half_width > 0 && std::isfinite(*options.half_width)))
    throw UsageError("half the width of the picture has to be positive and finite");
  if (options.centre && !options.centre->allFinite())
    throw UsageError("the middle of the picture has to be finite");
  if (options.view &&
      !(std::isfinite(options.view->azimuth) && std::abs(options.view->elevation) <= 90))
    throw UsageError("a view has a finite azimuth and an elevation from -90 to 90 degrees");
}

/// All points of a scene that are not cut away.
std::vector<Vec3> points_of(const SpaceScene& scene) {
  std::vector<Vec3> points;
  const auto add = [&](const std::array<float, 3>& position, unsigned clipped_by) {
    const Vec3 p = scene.place_of(position);
    if (!cut_away(p, clipped_by, scene.planes)) points.push_back(p);
  };
  for (const SpaceFill& fill : scene.fills)
    for (const SpaceCorner& corner : fill.corners) add(corner.position, fill.clipped_by);
  for (const SpaceLines& lines : scene.lines)
    for (const SpaceLines::End& end : lines.ends) add(end.position, lines.clipped_by);
  return points;
}

/// Whether only elements with a face on a wall have values of a field.
bool is_at_walls(const ElementField& field) {
  const WallField* wall = field.wall();
  return wall && (*wall == WallField::first_height || *wall == WallField::first_height_ratio ||
                  *wall == WallField::first_edge_tilt);
}

std::vector<Plane> chosen_cuts(const Mesh& mesh, const VolumeBoundary& boundary,
                               const VolumePictureOptions& options) {
  if (options.cuts) return *options.cuts;
  if (options.peel) return {};  // the enclosure is left out already
  // Bodies are coloured where there is no cut, and hardly any element of one has a value.
  if (options.color && is_at_walls(*options.color)) return {};
  return automatic_cuts(mesh, boundary, options.view.value_or(automatic_view({}, options.up)));
}

/// Builds one picture.
class VolumePicture {
 public:
  VolumePicture(const Mesh& mesh, const VolumePictureOptions& options)
      : mesh_(mesh),
        options_(options),
        theme_(picture_theme(options.dark)),
        boundary_(find_boundary(mesh)),
        normals_(normals_of(mesh, options.given)),
        inverted_(inverted_elements(mesh, normals_)) {
    look_.markers = marker_shows(*mesh.topology, options);
    look_.edges = options.wireframe;
    look_.crinkle = options.crinkle;
    choose_cuts();
    if (count_of(inverted_) > 0) look_.inverted = inverted_;
    if (options.color) choose_colors();
    choose_peeled();
    const auto markers = static_cast<Index>(mesh.topology->markers().size());
    for (Index m = 0; m < markers; ++m)
      look_.marker_colors.push_back(surface_color(m, theme_, options.dark));
    for (Index m = 0; is_surface(*mesh.topology) && m < markers; ++m)
      look_.border_colors.push_back(marker_color(m, options.dark));
    for (const Index node : options.vcvs) {
      require_inspectable(*mesh.topology, node);
      vcvs_.push_back(
          inspect_node(*mesh.topology, mesh.coordinates,
                       make_node_vcv(*mesh.topology, mesh.coordinates, node, options.vcv_kind)));
    }
  }

  Image draw() {
    const std::unique_ptr<HeadlessContext> context = make_headless_context();
    const FrameBuffer target(options_.width, options_.height, options_.samples);
    PictureFrame frame(options_.width, options_.height, text(), theme_);
    const SpaceScene scene = this->scene(frame.font_size());
    const SpaceCamera camera = place_camera(scene, frame.mesh_area());
    SpaceRenderer renderer;
    renderer.set_scene(scene);
    target.clear(theme_.paper);
    renderer.draw(camera, options_.height);
    const bool marks = frame.has_room_for_text();
    frame.draw(options_.half_width.has_value(), [&](ImDrawList& list, ImFont* font) {
      for (const VolumeNodalView& node : vcvs_)
        draw_sphere_vcv(list, camera, node, 0.06f * frame.font_size(), font);
      if (!marks) return;
      const MarkColors colors{theme_.ink, theme_.paper};
      draw_axes(list, *font, frame.font_size(), camera, colors);
      draw_scale_bar(list, *font, frame.font_size(), camera, colors);
    });
    return target.read();
  }

  VectorFigure figure() const {
    VectorFigure figure = begin_figure(text(), options_.dark, options_.width, options_.height);
    figure.framed = options_.half_width.has_value();
    const auto font = static_cast<float>(figure.font_size);
    const auto scene = std::make_shared<const SpaceScene>(this->scene(font));
    const SpaceCamera camera = place_camera(
        *scene, {0, 0, figure.camera.viewport_width(), figure.camera.viewport_height()});
    SceneFigureOptions how;
    how.ink = {theme_.ink[0], theme_.ink[1], theme_.ink[2]};
    how.font_size = figure.font_size;
    const std::array parts{scene};
    FigureScene drawn = figure_of_scene(parts, scene->planes, camera, how);
    if (drawn.wants_raster) drawn.raster = raster(*scene, camera, drawn.raster_pixels);
    figure.scene = std::make_shared<const FigureScene>(std::move(drawn));
    return figure;
  }

  Box<3> extent() const {
    constexpr float unit = 1;  // widths of lines are ignored
    Box<3> box = Box<3>::empty();
    for (const Vec3& point : all_points(scene(unit))) box.add(point);
    return box;
  }

 private:
  std::vector<Vec3> all_points(const SpaceScene& scene) const {
    std::vector<Vec3> points = points_of(scene);
    for (const VolumeNodalView& node : vcvs_)
      for (const Vec3& p : sphere_over_star(node)) points.push_back(p);
    return points;
  }

  /// Draws what the camera sees, with so many pixels per point.
  Image raster(const SpaceScene& scene, SpaceCamera camera, double finest) const {
    const std::unique_ptr<HeadlessContext> context = make_headless_context();
    const ScreenVector size = camera.viewport().size();
    constexpr double largest = 4096;
    const double factor = std::min(finest, largest / std::max(size.x(), size.y()));
    const auto width = static_cast<int>(std::lround(factor * size.x()));
    const auto height = static_cast<int>(std::lround(factor * size.y()));
    camera.set_viewport(0, 0, width, height);
    camera.look_at(camera.centre(), camera.units_per_pixel() / factor);
    const FrameBuffer target(width, height, options_.samples);
    target.clear(theme_.paper);
    SpaceRenderer renderer;
    renderer.set_scene(scene);
    renderer.draw(camera, height);
    return target.read();
  }

  SpaceScene scene(float unit) const { return build_scene(mesh_, boundary_, look_, style(unit)); }

  void choose_peeled() {
    if (!options_.peel) return;
    const Peel& peel = *options_.peel;
    if (peel.from < 1 || peel.to < peel.from)
      throw UsageError("layers at a marker go from 1 or more to no less");
    const auto nodes = mesh_.topology->markers().nodes_of({&peel.marker, 1});
    const std::vector<Index> layers = element_layers(*mesh_.topology, nodes);
    look_.isolated = isolated_ = peeled_elements(mesh_, look_, layers, {peel.from, peel.to});
  }

  void choose_cuts() {
    if (options_.isolate) return;
    look_.cuts = chosen_cuts(mesh_, boundary_, options_);
    check_cuts(mesh_, look_.cuts);
  }

  void choose_colors() {
    values_ = values_of(mesh_, *options_.color, options_.given, normals_);
    scale_ = picture_colors(*options_.color, options_.colors, options_.dark, values_);
    colors_ = element_colors(values_, scale_);
    look_.colors = colors_;
    if (!options_.isolate) return;
    isolated_ = worse_than(*options_.isolate, *options_.color, values_);
    look_.isolated = isolated_;
  }

  PictureText text() const {
    PictureText text;
    text.title = options_.title;
    text.warning = inverted_text(count_of(inverted_));
    text.note = note();
    if (options_.color && options_.legend)
      text.legend = picture_legend(*options_.color, values_, scale_, !text.warning.empty());
    const auto in_color = markers_in_color(mesh_, boundary_, look_);
    for (std::size_t m = 0; m < in_color.size() && options_.marker_key; ++m)
      if (in_color[m] != 0)
        text.key.emplace_back(mesh_.topology->markers()[m].name, look_.marker_colors[m]);
    return text;
  }

  std::string note() const {
    const std::string peeled = options_.peel ? "Layers " + std::to_string(options_.peel->from) +
                                                   " to " + std::to_string(options_.peel->to) +
                                                   " at " + options_.peel->marker
                                             : std::string();
    if (!options_.isolate) {
      const std::string cut = cut_text(look_.cuts);
      return peeled.empty() ? cut : peeled + (cut.empty() ? "" : ". ") + cut;
    }
    const Index count = count_of(isolated_);
    return std::to_string(count) + (count == 1 ? " element " : " elements ") +
           (field_info(*options_.color).larger_is_better ? "below " : "above ") +
           number(*options_.isolate);
  }

  VolumeStyle style(float unit) const {
    VolumeStyle style;
    style.fill = theme_.fill;
    style.edge = options_.color ? edges_on_colors(*options_.color, options_.colors, options_.dark)
                                : Rgba{theme_.edge[0], theme_.edge[1], theme_.edge[2], 0.7f};
    style.feature = theme_.edge;
    style.enclosure = theme_.frame;
    for (std::size_t c = 0; c < 3; ++c)
      style.enclosure[c] = 0.5f * (theme_.frame[c] + theme_.edge[c]);
    style.edge_width = 0.05f * unit;
    style.feature_width = 0.1f * unit;
    return style;
  }

  SpaceCamera place_camera(const SpaceScene& scene, const std::array<double, 4>& area) const {
    SpaceCamera camera;
    camera.set_viewport(area[0], area[1], area[2], area[3]);
    camera.look_from(options_.view.value_or(automatic_view(look_.cuts, options_.up)));
    if (options_.perspective) camera.set_perspective(opening);
    camera.set_content(scene.extent);
    const bool box = options_.extent && (options_.extent->size().array() >= 0).all();
    std::vector<Vec3> points = box ? corners_of(*options_.extent) : all_points(scene);
    if (points.empty()) points = corners_of(scene.extent);
    camera.fit(points, 0.02);
    const double size = options_.half_width
                            ? 2 * *options_.half_width / camera.viewport().size().x()
                            : camera.units_per_pixel();
    camera.look_at(options_.centre.value_or(camera.centre()), size);
    return camera;
  }

  const Mesh& mesh_;
  const VolumePictureOptions& options_;
  const PictureTheme& theme_;
  VolumeBoundary boundary_;
  std::vector<VolumeNodalView> vcvs_;
  std::vector<Vec3> normals_;
  std::vector<unsigned char> inverted_, isolated_;
  std::vector<double> values_;
  ColorScale scale_;
  std::vector<std::uint32_t> colors_;
  VolumeLook look_;
};

}  // namespace

std::vector<Plane> cuts_of_picture(const Mesh& mesh, const VolumePictureOptions& options) {
  return chosen_cuts(mesh, find_boundary(mesh), options);
}

ColorScale volume_picture_scale(const Mesh& mesh, const VolumePictureOptions& options) {
  return picture_colors(
      *options.color, options.colors, options.dark,
      values_of(mesh, *options.color, options.given, normals_of(mesh, options.given)));
}

VectorFigure volume_picture_figure(const Mesh& mesh, const VolumePictureOptions& options) {
  check(mesh, options);
  return VolumePicture(mesh, options).figure();
}

Box<3> volume_picture_extent(const Mesh& mesh, const VolumePictureOptions& options) {
  check(mesh, options);
  return VolumePicture(mesh, options).extent();
}

Image draw_volume_picture(const Mesh& mesh, const VolumePictureOptions& options) {
  check(mesh, options);
  return VolumePicture(mesh, options).draw();
}

}  // namespace winslow::gui
