#pragma once

#include "core/formulation/cell_targets.h"
#include "core/formulation/target_metric.h"
#include "core/mesh/element_type.h"

/// Targets `keep`, which let a mesh stay as it is where nothing moves. The energy of a cell is
///
///   w [ f_own + g Q(f_guard / limit) ],   limit = max(1.4, f_guard of the reference mesh),
///   Q(r) = r^8 - 1 - 8 (r - 1) - 28 (r - 1)^2 for 1 < r < 2, 0 below, with the same slope above.
///
/// f_own is the distortion from the cell's own shape in the reference mesh. The first term keeps
/// shapes, and with them heights at walls. It alone would let single cells become arbitrarily bad
/// in large motions. The second term is a guard: it has an effect only on cells that are worse than
/// they were, and worse than the least limit. f_guard is the distortion from the regular simplex,
/// or from the straight corner with the own edge lengths: a rectangle, a box, an upright prism. At
/// the reference mesh both gradients vanish, so it is the solution of a run that moves nothing.
/// Results depend only on the reference mesh and on where the boundary is.
///
/// The constants were chosen by measurement:
///
/// - Where a passage becomes narrow limits cannot be met. Beyond r = 2 the slope of Q is constant,
///   so that elements there do not squash the layers beside them.
/// - The guard of a cell with f_guard up to 1.5 has the weight 1 (times PenaltyOptions::guard).
///   That of worse cells grows with the 8th power, up to 100: they have less to lose.
/// - An element counts as much as the regular simplices that fill its volume. If each element
///   counted alike, hexahedra would give way to tetrahedra beside them.
/// - An element that is more than four times as long as wide has the weight (aspect ratio) / 4, at
///   most 300, so layers at walls keep their heights where a passage becomes narrower.
namespace winslow {

/// The two terms of a cell: of its own shape, and the guard with the inverse of its limit.
template <int D>
struct KeptTerms {
  typename CellTargets<D>::Term own, guard;
  double inverse_limit;
};

/// regular, own: metrics of the corner of the regular element, and of the element in the reference
/// mesh. weight: of the cell for a regular simplex; the type and the stretch increase it.
KeptTerms<2> kept_terms(const ElementShape& shape, const TargetMetric& regular,
                        const TargetMetric& own, double weight);
KeptTerms<3> kept_terms(const ElementShape& shape, const Eigen::Matrix3d& regular,
                        const Eigen::Matrix3d& own, double weight);

/// Appends the terms of a cell to the targets.
template <int D>
void append(CellTargets<D>& targets, const KeptTerms<D>& terms) {
  targets.terms.insert(targets.terms.end(), {terms.own, terms.guard});
  targets.inverse_limits.insert(targets.inverse_limits.end(), {0.0, terms.inverse_limit});
}

}  // namespace winslow
