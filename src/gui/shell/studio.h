#pragma once

#include "io/format/mesh_file.h"

namespace winslow::gui {

struct StudioOptions {
  std::optional<std::filesystem::path> mesh;  ///< opened at the start
  int width = 0, height = 0;     ///< of the window, in screen units; 0: as in the last run
  io::ReadOptions reading = {};  ///< of the mesh file
};

/// Opens the studio's window and runs it until it is closed. Throws Error with advice if there is
/// no display.
void run_studio(const StudioOptions& options);

/// Makes the whole process return freed arrays of at least a megabyte to the system; call it before
/// threads are started. A studio runs for a long time. With glibc's defaults, arrays of up to 32 MB
/// are allocated in the arenas of the threads and not returned when freed: a studio grew from 123
/// to 242 MB in 90 seconds of scripted use, with constant memory in use. Does nothing with other C
/// libraries.
void return_freed_memory();

}  // namespace winslow::gui
