#pragma once

#include "core/motion/motion.h"

namespace winslow {

class NodeClasses;

/// An element that a motion inverts and that smoothing cannot mend, since none of its nodes is
/// free: all of them are prescribed or fixed.
struct HeldInversion {
  Index element = -1;   ///< the first one to be inverted
  double fraction = 0;  ///< share of the motion up to which all such elements are right
  bool at_end = true;   ///< false: all such elements are right again at the end of the motion

  bool operator==(const HeldInversion&) const = default;
};

/// Which meshes of a motion have to be valid: those on its way, or the last one alone.
enum class MotionPart { way, end };

/// Finds the first element without free nodes that a motion inverts. It looks at 32 meshes of the
/// way, so an element that is inverted between two of them alone may be missed. Elements that are
/// inverted before the motion do not count. rest: all nodes before the motion.
std::optional<HeldInversion> find_held_inversion(const NodeClasses& classes,
                                                 const Coordinates& rest, const Motion& motion,
                                                 MotionPart part);

/// "the prescribed nodes invert element 17 at 62.5 % of the way, which smoothing cannot mend, ...".
std::string describe(const HeldInversion& inversion);

}  // namespace winslow
