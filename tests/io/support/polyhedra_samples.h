#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "io/support/samples.h"
#include "support/space_meshes.h"

/// Meshes with polyhedra for the tests of files.
namespace winslow::test {

/// Two prisms over a polygon of n corners, one on the other: markers "bottom", "top", "side".
inline MeshData stacked_prisms(Index n) {
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  for (Index level = 0; level < 3; ++level)
    for (Index k = 0; k < n; ++k) {
      const double angle = 2 * pi * k / n;
      data.coordinates.push_xyz({std::cos(angle), std::sin(angle), 0.7 * level});
    }
  for (Index level = 0; level < 2; ++level) {
    std::vector<Index> low, high;
    for (Index k = 0; k < n; ++k) {
      low.push_back(level * n + k);
      high.push_back((level + 1) * n + k);
    }
    std::vector<Face> faces{Face(std::span<const Index>(low)).reversed(),
                            Face(std::span<const Index>(high))};
    for (std::size_t k = 0; k < at(n); ++k) {
      const std::size_t next = (k + 1) % at(n);
      faces.emplace_back(low[k], low[next], high[next], high[k]);
    }
    low.insert(low.end(), high.begin(), high.end());
    data.add_polyhedron(low, faces);
  }
  mark_volume(data, [](const Vec3& p) {
    return p.z() < 1e-9 ? "bottom" : p.z() > 1.4 - 1e-9 ? "top" : "side";
  });
  return data;
}

/// cube(4, Volumes::mixed) with every third element given by its faces.
inline MeshData all_types() {
  const MeshData given = cube(4, Volumes::mixed);
  MeshData data = given;
  data.types.clear();
  data.element_nodes.clear();
  data.element_offsets = {0};
  for (Index e = 0; e < given.element_count(); ++e) {
    if (e % 3 == 0)
      data.add_polyhedron(given.element(e), faces_of(given, e));
    else
      data.add_element(given.types[at(e)], given.element(e));
  }
  return data;
}

/// The mesh with coordinates that need all their digits, two regions, and names and tags of
/// markers that need care.
inline MeshData with_odd_numbers(MeshData data, std::uint64_t seed) {
  Random random(seed);
  for (Index i = 0; i < data.node_count(); ++i) {
    const Vec3 noise(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    data.coordinates.set_xyz(i, 1e3 * (data.coordinates.xyz(i) + 1e-3 * noise));
  }
  data.regions = {{"near field", 41}, {"far", 7}};
  data.element_region.clear();
  for (Index e = 0; e < data.element_count(); ++e) data.element_region.push_back(e % 2);
  for (std::size_t m = 0; m < data.markers.size(); ++m) {
    data.markers[m].name += ".1";
    data.markers[m].tag = std::array{12, 5, 90}[m];
  }
  return data;
}

struct PolyhedraSample {
  std::string name;
  MeshData data;
};
/// A face of 12 corners, hexahedra with hanging nodes, all types mixed, and cells of one type as
/// polyhedra.
inline std::vector<PolyhedraSample> polyhedra_samples() {
  std::vector<PolyhedraSample> samples;
  samples.push_back({"faces of 12 corners", with_odd_numbers(stacked_prisms(12), 1)});
  samples.push_back({"hanging nodes", with_odd_numbers(split_box_with_body(4), 2)});
  samples.push_back({"all types", with_odd_numbers(all_types(), 3)});
  samples.push_back(
      {"tetrahedra by faces", with_odd_numbers(as_polyhedra(cube(2, Volumes::tetrahedra)), 4)});
  return samples;
}

/// The faces of an element of a mesh, each with its lowest node first: equal for cells with the
/// same faces that face the same way.
inline std::vector<Face> faces_of(const Topology& topology, Index e) {
  std::vector<Face> faces;
  for (const Face& local : topology.shape(e).faces) {
    const Face face = by_nodes(local, topology.element(e));
    std::vector<Index> nodes(face.begin(), face.end());
    std::rotate(nodes.begin(), std::ranges::min_element(nodes), nodes.end());
    faces.emplace_back(std::span<const Index>(nodes));
  }
  std::ranges::sort(faces);
  return faces;
}

/// Checks that two meshes have the same cells, bounded by the same faces, which all face outwards,
/// and the same nodes to the last bit.
inline void check_same_cells(const Mesh& found, const Mesh& expected) {
  CHECK(found.coordinates == expected.coordinates);
  const Topology &a = *found.topology, &b = *expected.topology;
  REQUIRE(a.element_count() == b.element_count());
  CHECK(a.face_count() == b.face_count());
  for (Index e = 0; e < a.element_count(); ++e) {
    CAPTURE(e);
    CHECK(faces_of(a, e) == faces_of(b, e));
  }
}

}  // namespace winslow::test
