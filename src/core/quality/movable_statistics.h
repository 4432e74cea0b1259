#pragma once

#include "core/quality/quality.h"

/// What smoothing can change of a volume mesh:
///
///     const auto statistics = winslow::movable_statistics(mesh);
///     std::printf("smallest scaled Jacobian %.3f\n", statistics.front().min);
namespace winslow {

/// Statistics of reported_metrics(3), in their order, over the elements of a volume mesh that have
/// a node inside it: without those that QualityReport::all_on_boundary counts. Elements with an
/// infinite value are left out; NaN if no element is left.
std::vector<Statistics> movable_statistics(const Mesh& mesh);

}  // namespace winslow
