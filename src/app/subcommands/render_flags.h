#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/mesh/mesh.h"

namespace winslow::app {

/// Of a picture of a volume mesh.
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

/// What the user asked for, in terms that need no OpenGL.
struct RenderFlags {
  std::string input, output;
  int zone = 0;
  std::string color, map = "automatic", axis = "automatic", title;
  std::optional<std::array<double, 4>> bounds;
  std::optional<std::array<double, 2>> range, percentiles;
  std::array<int, 2> size{1200, 900};
  std::string before;          // mesh to put beside
  std::string recipe, frames;  // frames of what the recipe does
  int per_command = 0, rate = 20;
  int turntable = 0;  // frames of a turn; 0: none
  std::vector<Index> vcvs;
  bool dark = false, no_wireframe = false, no_legend = false, quiet = false;
  VolumeFlags volume;
};

/// What --color says where elements are to have no colours.
inline constexpr const char* no_color = "none";

/// Declares the options that pictures of volume meshes alone have.
void add_volume_flags(CLI::App& app, VolumeFlags& flags);
/// Throws UsageError for options that the mesh's kind does not have, were they given, and for
/// numbers that make no picture.
void check_volume_flags(const CLI::App& app, const RenderFlags& flags, const Topology& topology);

/// Draws a volume mesh into flags.output, a PNG, SVG or PDF file; returns what to tell the user
/// beside its name. Throws UsageError for another format, and
/// Error where winslow was built without graphics.
std::string draw_volume(const RenderFlags& flags, const Mesh& mesh);
/// The same of two states side by side, seen alike, in one range of colours.
void draw_volumes(const RenderFlags& flags, const Mesh& before, const Mesh& after);
/// Draws frames of a volume mesh while the view turns once around it; returns what to tell the
/// user.
std::string draw_turntable(const RenderFlags& flags, const Mesh& mesh);
/// The same of the meshes on a recipe's way, as frames in flags.frames; returns what to tell the
/// user.
std::string draw_volume_frames(const RenderFlags& flags, const std::vector<Mesh>& meshes);

}  // namespace winslow::app
