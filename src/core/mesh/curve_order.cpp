#include "core/mesh/curve_order.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// The 21 bits of a number, two zeros after each.
std::uint64_t spread_bits(std::uint64_t bits) {
  bits = (bits | bits << 32U) & 0x1f00000000ffffU;
  bits = (bits | bits << 16U) & 0x1f0000ff0000ffU;
  bits = (bits | bits << 8U) & 0x100f00f00f00f00fU;
  bits = (bits | bits << 4U) & 0x10c30c30c30c30c3U;
  return (bits | bits << 2U) & 0x1249249249249249U;
}

}  // namespace

std::vector<Index> along_curve(const SpacePoints& x, Index node_count, const Box<3>& box) {
  constexpr double cells = (1U << 21U) - 1;
  const double unit = cells / std::max(box.size().maxCoeff(), 1e-300);
  std::vector<std::pair<std::uint64_t, Index>> codes(at(node_count));
  parallel_for(0, node_count, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const Vec3 cell = (x[i] - box.min) * unit;
      const auto bits = [&](Index k) {
        // Written so that what is no number, of a box without end, becomes 0.
        const double number = cell[k] > 0 ? std::min(cell[k], cells) : 0;
        return spread_bits(static_cast<std::uint64_t>(number));
      };
      codes[at(i)] = {bits(0) | bits(1) << 1U | bits(2) << 2U, i};
    }
  });
  std::ranges::sort(codes);
  std::vector<Index> nodes;
  nodes.reserve(codes.size());
  for (const auto& [code, node] : codes) nodes.push_back(node);
  return nodes;
}

}  // namespace winslow
