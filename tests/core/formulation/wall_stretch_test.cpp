#include "core/formulation/wall_stretch.h"

#include <doctest/doctest.h>

#include "core/command/command.h"
#include "core/quality/wall_measures.h"
#include "support/formulations.h"
#include "support/layered_meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

Coordinates mapped(Coordinates x, const std::function<Vec3(const Vec3&)>& map) {
  for (Index node = 0; node < x.size(); ++node) x.set_place(node, map(place_of(x, node)));
  return x;
}

/// Moves nodes of a marker as a map says.
DeformCommand deformed(const Mesh& mesh, const std::string& marker,
                       const std::function<Vec3(const Vec3&)>& map) {
  DisplacementTable table;
  const std::vector<std::string> markers{marker};
  for (const Index node : mesh.topology->markers().nodes_of(markers)) {
    const Vec3 p = place_of(mesh.coordinates, node), by = map(p) - p;
    table.entries.push_back({node, {}, {by.x(), by.y(), by.z()}, 0});
  }
  DeformCommand deform;
  deform.markers = markers;
  deform.shape = table;
  return deform;
}

/// Stretches the floor of the unit cube within its outline.
Vec3 stretched_floor(const Vec3& p) {
  return {p.x() + 0.03 * std::sin(2 * pi * p.x()), p.y() - 0.03 * std::sin(2 * pi * p.y()), p.z()};
}

/// The largest change of the first height over the floor of a layered cube, as a share.
double change_over_floor(const Mesh& mesh, const Coordinates& x) {
  double largest = 0;
  for (const Index node : mesh.topology->interior_nodes())
    if (std::abs(mesh.coordinates.xyz(node).z() - 0.01) < 1e-9)
      largest = std::max(largest, std::abs(x.xyz(node).z() / 0.01 - 1));
  return largest;
}

double change_of_first_heights(const Mesh& mesh, const Coordinates& x) {
  const Mesh now{mesh.topology, x};
  const auto walls = find_walls(mesh);
  REQUIRE(walls.size() == 1);
  const auto before = first_heights(mesh, walls[0]), after = first_heights(now, walls[0]);
  double largest = 0;
  for (std::size_t k = 0; k < before.size(); ++k)
    largest = std::max(largest, std::abs(after[k] / before[k] - 1));
  return largest;
}

}  // namespace

TEST_CASE("A wall that only turns and moves does not stretch") {
  const Mesh plane = make_mesh(o_grid(24, distances(6, 0.01, 1.5, 6), Cut::none, 0.3));
  const Mesh space = layered_cube(Volumes::mixed);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3::UnitZ()).toRotationMatrix();
  const auto rigid = [&](const Vec3& p) { return Vec3(turn * p + Vec3(3, -2, 0)); };
  for (const Mesh& mesh : {plane, space}) {
    const auto classes = free_interior(mesh.topology);
    CHECK(!WallStretch::find(*classes, mesh.coordinates, mesh.coordinates));
    CHECK(!WallStretch::find(*classes, mesh.coordinates, mapped(mesh.coordinates, rigid)));
  }
}

TEST_CASE("Elements in layers stretch with their wall, and others do not") {
  const auto stretch = [](const Vec3& p) { return Vec3(1.5 * p.x(), 0.8 * p.y(), p.z()); };
  for (const Volumes volumes : all_volumes) {
    CAPTURE(std::string(name_of(volumes)));
    const Mesh mesh = layered_cube(volumes);
    const auto found = WallStretch::find(*free_interior(mesh.topology), mesh.coordinates,
                                         mapped(mesh.coordinates, stretch));
    REQUIRE(found);
    Index low = 0, high = 0;
    for (Index e = 0; e < mesh.topology->element_count(); ++e) {
      Vec3 least = Vec3::Constant(1), most = Vec3::Zero();
      for (const Index node : mesh.topology->element(e)) {
        least = least.cwiseMin(mesh.coordinates.xyz(node));
        most = most.cwiseMax(mesh.coordinates.xyz(node));
      }
      const Eigen::Matrix3d* map = found->map_of(e);
      const bool central = least.head<2>().minCoeff() > 0.37 && most.head<2>().maxCoeff() < 0.63;
      const bool inside = least.head<2>().minCoeff() > 0.2 && most.head<2>().maxCoeff() < 0.8;
      if (inside && most.z() < 0.02) {  // flat, away from the other walls
        REQUIRE(map);
        CHECK((*map - Vec3(1.5, 0.8, 1).asDiagonal().toDenseMatrix()).norm() < 1e-12);
        ++low;
      } else if (mesh.topology->element_type(e) != ElementType::pyramid && central &&
                 least.z() > 0.26 && most.z() < 0.44) {
        // Higher than wide. (The pyramids on the floor of a cube are half as high as the cube.)
        CHECK(!map);
        ++high;
      }
    }
    CHECK(low > 0);
    CHECK((high > 0) == (volumes != Volumes::pyramids));
  }
}

namespace {

/// Whether two stretches are the same, bit for bit.
bool same_maps(const Topology& topology, const WallStretch* a, const WallStretch* b) {
  if (!a || !b) return a == b;
  for (Index e = 0; e < topology.element_count(); ++e) {
    const Eigen::Matrix3d *of_a = a->map_of(e), *of_b = b->map_of(e);
    if (!of_a != !of_b || (of_a && *of_a != *of_b)) return false;
    if (a->stiffness_of(e) != b->stiffness_of(e)) return false;
  }
  return a->elements() == b->elements();
}

}  // namespace

TEST_CASE("Layers that are kept for many motions stretch as those that are found for one") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(std::string(name_of(volumes)));
    const Mesh mesh = layered_cube(volumes);
    const Topology& topology = *mesh.topology;
    const auto classes = free_interior(mesh.topology);
    const WallLayers layers(classes, std::make_shared<const Coordinates>(mesh.coordinates));
    const std::vector<std::string> floor{"floor"};
    std::vector<double> factors(at(topology.node_count()), 0.0);
    for (const LayerEdge& edge : layer_edges(mesh, topology.markers().nodes_of(floor)))
      factors[at(edge.upper)] = 1.1;
    Index with_map = 0;
    for (const double x : {1.0, 1.3, 0.7, 1.0, 1.1, 0.0}) {
      const Coordinates moved = mapped(mesh.coordinates, [&](const Vec3& p) {
        return Vec3(x * p.x() + 0.1 * p.y(), p.y() + 0.2 * p.x() * p.x() * (x - 1), p.z());
      });
      for (const auto& of_heights : {std::vector<double>(), factors}) {
        const auto kept = layers.stretched(moved, of_heights);
        const auto found = WallStretch::find(*classes, mesh.coordinates, moved, of_heights);
        CHECK(same_maps(topology, kept.get(), found.get()));
        if (kept) with_map += static_cast<Index>(kept->elements().size());
      }
    }
    CHECK(with_map > 0);
  }
}

TEST_CASE("Under an edge of a wall in space, as in a fan, only the edge stretches") {
  // Two walls, z = 0, y < 0 and y = 0, z < 0, meet at the edge y = z = 0. The first two tetrahedra
  // stand on the walls, the last one on the edge.
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, -1, 0), Vec3(0.5, 0, -1),
                        Vec3(0.5, 0.01, 0.06), Vec3(0.5, 0.06, 0.01)})
    data.coordinates.push_xyz(p);
  add_cell(data, ElementType::tetrahedron, {0, 1, 2, 4});
  add_cell(data, ElementType::tetrahedron, {0, 3, 1, 5});
  add_cell(data, ElementType::tetrahedron, {0, 5, 1, 4});
  mark_volume(data, [](const Vec3&) { return "all"; });
  Mesh mesh = make_mesh(data);
  NodeClasses classes(mesh.topology);
  classes.set_free(std::array<Index, 2>{4, 5});
  const auto found =
      WallStretch::find(classes, mesh.coordinates, mapped(mesh.coordinates, [](const Vec3& p) {
                          return Vec3(1.4 * p.x(), 3 * p.y(), 2 * p.z());
                        }));
  REQUIRE(found);
  const std::array<Vec3, 3> expected{Vec3(1.4, 3, 1), Vec3(1.4, 1, 2), Vec3(1.4, 1, 1)};
  for (Index e = 0; e < 3; ++e) {
    REQUIRE(found->map_of(e));
    CAPTURE(e);
    CHECK((*found->map_of(e) - expected[at(e)].asDiagonal().toDenseMatrix()).norm() < 1e-12);
  }
}

TEST_CASE("First heights in space do not depend on how far a wall is stretched") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(std::string(name_of(volumes)));
    const Mesh mesh = layered_cube(volumes);
    DeformCommand deform = deformed(mesh, "floor", stretched_floor);
    const CommandResult result = execute(deform, make_state(mesh));
    REQUIRE(result.smooth.converged);
    CHECK(result.smooth.inverted == 0);
    // Shapes of tetrahedra whose walls stretch differently fit together less well.
    const double most = volumes == Volumes::tetrahedra ? 0.04 : 0.02;
    CHECK(change_over_floor(mesh, result.state.mesh.coordinates) < most);
    // The shapes alone would scale heights with the wall.
    deform.smooth.targets = {.rest = 1};
    const CommandResult shapes = execute(deform, make_state(mesh));
    CHECK(change_over_floor(mesh, shapes.state.mesh.coordinates) > 0.07);
  }
}

TEST_CASE("First heights in the plane do not depend on how far a wall is stretched") {
  for (const Cut cut : {Cut::none, Cut::forward, Cut::backward, Cut::alternating}) {
    for (const double factor : {0.5, 1.4, 2.0}) {
      CAPTURE(std::string(name_of(cut)));
      CAPTURE(factor);
      const Mesh mesh = make_mesh(o_grid(48, distances(24, 0.005, 1.25, 24), cut));
      const DeformCommand deform =
          deformed(mesh, "wall", [&](const Vec3& p) { return Vec3(factor * p.x(), p.y(), p.z()); });
      const CommandResult result = execute(deform, make_state(mesh));
      REQUIRE(result.smooth.converged);
      CHECK(result.smooth.inverted == 0);
      CHECK(change_of_first_heights(mesh, result.state.mesh.coordinates) < 0.02);
    }
  }
}

TEST_CASE("Where a motion ends early, heights are those for the walls as far as they came") {
  const Mesh mesh = make_mesh(o_grid(48, distances(24, 0.005, 1.25, 24), Cut::none));
  const auto far_out = [](const Vec3& p) { return Vec3(9 * p.x(), p.y(), p.z()); };
  const CommandResult result = execute(deformed(mesh, "wall", far_out), make_state(mesh));
  CHECK(result.smooth.inverted == 0);
  REQUIRE(result.smooth.fraction_reached > 0.2);
  REQUIRE(result.smooth.fraction_reached < 0.7);
  const auto walls = find_walls(mesh);
  const auto before = first_heights(mesh, walls[0]);
  auto ratios = first_heights({mesh.topology, result.state.mesh.coordinates}, walls[0]);
  for (std::size_t k = 0; k < ratios.size(); ++k) ratios[k] /= before[k];
  // With the targets for the end of the motion it would be about half.
  CHECK(quantiles_of(ratios).median == doctest::Approx(1).epsilon(0.05));
}

TEST_CASE("A wall that is stretched and goes back leaves the mesh as it was") {
  const Mesh mesh = make_mesh(o_grid(48, distances(20, 0.01, 1.25, 20), Cut::forward));
  const auto stretch = [](const Vec3& p) { return Vec3(1.3 * p.x(), p.y(), p.z()); };
  const auto back = [](const Vec3& p) { return Vec3(p.x() / 1.3, p.y(), p.z()); };
  const MeshState there = execute(deformed(mesh, "wall", stretch), make_state(mesh)).state;
  const MeshState again = execute(deformed(there.mesh, "wall", back), there).state;
  CHECK(largest_difference(again.mesh.coordinates, mesh.coordinates) < 1e-8);
}
