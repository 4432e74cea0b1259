#include "io/gmsh/node_tags.h"

#include <algorithm>

namespace winslow::io::gmsh {

std::optional<Index> NodeTags::build(const std::vector<std::int64_t>& tags) {
  if (tags.empty()) return std::nullopt;
  const auto [low, high] = std::minmax_element(tags.begin(), tags.end());
  // The reader lets only positive tags in, so the difference cannot overflow.
  const auto range = static_cast<std::uint64_t>(*high - *low);
  const bool dense = range < 8 * tags.size() + 1024;
  first_ = *low;
  if (dense) {
    dense_.assign(static_cast<std::size_t>(range) + 1, -1);
  } else {
    sparse_.reserve(tags.size());
  }
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const auto node = static_cast<Index>(i);
    if (dense) {
      Index& slot = dense_[static_cast<std::size_t>(tags[i] - first_)];
      if (slot >= 0) return node;
      slot = node;
    } else if (!sparse_.emplace(tags[i], node).second) {
      return node;
    }
  }
  return std::nullopt;
}

Index NodeTags::find(std::int64_t tag) const {
  if (!sparse_.empty()) {
    const auto found = sparse_.find(tag);
    return found == sparse_.end() ? -1 : found->second;
  }
  if (tag < first_ || static_cast<std::uint64_t>(tag - first_) >= dense_.size()) return -1;
  return dense_[static_cast<std::size_t>(tag - first_)];
}

}  // namespace winslow::io::gmsh
