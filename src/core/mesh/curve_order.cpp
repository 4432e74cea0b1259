#include "core/mesh/curve_order.h"

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

/// Elements by the first of their nodes in the order, of which `places` are the inverse.
std::vector<Index> by_first_node(const CompressedRows& corners, const std::vector<Index>& places) {
  std::vector<Index> first(at(corners.rows()));
  parallel_for(0, corners.rows(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      Index least = static_cast<Index>(places.size());
      for (const Index node : corners[e]) least = std::min(least, places[at(node)]);
      first[at(e)] = least;
    }
  });
  std::vector<Index> begin(places.size() + 1, 0);
  for (const Index place : first) ++begin[at(place) + 1];
  for (std::size_t k = 1; k < begin.size(); ++k) begin[k] += begin[k - 1];
  std::vector<Index> elements(first.size());
  for (std::size_t e = 0; e < first.size(); ++e)
    elements[at(begin[at(first[e])]++)] = static_cast<Index>(e);
  return elements;
}

}  // namespace

CurveOrder::CurveOrder(const SpacePoints& x, Index node_count, const Box<3>& box,
                       const CompressedRows& of_mesh)
    : nodes(along_curve(x, node_count, box)) {
  std::vector<Index> places(nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) places[at(nodes[k])] = static_cast<Index>(k);
  elements = by_first_node(of_mesh, places);
  corners.offsets.reserve(elements.size() + 1);
  for (const Index e : elements)
    corners.offsets.push_back(corners.offsets.back() + static_cast<Index>(of_mesh[e].size()));
  corners.values.resize(at(corners.offsets.back()));
  parallel_for(0, corners.rows(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      auto value = corners.values.begin() + corners.offsets[at(e)];
      for (const Index node : of_mesh[elements[at(e)]]) *value++ = places[at(node)];
    }
  });
}

}  // namespace winslow
