#include <charconv>

#include "app/options/flags.h"
#include "app/subcommands/render_flags.h"
#include "core/error.h"
#include "core/inspect/element_field.h"
#include "gui/picture/figure/vector_figure.h"
#include "gui/picture/picture.h"
#include "gui/picture/space/volume_picture.h"

namespace winslow::app {

namespace {

const std::vector<std::string> axes{"x", "y", "z"};

constexpr std::array plane_only{"--bounds"};
constexpr std::array space_only{"--isolate", "--view",       "--azimuth",     "--elevation", "--up",
                                "--centre",  "--half-width", "--perspective", "--turntable"};
constexpr std::array volume_only{"--cut",  "--no-cut",      "--crinkle",  "--show",
                                 "--hide", "--see-through", "--vcv-kind", "--peel"};

const std::vector<std::string> vcv_kinds{"equal", "existing", "adjusted"};

void add_cut_flags(CLI::App& app, VolumeFlags& flags) {
  FlagGroup group(app, "Cuts (volume meshes)");
  auto* cut = group
                  .value("--cut", flags.cuts, "PX PY PZ NX NY NZ",
                         "Cut by a plane through a point and take away what its normal points to; "
                         "may be given several times [around bodies: through their middle]")
                  ->allow_extra_args(false);  // the next word is the mesh
  auto* none = group.on("--no-cut", flags.no_cut, "Cut nothing");
  cut->excludes(none);
  group.on("--crinkle", flags.crinkle, "Cuts leave whole elements")->excludes(none);
  group
      .value("--isolate", flags.isolate, "VALUE",
             "Show whole the elements whose METRIC is worse than this value, without cuts")
      ->excludes(cut);
  group.value("--peel", flags.peel, "MARKER:FROM:TO",
              "Show whole the elements that lie so many layers deep below a marker, alone: "
              "wing:1:3 are the three layers at it, wing:4:6 the next three");
}

void add_view_flags(CLI::App& app, VolumeFlags& flags) {
  FlagGroup group(app, "View (meshes in space)");
  group
      .value_as("--view", flags.view, "NAME",
                "Seen from: " + join(gui::view_names()) + " [onto the cuts, turned aside a little]")
      ->check(one_of(gui::view_names()));
  group.value_as("--up", flags.up, "x|y|z [z]", "Axis that is up on screen")->check(one_of(axes));
  group.value("--azimuth", flags.azimuth, "DEG",
              "Seen from this angle about that axis: with z up 0 from +x, 90 from +y, with y up "
              "from +z and +x [of --view]");
  group.value("--elevation", flags.elevation, "DEG",
              "Seen from this angle above the horizon, -90 to 90 [of --view]");
  group.on("--perspective", flags.perspective, "In perspective; without, parallel lines stay so");
  group.value("--centre", flags.centre, "X Y Z",
              "Point in the middle of the picture [all is shown]");
  group.value("--half-width", flags.half_width, "LENGTH",
              "Half of the width that is shown, in units of the mesh [all is shown]");
}

void add_marker_flags(CLI::App& app, VolumeFlags& flags) {
  FlagGroup group(app, "Boundary (volume meshes)");
  const auto names = [&](const char* name, std::vector<std::string>& to, const char* help) {
    group.value(name, to, "MARKER,...", help)->delimiter(',')->allow_extra_args(false);
  };
  names("--show", flags.show,
        "Draw these parts of the boundary as surfaces, and no others [bodies as surfaces, what is "
        "around them as outlines]");
  names("--hide", flags.hide, "Draw these parts of the boundary not at all");
  names("--see-through", flags.see_through,
        "Draw these parts of the boundary so that one sees through");
}

void add_vcv_flag(CLI::App& app, VolumeFlags& flags) {
  FlagGroup(app, "Control volumes (volume meshes)")
      .value_as("--vcv-kind", flags.vcv_kind, "equal|existing|adjusted [adjusted]",
                "Solid angles of the control volumes that --vcv draws: all equal, those of the "
                "mesh, or the mean of both")
      ->check(one_of(vcv_kinds));
}

int axis_of(const std::string& name) { return name.front() - 'x'; }

std::optional<gui::Peel> peel_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto last = text.rfind(':');
  const auto first = last == std::string::npos || last == 0 ? last : text.rfind(':', last - 1);
  gui::Peel peel{true, {}, 0, 0};
  if (first != std::string::npos && first != last) {
    const auto number = [&](std::size_t from, std::size_t to, int& value) {
      const auto [end, error] = std::from_chars(text.data() + from, text.data() + to, value);
      return error == std::errc() && end == text.data() + to;
    };
    peel.marker = text.substr(0, first);
    if (number(first + 1, last, peel.from) && number(last + 1, text.size(), peel.to) &&
        peel.from >= 1 && peel.to >= peel.from)
      return peel;
  }
  throw UsageError("--peel: found \"" + text +
                   "\", expected a marker and two numbers of layers from 1 on, as in wing:1:3");
}

std::optional<gui::ViewDirection> direction_of(const VolumeFlags& flags,
                                               const std::vector<Plane>& cuts) {
  if (flags.view.empty() && !flags.azimuth && !flags.elevation) return {};
  const int up = axis_of(flags.up);
  gui::ViewDirection view =
      flags.view.empty() ? gui::automatic_view(cuts, up) : gui::named_view(flags.view, up);
  view.azimuth = flags.azimuth.value_or(view.azimuth);
  view.elevation = flags.elevation.value_or(view.elevation);
  return view;
}

gui::VolumePictureOptions volume_options(const RenderFlags& flags, MeshKind kind) {
  const VolumeFlags& volume = flags.volume;
  auto options = common_options<gui::VolumePictureOptions>(flags);
  if (flags.color == no_color)
    options.color.reset();
  else if (flags.color.empty())
    options.color = ElementField(Metric::normalized_jacobian, cell_dimension_of(kind));
  else
    options.color = parse_field(flags.color, kind);
  std::vector<Plane> cuts;
  for (const auto& c : volume.cuts)
    cuts.emplace_back(Vec3(c[0], c[1], c[2]), Vec3(c[3], c[4], c[5]));
  options.view = direction_of(volume, cuts);
  options.up = axis_of(volume.up);
  if (!cuts.empty() || volume.no_cut) options.cuts = std::move(cuts);
  options.crinkle = volume.crinkle;
  options.isolate = volume.isolate;
  options.peel = peel_of(volume.peel);
  options.perspective = volume.perspective;
  if (volume.centre) options.centre = Vec3(volume.centre->data());
  options.half_width = volume.half_width;
  options.show = volume.show;
  options.hide = volume.hide;
  options.see_through = volume.see_through;
  if (volume.vcv_kind == "equal") options.vcv_kind.angles = VcvAngles::equal;
  if (volume.vcv_kind == "existing") options.vcv_kind.angles = VcvAngles::existing;
  return options;
}

/// Options for comparable pictures of successive states of one mesh. The cuts are those of the last
/// state, the range of colours covers the first and the last, and every state is fully visible.
gui::VolumePictureOptions alike_options(const RenderFlags& flags,
                                        std::span<const Mesh* const> states) {
  const Mesh &first = *states.front(), &last = *states.back();
  gui::VolumePictureOptions options = volume_options(flags, first.topology->kind());
  options.given = std::make_shared<const Mesh>(first);
  if (!options.cuts && !options.isolate) options.cuts = gui::cuts_of_picture(last, options);
  Box<3> all = Box<3>::empty();
  for (const Mesh* state : states) all.add(gui::volume_picture_extent(*state, options));
  options.extent = all;
  if (options.color && !options.colors.range)
    gui::use_scale(options.colors, gui::joined(gui::volume_picture_scale(first, options),
                                               gui::volume_picture_scale(last, options)));
  return options;
}

}  // namespace

void add_volume_flags(CLI::App& app, VolumeFlags& flags) {
  add_cut_flags(app, flags);
  add_view_flags(app, flags);
  add_marker_flags(app, flags);
  add_vcv_flag(app, flags);
}

void check_volume_flags(const CLI::App& app, const RenderFlags& flags, const Topology& topology) {
  const MeshKind kind = topology.kind();
  const auto refuse = [&](std::span<const char* const> names, const char* whose) {
    for (const char* name : names) {
      if (app.count(name) > 0)
        throw UsageError(std::string(name) + ": only for a " + whose + ", and this is a " +
                         std::string(mesh_kind(topology)));
    }
  };
  if (kind != MeshKind::volume) refuse(volume_only, "volume mesh");
  if (kind == MeshKind::plane) return refuse(space_only, "mesh in space");
  refuse(plane_only, "plane mesh");
  if (kind == MeshKind::surface && !flags.vcvs.empty())
    throw UsageError("--vcv: not for a surface mesh, whose control volumes lie in no picture");
  const VolumeFlags& v = flags.volume;
  if (v.isolate && flags.color == no_color)
    throw UsageError("--isolate goes by the values of a metric, and --color none shows none");
  if (v.half_width && !(*v.half_width > 0 && std::isfinite(*v.half_width)))
    throw UsageError("--half-width: expected a length above 0");
  if (v.elevation && !(std::abs(*v.elevation) <= 90))
    throw UsageError("--elevation: expected -90 to 90 degrees");
}

std::string draw_volume(const RenderFlags& flags, const Mesh& mesh) {
  const gui::VolumePictureOptions options = volume_options(flags, mesh.topology->kind());
  if (!gui::is_vector_format(flags.output)) {
    const gui::Image picture = gui::draw_volume_picture(mesh, options);
    InterruptGuard::check();
    gui::write_png(flags.output, picture);
    return {};
  }
  const gui::VectorFigure figure = gui::volume_picture_figure(mesh, options);
  InterruptGuard::check();
  gui::write_figure(flags.output, figure);
  return figure.scene->raster
             ? ", the mesh in it as pixels: too many faces are seen, or lie over each other"
             : "";
}

std::string draw_turntable(const RenderFlags& flags, const Mesh& mesh) {
  gui::VolumePictureOptions options = volume_options(flags, mesh.topology->kind());
  if (!options.view)
    options.view = gui::automatic_view(gui::cuts_of_picture(mesh, options), options.up);
  // The whole mesh fits from every side, at the same scale.
  if (!options.half_width) {
    const Box<3> box = gui::volume_picture_extent(mesh, options);
    const Vec3 half = Vec3::Constant(0.5 * box.size().norm());
    options.extent = Box<3>{box.centre() - half, box.centre() + half};
  }
  const double start = options.view->azimuth;
  int frame = 0;
  const std::vector<Mesh> again(static_cast<std::size_t>(flags.turntable), mesh);
  return record_frames(flags, again, [&](const Mesh& shown) {
    options.view->azimuth = start + 360.0 * frame++ / flags.turntable;
    return gui::draw_volume_picture(shown, options);
  });
}

void draw_volumes(const RenderFlags& flags, const Mesh& before, const Mesh& after) {
  gui::VolumePictureOptions options = alike_options(flags, std::array{&before, &after});
  write_both(flags, [&](const std::string& title, bool first) {
    options.title = title;
    return gui::draw_volume_picture(first ? before : after, options);
  });
}

std::string draw_volume_frames(const RenderFlags& flags, const std::vector<Mesh>& meshes) {
  std::vector<const Mesh*> all;
  for (const Mesh& mesh : meshes) all.push_back(&mesh);
  const gui::VolumePictureOptions options = alike_options(flags, all);
  return record_frames(flags, meshes,
                       [&](const Mesh& mesh) { return gui::draw_volume_picture(mesh, options); });
}

}  // namespace winslow::app
