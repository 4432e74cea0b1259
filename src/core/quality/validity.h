#pragma once

#include "core/index.h"

namespace winslow {

/// What every outer iteration needs to know of a mesh.
struct Validity {
  Index inverted = 0;   ///< elements
  double min_sine = 0;  ///< smallest normalized Jacobian; in space the scaled one, of the elements
                        ///< of which some node is inside
};

}  // namespace winslow
