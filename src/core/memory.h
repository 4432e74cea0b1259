#pragma once

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "core/types.h"

/// What takes the memory of a run:
///
///     for (const auto& [name, bytes] : result.smooth.memory.parts())
///       std::printf("%s: %zu MB\n", std::string(name).c_str(), bytes >> 20);
namespace winslow {

/// Memory of a run by part, bytes, counted from the arrays themselves at their capacity. What lives
/// only for a moment is not counted, nor what an allocator adds.
struct MemoryUse {
  std::size_t mesh = 0;            ///< connectivity of the mesh, coordinates as given and now
  std::size_t targets = 0;         ///< shapes that the elements strive for, their VCVs
  std::size_t structure = 0;       ///< patterns of matrices, cells around their rows
  std::size_t matrix = 0;          ///< values of matrices as they are assembled
  std::size_t preconditioner = 0;  ///< matrices in another order, multigrid, incomplete factors
  std::size_t factors = 0;         ///< of direct solvers, with their matrices
  std::size_t vectors = 0;         ///< of outer solvers: gradients, steps kept, meshes tried

  struct Part {
    std::string_view name;
    std::size_t bytes;
  };
  /// All parts, by their names above.
  std::array<Part, 7> parts() const {
    return {{{"mesh", mesh},
             {"targets", targets},
             {"structure", structure},
             {"matrix", matrix},
             {"preconditioner", preconditioner},
             {"factors", factors},
             {"vectors", vectors}}};
  }
  std::size_t total() const {
    std::size_t sum = 0;
    for (const Part& part : parts()) sum += part.bytes;
    return sum;
  }
};

/// Bytes of an array at its capacity.
template <typename T>
std::size_t bytes_of(const std::vector<T>& list) {
  return list.capacity() * sizeof(T);
}
inline std::size_t bytes_of(const std::vector<bool>& list) { return list.capacity() / 8; }
/// Of several arrays.
template <typename First, typename Second, typename... More>
std::size_t bytes_of(const First& first, const Second& second, const More&... more) {
  return bytes_of(first) + bytes_of(second, more...);
}

}  // namespace winslow
