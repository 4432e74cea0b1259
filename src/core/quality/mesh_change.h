#pragma once

#include "core/quality/quality.h"

namespace winslow {

/// First heights of one mesh over those of another.
struct FirstHeightChange {
  /// A height has changed if it differs by more than this share of what it was.
  static constexpr double tolerance = 0.05;

  Quantiles ratio;  ///< after / before, of the nodes that have both; count 0: there are none
  double off = 0;   ///< share of these nodes whose height has changed
  /// The node whose height has changed by the largest factor; -1: there is none.
  Index worst_node = -1;
  double worst_ratio = 1;
};

/// Empty where the walls are not of the same nodes: another mesh, or layers in between.
std::optional<FirstHeightChange> compare_first_heights(std::span<const WallMeasures> before,
                                                       std::span<const WallMeasures> after);

/// Whether the walls' cells are not what they were: at more than 5 % of the nodes the height has
/// changed, or at any of them by more than 20 %.
bool spoils_walls(const FirstHeightChange& change);

/// What a motion or a smoothing run has spoilt, for a flow solver.
struct Damage {
  /// With the figures and the worst places, as the beginning of a sentence without its full stop;
  /// empty: nothing is spoilt.
  std::string text;
  std::optional<Index> node;     ///< of a wall, whose first height has changed most
  std::optional<Index> element;  ///< with the smallest sine, if that has fallen
};

/// First heights (as above), and a smallest sine that is less than half of what it was. Of a mesh
/// that has or had inverted elements nothing is said, nor of meshes of different connectivity.
Damage find_damage(const Mesh& before, const Mesh& after);

/// A motion that ends before the mesh gets worse than this:
///
///     winslow::MoveCommand move;
///     move.how.floor.set(winslow::Metric::normalized_jacobian, 0.2);

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
