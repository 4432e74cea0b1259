#include "io/support/samples.h"

#ifdef WINSLOW_HAS_CGNS

#include <array>
#include <functional>
#include <map>

#include "io/cgns/cgns.h"
#include "io/cgns/library_file.h"
#include "support/periodic_meshes.h"

/// Connections of a zone to itself with Periodic_t.
namespace winslow::test {
namespace {

constexpr Index cells = 10;
using Vector = std::array<float, 3>;

/// The numbers of the nodes of a marker, sorted along an axis, from 1 on.
CgnsNumbers vertices_along(const MeshData& data, const std::string& name, int axis) {
  std::map<double, cgsize_t> sorted;
  for (const Marker& marker : data.markers)
    if (marker.name == name)
      for (const Face& face : marker.faces)
        for (const Index node : face) sorted[data.coordinates.xy(node)[axis]] = node + 1;
  CgnsNumbers numbers;
  for (const auto& [place, node] : sorted) numbers.push_back(node);
  return numbers;
}

void connect(const LibraryFile& file, const char* name, GridLocation_t location,
             const CgnsNumbers& own, const CgnsNumbers& donor, const Vector& translation,
             const Vector& angle = {}) {
  int number = 0;
  require_cgns(cg_conn_write(file.file, file.base, file.zone, name, location, Abutting1to1,
                             PointList, static_cast<cgsize_t>(own.size()), own.data(), "Zone",
                             Unstructured, PointListDonor, DataTypeNull,
                             static_cast<cgsize_t>(donor.size()), donor.data(), &number));
  const Vector centre{};
  require_cgns(cg_conn_periodic_write(file.file, file.base, file.zone, number, centre.data(),
                                      angle.data(), translation.data()));
}

/// A square whose sides left and right are periodic, by vertices or by their edges.
void write_passage(const std::filesystem::path& path, int container, bool by_edges,
                   float sign = 1) {
  const MeshData data = square_with_periodic_sides(cells);
  LibraryFile file(path, container);
  file.start_zone("Zone", data.node_count(), data.element_count());
  file.coordinates(data.coordinates);
  write_mixed(file, data);
  std::map<std::string, CgnsNumbers> edges;
  for (const Marker& marker : data.markers) {
    edges[marker.name] = cgns_range(file.next, static_cast<cgsize_t>(marker.faces.size()));
    file.lines(marker.name.c_str(), marker.faces);
    file.condition(marker.name.c_str(), BCTypeNull, PointList, edges[marker.name], EdgeCenter);
  }
  const CgnsNumbers left = by_edges ? edges["left"] : vertices_along(data, "left", 1),
                    right = by_edges ? edges["right"] : vertices_along(data, "right", 1);
  const GridLocation_t location = by_edges ? FaceCenter : Vertex;
  connect(file, "there", location, left, right, {sign, 0, 0});
  connect(file, "back", location, right, left, {-sign, 0, 0});
}

void check_passage(const io::MeshFile& file) {
  CHECK_FALSE(any_contains(file.warnings, "periodic"));
  REQUIRE(file.details->periodic);
  REQUIRE(file.details->periodic->pairs.size() == 1);
  const GivenPairs& given = file.details->periodic->pairs.front();
  CHECK(given.fault.empty());
  CHECK(given.first == "left");
  CHECK(given.second == "right");
  CHECK(given.pairs.size() == cells + 1);
  for (const PeriodicPair& pair : given.pairs)
    CHECK((file.mesh.coordinates.xy(pair.image) - file.mesh.coordinates.xy(pair.node) - Vec2(1, 0))
              .norm() < 1e-14);
}

}  // namespace

TEST_CASE("CGNS: periodic connections by vertices and by edges are pairs of the file") {
  const TemporaryFolder folder;
  for (const int container : {CG_FILE_HDF5, CG_FILE_ADF})
    for (const bool by_edges : {false, true}) {
      CAPTURE(container);
      CAPTURE(by_edges);
      write_passage(folder / "a.cgns", container, by_edges);
      check_passage(io::read_mesh(folder / "a.cgns"));
    }
  // A program that counts the translation from the other side.
  write_passage(folder / "b.cgns", CG_FILE_HDF5, true, -1);
  check_passage(io::read_mesh(folder / "b.cgns"));
}

TEST_CASE("CGNS: the connection goes back into the file, with a warning if pairs came apart") {
  const TemporaryFolder folder;
  write_passage(folder / "a.cgns", CG_FILE_HDF5, false);
  io::MeshFile file = io::read_mesh(folder / "a.cgns");
  CHECK_FALSE(
      any_contains(io::write_mesh(folder / "b.cgns", file.mesh, file.details.get()), "periodic"));
  check_passage(io::read_mesh(folder / "b.cgns"));
  // As $Periodic into a file of Gmsh, and lost in a new file of CGNS with a warning.
  CHECK_FALSE(
      any_contains(io::write_mesh(folder / "c.msh", file.mesh, file.details.get()), "periodic"));
  const io::MeshFile gmsh = io::read_mesh(folder / "c.msh");
  REQUIRE(gmsh.details->periodic->pairs.size() == 1);
  CHECK(gmsh.details->periodic->pairs[0].pairs.size() == cells + 1);
  CHECK(any_contains(io::write_mesh(folder / "d.cgns", gmsh.mesh, gmsh.details.get()),
                     "are not written"));
  const Index node = file.details->periodic->pairs[0].pairs[2].node;
  file.mesh.coordinates.set_xy(node, file.mesh.coordinates.xy(node) + Vec2(0, 0.02));
  CHECK(any_contains(io::write_mesh(folder / "e.cgns", file.mesh, file.details.get()),
                     "no longer match"));
}

TEST_CASE("CGNS: a structured zone whose sides are periodic one to one") {
  const TemporaryFolder folder;
  constexpr Index ni = 5, nj = 4;
  std::vector<double> x, y;
  for (Index j = 0; j < nj; ++j)
    for (Index i = 0; i < ni; ++i) {
      x.push_back(i + 0.1 * j * j);
      y.push_back(j);
    }
  {
    LibraryFile file(folder / "a.cgns", CG_FILE_HDF5);
    file.start_structured_zone("Zone", ni, nj);
    file.coordinate("CoordinateX", x);
    file.coordinate("CoordinateY", y);
    file.condition("in", BCInflow, PointRange, {1, 1, 1, nj}, GridLocationNull, nullptr, 2);
    file.condition("out", BCOutflow, PointRange, {ni, 1, ni, nj}, GridLocationNull, nullptr, 2);
    const CgnsNumbers range{1, 1, 1, nj}, donor{ni, 1, ni, nj};
    const std::array<int, 2> transform{1, 2};
    int number = 0;
    require_cgns(cg_1to1_write(file.file, file.base, file.zone, "per", "Zone", range.data(),
                               donor.data(), transform.data(), &number));
    const Vector zero{}, translation{4, 0, 0};
    require_cgns(cg_1to1_periodic_write(file.file, file.base, file.zone, number, zero.data(),
                                        zero.data(), translation.data()));
  }
  const io::MeshFile file = io::read_mesh(folder / "a.cgns");
  CHECK(file.mesh.topology->node_count() == ni * nj);  // the sides stay two
  REQUIRE(file.details->periodic->pairs.size() == 1);
  const GivenPairs& given = file.details->periodic->pairs.front();
  CHECK(given.first == "in");
  CHECK(given.second == "out");
  REQUIRE(given.pairs.size() == nj);
  for (const PeriodicPair& pair : given.pairs) CHECK(pair.image - pair.node == ni - 1);
}

TEST_CASE("CGNS: what cannot be used of periodic connections is said, damage is refused") {
  const TemporaryFolder folder;
  const MeshData data = square_with_periodic_sides(cells);
  const auto write = [&](const std::function<void(const LibraryFile&)>& connections) {
    LibraryFile file(folder / "a.cgns", CG_FILE_HDF5);
    file.start_zone("Zone", data.node_count(), data.element_count());
    file.coordinates(data.coordinates);
    write_mixed(file, data);
    for (const Marker& marker : data.markers) {
      const CgnsNumbers edges = cgns_range(file.next, static_cast<cgsize_t>(marker.faces.size()));
      file.lines(marker.name.c_str(), marker.faces);
      file.condition(marker.name.c_str(), BCTypeNull, PointList, edges, EdgeCenter);
    }
    connections(file);
  };
  const CgnsNumbers left = vertices_along(data, "left", 1),
                    right = vertices_along(data, "right", 1);
  // Half a side is no marker.
  write([&](const LibraryFile& file) {
    connect(file, "half", Vertex, {left.begin(), left.begin() + 4},
            {right.begin(), right.begin() + 4}, {1, 0, 0});
  });
  io::MeshFile file = io::read_mesh(folder / "a.cgns");
  CHECK(file.details->periodic->pairs.empty());
  CHECK(
      any_contains(file.warnings, "the periodic connection \"half\" is not used: no two markers"));
  // The pairs count, not the translation: these are turned by half a circle.
  CgnsNumbers turned(right.rbegin(), right.rend());
  write([&](const LibraryFile& out) { connect(out, "turned", Vertex, left, turned, {1, 0, 0}); });
  file = io::read_mesh(folder / "a.cgns");
  REQUIRE(file.details->periodic->pairs.size() == 1);
  CHECK_CONTAINS(PeriodicPairs::of(*file.mesh.topology, file.mesh.coordinates,
                                   file.details->periodic->pairs[0])
                     .description,
                 "180 degrees");
  // A vertex that the zone has not.
  CgnsNumbers beyond = right;
  beyond[3] = data.node_count() + 1;
  write([&](const LibraryFile& out) { connect(out, "beyond", Vertex, left, beyond, {1, 0, 0}); });
  CHECK_THROWS_WITH_AS(io::read_mesh(folder / "a.cgns"), doctest::Contains("found vertex"),
                       InputError);
}

}  // namespace winslow::test

#endif
