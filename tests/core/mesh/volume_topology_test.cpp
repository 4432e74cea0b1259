#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

#include "core/error.h"
#include "core/mesh/mesh.h"
#include "core/mesh/topology.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

struct Sample {
  std::string name;
  MeshData data;
};

std::vector<Sample> samples() {
  std::vector<Sample> all;
  for (const Volumes volumes : all_volumes) {
    all.push_back({std::string("cube of ") + name_of(volumes), cube(4, volumes)});
    if (volumes == Volumes::mixed) continue;
    all.push_back({std::string("cavity in ") + name_of(volumes), cube_with_cavity(3, volumes)});
  }
  return all;
}

/// Volume as the sum of tetrahedra from the middle of the element to its faces, which are flat.
double volume(const MeshData& data, ElementType type, std::span<const Index> corners) {
  const Coordinates& x = data.coordinates;
  Vec3 middle(0, 0, 0);
  for (const Index node : corners) middle += x.xyz(node) / static_cast<double>(corners.size());
  double sum = 0;
  for (const Face& local : shape_of(type).faces) {
    const Face face = by_nodes(local, corners);
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
      const Vec3 a = x.xyz(face[0]) - middle, b = x.xyz(face[k]) - middle,
                 c = x.xyz(face[k + 1]) - middle;
      sum += a.dot(b.cross(c)) / 6;
    }
  }
  return sum;
}

/// The elements that have each face, by its sorted nodes.
std::map<Face, std::vector<Index>> faces_by_brute_force(const MeshData& data) {
  std::map<Face, std::vector<Index>> faces;
  for (Index e = 0; e < data.element_count(); ++e) {
    for (const Face& face : faces_of(data, e)) faces[face.sorted()].push_back(e);
  }
  return faces;
}

std::vector<Index> stars_by_brute_force(const MeshData& data, Index node) {
  std::vector<Index> star;
  for (Index e = 0; e < data.element_count(); ++e) {
    const auto c = data.element(e);
    if (std::find(c.begin(), c.end(), node) != c.end()) star.push_back(e);
  }
  return star;
}

std::set<Index> neighbours_by_brute_force(const MeshData& data, Index node) {
  std::set<Index> found;
  for (Index e = 0; e < data.element_count(); ++e) {
    const auto c = data.element(e);
    for (const auto& [a, b] : shape_of(data.types[at(e)]).edges) {
      if (c[at(a)] == node) found.insert(c[at(b)]);
      if (c[at(b)] == node) found.insert(c[at(a)]);
    }
  }
  return found;
}

/// Solid angle of a triangle seen from the origin (A. van Oosterom and J. Strackee, The Solid Angle
/// of a Plane Triangle, IEEE Trans. Biomed. Eng. 30, 1983).
double seen_angle(Vec3 a, Vec3 b, Vec3 c) {
  a.normalize();
  b.normalize();
  c.normalize();
  return 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

/// Sides of the unit cube that a point lies on.
int sides(const Vec3& p) {
  int count = 0;
  for (int k = 0; k < 3; ++k) count += p[k] == 0 || p[k] == 1 ? 1 : 0;
  return count;
}

}  // namespace

TEST_CASE("good volume meshes pass without a warning and keep their arrays") {
  for (const Sample& sample : samples()) {
    CAPTURE(sample.name);
    const MeshData& data = sample.data;
    std::vector<std::string> warnings;
    const Mesh mesh = make_mesh(data, &warnings);
    CHECK(warnings.empty());
    CHECK(mesh.coordinates == data.coordinates);
    const Topology& t = *mesh.topology;
    CHECK(t.cell_dimension() == 3);
    CHECK(t.space_dimension() == 3);
    CHECK(mesh_kind(t) == "volume mesh");
    CHECK(t.elements().values == data.element_nodes);
    CHECK(t.reversed_elements() == 0);
    double total = 0;
    for (Index e = 0; e < t.element_count(); ++e) {
      CHECK(t.element_type(e) == data.types[at(e)]);
      total += volume(data, t.element_type(e), t.element(e));
    }
    const bool cavity = sample.name.starts_with("cavity");
    CHECK(total == doctest::Approx(cavity ? 26 / 27.0 : 1).epsilon(1e-12));
  }
}

TEST_CASE("the mixed cube has all four volume elements") {
  const MeshData data = cube(4, Volumes::mixed);
  const std::set<ElementType> types(data.types.begin(), data.types.end());
  CHECK(types == std::set<ElementType>{ElementType::tetrahedron, ElementType::pyramid,
                                       ElementType::prism, ElementType::hexahedron});
}

TEST_CASE("elements that the file holds mirrored are turned, and keep their first node") {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    CAPTURE(seed);
    Random random(seed);
    for (const Sample& sample : samples()) {
      CAPTURE(sample.name);
      const MeshData& original = sample.data;
      const MeshData data = shuffled_volume(original, random, true);
      std::vector<std::string> warnings;
      const Mesh mesh = make_mesh(data, &warnings);
      Index mirrored = 0;
      for (Index e = 0; e < data.element_count(); ++e) {
        const auto corners = mesh.topology->element(e);
        CHECK(volume(data, data.types[at(e)], corners) > 0);
        CHECK(corners[0] == data.element(e)[0]);
        mirrored += volume(data, data.types[at(e)], data.element(e)) < 0 ? 1 : 0;
      }
      CHECK(mesh.topology->reversed_elements() == mirrored);
      REQUIRE(warnings.size() == 1);
      CHECK(warnings[0] ==
            std::to_string(mirrored) + " elements with mirrored corners were turned inside out");
    }
  }
}

TEST_CASE("a tangled volume mesh is oriented as its boundary says") {
  for (const std::uint64_t seed : {11u, 12u}) {
    CAPTURE(seed);
    for (const Sample& sample : samples()) {
      CAPTURE(sample.name);
      const MeshData& original = sample.data;
      const Mesh mesh = make_mesh(original);
      MeshData tangled = original;
      Random random(seed);
      for (const Index node : mesh.topology->interior_nodes()) {
        tangled.coordinates.set_xyz(node, {random.uniform(), random.uniform(), random.uniform()});
      }
      Random one(seed), same(seed);
      const auto a = Topology::build(shuffled_volume(tangled, one, true));
      const auto b = Topology::build(shuffled_volume(original, same, true));
      CHECK(a->elements().values == b->elements().values);
    }
  }
}

TEST_CASE("separate volumes are oriented each by itself") {
  MeshData data = cube(2, Volumes::tetrahedra);
  const MeshData other = cube(1, Volumes::hexahedra);
  const Index shift = data.node_count();
  const Index last = data.element_count();
  for (Index i = 0; i < other.node_count(); ++i) {
    data.coordinates.push_xyz(other.coordinates.xyz(i) + Vec3(3, 0, 0));
  }
  std::vector<Index> corners;
  for (const Index k : shape_of(ElementType::hexahedron).mirrored) {
    corners.push_back(other.element(0)[at(k)] + shift);
  }
  data.add_element(ElementType::hexahedron, corners);
  const auto topology = Topology::build(data);
  CHECK(topology->reversed_elements() == 1);
  CHECK(volume(data, ElementType::hexahedron, topology->element(last)) == doctest::Approx(1));
}

TEST_CASE("every face is there once, with the elements beside it, seen from outside the first") {
  for (const std::uint64_t seed : {21u, 22u}) {
    CAPTURE(seed);
    Random random(seed);
    for (const Sample& sample : samples()) {
      CAPTURE(sample.name);
      const MeshData& original = sample.data;
      const MeshData data = shuffled_volume(original, random, true);
      const auto topology = Topology::build(data);
      auto expected = faces_by_brute_force(data);
      CHECK(topology->face_count() == static_cast<Index>(expected.size()));
      Face before;
      for (Index f = 0; f < topology->face_count(); ++f) {
        const Topology::SharedFace face = topology->face(f);
        const auto key = face.nodes.sorted();
        CHECK(before < key);
        before = key;
        std::vector<Index> beside(face.elements.begin(), face.elements.end());
        if (beside[1] < 0) beside.pop_back();
        std::sort(beside.begin(), beside.end());
        CHECK(beside == expected[key]);
        // As the first element has it once it is oriented.
        const Index e = face.elements[0];
        bool own = false;
        for (const Face& local : topology->shape(e).faces) {
          Face turned = by_nodes(local, topology->element(e));
          for (std::size_t k = 0; k < turned.size(); ++k) {
            own = own || turned == face.nodes;
            turned = turned.size() == 3 ? Face(turned[1], turned[2], turned[0])
                                        : Face(turned[1], turned[2], turned[3], turned[0]);
          }
        }
        CHECK(own);
        CHECK(topology->find_face(face.nodes) == f);
        CHECK(topology->find_face(face.nodes.reversed()) == f);
      }
      CHECK_FALSE(topology->find_face(Face(0, 1, data.node_count())).has_value());
      CHECK_FALSE(topology->find_face(Face(-2, 0, 1)).has_value());
      CHECK_FALSE(topology->find_face(Face(0, 1)).has_value());
    }
  }
}

TEST_CASE("stars and neighbours are those of a search through all elements, ascending") {
  Random random(31);
  for (const Sample& sample : samples()) {
    CAPTURE(sample.name);
    const MeshData& original = sample.data;
    const MeshData data = shuffled_volume(original, random, true);
    const auto topology = Topology::build(data);
    for (Index i = 0; i < topology->node_count(); ++i) {
      CHECK(std::ranges::equal(topology->star(i), stars_by_brute_force(data, i)));
      CHECK(std::ranges::equal(topology->neighbours(i), neighbours_by_brute_force(data, i)));
    }
  }
}

TEST_CASE("faces, stars and neighbours of meshes that several threads go through in blocks") {
  Random random(32);
  for (const Volumes volumes : {Volumes::mixed, Volumes::tetrahedra}) {
    CAPTURE(name_of(volumes));
    const MeshData data = shuffled_volume(cube(18, volumes), random, true);
    REQUIRE(data.node_count() > 4096);  // blocks of parallel loops
    const auto topology = Topology::build(data);
    const auto expected = faces_by_brute_force(data);
    REQUIRE(topology->face_count() == static_cast<Index>(expected.size()));
    Index f = 0;
    for (const auto& [nodes, elements] : expected) {
      const Topology::SharedFace face = topology->face(f++);
      REQUIRE(face.nodes.sorted() == nodes);
      const std::vector<Index> beside(face.elements.begin(),
                                      face.elements.begin() + (face.elements[1] < 0 ? 1 : 2));
      REQUIRE(std::ranges::is_permutation(beside, elements));
    }
    std::vector<std::set<Index>> stars(at(data.node_count())), neighbours(stars.size());
    for (Index e = 0; e < data.element_count(); ++e) {
      const auto corners = data.element(e);
      for (const Index node : corners) stars[at(node)].insert(e);
      for (const auto& [a, b] : shape_of(data.types[at(e)]).edges) {
        neighbours[at(corners[at(a)])].insert(corners[at(b)]);
        neighbours[at(corners[at(b)])].insert(corners[at(a)]);
      }
    }
    for (Index node = 0; node < data.node_count(); ++node) {
      REQUIRE(std::ranges::equal(topology->star(node), stars[at(node)]));
      REQUIRE(std::ranges::equal(topology->neighbours(node), neighbours[at(node)]));
    }
  }
}

TEST_CASE("links close around interior nodes and are discs on the boundary") {
  Random random(41);
  for (const Sample& sample : samples()) {
    CAPTURE(sample.name);
    const MeshData& original = sample.data;
    const MeshData data = shuffled_volume(original, random, true);
    const auto topology = Topology::build(data);
    for (Index i = 0; i < topology->node_count(); ++i) {
      const std::vector<Face> link = node_link(*topology, i);
      REQUIRE(link.size() == topology->star(i).size());
      std::map<std::pair<Index, Index>, int> directed;
      std::set<Index> corners;
      for (std::size_t k = 0; k < link.size(); ++k) {
        const auto element = topology->element(topology->star(i)[k]);
        for (std::size_t m = 0; m < link[k].size(); ++m) {
          CHECK(std::find(element.begin(), element.end(), link[k][m]) != element.end());
          ++directed[{link[k][m], link[k][(m + 1) % link[k].size()]}];
          corners.insert(link[k][m]);
        }
      }
      CHECK(std::ranges::equal(corners, topology->neighbours(i)));
      int edges = 0, open = 0;
      for (const auto& [edge, count] : directed) {
        CHECK(count == 1);
        const bool paired = directed.contains({edge.second, edge.first});
        edges += paired ? 1 : 2;  // halves
        open += paired ? 0 : 1;
      }
      const int characteristic =
          static_cast<int>(corners.size()) - edges / 2 + static_cast<int>(link.size());
      CHECK((open == 0) == !topology->on_boundary(i));
      CHECK(characteristic == (open == 0 ? 2 : 1));
    }
  }
}

TEST_CASE("the polygons of a link fill the solid angle that the node sees of the mesh") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const MeshData data = cube(4, volumes);
    const auto topology = Topology::build(data);
    for (Index i = 0; i < topology->node_count(); ++i) {
      const Vec3 p = data.coordinates.xyz(i);
      double angle = 0;
      for (const Face& face : node_link(*topology, i)) {
        for (std::size_t k = 1; k + 1 < face.size(); ++k) {
          angle += seen_angle(data.coordinates.xyz(face[0]) - p, data.coordinates.xyz(face[k]) - p,
                              data.coordinates.xyz(face[k + 1]) - p);
        }
      }
      CHECK(angle == doctest::Approx(4 * pi / (1 << sides(p))));
    }
  }
}

TEST_CASE("nodes on the boundary of a volume are constrained, the others free") {
  for (const Volumes volumes : all_volumes) {
    const MeshData data = cube(4, volumes);
    const auto topology = Topology::build(data);
    for (Index i = 0; i < topology->node_count(); ++i) {
      CHECK(topology->on_boundary(i) == (sides(data.coordinates.xyz(i)) > 0));
    }
  }
}

TEST_CASE("markers of a volume mesh keep faces, order and direction") {
  MeshData data = cube(3, Volumes::prisms);
  data.markers[0].faces[0] = data.markers[0].faces[0].reversed();
  std::reverse(data.markers[1].faces.begin(), data.markers[1].faces.end());
  const auto topology = Topology::build(data);
  CHECK(topology->markers().from_file());
  REQUIRE(topology->markers().size() == 3);
  for (std::size_t m = 0; m < 3; ++m) {
    CHECK(topology->markers()[m].faces == data.markers[m].faces);
    std::set<Index> nodes;
    for (const Face& face : data.markers[m].faces) nodes.insert(face.begin(), face.end());
    CHECK(std::ranges::equal(nodes, topology->markers().nodes(static_cast<Index>(m))));
  }
  CHECK(topology->markers().unmarked_faces() == 0);
  data.markers.pop_back();
  std::vector<std::string> warnings;
  CHECK(make_mesh(data, &warnings).topology->markers().unmarked_faces() > 0);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("boundary faces belong to no marker") != std::string::npos);
}

TEST_CASE("a marker on faces inside a volume mesh constrains their nodes") {
  MeshData data = cube(4, Volumes::hexahedra);
  const auto before = Topology::build(data);
  Index inside = -1;
  for (Index f = 0; f < before->face_count() && inside < 0; ++f) {
    const auto nodes = before->face(f).nodes;
    if (std::ranges::none_of(nodes, [&](Index i) { return before->on_boundary(i); })) inside = f;
  }
  REQUIRE(inside >= 0);
  const Face membrane = before->face(inside).nodes;
  data.markers.push_back({"membrane", 9, {membrane}});
  const auto topology = Topology::build(data);
  for (const Index node : membrane) CHECK(topology->on_boundary(node));
  CHECK(topology->interior_nodes().size() == before->interior_nodes().size() - 4);
}

TEST_CASE("without markers each connected surface of the boundary becomes one") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::hexahedra}) {
    MeshData data = cube_with_cavity(3, volumes);
    std::set<std::set<Face>> expected;
    for (const Marker& marker : data.markers) {
      std::set<Face> faces;
      for (const Face& face : marker.faces) faces.insert(face.sorted());
      expected.insert(faces);
    }
    data.markers.clear();
    const auto topology = Topology::build(data);
    CHECK_FALSE(topology->markers().from_file());
    REQUIRE(topology->markers().size() == 2);
    std::set<std::set<Face>> found;
    for (std::size_t m = 0; m < 2; ++m) {
      CHECK(topology->markers()[m].name == "boundary_" + std::to_string(m + 1));
      std::set<Face> faces;
      for (const Face& face : topology->markers()[m].faces) faces.insert(face.sorted());
      found.insert(faces);
    }
    CHECK(found == expected);
    CHECK(topology->markers().unmarked_faces() == 0);
  }
}

TEST_CASE("unused nodes of a volume mesh are a warning, wherever they lie") {
  MeshData data = cube(2, Volumes::pyramids);
  data.coordinates.push_xyz({0, 0, 0});
  std::vector<std::string> warnings;
  const Mesh mesh = make_mesh(data, &warnings);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("1 nodes belong to no element") != std::string::npos);
  CHECK_FALSE(mesh.topology->used(data.node_count() - 1));
  CHECK(node_link(*mesh.topology, data.node_count() - 1).empty());
}

TEST_CASE("what is made for plane and surface meshes refuses a volume mesh") {
  const Mesh mesh = make_mesh(cube(2, Volumes::tetrahedra));
  CHECK_THROWS_AS(mesh.topology->edges(), UsageError);
  CHECK_THROWS_AS(mesh.topology->boundary_loops(), UsageError);
  CHECK_THROWS_AS(mesh.topology->half_edges(), UsageError);
  CHECK_THROWS_AS(bounds(mesh), UsageError);
  CHECK_THROWS_WITH_AS(require_plane(*mesh.topology, "layers"),
                       "layers: only for a plane mesh, and this is a volume mesh", UsageError);
}
