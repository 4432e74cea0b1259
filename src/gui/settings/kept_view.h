#pragma once

#include <array>
#include <string>
#include <vector>

#include "gui/settings/space_options.h"

namespace winslow::gui {

/// How a volume mesh was looked at last, for when it is opened again.
struct KeptView {
  std::string mesh;  ///< its file, absolute
  std::array<double, 3> centre{0, 0, 0};
  double height = 1;  ///< of what is seen around the centre, units of the mesh
  double azimuth = 0, elevation = 0, roll = 0;
  int up = 2;
  std::vector<CutPlane> cuts;
  Peel peel;

  bool operator==(const KeptView&) const = default;
};

/// Meshes whose views are kept, the last first.
inline constexpr std::size_t most_kept_views = 50;

}  // namespace winslow::gui
