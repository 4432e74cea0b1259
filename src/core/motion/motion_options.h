#pragma once

#include "core/motion/motion.h"
#include "core/options/option.h"

namespace winslow {

/// All that a user can set of a motion, but for the markers that move.
OptionTable option_table(RigidMotionRequest& motion);
OptionTable option_table(SineDeformation& sine);

}  // namespace winslow
