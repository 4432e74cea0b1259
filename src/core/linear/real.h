#pragma once

namespace winslow {

/// Multigrid is a preconditioner, so half the memory traffic is worth more than the digits.
using Real = float;

}  // namespace winslow
