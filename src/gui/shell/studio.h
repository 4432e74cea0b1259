#pragma once

#include <filesystem>
#include <optional>

namespace winslow::gui {

struct StudioOptions {
  std::optional<std::filesystem::path> mesh;  ///< opened at the start
  int width = 0, height = 0;                  ///< of the window, in screen units; 0: as last time
  int zone = 0;                               ///< of the mesh file; 0: the first
};

/// Opens the studio's window and runs it until it is closed. Throws Error, saying what to do, where
/// there is no display.
void run_studio(const StudioOptions& options);

/// One frame of the studio, without a display, written as a PNG once the mesh is drawn.
void screenshot_studio(const StudioOptions& options, const std::filesystem::path& png);

}  // namespace winslow::gui
