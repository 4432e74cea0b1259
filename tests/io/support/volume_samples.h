#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "io/support/samples.h"
#include "support/space_meshes.h"

namespace winslow::test {

/// A cube of elements of one or of all types (n at least 4 for the latter), in which nodes,
/// elements and marker faces come in random order, with coordinates that need all their digits.
/// Half of the marker faces are seen from inside.
inline MeshData volume_sample(Random& random, Volumes volumes, bool with_regions) {
  const Index n = volumes == Volumes::mixed ? 4 : 2;
  MeshData data = shuffled_volume(cube(n, volumes), random, false);
  for (Index i = 0; i < data.node_count(); ++i) {
    const Vec3 noise(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    data.coordinates.set_xyz(i, 1e3 * (data.coordinates.xyz(i) + 0.05 / n * noise));
  }
  if (with_regions) {
    data.regions = {{"near field", 41}, {"far", 7}};
    for (Index e = 0; e < data.element_count(); ++e) data.element_region.push_back(random.index(2));
  }
  const std::vector<int> tags{12, 5, 90};
  const std::vector<std::string> names{"inlet", "wall-1", "body.2"};
  for (std::size_t m = 0; m < data.markers.size(); ++m) {
    data.markers[m].name = names[m];
    data.markers[m].tag = tags[m];
    auto& faces = data.markers[m].faces;
    std::vector<Face> shuffled;
    for (const Index k : random.permutation(static_cast<Index>(faces.size()))) {
      const Face& face = faces[at(k)];
      shuffled.push_back(random.index(2) == 0 ? face.reversed() : face);
    }
    faces = shuffled;
  }
  return data;
}

}  // namespace winslow::test
