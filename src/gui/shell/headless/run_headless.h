#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/command/command.h"
#include "gui/settings/picture_spec.h"

namespace winslow::gui {

/// The studio as a program without a window.
struct HeadlessOptions {
  std::optional<std::filesystem::path> mesh;  ///< to start with; before that of the recipe
  int zone = 0;                               ///< of it; 0: the recipe's, or else the first
  std::filesystem::path recipe;               ///< carried out; empty: none
  std::filesystem::path script;               ///< played then; empty: none (docs/studio.md)
  std::filesystem::path picture;              ///< of the end: .png, .svg or .pdf; empty: none
  std::filesystem::path frames;    ///< of the recipe: a folder, or a film .mp4 or .gif; empty: none
  std::filesystem::path folder;    ///< where a script's pictures go; empty: the working folder
  RecordingSpec recording;         ///< of the frames; its picture is also that of `picture`
  int width = 1440, height = 900;  ///< of the window, pixels
  /// Called with the recipe's commands before the first is carried out; throws what is wrong.
  std::function<void(const std::vector<Command>&, const Topology&, const std::string& file)> check;
  /// Told of what was done, when it was: "Wrote a.png"; and of what reading the mesh found odd.
  std::function<void(const std::string&)> say = [](const std::string&) {};
  std::function<void(const std::string&)> warn = [](const std::string&) {};
};

/// What it came to.
struct HeadlessResult {
  Index inverted = 0;           ///< elements of the last mesh
  double fraction_reached = 1;  ///< of the recipe's motions, the smallest
  bool converged = true;        ///< every command of the recipe
};

/// Throws InputError, UsageError, OutputError, Error.
HeadlessResult run_headless(const HeadlessOptions& options);

}  // namespace winslow::gui
