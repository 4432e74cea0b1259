#include <iostream>

#include "app/job/edit_job.h"
#include "app/options/flags.h"
#include "app/output/terminal.h"
#include "app/subcommands/render_flags.h"
#include "app/subcommands/subcommand.h"
#include "core/command/motion_frames.h"
#include "core/error.h"
#include "core/inspect/element_field.h"
#include "gui/picture/figure/vector_figure.h"
#include "gui/picture/picture.h"
#include "gui/render/color_scale.h"
#include "io/recipe/recipe.h"
#include "io/tables/file_defaults.h"
#include "io/tables/slide_files.h"

namespace winslow::app {
namespace {

constexpr int largest_picture = 16384;

bool has_color(const RenderFlags& flags) { return !flags.color.empty() && flags.color != no_color; }

gui::PictureOptions picture_options(const RenderFlags& flags) {
  auto options = common_options<gui::PictureOptions>(flags);
  if (has_color(flags)) options.color = parse_field(flags.color);
  if (flags.bounds) {
    const auto& b = *flags.bounds;
    options.bounds = Bounds{Vec2(b[0], b[1]), Vec2(b[2], b[3])};
  }
  return options;
}

void draw(const RenderFlags& flags, const Mesh& mesh) {
  if (gui::is_vector_format(flags.output)) {
    const auto figure = gui::picture_figure(mesh, picture_options(flags));
    InterruptGuard::check();
    gui::write_figure(flags.output, figure);
  } else {
    const gui::Image picture = gui::draw_picture(mesh, picture_options(flags));
    InterruptGuard::check();
    gui::write_png(flags.output, picture);
  }
}

/// Draws both meshes at the requested size with the same range of colours.
void draw_both(const RenderFlags& flags, const Mesh& before, const Mesh& after) {
  gui::PictureOptions options = picture_options(flags);
  options.before = std::make_shared<const Coordinates>(before.coordinates);
  if (!options.bounds) {
    const Bounds a = bounds(before), b = bounds(after);
    options.bounds = Bounds{a.min.cwiseMin(b.min), a.max.cwiseMax(b.max)};
  }
  if (options.color && !options.colors.range) {
    gui::use_scale(options.colors, gui::joined(gui::picture_scale(before, options),
                                               gui::picture_scale(after, options)));
  }
  write_both(flags, [&](const std::string& title, bool first) {
    options.title = title;
    return gui::draw_picture(first ? before : after, options);
  });
}

/// Draws frames of a recipe's meshes, all with the same view and range of colours. Returns a
/// message for the user.
std::string draw_frames(const RenderFlags& flags, const std::vector<Mesh>& meshes) {
  gui::PictureOptions options = picture_options(flags);
  options.before = std::make_shared<const Coordinates>(meshes.front().coordinates);
  if (!options.bounds) {
    Bounds all = bounds(meshes.front());
    for (const Mesh& mesh : meshes) {
      const Bounds b = bounds(mesh);
      all = {all.min.cwiseMin(b.min), all.max.cwiseMax(b.max)};
    }
    options.bounds = all;
  }
  // For the first mesh, values that measure changes are not meaningful yet.
  if (options.color && !options.colors.range) {
    const bool change = field_info(*options.color).one_is_best;
    gui::use_scale(options.colors,
                   gui::picture_scale(change ? meshes.back() : meshes.front(), options));
  }
  return record_frames(flags, meshes,
                       [&](const Mesh& mesh) { return gui::draw_picture(mesh, options); });
}

class RenderSubcommand : public Subcommand {
 public:
  explicit RenderSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand("render",
                                          "Draw a mesh as a picture (PNG, SVG or PDF); needs no "
                                          "display, inverted elements are red")) {
    add_input(app(), flags_.input);
    flags_.reading.defects = io::Defects::show;
    add_reading_flags(app(), flags_.reading, "the first");
    FlagGroup group(app());
    group.value("-o,--output", flags_.output, "PIC", "Picture to write: .png, .svg or .pdf");
    group.value("--size", flags_.size, "W H", "Width and height in pixels [1200 900]");
    group.value("--bounds", flags_.bounds, "X0 Y0 X1 Y1",
                "Part of the plane to show whole [all of the mesh]");
    group
        .value("--vcv", flags_.vcvs, "NODE,...",
               "Draw the virtual control volumes of these nodes over the mesh")
        ->delimiter(',')
        ->allow_extra_args(false);  // the next word is the mesh
    group.value("--title", flags_.title, "TEXT", "Line above the picture");
    group.on("--dark", flags_.dark, "Dark background");
    group.on("--no-wireframe", flags_.no_wireframe, "Leave the edges of elements out");
    add_color_flags();
    add_volume_flags(app(), flags_.volume);
    add_frame_flags();
    add_quiet_flag(app(), flags_.quiet);
  }

  ExitCode run() override {
    check_flags();
    const InterruptGuard interrupts;
    const io::MeshFile file = io::read_mesh(flags_.input, flags_.reading);
    InterruptGuard::check();
    check_volume_flags(app(), flags_, *file.mesh.topology);
    const bool volume = file.mesh.topology->space_dimension() == 3;
    if (!flags_.quiet) {
      print_warnings(file.warnings);
      if (flags_.reading.zone == 0)
        print_warnings(io::zones_left(file.details.get(), flags_.input));
    }
    if (!flags_.frames.empty()) {
      const std::string said = draw_all_frames(file, volume);
      if (!flags_.quiet) std::cout << printable(said) << '\n';
    }
    if (flags_.output.empty()) return ExitCode::done;
    std::string more;
    if (!flags_.before.empty())
      (volume ? draw_volumes : draw_both)(flags_, read_before(file.mesh), file.mesh);
    else if (volume)
      more = draw_volume(flags_, file.mesh);
    else
      draw(flags_, file.mesh);
    if (!flags_.quiet) std::cout << "Wrote " << printable(flags_.output) << more << '\n';
    return ExitCode::done;
  }

 private:
  std::string draw_all_frames(const io::MeshFile& file, bool volume) const {
    if (flags_.turntable > 0) return draw_turntable(flags_, file.mesh);
    const std::vector<Mesh> meshes = frames_of(file);
    return volume ? draw_volume_frames(flags_, meshes) : draw_frames(flags_, meshes);
  }

  void add_frame_flags() {
    FlagGroup group(app(), "Motion");
    group.value("--before", flags_.before, "MESH",
                "The mesh before, drawn on the left of IN; of the same nodes and elements");
    auto* recipe = group.value("--recipe", flags_.recipe, "FILE.json",
                               "Commands to carry out on IN, for --frames");
    auto* frames = group.value(
        "--frames", flags_.frames, "DIR",
        "Draw the meshes on the recipe's way, of a body that turns one for every degree, or a turn "
        "of the view: PNG files into a folder, or a film .mp4 or .gif (by ffmpeg)");
    recipe->needs(frames);
    group
        .value("--turntable", flags_.turntable, "N",
               "Draw so many frames while the view turns once around a mesh in space, for --frames")
        ->check(CLI::Range(2, 36000))
        ->needs(frames)
        ->excludes(recipe);
    group.value("--per-command", flags_.per_command, "N", "Most frames of one command [all]")
        ->check(CLI::Range(1, 10000));
    group.value("--rate", flags_.rate, "N", "Frames a second of a film [20]")
        ->check(CLI::Range(1, 60));
  }

  Mesh read_before(const Mesh& after) const {
    Mesh before = io::read_mesh(flags_.before, {.zone = flags_.reading.zone}).mesh;
    const Topology& a = *before.topology;
    const Topology& b = *after.topology;
    bool same = before.coordinates.size() == after.coordinates.size() &&
                a.element_count() == b.element_count();
    for (Index e = 0; same && e < a.element_count(); ++e)
      same = std::ranges::equal(a.element(e), b.element(e));
    if (!same) {
      throw InputError(flags_.before + ": not the same nodes and elements as " + flags_.input +
                       ", so it is no earlier state of it");
    }
    return before;
  }

  std::vector<Mesh> frames_of(const io::MeshFile& file) const {
    const std::vector<Command> expanded = io::with_names_expanded(
        io::read_recipe(flags_.recipe).commands, file.details.get(), *file.mesh.topology);
    check_markers(expanded, *file.mesh.topology, flags_.input);
    std::vector<ResolvedCommand> commands;
    for (const Command& command : expanded)
      commands.push_back(io::resolve_files(command, file.details.get()));
    return motion_frames(commands, make_state(file.mesh),
                         {flags_.per_command, [] { return InterruptGuard::requested(); }});
  }

  void add_color_flags() {
    std::vector<std::string> names;
    // A mesh file holds neither layers nor requested heights.
    for (const MeshKind kind : {MeshKind::plane, MeshKind::surface, MeshKind::volume}) {
      for (const ElementField& f : all_element_fields(kind)) {
        const std::string name(field_info(f).name);
        if (!f.layer() && std::ranges::find(names, name) == names.end()) names.push_back(name);
      }
    }
    names.emplace_back(no_color);
    FlagGroup group(app(), "Colour");
    auto* color = group
                      .value_as("--color", flags_.color, "METRIC",
                                "Colour elements by one of " + join(names) +
                                    " [in space: normalized_jacobian]")
                      ->check(one_of(names));
    group
        .value("--range", flags_.range, "LOW HIGH", "Values at the ends of the colours [automatic]")
        ->needs(color);
    group
        .value("--percentiles", flags_.percentiles, "LOW HIGH",
               "Range of the colours as percentiles of the values, 1 99 for instance [automatic]")
        ->needs(color);
    group
        .value_as("--axis", flags_.axis, "NAME [automatic]",
                  "Spread the colours over differences or ratios of values: automatic, which takes "
                  "ratios where a mesh is stretched, linear, log")
        ->check(one_of({"automatic", "linear", "log"}))
        ->needs(color);
    group
        .value_as("--map", flags_.map, "NAME [" + flags_.map + "]",
                  "Colours: " + join(gui::color_map_choices()))
        ->check(one_of(gui::color_map_choices()));
    group.on("--no-legend", flags_.no_legend, "Leave the colour bar out");
  }

  void check_flags() const {
    if (flags_.output.empty() && flags_.frames.empty()) {
      throw UsageError(
          "nothing to draw to: give a picture with -o PIC or frames with --frames DIR");
    }
    if (!flags_.frames.empty() && flags_.recipe.empty() && flags_.turntable == 0) {
      throw UsageError(
          "--frames is for the meshes of a --recipe, or for a --turntable around a mesh in space");
    }
    if (!flags_.before.empty() && flags_.output.empty()) {
      throw UsageError("--before is for a picture: give one with -o PIC.png");
    }
    if (!flags_.before.empty() && gui::is_vector_format(flags_.output)) {
      throw UsageError(
          "--before draws two pictures into one PNG file; for vector graphics draw them "
          "one by one");
    }
    const bool compares = flags_.color == field_info(WallField::first_height_ratio).name ||
                          flags_.color == field_info(SurfaceField::deviation).name;
    if (compares && flags_.before.empty() && !flags_.output.empty()) {
      throw UsageError("--color " + flags_.color +
                       " compares with an earlier mesh: give it with --before MESH");
    }
    if (gui::film_format(flags_.frames)) check_output(flags_.frames);
    check_output(flags_.output);
    if (!flags_.output.empty()) gui::check_picture_name(flags_.output);
    check_inputs_kept({flags_.output, flags_.frames}, {flags_.input, flags_.before, flags_.recipe});
    for (const int pixels : flags_.size) {
      if (pixels < 16 || pixels > largest_picture) {
        throw UsageError("--size: found " + std::to_string(pixels) + ", expected 16 to " +
                         std::to_string(largest_picture) + " pixels");
      }
    }
    if (flags_.bounds) {
      const auto& b = *flags_.bounds;
      const bool ordered = b[0] < b[2] && b[1] < b[3];
      // A NaN fails the comparison, an infinity the difference.
      const double width = b[2] - b[0], height = b[3] - b[1];
      const double most = std::numeric_limits<double>::max();
      if (!ordered || width > most || height > most) {
        throw UsageError("--bounds: expected x0 < x1 and y0 < y1, all finite");
      }
    }
    if (flags_.range && !((*flags_.range)[0] < (*flags_.range)[1])) {
      throw UsageError("--range: expected LOW < HIGH");
    }
    if (flags_.range && flags_.percentiles)
      throw UsageError("--range and --percentiles both say where the colours end: give one");
    if (const auto& p = flags_.percentiles;
        p && !(0 <= (*p)[0] && (*p)[0] < (*p)[1] && (*p)[1] <= 100))
      throw UsageError("--percentiles: expected 0 <= LOW < HIGH <= 100");
  }

  RenderFlags flags_;
};

}  // namespace

std::unique_ptr<Subcommand> make_render_subcommand(CLI::App& program) {
  return std::make_unique<RenderSubcommand>(program);
}

}  // namespace winslow::app
