#pragma once

#include <memory>

#include "core/linear/preconditioner.h"

namespace winslow {

/// Incomplete LU factorisation with threshold (ILUT), scalar, for matrices of any kind.
std::unique_ptr<Preconditioner> make_incomplete_lu();

}  // namespace winslow
