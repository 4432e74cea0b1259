#pragma once

#include "core/strategy/smooth_options.h"

namespace winslow {

/// The table of options of a surface mesh: what such meshes refuse, and what has no effect on them,
/// does not apply.
OptionTable surface_option_table(SmoothOptions& options);

/// Puts what surface meshes refuse of options to what they have by default, or to the first choice
/// that is left.
void settle_for_surface(SmoothOptions& options);

}  // namespace winslow
