#pragma once

#include <array>
#include <vector>

namespace winslow::gui {

/// A plane that cuts a volume mesh; what its normal points to is taken away.
struct CutPlane {
  std::array<double, 3> point{0, 0, 0};
  std::array<double, 3> normal{0, 0, 1};  ///< of any length but 0
  bool on = true;

  bool operator==(const CutPlane&) const = default;
};

/// How volume meshes are shown, beside what they have in common with plane ones.
struct SpaceOptions {
  std::vector<CutPlane> cuts;  ///< of the open mesh
  bool crinkle = false;        ///< cuts leave whole elements
  bool perspective = false;
  int up = 2;          ///< the axis that is up on screen, 0 to 2
  bool axes = true;    ///< a small cross of axes in the corner
  bool worst = false;  ///< the worst elements are seen through what hides them

  bool operator==(const SpaceOptions&) const = default;
};

/// The cuts that are on can be six.
inline constexpr std::size_t most_cuts = 6;

}  // namespace winslow::gui
