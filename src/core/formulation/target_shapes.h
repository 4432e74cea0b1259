#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/mesh/coordinates.h"
#include "core/types.h"
#include "core/vcv/virtual_control_volumes.h"

namespace winslow {

/// Which shapes the variational form drives elements towards. The shares are relative; a blend lies
/// between its parts (on the geodesic of the metrics, see TargetShapes).
struct TargetBlend {
  double automatic = 1;  ///< regular, or the element's own shape where it is stretched on purpose:
                         ///< StretchField
  double element = 0;    ///< equilateral triangles, square corners
  double vcv = 0;        ///< the triangles of the virtual control volumes: angles, edge lengths
  double rest = 0;       ///< the element's own shape in the mesh as given

  static constexpr TargetBlend regular() { return {.automatic = 0, .element = 1}; }

  bool operator==(const TargetBlend&) const = default;
};

/// Whether targets depend on the mesh as given.
bool refers_to_given(const TargetBlend& blend);

/// One target of one triangle (a, b, c), as the quadratic form that measures the physical triangle
/// in the target's metric:
///
///   N = ab |b - a|^2 + ac |c - a|^2 + bc |c - b|^2,   |J|_F^2 / det J = N / (2 area),
///
/// J being the linear map from the target to the physical triangle. Scaled so that N = 4 area if
/// the two are similar. The three numbers are the cotangents of the target's angles, at c, b and a.
struct ShapeTerm {
  double ab = 0, ac = 0, bc = 0;
  double weight = 0;  ///< share in the energy
};

/// All targets of a mesh: triangles, and corners of quadrilaterals, each with one or more terms.
/// The terms of an element have weights that sum to its own
/// (VirtualControlVolumes::Role, one as a rule), however many of its nodes lie at the boundary.
/// Triangles whose three nodes lie on the boundary are left out: they cannot change.
///
/// A VCV that was edited (VirtualControlVolumes::edited) counts whatever the blend: in the corners
/// at such a node the shares `automatic` and `element` go to the VCV, and where the blend has no
/// share for VCVs at all, a triangle with such corners has the targets of these alone. A corner at
/// the boundary of a quadrilateral with such corners takes part: its target is the parallelogram of
/// theirs.
struct TargetShapes {
  std::vector<std::array<Index, 3>> triangles;  ///< nodes, counter-clockwise; a is the corner
  std::vector<Index> offsets{0};                ///< #triangles + 1, into terms
  std::vector<ShapeTerm> terms;

  /// Part of the elements (0 to 1) that `auto` targets keep stretched: StretchField::stretched.
  /// None where the blend has no share for them.
  std::optional<double> stretched;

  /// Targets over the VCVs as the blend says. given: coordinates (#nodes by 2) of the mesh that the
  /// shares `automatic` and `rest` refer to; may be null if those are zero. threads: 0 for all
  /// cores. urgent: elements that count four
  /// times as much under `automatic`, once more for each time they are listed.
  /// Throws UsageError for shares that are negative or all zero, MeshError if `rest` counts
  /// and the mesh has an inverted element.
  static TargetShapes build(const VirtualControlVolumes& vcv, const TargetBlend& blend,
                            const Coordinates* given, int threads = 0,
                            std::span<const Index> urgent = {});
};

}  // namespace winslow
