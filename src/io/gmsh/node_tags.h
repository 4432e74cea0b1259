#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "core/types.h"

namespace winslow::io::gmsh {

/// From node tags, which may have gaps and come in any order, to node indices.
class NodeTags {
 public:
  /// Returns the index of the first node whose tag an earlier node has, if there is one.
  std::optional<Index> build(const std::vector<std::int64_t>& tags);
  /// -1 if no node has the tag.
  Index find(std::int64_t tag) const;

 private:
  std::int64_t first_ = 0;
  std::vector<Index> dense_;  ///< by tag - first_
  std::unordered_map<std::int64_t, Index> sparse_;
};

}  // namespace winslow::io::gmsh
