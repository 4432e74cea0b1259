#pragma once

#include <array>
#include <utility>
#include <vector>

#include "core/vcv/virtual_control_volumes.h"
#include "support/meshes.h"
#include "support/vcv.h"

/// Meshes with control volumes of random shape.
namespace winslow::test {

inline constexpr std::array<Cells, 3> all_cells{Cells::triangles, Cells::quads, Cells::mixed};

/// Gives every other VCV, on average, random angles and lengths.
inline void randomise(VirtualControlVolumes& vcv, Random& random) {
  for (const Index node : vcv.topology().interior_nodes()) {
    const auto n = static_cast<Index>(vcv.angles(node).size());
    if (n < 3 || random.index(2) == 0) continue;
    std::vector<double> lengths;
    for (Index k = 0; k < n; ++k) lengths.push_back(random.uniform(0.5, 2));
    vcv.set(node, random_angles(random, n), lengths);
  }
}

/// A mesh, its nodes moved at random, with VCVs of random shape.
struct Sample {
  Mesh mesh;
  VirtualControlVolumes vcv;
};

inline Sample make_sample(std::uint64_t seed, Cells cells, bool tangled) {
  Random random(seed);
  Mesh mesh = make_mesh(square(6, cells));
  if (tangled) {
    tangle(mesh, random);
  } else {
    perturb(mesh, random);
  }
  VirtualControlVolumes vcv(mesh.topology);
  randomise(vcv, random);
  return {std::move(mesh), std::move(vcv)};
}

}  // namespace winslow::test
