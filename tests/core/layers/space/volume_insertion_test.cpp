#include "core/layers/space/volume_insertion.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "core/layers/space/volume_plan.h"
#include "core/mesh/surface_faces.h"
#include "support/walled_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

VolumeLayerInsertion inserted(const Mesh& mesh, const LayerOptions& options) {
  return insert_volume_layers(mesh, plan_volume_layers(mesh, options));
}

/// What every insertion must be: valid, conforming, of the volume before, with straight columns of
/// the planned heights in `ideal`.
void check_insertion(const Mesh& before, const VolumeLayerInsertion& layers) {
  const Topology& topology = *layers.mesh.topology;
  const Coordinates& x = layers.mesh.coordinates;
  CHECK(check_validity(topology, x).inverted == 0);
  CHECK(check_validity(*layers.outside, x).min_sine >=
        0.5 * check_validity(*before.topology, before.coordinates).min_sine);
  CHECK(total_volume(topology, x) ==
        doctest::Approx(total_volume(*before.topology, before.coordinates)).epsilon(1e-12));
  CHECK(topology.reversed_elements() == 0);
  std::vector<std::string> warnings;
  CHECK_NOTHROW(make_mesh(arrays_of(layers.mesh), &warnings));
  CHECK(warnings.empty());

  std::size_t nodes = 0;
  for (const LayerColumn& column : layers.stack.columns) {
    nodes += column.count();
    REQUIRE(column.nodes.size() == column.count() + 1);
    CHECK(column.nodes.front() == column.wall_node);
    double height = 0;
    for (std::size_t k = 0; k < column.count(); ++k) {
      height += column.heights[k];
      const Vec3 along =
          layers.ideal.xyz(column.nodes[k + 1]) - before.coordinates.xyz(column.wall_node);
      CHECK(along.norm() == doctest::Approx(height * column.slant));
      CHECK((along.normalized() - column.direction).norm() < 1e-6);
      const Vec3 now = x.xyz(column.nodes[k + 1]) - before.coordinates.xyz(column.wall_node);
      CHECK(now.norm() == doctest::Approx(layers.share * along.norm()));
    }
  }
  CHECK(at(x.size()) == at(before.coordinates.size()) + nodes);
  for (Index node = 0; node < before.coordinates.size(); ++node) {
    CHECK(x.same_place(node, before.coordinates));
    CHECK(layers.ideal.same_place(node, before.coordinates));
  }

  std::size_t cells = 0;
  for (const ColumnFace& face : layers.stack.faces)
    cells += layers.stack.columns[face.columns[0]].count();
  CHECK(at(topology.element_count()) == at(before.topology->element_count()) + cells);
  REQUIRE(layers.stack.layer_of_element.size() == at(topology.element_count()));
  for (Index e = 0; e < topology.element_count(); ++e) {
    const bool old = e < before.topology->element_count();
    CHECK((layers.stack.layer_of_element[at(e)] < 0) == old);
    if (old) CHECK(topology.element_type(e) == before.topology->element_type(e));
  }
  CHECK(layers.outside->element_count() == before.topology->element_count());
  CHECK(layers.outside->node_count() == topology.node_count());
  for (const LayerColumn& column : layers.stack.columns) {
    CHECK_FALSE(layers.outside->used(column.wall_node));
    CHECK(layers.outside->used(column.rim()));
    CHECK(layers.outside->on_boundary(column.rim()));
  }
  // The boundary of what is outside is closed: the mesh without its layers.
  CHECK(total_volume(*layers.outside, layers.ideal) < total_volume(topology, x));
}

}  // namespace

TEST_CASE("layers around a cube and a ball, in all elements") {
  const LayerSpacing spacing{.count = 5, .first = 2e-3, .ratio = 1.3};
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    for (const bool round : {false, true}) {
      const Mesh mesh = round ? ball_in_box(6, volumes) : make_mesh(cube_with_cavity(6, volumes));
      const auto layers = inserted(mesh, layers_on("cavity", spacing));
      check_insertion(mesh, layers);
      CHECK(layers.share > 0.01);
      CHECK(face_count_of(layers.mesh, "cavity") == face_count_of(mesh, "cavity"));
      CHECK(face_count_of(layers.mesh, "outer") == face_count_of(mesh, "outer"));
      for (Index e = mesh.topology->element_count(); e < layers.mesh.topology->element_count();
           ++e) {
        const ElementType type = layers.mesh.topology->element_type(e);
        if (volumes == Volumes::tetrahedra) CHECK(type == ElementType::prism);
        if (volumes == Volumes::hexahedra) CHECK(type == ElementType::hexahedron);
      }
    }
  }
}

TEST_CASE("layers of a body on one and two planes of symmetry lie in the planes") {
  const LayerSpacing spacing{.count = 4, .first = 2e-3, .ratio = 1.4};
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::hexahedra}) {
    const Mesh half = half_ball_on_floor(6, volumes);
    const auto layers = inserted(half, layers_on("body", spacing));
    check_insertion(half, layers);
    CHECK(face_count_of(layers.mesh, "floor") == face_count_of(half, "floor") + 8 * 4);
    for (const Index node :
         layers.mesh.topology->markers().nodes(*layers.mesh.topology->markers().find("floor"))) {
      CHECK(std::abs(layers.mesh.coordinates.xyz(node).z()) < 1e-15);
      CHECK(std::abs(layers.ideal.xyz(node).z()) < 1e-15);
    }
    const Mesh corner = make_mesh(box_with_body_on_two_planes(6, volumes));
    const auto both = inserted(corner, layers_on("body", spacing));
    check_insertion(corner, both);
    CHECK(face_count_of(both.mesh, "floor") > face_count_of(corner, "floor"));
    CHECK(face_count_of(both.mesh, "side") > face_count_of(corner, "side"));
    CHECK(face_count_of(both.mesh, "far") == face_count_of(corner, "far"));
  }
}

TEST_CASE("layers on the floor of a box end at its sides, and on all its sides at once") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(cube(4, volumes));
    const auto floor =
        inserted(mesh, layers_on("floor", {.count = 3, .first = 5e-3, .ratio = 1.5}));
    check_insertion(mesh, floor);
    CHECK(face_count_of(floor.mesh, "walls") == face_count_of(mesh, "walls") + 16 * 3);
    LayerOptions all = layers_on("floor", {.count = 3, .first = 5e-3, .ratio = 1.5});
    all.walls[0].markers = {"floor", "lid", "walls"};
    check_insertion(mesh, inserted(mesh, all));
  }
}

TEST_CASE("two walls with spacings of their own") {
  const Mesh mesh = make_mesh(cube_with_cavity(6, Volumes::tetrahedra));
  LayerOptions options;
  options.walls = {{{"cavity"}, {.count = 5, .first = 1e-3, .ratio = 1.3}},
                   {{"outer"}, {.count = 3, .first = 4e-3, .ratio = 1.3}}};
  const auto layers = inserted(mesh, options);
  check_insertion(mesh, layers);
  for (const LayerColumn& column : layers.stack.columns)
    CHECK(column.count() == (column.wall == 0 ? 5u : 3u));
}

TEST_CASE("the gap between a slab and the floor takes layers on both sides") {
  const Mesh mesh = box_with_slab(8, 1, 3, Volumes::tetrahedra);
  LayerOptions options = layers_on("body", {.count = 6, .first = 2e-3, .ratio = 1.6});
  options.walls[0].markers = {"body", "outer"};
  check_insertion(mesh, inserted(mesh, options));
}

TEST_CASE("first heights of a millionth start valid") {
  const Mesh mesh = ball_in_box(6, Volumes::tetrahedra);
  const auto layers =
      inserted(mesh, layers_on("cavity", {.count = 30, .first = 1e-6, .ratio = 1.3}));
  check_insertion(mesh, layers);
}

TEST_CASE("regions and markers inside the mesh go on through the layers") {
  MeshData data = cube(4, Volumes::hexahedra);
  data.regions = {{"left", 1}, {"right", 2}};
  Marker between{"between", 7, {}};
  for (Index e = 0; e < data.element_count(); ++e) {
    double middle = 0;
    for (const Index node : data.element(e)) middle += data.coordinates.xyz(node).x() / 8;
    data.element_region.push_back(middle < 0.5 ? 0 : 1);
    if (middle > 0.5) continue;
    for (const Face& face : faces_of(data, e)) {
      if (std::ranges::all_of(face, [&](Index node) {
            return std::abs(data.coordinates.xyz(node).x() - 0.5) < 1e-9;
          }))
        between.faces.push_back(face);
    }
  }
  data.markers.push_back(between);
  const Mesh mesh = make_mesh(data);
  const auto layers = inserted(mesh, layers_on("floor", {.count = 3, .first = 5e-3, .ratio = 1.5}));
  check_insertion(mesh, layers);
  CHECK(face_count_of(layers.mesh, "between") == face_count_of(mesh, "between") + 4 * 3);
  const Topology& topology = *layers.mesh.topology;
  CHECK(topology.interfaces().empty());  // all faces between the regions are of the marker
  for (Index e = 0; e < topology.element_count(); ++e) {
    double middle = 0;
    for (const Index node : topology.element(e))
      middle += layers.mesh.coordinates.xyz(node).x() / 8;
    CHECK(topology.element_regions()[at(e)] == (middle < 0.5 ? 0 : 1));
  }
}

TEST_CASE("meshes may be numbered in any order, with elements turned and faces seen from inside") {
  Random random(3);
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    MeshData data = shuffled_volume(cube(4, volumes), random, true);
    for (Marker& marker : data.markers) {
      if (marker.name == "floor")
        for (Face& face : marker.faces) face = face.reversed();
    }
    const Mesh mesh = make_mesh(data);
    check_insertion(mesh, inserted(mesh, layers_on("floor", {.count = 3, .first = 5e-3})));
  }
}

TEST_CASE("sides of layers are turned as the faces of their marker, and cover what these leave") {
  const Mesh mesh = half_ball_on_floor(6, Volumes::mixed);
  const auto layers = inserted(mesh, layers_on("body", {.count = 4, .first = 4e-3, .ratio = 1.4}));
  const auto area = [](const Mesh& of, const Coordinates& x, const std::string& name) {
    const SpacePoints points(x);
    Vec3 sum(0, 0, 0);
    double size = 0;
    const Markers& markers = of.topology->markers();
    for (const Face& face : markers[at(*markers.find(name))].faces) {
      sum += area_vector(points, face);
      size += area_vector(points, face).norm();
    }
    CHECK(sum.norm() == doctest::Approx(size));  // none is turned the other way
    return sum;
  };
  const Vec3 before = area(mesh, mesh.coordinates, "floor");
  CHECK((area(layers.mesh, layers.mesh.coordinates, "floor") - before).norm() < 1e-12);
}

TEST_CASE("polyhedra away from the wall stay as they are") {
  const MeshData cubes = cube(4, Volumes::hexahedra);
  MeshData data;
  data.coordinates = cubes.coordinates;
  data.markers = cubes.markers;
  for (Index e = 0; e < cubes.element_count(); ++e) {
    if (cubes.coordinates.xyz(cubes.element(e)[0]).z() < 0.4)
      data.add_element(ElementType::hexahedron, cubes.element(e));
    else
      data.add_polyhedron(cubes.element(e), faces_of(cubes, e));
  }
  const Mesh mesh = make_mesh(data);
  check_insertion(mesh, inserted(mesh, layers_on("floor", {.count = 3, .first = 5e-3})));
}

TEST_CASE("beside a curved boundary the layers divide its edges") {
  MeshData data = cube(6, Volumes::hexahedra);
  for (Index node = 0; node < data.node_count(); ++node) {
    Vec3 p = data.coordinates.xyz(node);
    p.x() = 0.5 + (p.x() - 0.5) * (1 + 0.4 * p.z() * p.z() + 0.3 * p.y() * (1 - p.y()));
    data.coordinates.set_xyz(node, p);
  }
  const Mesh mesh = make_mesh(data);
  const auto layers = inserted(mesh, layers_on("floor", {.count = 5, .first = 0.01, .ratio = 1.6}));
  check_insertion(mesh, layers);
  int ends = 0;
  for (const LayerColumn& column : layers.stack.columns) {
    if (column.limit != LayerLimit::end) continue;
    ++ends;
    const double length = column.thickness() * column.slant;
    bool found = false;
    for (const Index other : mesh.topology->neighbours(column.wall_node)) {
      const Vec3 edge = mesh.coordinates.xyz(other) - mesh.coordinates.xyz(column.wall_node);
      found |= (edge - edge.norm() * column.direction).norm() < 1e-12 &&
               length <= 0.6 * edge.norm() * (1 + 1e-9);
    }
    CHECK(found);
  }
  CHECK(ends > 0);
}

TEST_CASE("what layers cannot be inserted into is refused") {
  Mesh mesh = make_mesh(cube(4, Volumes::tetrahedra));
  const auto options = layers_on("floor", {.count = 3, .first = 5e-3, .ratio = 1.5});
  LayerStack plan = plan_volume_layers(mesh, options);
  LayerStack uneven = plan;
  uneven.columns[3].heights.pop_back();
  CHECK_THROWS_WITH_AS(insert_volume_layers(mesh, uneven),
                       doctest::Contains("has another number of layers"), UsageError);
  LayerStack empty = plan;
  for (LayerColumn& column : empty.columns) column.heights.clear();
  CHECK_THROWS_WITH_AS(insert_volume_layers(mesh, empty),
                       doctest::Contains("there is no room for layers"), UsageError);
  const Index node = mesh.topology->interior_nodes()[0];
  mesh.coordinates.set_xyz(node, mesh.coordinates.xyz(node) + Vec3(0, 0, 3));
  CHECK_THROWS_WITH_AS(insert_volume_layers(mesh, plan),
                       doctest::Contains("elements of the mesh are inverted"), UsageError);
  CHECK_THROWS_AS(insert_volume_layers(make_mesh(square_with_hole(8, Cells::triangles)), plan),
                  UsageError);
}
