#include "core/geometry/periodic_pairs.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "core/strategy/slide_options.h"
#include "support/periodic_meshes.h"
#include "support/space_meshes.h"

namespace winslow::test {

TEST_CASE("sides that a translation takes to one another are paired, their ends left out") {
  const Mesh mesh = make_mesh(square(6, Cells::triangles));
  const auto found = PeriodicPairs::find(*mesh.topology, mesh.coordinates, "left", "right");
  CHECK(found.description == "translation by (1, 0)");
  REQUIRE(found.pairs.size() == 5);
  for (const auto& [node, image] : found.pairs) {
    const Vec2 p = mesh.coordinates.xy(node), q = mesh.coordinates.xy(image);
    CHECK(p.x() == 0);
    CHECK((q - p - Vec2(1, 0)).norm() < 1e-15);
  }
}

TEST_CASE("sides that a rotation takes to one another are paired") {
  for (const double angle : {20.0, 90.0, 120.0}) {
    CAPTURE(angle);
    const Mesh mesh = make_mesh(sector(angle, 6, 5, {3, -2}));
    const auto found = PeriodicPairs::find(*mesh.topology, mesh.coordinates, "begin", "end");
    CHECK(found.description == "rotation by " + number_text(angle) + " degrees");
    CHECK(found.pairs.size() == 4);
    for (const auto& [node, image] : found.pairs) {
      const Vec2 p = mesh.coordinates.xy(node), q = mesh.coordinates.xy(image);
      const Vec3 mapped = found.image.of({p.x(), p.y(), 0});
      CHECK((mapped.head<2>() - q).norm() < 1e-13);
      CHECK(mapped.z() == 0);
    }
  }
}

TEST_CASE("sides of volume meshes are paired, by translation and by rotation about an axis") {
  MeshData data = cube(3, Volumes::tetrahedra);
  data.markers.clear();
  mark_volume(data, [](const Vec3& p) {
    return p.x() < 1e-9 ? "first" : p.x() > 1 - 1e-9 ? "second" : "rest";
  });
  const Mesh box = make_mesh(data);
  const auto shifted = PeriodicPairs::find(*box.topology, box.coordinates, "first", "second");
  CHECK(shifted.description == "translation by (1, 0, 0)");
  CHECK(shifted.pairs.size() == 4);
  // The same box bent round the z axis.
  for (Index node = 0; node < data.coordinates.size(); ++node) {
    const Vec3 p = data.coordinates.xyz(node);
    const double phi = radians(30 * p.x()), r = 1 + p.y();
    data.coordinates.set_xyz(node, {r * std::cos(phi), r * std::sin(phi), p.z()});
  }
  const Mesh bent = make_mesh(data);
  const auto turned = PeriodicPairs::find(*bent.topology, bent.coordinates, "first", "second");
  CHECK(turned.description == "rotation by 30 degrees");
  CHECK(turned.pairs.size() == 4);
}

TEST_CASE("sides that do not match are refused, and the pair that does not is named") {
  MeshData data = square(6, Cells::triangles);
  for (Index node = 0; node < data.coordinates.size(); ++node) {
    const Vec2 p = data.coordinates.xy(node);
    if (p.x() > 1 - 1e-9 && std::abs(p.y() - 0.5) < 1e-9)
      data.coordinates.set_xy(node, p + Vec2(0, 0.05));
  }
  const Mesh mesh = make_mesh(data);
  const auto pair = [&](const std::string& a, const std::string& b) {
    return PeriodicPairs::find(*mesh.topology, mesh.coordinates, a, b);
  };
  CHECK_THROWS_WITH_AS(pair("left", "right"), doctest::Contains("at (0, 0.5)"), UsageError);
  CHECK_THROWS_WITH_AS(pair("left", "left"), doctest::Contains("twice"), UsageError);
  CHECK_THROWS_WITH_AS(pair("left", "lid"), doctest::Contains("lid"), UsageError);
  const Mesh other = make_mesh(square_with_hole(10, Cells::triangles));
  CHECK_THROWS_WITH_AS(PeriodicPairs::find(*other.topology, other.coordinates, "outer", "hole"),
                       doctest::Contains("40 and 8 nodes"), UsageError);
}

namespace {

/// The pairs that are found by place, as a file would list them, ends included.
GivenPairs listed(const Mesh& mesh, const std::string& first, const std::string& second,
                  const RigidImage& image) {
  GivenPairs given{first, second, {}, {}};
  const std::vector<std::string> one{first}, other{second};
  for (const Index a : mesh.topology->markers().nodes_of(one)) {
    for (const Index b : mesh.topology->markers().nodes_of(other)) {
      const auto place = [&](Index node) {
        if (mesh.coordinates.dimension() == 3) return mesh.coordinates.xyz(node);
        return Vec3(mesh.coordinates.xy(node).x(), mesh.coordinates.xy(node).y(), 0);
      };
      if ((image.of(place(a)) - place(b)).norm() < 1e-9) given.pairs.push_back({a, b});
    }
  }
  return given;
}

std::string refusal(const Mesh& mesh, const GivenPairs& given) {
  try {
    PeriodicPairs::of(*mesh.topology, mesh.coordinates, given);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("pairs of a file give what is found by place") {
  const Mesh mesh = make_mesh(sector(50, 6, 5, {3, -2}));
  const auto by_place = PeriodicPairs::find(*mesh.topology, mesh.coordinates, "begin", "end");
  const GivenPairs given = listed(mesh, "begin", "end", by_place.image);
  CHECK(given.pairs.size() == 6);
  const auto of_file = PeriodicPairs::of(*mesh.topology, mesh.coordinates, given);
  CHECK(of_file.pairs == by_place.pairs);
  CHECK(of_file.description == "rotation by 50 degrees");
  CHECK((of_file.image.offset - by_place.image.offset).norm() < 1e-12);
  CHECK(of_file.deviation < 1e-14);
}

TEST_CASE("pairs of a file may be turned about any axis, which place alone does not find") {
  MeshData data = cube(3, Volumes::tetrahedra);
  data.markers.clear();
  mark_volume(data, [](const Vec3& p) {
    return p.x() < 1e-9 ? "first" : p.x() > 1 - 1e-9 ? "second" : "rest";
  });
  for (Index node = 0; node < data.coordinates.size(); ++node) {
    const Vec3 p = data.coordinates.xyz(node);
    const double phi = radians(30 * p.x()), r = 1 + p.y();
    data.coordinates.set_xyz(node, {r * std::cos(phi) + 4, r * std::sin(phi), p.z()});
  }
  const Mesh mesh = make_mesh(data);
  CHECK_THROWS_AS(PeriodicPairs::find(*mesh.topology, mesh.coordinates, "first", "second"),
                  UsageError);
  RigidImage turn;
  const double c = std::cos(radians(30)), s = std::sin(radians(30));
  turn.rotation << c, -s, 0, s, c, 0, 0, 0, 1;
  turn.offset = Vec3(4, 0, 0) - turn.rotation * Vec3(4, 0, 0);
  const GivenPairs given = listed(mesh, "first", "second", turn);
  REQUIRE(given.pairs.size() == 16);
  const auto pairs = PeriodicPairs::of(*mesh.topology, mesh.coordinates, given);
  CHECK(pairs.description == "rotation by 30 degrees");
  CHECK(pairs.pairs.size() == 4);
  CHECK((pairs.image.rotation - turn.rotation).norm() < 1e-12);
}

TEST_CASE("pairs of a file that no image fits are refused, and the first one is named") {
  const Mesh mesh = make_mesh(square(4, Cells::triangles));
  RigidImage right;
  right.offset = {1, 0, 0};
  GivenPairs given = listed(mesh, "left", "right", right);
  REQUIRE(given.pairs.size() == 5);
  std::swap(given.pairs[1].image, given.pairs[2].image);
  CHECK(refusal(mesh, given).find("is paired with node") != std::string::npos);
  given = listed(mesh, "left", "right", right);
  given.pairs[0].image = mesh.topology->node_count();
  CHECK(refusal(mesh, given) ==
        "the markers \"left\" and \"right\" are not periodic: there is no node 25");
  given.fault = "a.msh:7: found this, expected that";
  CHECK(refusal(mesh, given) == given.fault);
  given = listed(mesh, "left", "right", right);
  given.second = "nowhere";
  CHECK(refusal(mesh, given).find("nowhere") != std::string::npos);
}

TEST_CASE("held nodes of a file's pairs and those on other markers stay") {
  const Mesh mesh = make_mesh(square(4, Cells::triangles));
  RigidImage right;
  right.offset = {1, 0, 0};
  GivenPairs given = listed(mesh, "left", "right", right);
  given.held = {given.pairs[2].node};
  CHECK(PeriodicPairs::of(*mesh.topology, mesh.coordinates, given).pairs.size() == 2);
}

TEST_CASE("where a periodic side meets a boundary in no marker its nodes stay") {
  MeshData data = square(4, Cells::triangles);
  std::erase_if(data.markers, [](const Marker& m) { return m.name == "top"; });
  const Mesh mesh = make_mesh(data);
  RigidImage right;
  right.offset = {1, 0, 0};
  GivenPairs given = listed(mesh, "left", "right", right);
  const auto by_place = PeriodicPairs::find(*mesh.topology, mesh.coordinates, "left", "right");
  CHECK(by_place.pairs.size() == 3);
  CHECK(PeriodicPairs::of(*mesh.topology, mesh.coordinates, given).pairs == by_place.pairs);
  given.halo = true;  // whose last row is such a boundary
  CHECK(PeriodicPairs::of(*mesh.topology, mesh.coordinates, given).pairs.size() == 4);
}

TEST_CASE("pairs of the file are taken where they are wanted, named ones once") {
  const Mesh mesh = make_mesh(square(4, Cells::triangles));
  RigidImage right;
  right.offset = {1, 0, 0};
  auto file = std::make_shared<GivenPeriodicity>();
  file->source = "a.msh";
  file->nodes = mesh.topology->node_count();
  file->elements = mesh.topology->element_count();
  SlideOptions slide;
  SlideFiles files{.periodic = file};
  const auto taken = [&] {
    NodeClasses classes(mesh.topology);
    return make_boundary_move({slide, files}, mesh, {}, classes).periodic.size();
  };
  const auto refused = [&] {
    try {
      taken();
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(taken() == 0);
  slide.periodic_from_file = true;
  CHECK(refused().starts_with("a.msh: found no periodic pairs in the file, expected $Periodic"));
  file->pairs.push_back(listed(mesh, "left", "right", right));
  CHECK(taken() == 1);
  slide.periodic = {"right", "left"};
  CHECK(taken() == 1);
  slide.periodic = {"bottom", "top"};
  CHECK(taken() == 2);
  slide.periodic.clear();
  // The file was of another mesh, before layers: by the names of the markers.
  file->nodes = 7;
  file->pairs[0].pairs.clear();
  CHECK(taken() == 1);
  file->pairs[0].halo = true;
  CHECK(taken() == 0);
  files.periodic = nullptr;
  CHECK(refused() == "slide.periodic_from_file: the file of the mesh was not read");
  file->pairs[0].halo = false;
  files.periodic = file;
  slide.markers = {"left"};
  CHECK(refused() == "marker \"left\" is to slide and to be periodic: expected one");
}

}  // namespace winslow::test
