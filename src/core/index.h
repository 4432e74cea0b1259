#pragma once

#include <cstddef>
#include <cstdint>

namespace winslow {

/// Index of a node, an element, or an entry of a compressed row.
using Index = std::int32_t;

/// An index, which must not be negative, as subscript of a standard container.
constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace winslow
