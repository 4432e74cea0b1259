#pragma once

#include <type_traits>

#include "core/formulation/stretch_field.h"
#include "core/index.h"
#include "core/mesh/topology.h"
#include "core/types.h"

namespace winslow {

/// One target of one triangle (a, b, c), as the quadratic form of the physical triangle in the
/// target's metric:
///
///   N = ab |b - a|^2 + ac |c - a|^2 + bc |c - b|^2,   |J|_F^2 / det J = N / (2 area),
///
/// J being the linear map from the target to the physical triangle. Scaled so that N = 4 area if
/// the two are similar. The three numbers are the cotangents of the target's angles, at c, b and a.
struct ShapeTerm {
  double ab = 0, ac = 0, bc = 0;
  double weight = 0;  ///< share in the energy
};

/// One target of one tetrahedron: its metric over the three edges from the first node, the inverse
/// of their Gram matrix scaled to determinant 1 (see core/formulation/target_metric.h).
struct VolumeTerm {
  double a11 = 0, a12 = 0, a13 = 0, a22 = 0, a23 = 0, a33 = 0;
  double weight = 0;  ///< share in the energy
  double unused = 0;  ///< padding: a term is two packs of four
};

/// Targets of simplices: triangles of a plane mesh (D = 2), tetrahedra of a volume mesh (D = 3),
/// each with one or more terms.
template <int D>
struct CellTargets {
  using Term = std::conditional_t<D == 2, ShapeTerm, VolumeTerm>;

  std::vector<std::array<Index, D + 1>> cells;  ///< nodes, positively oriented; the corner first
  std::vector<Index> offsets{0};                ///< #cells + 1, into terms
  std::vector<Term> terms;
  /// #terms, or empty: not 0 for guards, terms with a one-sided penalty beyond a limit of f
  /// (PenaltyConstants): the inverse of the limit.
  std::vector<double> inverse_limits;
  /// Fraction of the elements (0 to 1) that `auto` targets keep stretched. None if the blend has no
  /// `automatic` share.
  std::optional<double> stretched;
  /// Number of elements without a shape of their own in the mesh as given, under `keep`.
  Index without_shape = 0;

  double inverse_limit(std::size_t term) const {
    return inverse_limits.empty() ? 0 : inverse_limits[term];
  }
  /// Adds a cell of other targets, which have inverse limits if these have.
  void add_cell(const CellTargets& from, std::size_t cell) {
    cells.push_back(from.cells[cell]);
    const auto added = from.terms_of(cell);
    terms.insert(terms.end(), added.begin(), added.end());
    if (!from.inverse_limits.empty())
      inverse_limits.insert(inverse_limits.end(), from.inverse_limits.begin() + from.offsets[cell],
                            from.inverse_limits.begin() + from.offsets[cell + 1]);
    end_cell();
  }
  /// Ends a cell, which has the terms that were added since the end of the last one.
  void end_cell() { offsets.push_back(index_count(terms.size(), "target shapes of elements")); }
  std::size_t bytes() const { return bytes_of(cells, offsets, terms, inverse_limits); }
  std::span<const Term> terms_of(std::size_t cell) const { return part(terms, cell); }
  std::span<Term> terms_of(std::size_t cell) { return part(terms, cell); }

 private:
  template <typename Terms>
  auto part(Terms& all, std::size_t cell) const {
    return std::span(all).subspan(at(offsets[cell]), at(offsets[cell + 1] - offsets[cell]));
  }
};

/// Targets of some of the cells of a mesh.
template <int D>
struct TargetsOfSome {
  CellTargets<D> targets;
  std::vector<Index> cells;     ///< of each of their cells, its number among all
  std::vector<Index> elements;  ///< of each of their cells
};

/// Makes all elements isotropic, including those that were stretched:
///
///     winslow::SmoothCommand smooth;
///     smooth.smooth.targets = winslow::TargetBlend::regular();

/// The target shapes of the variational form. The shares are relative; a blend lies between its
/// parts (on the geodesic of the metrics of the shapes). By default the command chooses: motions
/// keep the elements' shapes, all others make them regular or keep them as `automatic` does.
struct TargetBlend {
  double automatic = 0;  ///< regular, or the element's own shape where it is deliberately stretched
  double element = 0;    ///< regular: equilateral triangles, square corners, and analogues in space
  double vcv = 0;        ///< triangles or tetrahedra of the virtual control volumes
  double rest = 0;       ///< the element's own shape in the mesh as given
  /// The same, and guards that keep elements from becoming worse than they were given: `keep` of
  /// target_shapes.h. Not blended with others.
  double keep = 0;

  static constexpr TargetBlend regular() { return {.element = 1}; }
  static constexpr TargetBlend automatically() { return {.automatic = 1}; }
  static constexpr TargetBlend keeping() { return {.keep = 1}; }

  /// Whether the command chooses: all shares are zero.
  bool by_command() const { return *this == TargetBlend{}; }
  /// These, or `fallback` if the command is to choose.
  TargetBlend or_else(const TargetBlend& fallback) const { return by_command() ? fallback : *this; }

  bool operator==(const TargetBlend&) const = default;
};

/// Whether targets depend on the mesh as given.
inline bool refers_to_given(const TargetBlend& blend) {
  return blend.automatic > 0 || blend.rest > 0 || blend.keep > 0;
}

/// The shares scaled to sum to 1. Throws UsageError for shares that are negative or all zero, and
/// for `keep` with others.
TargetBlend normalized(const TargetBlend& blend);

/// The role of an element, which affects its targets.
enum class ElementRole : std::uint8_t {
  ordinary,      ///< nothing
  layer,         ///< in an inserted layer: its shape has a far greater weight
  found_layer,   ///< in a layer found in the mesh: a greater weight, but less so
  beside_layers  ///< outside, at the rim or a step of layers: it keeps its own target
};
/// #elements
using ElementRoles = std::vector<ElementRole>;

/// The role of an element; ordinary where roles is null.
inline ElementRole role_of(const ElementRoles* roles, Index element) {
  return roles ? (*roles)[at(element)] : ElementRole::ordinary;
}

/// Weight of an element's shape relative to that of an ordinary element.
///
/// The energy does not depend on size. So elements outside that were compressed to make room would
/// compress the layers by about as much and turn the columns of fans; the weight 1e4 leaves a
/// ten-thousandth of this to the corrections. Found layers keep their present shapes, for which 1e3
/// suffices, and the linear systems are easier to solve.
double role_weight(ElementRole role);
/// Whether an element ignores edited VCVs of its nodes: those of a rim are made for the layers.
inline bool ignores_vcvs(ElementRole role) { return role == ElementRole::beside_layers; }

/// Weight of an element in the energy: the sum over its targets. stretch: of the mesh as given;
/// used if the blend has an `automatic` share.
double element_weight(Index element, const TargetBlend& blend, const StretchField& stretch,
                      const ElementRoles* roles);

/// Throws UsageError unless there is one role for each element, or none at all (null).
void require_role_of_each(const ElementRoles* roles, const Topology& topology);

}  // namespace winslow
