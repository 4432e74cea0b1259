#pragma once

#include "core/quality/quality.h"

namespace winslow {

/// The change of first heights from one mesh to another.
struct FirstHeightChange {
  /// A height counts as changed if the relative change is larger than this.
  static constexpr double tolerance = 0.05;

  Quantiles ratio;  ///< after / before, of the nodes that have both; count 0: there are none
  double off = 0;   ///< share of these nodes with a changed height
  /// The node with the largest factor of change; -1: there is none.
  Index worst_node = -1;
  double worst_ratio = 1;

  /// A change matters to a flow solver where cells are stretched along the wall, to resolve what
  /// happens across it. Where they are not, it matters only beyond this factor.
  static constexpr double isotropic_factor = 1.5;
  /// Cells are isotropic where the edges along the wall are less than this times the height.
  static constexpr double isotropic_stretch = 2;
  /// Shares of the nodes whose changed heights matter, with stretched and with isotropic cells.
  double off_stretched = 0, off_isotropic = 0;
  bool gross = false;  ///< one of these heights has changed by more than 20 %
  /// The node with the largest factor among those whose changed heights matter; -1: there is none.
  Index harmed_node = -1;
  double harmed_ratio = 1;
};

/// Empty if the walls have other nodes: of another mesh, or after layers were inserted.
std::optional<FirstHeightChange> compare_first_heights(std::span<const WallMeasures> before,
                                                       std::span<const WallMeasures> after);

/// Whether a change spoils the cells at walls: more than 5 % of the nodes have changed heights that
/// matter, or the height of any of them has changed by more than 20 %.
bool spoils_walls(const FirstHeightChange& change);

/// What a motion or a smoothing run has made worse for a flow solver.
struct Damage {
  /// One sentence with figures and the worst places, without its full stop; empty: no damage.
  std::string text;
  std::optional<Index> node;  ///< the wall node with the largest change of the first height
  bool stretched = false;     ///< some of the changed first heights are of stretched cells
  /// The element with the smallest sine, if that has fallen; else one at the face that leans most.
  std::optional<Index> element;
  Index leaning_faces = 0;  ///< of a mesh with polyhedra: newly_leaning_faces()
};

/// Share of the smallest sine that a run leaves at least, or else it has done damage.
inline constexpr double least_sine_kept = 0.9;

/// Damage is a change of first heights that spoils_walls(), or a smallest sine (of volumes, scaled
/// Jacobian) less than least_sine_kept times the one before. In a mesh with polyhedra, of which
/// finite volume solvers are the users, newly_leaning_faces() are damage, too. There is none if one
/// of the meshes has inverted elements, or if they have different topologies.
Damage find_damage(const Mesh& before, const Mesh& after);

/// A motion that ends before an element becomes worse than a limit:
///
///     winslow::MoveCommand move;
///     move.how.floor.set(winslow::Metric::normalized_jacobian, 0.2);

/// All metrics that can have a limit: rating_metrics() of plane meshes, in their order, then those
/// that only volume meshes have.
const std::vector<Metric>& limited_metrics();

/// Limits for the quality of all elements.
struct QualityFloor {
  /// A limit for each of limited_metrics(): the least value if larger is better, else the largest.
  std::vector<std::optional<double>> limits =
      std::vector<std::optional<double>>(limited_metrics().size());

  bool given() const;
  /// Throws UsageError for a metric that is not among limited_metrics().
  void set(Metric metric, double limit);
  /// Throws UsageError for a limit of a metric that elements of that dimension do not have.
  void require_dimension(int cell_dimension) const;
  /// The first limit that a mesh breaks, e.g. "Normalized Jacobian would be less than 0.3"; empty:
  /// none. No smoothing can change elements of a volume mesh with all nodes on the boundary: they
  /// break a limit only if they are also worse than in the given mesh. given: its coordinates.
  std::string fault(const Mesh& mesh, const Coordinates& given) const;

  bool operator==(const QualityFloor&) const = default;
};

}  // namespace winslow
