#ifdef WINSLOW_HAS_CGNS

#include <map>

#include "core/command/command.h"
#include "io/cgns/library_file.h"
#include "io/support/volume_samples.h"
#include "io/tables/file_defaults.h"
#include "io/tables/slide_files.h"

/// What a file says of its boundary: planes of symmetry slide, periodic sides move together.
namespace winslow::test {
namespace {

using Names = std::vector<std::string>;
using Roles = std::vector<std::pair<std::string, std::string>>;

/// A square with a hole; markers left, right, lower, upper, hole.
MeshData passage() {
  MeshData data = square_with_hole(10, Cells::triangles);
  data.markers.clear();
  mark_boundary(data, [](const Vec2& p) {
    if ((p - Vec2(0.5, 0.5)).cwiseAbs().maxCoeff() < 0.5 - 1e-9) return "hole";
    if (p.y() < 1e-9 || p.y() > 1 - 1e-9) return p.y() < 0.5 ? "lower" : "upper";
    return p.x() < 0.5 ? "left" : "right";
  });
  return data;
}

/// The numbers of the nodes of a marker by their y, from 1 on.
CgnsNumbers upwards(const MeshData& data, const std::string& name) {
  std::map<double, cgsize_t> sorted;
  for (const Marker& marker : data.markers)
    if (marker.name == name)
      for (const Face& face : marker.faces)
        for (const Index node : face) sorted[data.coordinates.xy(node).y()] = node + 1;
  CgnsNumbers numbers;
  for (const auto& entry : sorted) numbers.push_back(entry.second);
  return numbers;
}

/// The lower side is a plane of symmetry, left and right are periodic.
void write_passage(const std::filesystem::path& path, int container) {
  const MeshData data = passage();
  LibraryFile file(path, container);
  file.start_zone("Zone", data.node_count(), data.element_count());
  file.coordinates(data.coordinates);
  write_mixed(file, data);
  for (const Marker& marker : data.markers) {
    const cgsize_t first = file.next;
    file.lines(("section " + marker.name).c_str(), marker.faces);
    file.condition(marker.name.c_str(), marker.name == "lower" ? BCSymmetryPlane : BCWall,
                   PointRange, {first, file.next - 1}, EdgeCenter);
  }
  const CgnsNumbers own = upwards(data, "left"), donor = upwards(data, "right");
  int number = 0;
  require_cgns(cg_conn_write(file.file, file.base, file.zone, "sides", Vertex, Abutting1to1,
                             PointList, static_cast<cgsize_t>(own.size()), own.data(), "Zone",
                             Unstructured, PointListDonor, DataTypeNull,
                             static_cast<cgsize_t>(donor.size()), donor.data(), &number));
  const std::array<float, 3> none{}, translation{1, 0, 0};
  require_cgns(cg_conn_periodic_write(file.file, file.base, file.zone, number, none.data(),
                                      none.data(), translation.data()));
}

/// A file whose hole moves, with the defaults of the file.
struct Run {
  io::MeshFile file;
  std::string said;
  Coordinates moved;

  Run(const std::filesystem::path& path, const Names& fixed) : file(io::read_mesh(path)) {
    MoveCommand move;
    move.bodies[0].markers = {"hole"};
    move.bodies[0].motion.translate = {0.1, 0.05, 0};
    move.smooth.slide.fixed = fixed;
    Command command = move;
    said = io::add_file_defaults(command, file);
    const MeshState state = make_state(file.mesh);
    moved = execute(io::resolve_files(command, file.details.get()), state).state.mesh.coordinates;
  }

  Vec2 way(Index node) const { return moved.xy(node) - file.mesh.coordinates.xy(node); }
  /// The longest way of the nodes of a marker.
  double way(const std::string& marker) const {
    double longest = 0;
    for (const Index node : file.mesh.topology->markers().nodes_of(Names{marker}))
      longest = std::max(longest, way(node).norm());
    return longest;
  }
};

}  // namespace

TEST_CASE("CGNS: planes of symmetry slide and periodic sides move together, unless fixed") {
  const TemporaryFolder folder;
  for (const int container : cgns_containers) {
    write_passage(folder / "a.cgns", container);
    const Run free(folder / "a.cgns", {});
    CHECK(free.said ==
          "As the file says, lower (BCSymmetryPlane) slides, left and right move together; --fixed "
          "NAME holds a marker");
    CHECK(free.way("lower") > 1e-3);
    for (const Index node : free.file.mesh.topology->markers().nodes_of(Names{"lower"}))
      CHECK(std::abs(free.moved.xy(node).y()) < 1e-12);
    CHECK(free.way("left") > 1e-3);
    const auto& pairs = free.file.details->periodic->pairs[0].pairs;
    REQUIRE(pairs.size() == 11);
    for (const auto& [node, image] : pairs)
      CHECK((free.way(node) - free.way(image)).norm() < 1e-13);
    CHECK(free.way("upper") == 0);
  }
  const Run held(folder / "a.cgns", {"lower"});
  CHECK(held.said == "As the file says, left and right move together; --fixed NAME holds a marker");
  CHECK(held.way("lower") == 0);
  CHECK(held.way("right") > 1e-3);
  const Run apart(folder / "a.cgns", {"right"});
  CHECK(apart.said ==
        "As the file says, lower (BCSymmetryPlane) slides; --fixed NAME holds a marker");
  CHECK(apart.way("left") == 0);
  CHECK(apart.way("right") == 0);
  CHECK(apart.way("lower") > 1e-3);
  const Run still(folder / "a.cgns", {"left", "lower"});
  CHECK(still.said.empty());
  for (const char* name : {"left", "right", "lower", "upper"}) CHECK(still.way(name) == 0);
}

TEST_CASE("CGNS: a condition or its family says what a plane of symmetry is") {
  const TemporaryFolder folder;
  const MeshData data = passage();
  const auto roles_of = [&](const std::function<void(LibraryFile&, const CgnsNumbers&)>& write) {
    {
      LibraryFile file(folder / "a.cgns", CG_FILE_HDF5);
      file.start_zone("Zone", data.node_count(), data.element_count());
      file.coordinates(data.coordinates);
      write_mixed(file, data);
      const cgsize_t first = file.next;
      file.lines("lines", data.markers[0].faces);
      write(file, {first, file.next - 1});
    }
    return io::read_mesh(folder / "a.cgns").details->roles.symmetry;
  };
  const auto write_family = [](const LibraryFile& file, const char* name, BCType_t type) {
    int family = 0, condition = 0;
    require_cgns(cg_family_write(file.file, file.base, name, &family));
    require_cgns(cg_fambc_write(file.file, file.base, family, "FamBC", type, &condition));
  };
  const Roles expected{{"mid", "BCSymmetryPlane"}};
  CHECK(roles_of([](LibraryFile& file, const CgnsNumbers& range) {
          file.condition("bc", BCSymmetryPlane, PointRange, range, EdgeCenter, "mid");
        }) == expected);
  CHECK(roles_of([&](LibraryFile& file, const CgnsNumbers& range) {
          write_family(file, "mid", BCSymmetryPlane);
          file.condition("bc", FamilySpecified, PointRange, range, EdgeCenter, "mid");
        }) == expected);
  // Two conditions of one family are one marker, and one plane.
  CHECK(roles_of([&](LibraryFile& file, const CgnsNumbers& range) {
          write_family(file, "mid", BCSymmetryPlane);
          for (const cgsize_t line : range)
            file.condition(("bc" + std::to_string(line)).c_str(), FamilySpecified, PointRange,
                           {line, line}, EdgeCenter, "mid");
        }) == expected);
  // The condition counts where it says itself what it is.
  CHECK(roles_of([&](LibraryFile& file, const CgnsNumbers& range) {
          write_family(file, "mid", BCSymmetryPlane);
          file.condition("bc", BCWall, PointRange, range, EdgeCenter, "mid");
        }).empty());
  CHECK(roles_of([&](LibraryFile& file, const CgnsNumbers& range) {
          write_family(file, "mid", BCWall);
          file.condition("bc", FamilySpecified, PointRange, range, EdgeCenter, "mid");
        }).empty());
  CHECK(roles_of([](LibraryFile& file, const CgnsNumbers& range) {
          file.condition("bc", FamilySpecified, PointRange, range, EdgeCenter, "none");
        }).empty());
}

TEST_CASE("CGNS: sides of structured zones and of volumes are planes of symmetry, too") {
  const TemporaryFolder folder;
  {
    LibraryFile file(folder / "a.cgns", CG_FILE_HDF5);
    file.start_structured_zone("Zone", 3, 3);
    file.coordinate("CoordinateX", std::vector<double>{0, 1, 2, 0, 1, 2, 0, 1, 2});
    file.coordinate("CoordinateY", std::vector<double>{0, 0, 0, 1, 1, 1, 2, 2, 2});
    file.condition("mid", BCSymmetryPlane, PointRange, {1, 1, 3, 1}, GridLocationNull, nullptr, 2);
  }
  const Roles expected{{"mid", "BCSymmetryPlane"}};
  CHECK(io::read_mesh(folder / "a.cgns").details->roles.symmetry == expected);
  const MeshData data = cube(3, Volumes::hexahedra);
  {
    LibraryFile file(folder / "b.cgns", CG_FILE_HDF5, 3, 3);
    write_places(file, data);
    CgnsNumbers nodes, floor;
    for (const Index node : data.element_nodes) nodes.push_back(node + 1);
    file.section("cells", HEXA_8, nodes, data.element_count());
    for (Index i = 0; i < data.node_count(); ++i)
      if (data.coordinates.xyz(i).z() == 0) floor.push_back(i + 1);
    file.condition("mid", BCSymmetryPlane, PointList, floor);
  }
  const io::MeshFile file = io::read_mesh(folder / "b.cgns");
  CHECK(file.details->roles.symmetry == expected);
  SmoothOptions smooth;
  CHECK_CONTAINS(io::add_file_defaults(smooth, {}, file), "mid (BCSymmetryPlane) slides");
  CHECK(smooth.slide.markers == Names{"mid"});
}

}  // namespace winslow::test

#endif
