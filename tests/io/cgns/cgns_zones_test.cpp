#include "io/support/samples.h"

#ifdef WINSLOW_HAS_CGNS

#include "io/cgns/cgns.h"
#include "io/cgns/library_file.h"

namespace winslow::test {
namespace {

/// Places of the vertices of a structured zone of 9 by 4 that wraps a half disc twice: a C-grid,
/// whose cut is i = 1..3 and i = 9..7 at j = 1.
struct CGrid {
  static constexpr Index ni = 9, nj = 4;
  std::vector<double> x, y;

  CGrid() {
    for (Index j = 0; j < nj; ++j) {
      for (Index i = 0; i < ni; ++i) {
        // From downstream along the lower side of the cut to the body (i = 2), around it, and back.
        const double r = 1 + 0.5 * j;
        if (i < 2 || i > ni - 3) {
          const bool lower = i < 2;
          x.push_back(1 + (lower ? 2 - i : i - (ni - 3)));
          y.push_back((lower ? -0.5 : 0.5) * j);
        } else {
          const double angle = 2 * pi * (i - 2) / (ni - 5);
          x.push_back(r * std::cos(angle) - 0.5 * j);
          y.push_back(-r * std::sin(angle) - 0.0 * j);
        }
      }
    }
    // Above the trailing edge the grid leaves the body on both sides.
    for (Index j = 1; j < nj; ++j) {
      x[at(2 + j * ni)] = x[at(ni - 3 + j * ni)] = 1;
      y[at(2 + j * ni)] = -0.5 * j;
      y[at(ni - 3 + j * ni)] = 0.5 * j;
    }
    y[2] = y[at(ni - 3)] = 0;
  }
};

void write_c_grid(const std::filesystem::path& path, int container, double gap = 0) {
  CGrid grid;
  grid.y[0] -= gap;
  LibraryFile file(path, container);
  file.start_structured_zone("wake", CGrid::ni, CGrid::nj);
  file.coordinate("CoordinateX", grid.x);
  file.coordinate("CoordinateY", grid.y);
  const CgnsNumbers range{1, 1, 3, 1}, donor{9, 1, 7, 1};
  const std::array<int, 2> transform{-1, -2};
  int number = 0;
  require_cgns(cg_1to1_write(file.file, file.base, file.zone, "cut", "wake", range.data(),
                             donor.data(), transform.data(), &number));
  file.condition("body", BCWall, PointRange, {3, 1, 7, 1}, GridLocationNull, nullptr, 2);
  file.condition("outer", BCFarfield, PointRange, {1, 4, 9, 4}, GridLocationNull, nullptr, 2);
  file.condition("out1", BCOutflow, PointRange, {1, 1, 1, 4}, GridLocationNull, "outflow", 2);
  file.condition("out2", BCOutflow, PointRange, {9, 1, 9, 3}, EdgeCenter, "outflow", 2);
}

/// A unit square of n by n vertices with its left lower corner at x.
void write_block(LibraryFile& file, const std::string& name, Index n, double x0) {
  file.start_structured_zone(name, n, n);
  std::vector<double> x, y;
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i) {
      x.push_back(x0 + static_cast<double>(i) / (n - 1));
      y.push_back(static_cast<double>(j) / (n - 1));
    }
  }
  file.coordinate("CoordinateX", x);
  file.coordinate("CoordinateY", y);
  file.condition("lower", BCWall, PointRange, {1, 1, n, 1}, GridLocationNull, nullptr, 2);
}

/// Two blocks side by side that know of one another; in the file, B comes before A.
void write_two_blocks(const std::filesystem::path& path, int container) {
  LibraryFile file(path, container);
  const std::array<int, 2> transform{1, 2};
  const CgnsNumbers right{4, 1, 4, 4}, left{1, 1, 1, 4};
  int number = 0;
  write_block(file, "B", 4, 1);
  require_cgns(cg_1to1_write(file.file, file.base, file.zone, "to A", "A", left.data(),
                             right.data(), transform.data(), &number));
  write_block(file, "A", 4, 0);
  require_cgns(cg_1to1_write(file.file, file.base, file.zone, "to B", "B", right.data(),
                             left.data(), transform.data(), &number));
}

std::vector<std::string> names_of(const io::MeshFile& file) {
  std::vector<std::string> names;
  for (const Marker& marker : file.mesh.topology->markers()) names.push_back(marker.name);
  return names;
}

}  // namespace

TEST_CASE("CGNS: the cut of a C-grid is closed, and both its sides are written") {
  for (const int container : cgns_containers) {
    CAPTURE(container);
    const TemporaryFolder folder;
    write_c_grid(folder / "a.cgns", container);
    edit_node(folder / "a.cgns", "/Base/wake/ZoneBC/out2/GridLocation", [](io::cgns::Node& node) {
      node = *io::cgns::make_text(node.name, node.label, "IFaceCenter");
    });
    io::MeshFile file = io::read_mesh(folder / "a.cgns");
    CHECK(file.warnings.empty());  // left-handed or not, elements of a structured zone are ours
    const Topology& topology = *file.mesh.topology;
    CHECK(topology.node_count() == CGrid::ni * CGrid::nj - 3);
    CHECK(topology.element_count() == (CGrid::ni - 1) * (CGrid::nj - 1));
    CHECK(topology.boundary_loops().size() == 2);
    CHECK(names_of(file) == std::vector<std::string>{"body", "outer", "outflow"});
    CHECK(topology.markers()[0].faces.size() == 4);
    CHECK(topology.markers()[1].faces.size() == 8);
    CHECK(topology.markers()[2].faces.size() == 6);
    CHECK(topology.markers().unmarked_faces() == 0);

    // Node 1 is the second vertex of the cut, (2, 1) and (8, 1).
    file.mesh.coordinates.set_xy(1, {2.0, 0.125});
    io::write_mesh(folder / "b.cgns", file.mesh, file.details.get());
    int handle = 0;
    std::vector<double> y(at(CGrid::ni));
    const CgnsNumbers first{1, 1}, last{9, 1};
    require_cgns(cg_open((folder / "b.cgns").c_str(), CG_MODE_READ, &handle));
    require_cgns(cg_coord_read(handle, 1, 1, "CoordinateY", RealDouble, first.data(), last.data(),
                               y.data()));
    require_cgns(cg_close(handle));
    CHECK(y[1] == 0.125);
    CHECK(y[7] == 0.125);
    CHECK(io::read_mesh(folder / "b.cgns").mesh.coordinates == file.mesh.coordinates);
  }
}

TEST_CASE("CGNS: a cut whose sides lie apart stays open") {
  const TemporaryFolder folder;
  write_c_grid(folder / "a.cgns", CG_FILE_HDF5, 0.01);
  const io::MeshFile file = io::read_mesh(folder / "a.cgns");
  CHECK(any_contains(file.warnings, "\"cut\" of the zone to itself lie apart"));
  CHECK(file.mesh.topology->node_count() == CGrid::ni * CGrid::nj);
  CHECK(file.mesh.topology->boundary_loops().size() == 1);
}

TEST_CASE("CGNS: zones are numbered by name, read apart, and written back together") {
  for (const int container : cgns_containers) {
    const TemporaryFolder folder;
    write_two_blocks(folder / "a.cgns", container);
    io::MeshFile a = io::read_mesh(folder / "a.cgns"),
                 b = io::read_mesh(folder / "a.cgns", {.zone = 2});
    CHECK(a.details->zones == std::vector<int>{1, 2});
    CHECK(a.mesh.coordinates.xy(0) == Vec2(0, 0));
    CHECK(b.mesh.coordinates.xy(0) == Vec2(1, 0));
    CHECK(b.details->zone == 2);
    CHECK(names_of(a) == std::vector<std::string>{"lower", "to B"});
    CHECK_THROWS_WITH_AS(io::read_mesh(folder / "a.cgns", {.zone = 3}),
                         doctest::Contains("no zone 3 in the file, expected 1 to 2"), UsageError);

    const io::Source before = io::Source::load(folder / "a.cgns");
    a.mesh.coordinates.set_xy(5, {0.3, 0.4});
    const std::vector<io::MeshZone> both{{&b.mesh, b.details.get()}, {&a.mesh, a.details.get()}};
    CHECK(io::write_mesh_zones(folder / "b.cgns", both).empty());
    CHECK(io::read_mesh(folder / "b.cgns").mesh.coordinates == a.mesh.coordinates);
    CHECK(io::read_mesh(folder / "b.cgns", {.zone = 2}).mesh.coordinates == b.mesh.coordinates);
    // One zone that was read alone leaves the other one as it is.
    b.mesh.coordinates.set_xy(5, {1.3, 0.4});
    io::write_mesh(folder / "c.cgns", b.mesh, b.details.get());
    CHECK(io::read_mesh(folder / "c.cgns").mesh.coordinates !=
          io::read_mesh(folder / "b.cgns").mesh.coordinates);
    CHECK(io::read_mesh(folder / "c.cgns", {.zone = 2}).mesh.coordinates == b.mesh.coordinates);
    // Alone it is a file of its own.
    io::WriteOptions alone_only;
    alone_only.zone_alone = true;
    const auto warnings = io::write_mesh(folder / "d.cgns", b.mesh, b.details.get(), alone_only);
    CHECK(any_contains(warnings, "the interfaces \"to A\" lead to other zones"));
    const io::MeshFile alone = io::read_mesh(folder / "d.cgns");
    CHECK(alone.details->zones.empty());
    CHECK(alone.mesh.coordinates == b.mesh.coordinates);
    CHECK(names_of(alone) == std::vector<std::string>{"lower"});
  }
}

TEST_CASE("CGNS: a structured zone that changed is written as an unstructured one") {
  const TemporaryFolder folder;
  write_two_blocks(folder / "a.cgns", CG_FILE_HDF5);
  const io::MeshFile a = io::read_mesh(folder / "a.cgns");
  MeshData data = grid_with_holes(3, Cells::triangles, [](Index, Index) { return false; });
  mark_boundary(data, [](const Vec2& p) { return std::string(p.y() == 0 ? "lower" : "to B"); });
  const Mesh other = make_mesh(data);
  const auto warnings = io::write_mesh(folder / "b.cgns", other, a.details.get());
  CHECK(any_contains(warnings, "\"ZoneGridConnectivity\" of the zone \"A\" is not written"));
  CHECK(any_contains(warnings, "the structured zone \"A\" is written as an unstructured one"));
  check_same_mesh(io::read_mesh(folder / "b.cgns").mesh, other);
  CHECK(io::read_mesh(folder / "b.cgns", {.zone = 2}).mesh.coordinates.xy(0) == Vec2(1, 0));
}

}  // namespace winslow::test

#endif
