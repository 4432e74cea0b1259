#pragma once

namespace winslow {

/// Which shapes the variational form drives elements towards. The shares are relative; a blend lies
/// between its parts (on the geodesic of the metrics of the shapes).
struct TargetBlend {
  double automatic = 1;  ///< regular, or the element's own shape where it is stretched on purpose
  double element = 0;  ///< regular: equilateral triangles, square corners, and their like in space
  double vcv = 0;      ///< the triangles or tetrahedra of the virtual control volumes
  double rest = 0;     ///< the element's own shape in the mesh as given

  static constexpr TargetBlend regular() { return {.automatic = 0, .element = 1}; }

  bool operator==(const TargetBlend&) const = default;
};

/// Whether targets depend on the mesh as given.
inline bool refers_to_given(const TargetBlend& blend) {
  return blend.automatic > 0 || blend.rest > 0;
}

/// The shares scaled to sum to 1. Throws UsageError for shares that are negative or all zero.
TargetBlend normalized(const TargetBlend& blend);

}  // namespace winslow
