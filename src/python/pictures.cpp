#include "gui/picture/picture.h"

#include "core/error.h"
#include "gui/picture/space/volume_picture.h"
#include "python/keywords.h"
#include "python/measures.h"
#include "python/option_values.h"

namespace py = pybind11;

namespace winslow::python {
namespace {

using Pair = std::array<double, 2>;
using Triple = std::array<double, 3>;
constexpr int smallest = 16, largest = 16384;

/// Takes what pictures in the plane and in space have in common.
template <class Options>
void take_common(py::dict& keywords, Options& options, MeshKind kind) {
  std::array<int, 2> size{options.width, options.height};
  take(keywords, "size", size, "width and height in pixels");
  for (const int pixels : size)
    if (pixels < smallest || pixels > largest)
      throw UsageError("size: found " + std::to_string(pixels) + ", expected " +
                       std::to_string(smallest) + " to " + std::to_string(largest) + " pixels");
  options.width = size[0];
  options.height = size[1];
  std::string color, axis = "automatic";
  take(keywords, "color", color, "the name of a field");
  if (color == "none") options.color.reset();
  if (!color.empty() && color != "none") options.color = parse_field(color, kind);
  take(keywords, "map", options.colors.map, "the name of a map of colours");
  take(keywords, "axis", axis, "automatic, linear or log");
  if (axis != "automatic" && axis != "linear" && axis != "log")
    throw UsageError("axis: found \"" + axis + "\", expected automatic, linear or log");
  if (axis != "automatic")
    options.colors.axis = axis == "log" ? gui::ColorAxis::logarithmic : gui::ColorAxis::linear;
  if (Pair ends; keywords.contains("range")) {
    take(keywords, "range", ends, "two numbers, the lower one first");
    options.colors.range = ends;
  }
  if (Pair ends; keywords.contains("percentiles")) {
    take(keywords, "percentiles", ends, "two numbers from 0 to 100, the lower one first");
    if (!(0 <= ends[0] && ends[0] < ends[1] && ends[1] <= 100))
      throw UsageError("percentiles: expected 0 <= low < high <= 100");
    options.colors.percentiles = ends;
  }
  take(keywords, "title", options.title, "a text");
  take(keywords, "dark", options.dark, "True or False");
  take(keywords, "wireframe", options.wireframe, "True or False");
  take(keywords, "legend", options.legend, "True or False");
  take(keywords, "vcv", options.vcvs, "ids of nodes");
  if (options.colors.range && !((*options.colors.range)[0] < (*options.colors.range)[1]))
    throw UsageError("range: expected low < high");
}

gui::PictureOptions plane_options(py::dict& keywords) {
  gui::PictureOptions options;
  take_common(keywords, options, MeshKind::plane);
  if (std::array<double, 4> b; keywords.contains("bounds")) {
    take(keywords, "bounds", b, "four numbers: x0, y0, x1, y1");
    options.bounds = Bounds{Vec2(b[0], b[1]), Vec2(b[2], b[3])};
  }
  return options;
}

void take_view(py::dict& keywords, gui::VolumePictureOptions& options,
               const std::vector<Plane>& cuts) {
  std::string view, up = "z";
  std::optional<double> azimuth, elevation;
  take(keywords, "view", view, "the name of a side");
  take(keywords, "up", up, "x, y or z");
  take(keywords, "azimuth", azimuth, "an angle in degrees");
  take(keywords, "elevation", elevation, "an angle in degrees");
  take(keywords, "perspective", options.perspective, "True or False");
  take(keywords, "half_width", options.half_width, "a length");
  std::optional<Triple> centre;
  take(keywords, "centre", centre, "three numbers");
  if (centre) options.centre = Vec3(centre->data());
  if (up != "x" && up != "y" && up != "z")
    throw UsageError("up: found \"" + up + "\", expected x, y or z");
  options.up = up.front() - 'x';
  if (elevation && !(std::abs(*elevation) <= 90))
    throw UsageError("elevation: expected -90 to 90 degrees");
  if (view.empty() && !azimuth && !elevation) return;
  options.view =
      view.empty() ? gui::automatic_view(cuts, options.up) : gui::named_view(view, options.up);
  options.view->azimuth = azimuth.value_or(options.view->azimuth);
  options.view->elevation = elevation.value_or(options.view->elevation);
}

gui::VolumePictureOptions space_options(py::dict& keywords, MeshKind kind) {
  gui::VolumePictureOptions options;
  options.color = ElementField(Metric::normalized_jacobian, cell_dimension_of(kind));
  take_common(keywords, options, kind);
  std::vector<Plane> cuts;
  if (kind == MeshKind::volume) {
    std::optional<std::vector<std::array<Triple, 2>>> given;
    take(keywords, "cuts", given, "a list of planes, each a point and a normal");
    if (given) {
      for (const auto& [point, normal] : *given)
        cuts.emplace_back(Vec3(point.data()), Vec3(normal.data()));
      options.cuts = cuts;
    }
    take(keywords, "crinkle", options.crinkle, "True or False");
    take(keywords, "isolate", options.isolate, "a value of the field");
    options.show = names_of(taken(keywords, "show"), "show");
    options.hide = names_of(taken(keywords, "hide"), "hide");
    options.see_through = names_of(taken(keywords, "see_through"), "see_through");
  }
  take_view(keywords, options, cuts);
  return options;
}

/// Throws UsageError for keywords that pictures of this kind of mesh do not have.
void check_keywords(const py::dict& keywords, MeshKind kind) {
  std::vector<std::string> known{"size",  "color", "map",       "axis",   "range", "percentiles",
                                 "title", "dark",  "wireframe", "legend", "vcv"};
  const auto add = [&](std::initializer_list<const char*> more) {
    known.insert(known.end(), more.begin(), more.end());
  };
  if (kind == MeshKind::plane)
    add({"bounds"});
  else
    add({"view", "up", "azimuth", "elevation", "perspective", "half_width", "centre"});
  if (kind == MeshKind::volume) add({"cuts", "crinkle", "isolate", "show", "hide", "see_through"});
  refuse_others(keywords, known);
}

/// Draws into a file, or returns a PNG where none is named. One picture at a time: they share one
/// context of the renderer.
template <class Draw, class Figure>
std::string drawn(const std::string& path, const Draw& draw, const Figure& figure) {
  const py::gil_scoped_release released;
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  if (path.empty()) return gui::png_of(draw());
  app::check_output(path);
  gui::check_picture_name(path);
  if (gui::is_vector_format(path))
    gui::write_figure(path, figure());
  else
    gui::write_png(path, draw());
  return {};
}

/// A picture of a mesh: the bytes of a PNG, or nothing where it went to a file.
py::bytes picture(const MeshPointer& mesh, const std::string& path, py::dict keywords) {
  const Mesh& drawn_mesh = mesh->mesh();
  const MeshKind kind = drawn_mesh.topology->kind();
  if (kind == MeshKind::plane) {
    const gui::PictureOptions options = plane_options(keywords);
    check_keywords(keywords, kind);
    return drawn(
        path, [&] { return gui::draw_picture(drawn_mesh, options); },
        [&] { return gui::picture_figure(drawn_mesh, options); });
  }
  const gui::VolumePictureOptions options = space_options(keywords, kind);
  check_keywords(keywords, kind);
  return drawn(
      path, [&] { return gui::draw_volume_picture(drawn_mesh, options); },
      [&] { return gui::volume_picture_figure(drawn_mesh, options); });
}

}  // namespace

void bind_pictures(py::module_& module) { module.def("picture", &picture); }

}  // namespace winslow::python
