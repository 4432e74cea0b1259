#include "io/tables/file_pairs.h"

namespace winslow::io {

void give_pairs(Command& command, const FormatDetails* details) {
  if (SmoothOptions* smooth = smooth_options(command))
    smooth->slide.file_pairs.found = details ? details->periodic : nullptr;
}

}  // namespace winslow::io
