#pragma once

#include <array>
#include <string>
#include <vector>

namespace winslow::gui {

/// A plane that cuts a volume mesh; what its normal points to is taken away.
struct CutPlane {
  std::array<double, 3> point{0, 0, 0};
  std::array<double, 3> normal{0, 0, 1};  ///< of any length but 0
  bool on = true;

  bool operator==(const CutPlane&) const = default;
};

/// Elements by how deep they lie below a marker: layer 1 has a node of it, layer 2 lies beside
/// layer 1, and so on. Those of some layers are shown alone, whole.
struct Peel {
  bool on = false;
  std::string marker;
  int from = 1, to = 3;  ///< layers that are shown

  bool operator==(const Peel&) const = default;
};

/// How volume meshes are shown, beside what they have in common with plane ones.
struct SpaceOptions {
  std::vector<CutPlane> cuts;  ///< of the open mesh
  bool crinkle = false;        ///< cuts leave whole elements
  bool perspective = false;
  int up = 2;               ///< the axis that is up on screen, 0 to 2
  bool axes = true;         ///< a small cross of axes in the corner
  bool worst = false;       ///< the worst elements are seen through what hides them
  bool free_orbit = false;  ///< the mouse turns the view about any axis, not as a turntable
  Peel peel;                ///< of the open mesh

  bool operator==(const SpaceOptions&) const = default;
};

/// From where a volume mesh is looked at, at what, and how it is cut.
struct SpaceLook {
  double azimuth = 0, elevation = 0;  ///< degrees, as ViewDirection has them
  int up = 2;
  std::array<double, 3> centre{0, 0, 0};
  double radius = 1;  ///< shown around the centre
  std::vector<CutPlane> cuts;

  bool operator==(const SpaceLook&) const = default;
};

/// The cuts that are on can be six.
inline constexpr std::size_t most_cuts = 6;

}  // namespace winslow::gui
