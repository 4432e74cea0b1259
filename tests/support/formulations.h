#pragma once

#include <memory>

#include "core/formulation/pointwise_winslow.h"
#include "core/problem/node_classes.h"

/// Formulations in which the interior nodes move and the boundary stays.
namespace winslow::test {

inline std::shared_ptr<const NodeClasses> free_interior(
    const std::shared_ptr<const Topology>& topology) {
  return std::make_shared<const NodeClasses>(topology);
}

inline PointwiseWinslow pointwise(const VirtualControlVolumes& vcv, int threads = 1) {
  return {vcv, free_interior(vcv.shared_topology()), threads};
}

}  // namespace winslow::test
