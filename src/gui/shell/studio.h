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

/// Has arrays of a megabyte and more go back to the system when they are freed, for the whole
/// process; to be called before threads are started. A studio is open all day: with glibc's own
/// settings arrays of up to 32 MB come to lie in the arenas of the threads that made them, and
/// what is freed there stays, so that a studio grew from 123 to 242 MB in 90 seconds of scripted
/// use, though no more was in use. Does nothing with other C libraries.
void return_freed_memory();

}  // namespace winslow::gui
