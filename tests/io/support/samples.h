#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "io/format/mesh_file.h"
#include "io/support/files.h"
#include "support/meshes.h"

namespace winslow::test {

/// A square of triangles and quadrilaterals with two holes, in which nodes, elements, corners and
/// marker edges come in random order, with coordinates that need all their digits.
inline MeshData shuffled_mesh(Random& random, bool with_regions) {
  const Index n = 4 + random.index(5);
  const auto cells = std::array{Cells::triangles, Cells::quads, Cells::mixed}[at(random.index(3))];
  const MeshData grid = grid_with_holes(n, cells, [&](Index i, Index j) {
    return (i == 1 && j == 1) || (n > 4 && i == n - 2 && j == n - 2);
  });
  MeshData data;
  const auto new_node = random.permutation(grid.node_count());
  data.coordinates = Coordinates(2, grid.node_count());
  for (Index i = 0; i < grid.node_count(); ++i) {
    const Vec2 noise = random.vector(-0.1 / n, 0.1 / n);
    data.coordinates.set_xy(new_node[at(i)], 1e3 * (grid.coordinates.xy(i) + noise));
  }
  for (const Index e : random.permutation(grid.element_count())) {
    std::vector<Index> corners;
    for (const Index c : grid.element(e)) corners.push_back(new_node[at(c)]);
    std::rotate(corners.begin(), corners.begin() + random.index(3), corners.end());
    data.add_element(grid.types[at(e)], corners);
    if (with_regions) data.element_region.push_back(random.index(2));
  }
  if (with_regions) data.regions = {{"near field", 41}, {"far", 7}};
  mark_boundary(data, [&](const Vec2& p) {
    return std::string(p.x() < 200 ? "inlet" : p.y() < 200 ? "wall-1" : "body.2");
  });
  std::vector<int> tags{12, 5, 90, 33};
  for (std::size_t m = 0; m < data.markers.size(); ++m) {
    data.markers[m].tag = tags[m];
    auto& edges = data.markers[m].faces;
    std::vector<Face> shuffled;
    for (const Index k : random.permutation(static_cast<Index>(edges.size()))) {
      const Face& edge = edges[at(k)];
      shuffled.push_back(random.index(2) == 0 ? edge.reversed() : edge);
    }
    edges = shuffled;
  }
  return data;
}

/// Checks that two meshes are the same, bit for bit and in the same order.
struct Comparison {
  bool markers = true;
  bool tags = true;
  bool regions = true;
};
inline void check_same_mesh(const Mesh& a, const Mesh& b, const Comparison& what = {}) {
  CHECK(a.coordinates == b.coordinates);
  const Topology& s = *a.topology;
  const Topology& t = *b.topology;
  REQUIRE(s.element_count() == t.element_count());
  CHECK(s.elements().offsets == t.elements().offsets);
  CHECK(s.elements().values == t.elements().values);
  if (what.markers) {
    REQUIRE(s.markers().size() == t.markers().size());
    CHECK(s.markers().from_file() == t.markers().from_file());
    for (std::size_t m = 0; m < s.markers().size(); ++m) {
      CHECK(s.markers()[m].name == t.markers()[m].name);
      CHECK(s.markers()[m].faces == t.markers()[m].faces);
      if (what.tags) CHECK(s.markers()[m].tag == t.markers()[m].tag);
    }
  }
  if (what.regions) {
    REQUIRE(s.regions().size() == t.regions().size());
    for (std::size_t r = 0; r < s.regions().size(); ++r) {
      CHECK(s.regions()[r].name == t.regions()[r].name);
      if (what.tags) CHECK(s.regions()[r].tag == t.regions()[r].tag);
    }
    CHECK(std::equal(s.element_regions().begin(), s.element_regions().end(),
                     t.element_regions().begin(), t.element_regions().end()));
  }
}

/// Extension, MSH version and encoding of a file to write.
struct Kind {
  const char* extension;
  const char* gmsh_version;
  bool binary;
};
inline std::vector<Kind> kinds() {
  return {{"su2", "", false},   {"msh", "2.2", false}, {"msh", "2.2", true}, {"msh", "4.1", false},
          {"msh", "4.1", true}, {"vtk", "", false},    {"vtk", "", true},    {"vtu", "", false},
          {"vtu", "", true},    {"obj", "", false},    {"off", "", false},   {"ply", "", false},
          {"ply", "", true},    {"stl", "", false},    {"stl", "", true}};
}
inline std::string text_of(const Kind& kind) {
  return std::string(kind.extension) + " " + kind.gmsh_version +
         (kind.binary ? " binary" : " ascii");
}
inline io::WriteOptions options_of(const Kind& kind) {
  io::WriteOptions options;
  options.binary = kind.binary;
  options.keep_encoding = false;
  options.gmsh_version = kind.gmsh_version;
  return options;
}

}  // namespace winslow::test
