#include "core/mesh/topology.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/error.h"
#include "core/mesh/half_edge.h"
#include "core/mesh/mesh.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// The same mesh with nodes and elements in random order, elements starting at random corners and,
/// if asked, a random half of them clockwise.
MeshData shuffled(const MeshData& data, Random& random, bool flip) {
  MeshData out;
  const auto node_at = random.permutation(data.node_count());
  out.coordinates = Coordinates(2, data.node_count());
  for (Index i = 0; i < data.node_count(); ++i) {
    out.coordinates.set_xy(node_at[at(i)], data.coordinates.xy(i));
  }
  for (const Index e : random.permutation(data.element_count())) {
    std::vector<Index> corners;
    for (const Index node : data.element(e)) corners.push_back(node_at[at(node)]);
    std::rotate(corners.begin(), corners.begin() + random.index(static_cast<Index>(corners.size())),
                corners.end());
    if (flip && random.index(2) == 0) std::reverse(corners.begin(), corners.end());
    out.add_element(data.types[at(e)], corners);
  }
  out.markers = data.markers;
  for (Marker& marker : out.markers) {
    for (Face& edge : marker.faces) edge = by_nodes(edge, node_at);
  }
  return out;
}

double twice_area(const Coordinates& x, std::span<const Index> corners) {
  double sum = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2 a = x.xy(corners[k]);
    const Vec2 b = x.xy(corners[(k + 1) % corners.size()]);
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

std::set<Index> neighbours_by_brute_force(const Topology& topology, Index node) {
  std::set<Index> found;
  for (Index e = 0; e < topology.element_count(); ++e) {
    const auto c = topology.element(e);
    for (std::size_t k = 0; k < c.size(); ++k) {
      const Index next = c[(k + 1) % c.size()];
      if (c[k] == node) found.insert(next);
      if (next == node) found.insert(c[k]);
    }
  }
  return found;
}

bool contains(std::span<const Index> values, Index value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

/// Angle from edge k to edge k + 1 around a node, in (0, 2 pi).
double turn(const Coordinates& x, Index node, Index from, Index to) {
  const Vec2 a = x.xy(from) - x.xy(node);
  const Vec2 b = x.xy(to) - x.xy(node);
  const double angle = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  return angle > 0 ? angle : angle + 2 * pi;
}

void check_star(const Topology& topology, const Coordinates& x, Index node) {
  CAPTURE(node);
  const auto row = topology.neighbours(node);
  const auto star = topology.star(node);
  const std::set<Index> expected = neighbours_by_brute_force(topology, node);
  CHECK(std::set<Index>(row.begin(), row.end()) == expected);
  CHECK(row.size() == expected.size());
  const bool interior = star.size() == row.size();
  if (!interior) REQUIRE(star.size() + 1 == row.size());
  double around = 0;
  for (std::size_t k = 0; k < star.size(); ++k) {
    const Index next = row[(k + 1) % row.size()];
    const auto corners = topology.element(star[k]);
    CHECK(contains(corners, node));
    CHECK(contains(corners, row[k]));
    CHECK(contains(corners, next));
    const double angle = turn(x, node, row[k], next);
    CHECK(angle < pi);
    around += angle;
  }
  if (interior) CHECK(around == doctest::Approx(2 * pi));
  if (!interior) CHECK(around < 2 * pi);
}

std::vector<MeshData> sample_meshes() {
  std::vector<MeshData> meshes;
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    meshes.push_back(square(5, cells));
    meshes.push_back(annulus(12, 4, 1.4, cells));
    meshes.push_back(square_with_two_holes(10, cells));
  }
  meshes.push_back(regular_star(7));
  return meshes;
}

}  // namespace

TEST_CASE(
    "stars run counter-clockwise and line up with the neighbours, whatever the file's order") {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    CAPTURE(seed);
    Random random(seed);
    for (const MeshData& original : sample_meshes()) {
      const MeshData data = shuffled(original, random, true);
      Mesh mesh = make_mesh(data);
      perturb(mesh, random, 0.3);
      for (Index i = 0; i < mesh.topology->node_count(); ++i) {
        check_star(*mesh.topology, mesh.coordinates, i);
      }
    }
  }
}

TEST_CASE("elements are counter-clockwise on return and keep their first node") {
  for (const std::uint64_t seed : {11u, 12u, 13u, 14u}) {
    CAPTURE(seed);
    Random random(seed);
    for (const MeshData& original : sample_meshes()) {
      const MeshData data = shuffled(original, random, true);
      const auto topology = Topology::build(data);
      Index clockwise = 0;
      for (Index e = 0; e < data.element_count(); ++e) {
        CHECK(twice_area(data.coordinates, topology->element(e)) > 0);
        CHECK(topology->element(e)[0] == data.element(e)[0]);
        CHECK(topology->element_type(e) == data.types[at(e)]);
        const bool same = std::ranges::equal(topology->element(e), data.element(e));
        const bool turned = twice_area(data.coordinates, data.element(e)) < 0;
        CHECK(same != turned);
        clockwise += turned ? 1 : 0;
      }
      CHECK(topology->reversed_elements() == clockwise);
    }
  }
}

TEST_CASE("a tangled mesh is oriented as its boundary says") {
  for (const std::uint64_t seed : {21u, 22u, 23u}) {
    CAPTURE(seed);
    Random random(seed);
    for (const MeshData& original : sample_meshes()) {
      Mesh mesh = make_mesh(original);
      tangle(mesh, random);
      MeshData data = original;
      data.coordinates = mesh.coordinates;
      Random again(seed);
      const auto tangled = Topology::build(shuffled(data, again, true));
      Random same(seed);
      const auto valid = Topology::build(shuffled(original, same, true));
      CHECK(tangled->elements().values == valid->elements().values);
      CHECK(tangled->neighbour_rows().values == valid->neighbour_rows().values);
    }
  }
}

TEST_CASE("the row of an interior node starts at its smallest neighbour") {
  const auto topology = Topology::build(square(4, Cells::mixed));
  for (const Index node : topology->interior_nodes()) {
    const auto row = topology->neighbours(node);
    CHECK(row.front() == *std::min_element(row.begin(), row.end()));
  }
}

TEST_CASE("every side of every element is one of the edges, boundary edges have one element") {
  for (const MeshData& data : sample_meshes()) {
    const auto topology = Topology::build(data);
    std::size_t sides = 0;
    for (const auto& edge : topology->edges()) {
      CHECK(edge.nodes[0] < edge.nodes[1]);
      for (const Index e : edge.elements) {
        if (e < 0) continue;
        ++sides;
        CHECK(contains(topology->element(e), edge.nodes[0]));
        CHECK(contains(topology->element(e), edge.nodes[1]));
      }
      CHECK(edge.elements[0] >= 0);
    }
    CHECK(sides == data.element_nodes.size());
    // Euler: V - E + F = 1 - number of holes.
    const auto holes = static_cast<Index>(topology->boundary_loops().size()) - 1;
    CHECK(topology->node_count() - static_cast<Index>(topology->edges().size()) +
              topology->element_count() ==
          1 - holes);
  }
}

TEST_CASE("boundary loops are closed and have the elements on their left") {
  for (const std::uint64_t seed : {31u, 32u}) {
    CAPTURE(seed);
    Random random(seed);
    const std::vector<std::pair<MeshData, std::size_t>> cases{
        {square(4, Cells::quads), 1},
        {annulus(10, 3, 1.3, Cells::mixed), 2},
        {square_with_two_holes(10, Cells::triangles), 3}};
    for (const auto& [original, loops] : cases) {
      const MeshData data = shuffled(original, random, true);
      const auto topology = Topology::build(data);
      REQUIRE(topology->boundary_loops().size() == loops);
      int outer = 0;
      for (const auto& loop : topology->boundary_loops()) {
        // Elements on the left: the outer loop runs counter-clockwise, holes clockwise.
        if (twice_area(data.coordinates, loop) > 0) ++outer;
        for (std::size_t k = 0; k < loop.size(); ++k) {
          const Index a = loop[k], b = loop[(k + 1) % loop.size()];
          bool side = false;  // a to b is a side of an element, in the element's own direction
          for (const Index e : topology->star(a)) {
            const auto c = topology->element(e);
            for (std::size_t m = 0; m < c.size(); ++m) {
              side = side || (c[m] == a && c[(m + 1) % c.size()] == b);
            }
          }
          CHECK(side);
        }
      }
      CHECK(outer == 1);
      std::size_t in_loops = 0;
      for (const auto& loop : topology->boundary_loops()) in_loops += loop.size();
      CHECK(in_loops ==
            static_cast<std::size_t>(topology->node_count()) - topology->interior_nodes().size());
    }
  }
}

TEST_CASE("the half-edge mesh says the same as the rows") {
  for (const MeshData& data : sample_meshes()) {
    const auto topology = Topology::build(data);
    const HalfEdgeMesh& mesh = topology->half_edges();
    CHECK(mesh.n_vertices() == at(topology->node_count()));
    CHECK(mesh.n_faces() == at(topology->element_count()));
    CHECK(mesh.n_edges() == topology->edges().size());
    for (Index f = 0; f < topology->face_count(); ++f) {
      const Topology::Edge& edge = topology->edges()[at(f)];
      const OpenMesh::HalfedgeHandle h = mesh.halfedge_handle(OpenMesh::EdgeHandle(f), 0);
      const OpenMesh::HalfedgeHandle back = mesh.opposite_halfedge_handle(h);
      CHECK(mesh.from_vertex_handle(h).idx() == edge.nodes[0]);
      CHECK(mesh.to_vertex_handle(h).idx() == edge.nodes[1]);
      std::array<Index, 2> beside{mesh.face_handle(h).idx(), mesh.face_handle(back).idx()};
      if (beside[0] != edge.elements[0]) std::swap(beside[0], beside[1]);
      CHECK(beside == edge.elements);
    }
    for (const OpenMesh::HalfedgeHandle h : mesh.halfedges()) {
      CHECK(mesh.prev_halfedge_handle(mesh.next_halfedge_handle(h)) == h);
      CHECK(mesh.to_vertex_handle(h) == mesh.from_vertex_handle(mesh.next_halfedge_handle(h)));
      CHECK(mesh.face_handle(h) == mesh.face_handle(mesh.next_halfedge_handle(h)));
    }
    for (Index i = 0; i < topology->node_count(); ++i) {
      const OpenMesh::VertexHandle v(i);
      const OpenMesh::HalfedgeHandle first = mesh.halfedge_handle(v);
      if (mesh.is_boundary(v)) {
        CHECK(mesh.is_boundary(first));
      } else {
        CHECK(mesh.to_vertex_handle(first).idx() == std::ranges::min(topology->neighbours(i)));
      }
      std::set<Index> ring;
      for (auto it = mesh.cvv_iter(v); it.is_valid(); ++it) ring.insert(it->idx());
      const auto row = topology->neighbours(i);
      CHECK(ring == std::set<Index>(row.begin(), row.end()));
      CHECK(mesh.is_boundary(v) == (topology->star(i).size() < row.size()));
    }
    for (Index e = 0; e < topology->element_count(); ++e) {
      std::vector<Index> corners;
      const OpenMesh::FaceHandle face(e);
      for (auto it = mesh.cfv_ccwiter(face); it.is_valid(); ++it) corners.push_back(it->idx());
      const auto expected = topology->element(e);
      const auto first = std::find(corners.begin(), corners.end(), expected[0]);
      REQUIRE(first != corners.end());
      std::rotate(corners.begin(), first, corners.end());
      CHECK(std::ranges::equal(corners, expected));
    }
  }
}

TEST_CASE("boundary nodes are constrained, the others are free, in ascending order") {
  const auto topology = Topology::build(square(3, Cells::quads));
  std::vector<Index> free;
  for (Index i = 0; i < topology->node_count(); ++i) {
    if (!topology->on_boundary(i)) free.push_back(i);
  }
  CHECK(free.size() == 4);
  CHECK(std::ranges::equal(free, topology->interior_nodes()));
  CHECK(std::is_sorted(free.begin(), free.end()));
}

TEST_CASE("a marker inside the mesh constrains its nodes") {
  MeshData data = square(4, Cells::quads);
  const auto before = Topology::build(data);
  const Index a = before->interior_nodes()[0];
  Index b = -1;
  for (const Index k : before->neighbours(a)) {
    if (!before->on_boundary(k)) b = k;
  }
  REQUIRE(b >= 0);
  data.markers.push_back({"membrane", 9, {{b, a}}});
  const auto topology = Topology::build(data);
  CHECK(topology->on_boundary(a));
  CHECK(topology->on_boundary(b));
  CHECK(topology->interior_nodes().size() == before->interior_nodes().size() - 2);
  CHECK(topology->neighbours(a).size() == topology->star(a).size());
  CHECK(topology->boundary_loops().size() == 1);
}

TEST_CASE("markers keep the order and the direction of the file") {
  MeshData data = square(3, Cells::triangles);
  data.markers[0].faces[0] = data.markers[0].faces[0].reversed();
  std::reverse(data.markers[1].faces.begin(), data.markers[1].faces.end());
  data.markers[2].tag = 42;
  const auto topology = Topology::build(data);
  CHECK(topology->markers().from_file());
  REQUIRE(topology->markers().size() == 4);
  for (std::size_t m = 0; m < 4; ++m) {
    CHECK(topology->markers()[m].name == data.markers[m].name);
    CHECK(topology->markers()[m].tag == data.markers[m].tag);
    CHECK(topology->markers()[m].faces == data.markers[m].faces);
    CHECK(topology->markers().find(data.markers[m].name) == static_cast<Index>(m));
    std::set<Index> nodes;
    for (const Face& edge : data.markers[m].faces) nodes.insert(edge.begin(), edge.end());
    CHECK(std::ranges::equal(nodes, topology->markers().nodes(static_cast<Index>(m))));
  }
  CHECK(topology->markers().unmarked_faces() == 0);
  CHECK_FALSE(topology->markers().find("lid").has_value());
}

TEST_CASE("nodes of several markers are joined, an unknown name is refused with the known ones") {
  const auto topology = Topology::build(square(3, Cells::quads));
  const std::vector<std::string> two{"bottom", "right"};
  const auto nodes = topology->markers().nodes_of(two);
  CHECK(nodes.size() == 7);
  CHECK(std::is_sorted(nodes.begin(), nodes.end()));
  const std::vector<std::string> wrong{"bottom", "lid"};
  CHECK_THROWS_WITH_AS(topology->markers().nodes_of(wrong),
                       "no marker named 'lid'; the mesh has: bottom, left, right, top", UsageError);
}

TEST_CASE("without markers each boundary loop becomes one") {
  MeshData data = square_with_two_holes(10, Cells::mixed);
  data.markers.clear();
  const auto topology = Topology::build(data);
  CHECK_FALSE(topology->markers().from_file());
  REQUIRE(topology->markers().size() == 3);
  for (std::size_t m = 0; m < 3; ++m) {
    CHECK(topology->markers()[m].name == "loop_" + std::to_string(m + 1));
    CHECK(topology->markers()[m].faces.size() == topology->boundary_loops()[m].size());
  }
  CHECK(topology->markers().unmarked_faces() == 0);
}

TEST_CASE("boundary edges without a marker are counted and still hold their nodes") {
  MeshData data = square(4, Cells::quads);
  data.markers.pop_back();
  const auto topology = Topology::build(data);
  CHECK(topology->markers().unmarked_faces() == 4);
  CHECK(topology->interior_nodes().size() == 9);
}

TEST_CASE("unused nodes have no neighbours and are not free") {
  MeshData data = square(3, Cells::triangles);
  const Index extra = data.node_count();
  data.coordinates.push_xy({7, 7});
  const auto topology = Topology::build(data);
  CHECK(topology->node_count() == extra + 1);
  CHECK_FALSE(topology->used(extra));
  CHECK(topology->used(0));
  CHECK(topology->neighbours(extra).empty());
  CHECK(topology->star(extra).empty());
  CHECK_FALSE(contains(topology->interior_nodes(), extra));
}

TEST_CASE("separate parts are oriented each by itself") {
  MeshData data = square(3, Cells::triangles);
  const MeshData other = square(2, Cells::quads);
  const Index shift = data.node_count();
  for (Index i = 0; i < other.node_count(); ++i) {
    data.coordinates.push_xy(other.coordinates.xy(i) + Vec2(3, 0));
  }
  for (Index e = 0; e < other.element_count(); ++e) {
    std::vector<Index> corners;
    for (const Index node : other.element(e)) corners.push_back(node + shift);
    std::reverse(corners.begin(), corners.end());
    data.add_element(ElementType::quadrilateral, corners);
  }
  const auto topology = Topology::build(data);
  CHECK(topology->reversed_elements() == other.element_count());
  CHECK(topology->boundary_loops().size() == 2);
  for (Index e = 0; e < topology->element_count(); ++e) {
    CHECK(twice_area(data.coordinates, topology->element(e)) > 0);
  }
}

TEST_CASE("regions of the file are kept") {
  MeshData data = square(2, Cells::quads);
  data.regions = {{"fluid", 5}, {"solid", 6}};
  data.element_region = {0, 1, -1, 0};
  const auto topology = Topology::build(data);
  CHECK(topology->regions().size() == 2);
  CHECK(topology->regions()[1].name == "solid");
  CHECK(std::ranges::equal(topology->element_regions(), data.element_region));
}
