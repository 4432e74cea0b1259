#pragma once

#include <CLI/CLI.hpp>
#include <chrono>

#include "core/error.h"
#include "core/mesh/mesh.h"
#include "gui/picture/capture/recorder.h"
#include "gui/picture/frame/picture_frame.h"
#include "gui/picture/picture.h"

namespace winslow::app {

/// Flags for pictures of volume meshes.
struct VolumeFlags {
  std::vector<std::array<double, 6>> cuts;  // point, normal
  bool no_cut = false, crinkle = false, perspective = false;
  std::optional<double> isolate;
  std::string view, up = "z";
  std::optional<double> azimuth, elevation;  // degrees
  std::optional<std::array<double, 3>> centre;
  std::optional<double> half_width;
  std::vector<std::string> show, hide, see_through;
  std::string vcv_kind = "adjusted";
  std::string peel;  // MARKER:FROM:TO
};

/// Flags of the subcommand render, in types that need no OpenGL.
struct RenderFlags {
  std::string input, output, time;
  int zone = 0;
  std::string color, map = "automatic", axis = "automatic", title;
  std::optional<std::array<double, 4>> bounds;
  std::optional<std::array<double, 2>> range, percentiles;
  std::array<int, 2> size{1200, 900};
  std::string before;          // mesh to draw beside the input
  std::string recipe, frames;  // frames that show the recipe
  int per_command = 0, rate = 20;
  int turntable = 0;  // frames of a turn; 0: none
  std::vector<Index> vcvs;
  bool dark = false, no_wireframe = false, no_legend = false, quiet = false;
  VolumeFlags volume;
};

/// Value of --color for elements without colours.
inline constexpr const char* no_color = "none";

/// Declares the flags that only pictures of volume meshes have.
void add_volume_flags(CLI::App& app, VolumeFlags& flags);
/// Throws UsageError for given flags that do not apply to the mesh's kind, and for invalid numbers.
void check_volume_flags(const CLI::App& app, const RenderFlags& flags, const Topology& topology);

/// Draws a volume mesh into flags.output, a PNG, SVG or PDF file; returns a message for the user to
/// add to its name. Throws UsageError for another format.
std::string draw_volume(const RenderFlags& flags, const Mesh& mesh);
/// Draws two states side by side, with the same view and the same range of colours.
void draw_volumes(const RenderFlags& flags, const Mesh& before, const Mesh& after);
/// Draws frames of a volume mesh while the view turns once around it; returns a message for the
/// user.
std::string draw_turntable(const RenderFlags& flags, const Mesh& mesh);
/// Draws the meshes of a recipe's steps as frames in flags.frames; returns a message for the user.
std::string draw_volume_frames(const RenderFlags& flags, const std::vector<Mesh>& meshes);

/// The colours of values that the flags choose.
inline gui::ColorChoice color_choice(const RenderFlags& flags) {
  gui::ColorChoice choice;
  choice.map = flags.map;
  if (flags.axis != "automatic")
    choice.axis = flags.axis == "log" ? gui::ColorAxis::logarithmic : gui::ColorAxis::linear;
  choice.range = flags.range;
  choice.percentiles = flags.percentiles;
  return choice;
}

/// Options that pictures in the plane and in space share.
template <class Options>
Options common_options(const RenderFlags& flags) {
  Options options;
  options.width = flags.size[0];
  options.height = flags.size[1];
  options.colors = color_choice(flags);
  options.title = flags.title;
  options.vcvs = flags.vcvs;
  options.dark = flags.dark;
  options.wireframe = !flags.no_wireframe;
  options.legend = !flags.no_legend;
  return options;
}

/// Writes a frame of each mesh, in order, into flags.frames; returns a message for the user. Throws
/// OutputError, and what `draw` throws.
inline std::string record_frames(const RenderFlags& flags, const std::vector<Mesh>& meshes,
                                 const std::function<gui::Image(const Mesh&)>& draw) {
  gui::Recorder recorder;
  gui::RecordingSpec spec;
  spec.rate = flags.rate;
  recorder.start(flags.frames, spec);
  for (const Mesh& mesh : meshes) recorder.add(draw(mesh));
  recorder.stop();
  for (;;) {
    if (const auto outcome = recorder.poll()) {
      if (outcome->kind != gui::Recorder::Outcome::Kind::done) throw OutputError(outcome->text);
      return outcome->text;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

/// Writes two pictures side by side: draw(title, true for the picture before the change).
template <class Draw>
void write_both(const RenderFlags& flags, const Draw& draw) {
  const std::string title = flags.title.empty() ? "" : flags.title + ": ";
  const gui::Image left = draw(title + "before", true);
  gui::write_png(flags.output, gui::side_by_side(left, draw(title + "after", false)));
}

}  // namespace winslow::app
