#include "core/problem/sliding_nodes.h"

#include "core/mesh/coordinates.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

void SlidingNodes::set(Index node, const TangentFrame& frame) { frames_[node] = frame; }

std::vector<TangentFrame> SlidingNodes::set(std::span<const Index> nodes,
                                            std::shared_ptr<const SlidingGeometry> geometry,
                                            const Coordinates& x) {
  if (geometry_.empty()) geometry_.resize(at(x.size()));
  constexpr Index block = 512;  // a foot may take a search
  std::vector<TangentFrame> frames(nodes.size());
  const auto find = [&](Index begin, Index end) {
    for (std::size_t i = at(begin); i < at(end); ++i)
      frames[i] = geometry->foot(nodes[i], place_of(x, nodes[i])).frame;
  };
  parallel_for(0, static_cast<Index>(nodes.size()), find, block);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    frames_[nodes[i]] = frames[i];
    geometry_[at(nodes[i])] = geometry;
  }
  return frames;
}

void SlidingNodes::erase(Index node) {
  frames_.erase(node);
  if (!geometry_.empty()) geometry_[at(node)] = nullptr;
}

const TangentFrame* SlidingNodes::frame(Index node) const {
  const auto found = frames_.find(node);
  return found != frames_.end() ? &found->second : nullptr;
}

const SlidingGeometry* SlidingNodes::geometry(Index node) const {
  return geometry_.empty() ? nullptr : geometry_[at(node)].get();
}

}  // namespace winslow
