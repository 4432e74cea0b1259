#include <array>
#include <iostream>
#include <limits>
#include <optional>

#include "app/options/file_flags.h"
#include "app/options/suggestion.h"
#include "app/subcommands/subcommand.h"
#include "core/error.h"
#include "core/inspect/element_field.h"
#include "io/mesh_file.h"
#ifdef WINSLOW_HAS_GUI
#include "gui/picture.h"
#include "gui/render/color_map.h"
#endif

namespace winslow::app {
namespace {

constexpr int largest_picture = 16384;

/// What the user asked for, in terms that need no OpenGL.
struct RenderFlags {
  std::string input, output;
  std::string color, map = "viridis", title;
  std::optional<std::array<double, 4>> bounds;
  std::optional<std::array<double, 2>> range;
  std::array<int, 2> size{1200, 900};
  bool dark = false, no_wireframe = false, no_legend = false, quiet = false;
};

#ifdef WINSLOW_HAS_GUI

std::vector<std::string> color_maps() { return gui::color_map_names(); }

gui::PictureOptions picture_options(const RenderFlags& flags) {
  gui::PictureOptions options;
  options.width = flags.size[0];
  options.height = flags.size[1];
  if (!flags.color.empty()) options.color = parse_field(flags.color);
  if (flags.bounds) {
    const auto& b = *flags.bounds;
    options.bounds = Bounds{Vec2(b[0], b[1]), Vec2(b[2], b[3])};
  }
  options.range = flags.range;
  options.color_map = flags.map;
  options.title = flags.title;
  options.dark = flags.dark;
  options.wireframe = !flags.no_wireframe;
  options.legend = !flags.no_legend;
  return options;
}

void draw(const RenderFlags& flags, const Mesh& mesh) {
  gui::write_png(flags.output, gui::draw_picture(mesh, picture_options(flags)));
}

#else

std::vector<std::string> color_maps() { return {"viridis"}; }

void draw(const RenderFlags&, const Mesh&) {
  throw Error("this winslow was built without graphics (WINSLOW_BUILD_GUI=OFF): it cannot render");
}

#endif

class RenderSubcommand : public Subcommand {
 public:
  explicit RenderSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand(
            "render",
            "Draw a mesh as a PNG picture; needs no display, inverted elements are red")) {
    add_input(app(), flags_.input);
    app()
        .add_option("-o,--output", flags_.output, "Picture to write")
        ->required()
        ->type_name("PIC.png");
    app()
        .add_option("--size", flags_.size, "Width and height in pixels [1200 900]")
        ->type_name("W H");
    app()
        .add_option_function<std::array<double, 4>>(
            "--bounds", [this](const std::array<double, 4>& b) { flags_.bounds = b; },
            "Part of the plane to show whole [all of the mesh]")
        ->type_name("X0 Y0 X1 Y1");
    app().add_option("--title", flags_.title, "Line above the picture")->type_name("TEXT");
    app().add_flag("--dark", flags_.dark, "Dark background");
    app().add_flag("--no-wireframe", flags_.no_wireframe, "Leave the edges of elements out");
    add_color_flags();
    add_quiet_flag(app(), flags_.quiet);
  }

  ExitCode run() override {
    check_flags();
    const io::MeshFile file = io::read_mesh(flags_.input);
    if (!flags_.quiet) {
      for (const std::string& text : file.warnings) {
        std::cerr << "winslow: warning: " << text << '\n';
      }
    }
    draw(flags_, file.mesh);
    if (!flags_.quiet) std::cout << "Wrote " << flags_.output << '\n';
    return ExitCode::done;
  }

 private:
  void add_color_flags() {
    std::vector<std::string> names;
    for (const ElementField& f : all_element_fields()) names.emplace_back(field_name(f));
    const char* group = "Colour";
    auto* color =
        app()
            .add_option("--color", flags_.color, "Colour elements by one of " + join(names))
            ->check(one_of(names))
            ->option_text("METRIC")
            ->group(group);
    app()
        .add_option_function<std::array<double, 2>>(
            "--range", [this](const std::array<double, 2>& r) { flags_.range = r; },
            "Values at the ends of the colours [automatic]")
        ->type_name("LOW HIGH")
        ->needs(color)
        ->group(group);
    app()
        .add_option("--map", flags_.map, "Colours: " + join(color_maps()))
        ->check(one_of(color_maps()))
        ->option_text("NAME [" + flags_.map + "]")
        ->group(group);
    app().add_flag("--no-legend", flags_.no_legend, "Leave the colour bar out")->group(group);
  }

  void check_flags() const {
    check_output(flags_.output);
    check_distinct({flags_.output, flags_.input});
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
  }

  RenderFlags flags_;
};

}  // namespace

std::unique_ptr<Subcommand> make_render_subcommand(CLI::App& program) {
  return std::make_unique<RenderSubcommand>(program);
}

}  // namespace winslow::app
