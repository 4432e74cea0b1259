#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/quality/quality.h"

namespace winslow {

/// All metrics to which a limit can be set: those reported of plane meshes, in their order, then
/// those that volume meshes alone have.
const std::vector<Metric>& limited_metrics();

/// Values that no element may be worse than.
struct QualityFloor {
  /// Of limited_metrics(), in their order: a least value where larger is better, else a largest.
  std::vector<std::optional<double>> limits =
      std::vector<std::optional<double>>(limited_metrics().size());

  bool given() const;
  /// Throws UsageError for a metric that is not reported.
  void set(Metric metric, double limit);
  /// Throws UsageError for a limit to what elements of that dimension do not have.
  void require_dimension(int cell_dimension) const;
  /// The first limit that a mesh breaks, e.g. "Normalized Jacobian would be less than 0.3"; empty:
  /// none. Elements of a volume mesh whose nodes all lie on the boundary, which no smoothing can
  /// change, break one only where they are worse than they came. given: the mesh as it came.
  std::string fault(const Mesh& mesh, const Coordinates& given) const;

  bool operator==(const QualityFloor&) const = default;
};

}  // namespace winslow
