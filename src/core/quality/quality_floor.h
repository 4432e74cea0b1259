#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/quality/quality.h"

namespace winslow {

/// Values that no element may be worse than.
struct QualityFloor {
  /// Of reported_metrics(), in their order: a least value where larger is better, else a largest.
  std::vector<std::optional<double>> limits =
      std::vector<std::optional<double>>(reported_metrics().size());

  bool given() const;
  /// Throws UsageError for a metric that is not reported.
  void set(Metric metric, double limit);
  /// The first limit that a plane mesh breaks, e.g. "Normalized Jacobian would be less than 0.3";
  /// empty: none. x: #nodes by 2.
  std::string fault(const std::shared_ptr<const Topology>& topology, const Coordinates& x) const;

  bool operator==(const QualityFloor&) const = default;
};

}  // namespace winslow
