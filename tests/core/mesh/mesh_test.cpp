#include "core/mesh/mesh.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "core/error.h"
#include "core/mesh/topology.h"
#include "support/coordinate.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

bool says(const std::string& message, const std::string& text) {
  return message.find(text) != std::string::npos;
}

}  // namespace

TEST_CASE("good meshes pass without a warning") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    for (const MeshData& data :
         {square(4, cells), annulus(9, 3, 1.5, cells), square_with_two_holes(10, cells)}) {
      std::vector<std::string> warnings;
      const Mesh mesh = make_mesh(data, &warnings);
      CHECK(warnings.empty());
      CHECK(mesh.coordinates == data.coordinates);
      CHECK(check_validity(*mesh.topology, mesh.coordinates).inverted == 0);
    }
  }
}

TEST_CASE("a coordinate that is not finite is refused") {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    for (const int component : {0, 1}) {
      MeshData data = square(2, Cells::quads);
      coordinate(data.coordinates, 3, component) = bad;
      const MeshError error = refusal(data);
      CHECK(error.entity() == MeshEntity::node);
      CHECK(error.index() == 3);
    }
  }
}

TEST_CASE("an element without area is refused") {
  SUBCASE("triangle") {
    MeshData data;
    for (const Vec2& p : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2(0.5, 0.5)}) {
      data.coordinates.push_xy(p);
    }
    add_triangle(data, 0, 1, 2);
    add_triangle(data, 1, 3, 2);
    const MeshError error = refusal(data);
    CHECK(error.entity() == MeshEntity::element);
    CHECK(error.index() == 1);
    CHECK(says(error.what(), "no area"));
  }
  SUBCASE("quadrilateral") {
    MeshData data;
    for (const Vec2& p : {Vec2(0, 0), Vec2(1, 0), Vec2(2, 0), Vec2(3, 0)}) {
      data.coordinates.push_xy(p);
    }
    add_quad(data, 0, 1, 2, 3);
    CHECK(refusal(data).index() == 0);
  }
}

TEST_CASE("thin elements have an area: they pass") {
  MeshData data = square(3, Cells::triangles);
  for (Index i = 0; i < data.node_count(); ++i) {
    coordinate(data.coordinates, i, 1) *= 1e-9;
  }
  CHECK_NOTHROW(make_mesh(data));
}

TEST_CASE("two nodes in one place are refused") {
  MeshData data = square(3, Cells::quads);
  const auto topology = Topology::build(data);
  data.coordinates.set_xy(topology->interior_nodes()[1],
                          data.coordinates.xy(topology->interior_nodes()[0]));
  const MeshError error = refusal(data);
  CHECK(error.entity() == MeshEntity::node);
  CHECK(says(error.what(), "duplicate"));
}

TEST_CASE("the two sides of a crack are a mesh, corners of an element in one place are not") {
  // Two rows of four squares. Of the line between them the middle node is double, 7 below and 15
  // above, so that the line is open from node 6 to node 8.
  MeshData data;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 5; ++i) data.coordinates.push_xy(Vec2(i, j));
  }
  data.coordinates.push_xy(Vec2(2, 1));
  const auto upper = [](Index node) { return node == 7 ? Index{15} : node; };
  for (Index i = 0; i < 4; ++i) {
    add_quad(data, i, i + 1, i + 6, i + 5);
    add_quad(data, upper(i + 5), upper(i + 6), i + 11, i + 10);
  }
  std::vector<std::string> warnings;
  const Mesh mesh = make_mesh(data, &warnings);
  CHECK(mesh.topology->on_boundary(15));
  REQUIRE(!warnings.empty());
  CHECK(says(warnings.back(), "1 boundary nodes lie where others do: a crack or a baffle"));

  data.coordinates.set_xy(15, data.coordinates.xy(12));
  CHECK(says(refusal(data).what(), "node 15 lies exactly where node 12 does (duplicate node)"));
}

TEST_CASE("an unused node may lie on a used one: it is only a warning") {
  MeshData data = square(3, Cells::quads);
  data.coordinates.push_xy(data.coordinates.xy(0));
  std::vector<std::string> warnings;
  make_mesh(data, &warnings);
  REQUIRE(warnings.size() == 1);
  CHECK(says(warnings[0], "1 nodes belong to no element"));
}

TEST_CASE("a hanging node is refused") {
  // Two columns of quads; the middle of the right column is cut in half and the left one is not,
  // so that node 9 hangs on the edge between nodes 4 and 7.
  MeshData data;
  const std::array<Vec2, 14> p{Vec2(0, -1),  Vec2(1, -1), Vec2(2, -1), Vec2(0, 0), Vec2(1, 0),
                               Vec2(2, 0),   Vec2(0, 1),  Vec2(1, 1),  Vec2(2, 1), Vec2(1, 0.5),
                               Vec2(2, 0.5), Vec2(0, 2),  Vec2(1, 2),  Vec2(2, 2)};
  for (const Vec2& q : p) data.coordinates.push_xy(q);
  add_quad(data, 0, 1, 4, 3);
  add_quad(data, 1, 2, 5, 4);
  add_quad(data, 3, 4, 7, 6);
  add_quad(data, 4, 5, 10, 9);
  add_quad(data, 9, 10, 8, 7);
  add_quad(data, 6, 7, 12, 11);
  add_quad(data, 7, 8, 13, 12);
  const MeshError error = refusal(data);
  CHECK(error.entity() == MeshEntity::node);
  CHECK(error.index() == 9);
  CHECK(says(error.what(), "hanging"));
}

TEST_CASE("an element that shares no edge is refused, a single element is a mesh") {
  MeshData data = square(2, Cells::quads);
  const Index o = data.node_count();
  for (const Vec2& q : {Vec2(5, 5), Vec2(6, 5), Vec2(5, 6)}) data.coordinates.push_xy(q);
  add_triangle(data, o, o + 1, o + 2);
  const MeshError error = refusal(data);
  CHECK(error.entity() == MeshEntity::element);
  CHECK(error.index() == 4);
  CHECK(says(error.what(), "isolated"));

  CHECK_NOTHROW(make_mesh(square(1, Cells::quads)));
}

TEST_CASE("harmless faults are warnings, one sentence each") {
  MeshData data = square(3, Cells::quads);
  data.coordinates.push_xy({9, 9});
  data.markers.erase(data.markers.begin());
  std::swap(data.element_nodes[1], data.element_nodes[3]);
  std::vector<std::string> warnings;
  const Mesh mesh = make_mesh(data, &warnings);
  REQUIRE(warnings.size() == 3);
  CHECK(says(warnings[0], "1 nodes belong to no element"));
  CHECK(says(warnings[1], "3 boundary edges belong to no marker"));
  CHECK(says(warnings[2], "1 clockwise elements"));
  CHECK(mesh.topology->node_count() == 17);
}

TEST_CASE("an inverted element is no error") {
  MeshData data = square(3, Cells::quads);
  const auto topology = Topology::build(data);
  data.coordinates.set_xy(topology->interior_nodes()[0], {0.9, 0.95});
  const Mesh mesh = make_mesh(data);
  CHECK(check_validity(*mesh.topology, mesh.coordinates).inverted > 0);
}

TEST_CASE("bounds cover the used nodes and no others") {
  MeshData data = square(3, Cells::triangles);
  data.coordinates.push_xy({50, -70});
  const Mesh mesh = make_mesh(data);
  const Bounds box = bounds(mesh);
  CHECK(box.min == Vec2(0, 0));
  CHECK(box.max == Vec2(1, 1));
  CHECK(box.centre() == Vec2(0.5, 0.5));
  CHECK(box.size() == Vec2(1, 1));
  const std::vector<std::string> top{"top"};
  CHECK(bounds(mesh.coordinates, mesh.topology->markers().nodes_of(top)).min == Vec2(0, 1));
  CHECK_THROWS_AS(bounds(mesh.coordinates, {}), UsageError);
}

TEST_CASE("interfaces are the faces between regions that belong to no marker") {
  const auto by_columns = [](MeshData data, const std::vector<Index>& regions) {
    data.regions = {{"left", 1}, {"right", 2}};
    for (Index e = 0; e < data.element_count(); ++e) {
      double x = 0;
      const auto nodes = data.element(e);
      for (const Index i : nodes) x += place_of(data.coordinates, i).x();
      const double share = x / static_cast<double>(nodes.size());
      data.element_region.push_back(
          regions[static_cast<std::size_t>(share * static_cast<double>(regions.size()))]);
    }
    return data;
  };
  MeshData space = by_columns(cube(4, Volumes::hexahedra), {0, 1});
  const auto topology = Topology::build(space);
  REQUIRE(topology->interfaces().size() == 1);
  const RegionInterface& meeting = topology->interfaces()[0];
  CHECK(meeting.regions == std::array<Index, 2>{0, 1});
  CHECK(topology->name_of(meeting) == "left and right");
  CHECK(meeting.faces.size() == 16);
  CHECK(meeting.nodes.size() == 25);
  CHECK(interface_nodes_inside(*topology).size() == 9);
  for (const Face& face : meeting.faces) CHECK(topology->find_face(face));
  space.markers.push_back({"baffle", 9, meeting.faces});
  CHECK(Topology::build(space)->interfaces().empty());

  const auto plane = Topology::build(by_columns(square(4, Cells::quads), {0, -1, 1, 0}));
  REQUIRE(plane->interfaces().size() == 3);
  CHECK(plane->name_of(plane->interfaces()[0]) == "left and right");
  CHECK(plane->name_of(plane->interfaces()[1]) == "left and no region");
  CHECK(plane->name_of(plane->interfaces()[2]) == "right and no region");
  for (const RegionInterface& each : plane->interfaces()) CHECK(each.faces.size() == 4);

  const MeshData one = by_columns(cube(4, Volumes::hexahedra), {0});
  CHECK(Topology::build(one)->interfaces().empty());
  CHECK(Topology::build(cube(4, Volumes::hexahedra))->interfaces().empty());
  std::vector<std::string> warnings;
  make_mesh(space, &warnings);
  CHECK(warnings.empty());
}

TEST_CASE("markers with others behind them") {
  const Mesh mesh = make_mesh(square(3, Cells::quads));
  const Markers& markers = mesh.topology->markers();
  const std::vector<Marker> more{{"inside", 7, {Face(5, 6), Face(6, 10)}}};
  const Markers all = markers.with(more);
  REQUIRE(all.size() == markers.size() + 1);
  const Index last = *all.find("inside");
  CHECK(last == static_cast<Index>(markers.size()));
  CHECK(std::ranges::equal(all.nodes(last), std::vector<Index>{5, 6, 10}));
  for (Index m = 0; m < last; ++m) CHECK(std::ranges::equal(all.nodes(m), markers.nodes(m)));
}

namespace winslow::test {

namespace {

Mesh shifted(MeshData data, const Vec2& by) {
  for (Index i = 0; i < data.node_count(); ++i)
    data.coordinates.set_xy(i, data.coordinates.xy(i) + by);
  return make_mesh(data);
}

}  // namespace

TEST_CASE("a mesh near the origin is its own frame") {
  for (const Vec2& by : {Vec2(0, 0), Vec2(-0.5, -0.5), Vec2(15, -12)}) {
    const LocalFrame frame(shifted(square(4, Cells::quads), by));
    CHECK_FALSE(frame.shifts());
    CHECK(frame.origin() == Vec3(0, 0, 0));
  }
}

TEST_CASE("far from the origin nodes go to the frame exactly and come back bit by bit") {
  for (const Vec2& by : {Vec2(1e7, -3e7), Vec2(-20, 17), Vec2(123456.789, 0.25), Vec2(0, 1e15)}) {
    MeshData data = square(8, Cells::triangles);
    if (by.norm() > 1e14)
      for (double& value : data.coordinates.values()) value *= 1024;  // apart at that distance
    const Mesh mesh = shifted(data, by);
    const LocalFrame frame(mesh);
    REQUIRE(frame.shifts());
    CHECK(bounds(frame.to_local(mesh)).max.cwiseAbs().maxCoeff() < 16.1 * 1024);
    for (Index i = 0; i < mesh.coordinates.size(); ++i) {
      const Vec2 p = mesh.coordinates.xy(i);
      CHECK(frame.to_mesh(frame.to_local(p)) == p);
    }
    CHECK(frame.to_mesh(frame.to_local(mesh.coordinates), mesh.coordinates) == mesh.coordinates);
  }
}

TEST_CASE("axes along which a mesh is near 0 are left alone") {
  const LocalFrame frame(shifted(square(4, Cells::quads), Vec2(1e7, 0.1)));
  CHECK(frame.origin().x() == 1e7 + 0.5);
  CHECK(frame.origin().y() == 0);
}

TEST_CASE("nodes of no element come back bit by bit, wherever they are") {
  MeshData data = square(4, Cells::quads);
  for (double& value : data.coordinates.values()) value += 1e7;
  data.coordinates.push_xy(Vec2(0.1, 1e-30));
  const Mesh mesh = make_mesh(data);
  const LocalFrame frame(mesh);
  REQUIRE(frame.shifts());
  Coordinates x = frame.to_local(mesh.coordinates);
  x.set_xy(0, x.xy(0) + Vec2(0.5, 0));
  x.push_xy(Vec2(0, 0));  // layers add nodes
  const Coordinates back = frame.to_mesh(x, mesh.coordinates);
  CHECK(back.xy(0) == mesh.coordinates.xy(0) + Vec2(0.5, 0));
  for (Index i = 1; i < mesh.coordinates.size(); ++i) CHECK(back.xy(i) == mesh.coordinates.xy(i));
  CHECK(back.xy(back.size() - 1) == frame.origin().head<2>());
}

TEST_CASE("the frame of a volume mesh has three axes, of which each may be far from 0 alone") {
  for (const Vec3& by :
       {Vec3(4.5e5, 5.1e6, 300), Vec3(0, 0, 1e7), Vec3(0.25, -20, 0), Vec3(-1e6, 0, 0.125)}) {
    CAPTURE(by.transpose());
    MeshData data = cube(3, Volumes::mixed);
    for (Index i = 0; i < data.node_count(); ++i)
      data.coordinates.set_xyz(i, data.coordinates.xyz(i) + by);
    const Mesh mesh = make_mesh(data);
    const LocalFrame frame(mesh);
    REQUIRE(frame.shifts());
    for (const int axis : {0, 1, 2}) {
      const double middle = space_bounds(mesh).centre()[axis];
      CHECK(frame.origin()[axis] == (std::abs(by[axis]) > 16 ? middle : 0));
    }
    const Coordinates local = frame.to_local(mesh.coordinates);
    for (Index i = 0; i < local.size(); ++i) {
      const Vec3 p = mesh.coordinates.xyz(i);
      CHECK(local.xyz(i) == p - frame.origin());
      CHECK(frame.to_mesh(frame.to_local(p)) == p);
    }
    CHECK(frame.to_mesh(local, mesh.coordinates) == mesh.coordinates);
  }
  CHECK_FALSE(LocalFrame(make_mesh(cube(3, Volumes::mixed))).shifts());
}

}  // namespace winslow::test
