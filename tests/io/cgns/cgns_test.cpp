#include "io/cgns/cgns.h"

#include <cstring>

#include "io/format/mesh_in_space.h"
#include "io/support/samples.h"
#include "support/meshes.h"

#ifdef WINSLOW_HAS_CGNS

#include "io/cgns/library_file.h"

namespace winslow::test {

TEST_CASE("CGNS: meshes of other formats come back in order and to the last bit") {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    std::vector<std::string> warnings;  // of regions that meet in edges of no marker
    const Mesh mesh = make_mesh(shuffled_mesh(random, seed % 2 == 0), &warnings);
    const TemporaryFolder folder;
    CHECK(io::write_mesh(folder / "a.cgns", mesh, nullptr).empty());
    const io::MeshFile file = io::read_mesh(folder / "a.cgns");
    Comparison what;
    what.tags = false;
    REQUIRE(file.warnings.size() == warnings.size());
    for (std::size_t k = 0; k < warnings.size(); ++k)
      CHECK(file.warnings[k].ends_with(warnings[k]));
    const auto& regions = mesh.topology->regions();
    what.regions = regions.empty();
    check_same_mesh(file.mesh, mesh, what);
    REQUIRE(file.mesh.topology->regions().size() == regions.size());
    for (std::size_t r = 0; r < regions.size(); ++r)
      CHECK(file.mesh.topology->regions()[r].name == regions[r].name);
    const auto of = mesh.topology->element_regions(), found = file.mesh.topology->element_regions();
    CHECK(std::equal(of.begin(), of.end(), found.begin(), found.end()));
  }
}

TEST_CASE("CGNS: libcgns finds in our file what is in the mesh") {
  const TemporaryFolder folder;
  const MeshData data = cgns_square();
  io::write_mesh(folder / "a.cgns", make_mesh(data), nullptr);
  int file = 0, zones = 0, sections = 0, conditions = 0;
  require_cgns(cg_open((folder / "a.cgns").c_str(), CG_MODE_READ, &file));
  require_cgns(cg_nzones(file, 1, &zones));
  CHECK(zones == 1);
  require_cgns(cg_nsections(file, 1, 1, &sections));
  CHECK(sections == 3);
  require_cgns(cg_nbocos(file, 1, 1, &conditions));
  CHECK(conditions == 2);
  for (int s = 2; s <= sections; ++s) {
    std::array<char, 33> name{};
    ElementType_t type{};
    cgsize_t first = 0, last = 0;
    int boundary = 0, parents = 0;
    require_cgns(
        cg_section_read(file, 1, 1, s, name.data(), &type, &first, &last, &boundary, &parents));
    const Marker& marker = data.markers[static_cast<std::size_t>(s - 2)];
    CHECK(std::string(name.data()) == marker.name);
    CHECK(type == BAR_2);
    CgnsNumbers nodes(2 * marker.faces.size());
    REQUIRE(last - first + 1 == static_cast<cgsize_t>(marker.faces.size()));
    require_cgns(cg_elements_read(file, 1, 1, s, nodes.data(), nullptr));
    for (std::size_t k = 0; k < marker.faces.size(); ++k) {
      CHECK(nodes[2 * k] == marker.faces[k][0] + 1);
      CHECK(nodes[2 * k + 1] == marker.faces[k][1] + 1);
    }
  }
  std::vector<double> x(at(data.node_count()));
  const cgsize_t one = 1, all = data.node_count();
  require_cgns(cg_coord_read(file, 1, 1, "CoordinateX", RealDouble, &one, &all, x.data()));
  for (Index i = 0; i < data.node_count(); ++i) CHECK(x[at(i)] == data.coordinates.xy(i).x());
  require_cgns(cg_close(file));
}

TEST_CASE("CGNS: names that it does not allow are changed, with a warning") {
  MeshData data = cgns_square();
  data.markers[0].name = "lower/wall";
  data.markers[1].name = "a name of more than thirty-two characters";
  const TemporaryFolder folder;
  const auto warnings = io::write_mesh(folder / "a.cgns", make_mesh(data), nullptr);
  CHECK(any_contains(warnings, "\"lower/wall\" is written as \"lower_wall\""));
  const io::MeshFile file = io::read_mesh(folder / "a.cgns");
  CHECK(file.mesh.topology->markers()[0].name == "lower_wall");
  CHECK(file.mesh.topology->markers()[1].name == data.markers[1].name.substr(0, 32));
}

TEST_CASE("CGNS: a file of another program is read, and comes back as it was") {
  const MeshData data = cgns_square();
  for (const int container : cgns_containers) {
    CAPTURE(container);
    const TemporaryFolder folder;
    write_square(folder / "a.cgns", container, data);
    io::MeshFile file = io::read_mesh(folder / "a.cgns");
    CHECK(file.warnings.empty());
    check_same_mesh(file.mesh, make_mesh(data));
    io::write_mesh(folder / "b.cgns", file.mesh, file.details.get());
    const auto before = tree_of(folder / "a.cgns"), same = tree_of(folder / "b.cgns");
    CHECK(differences(before.root, same.root).empty());
    CHECK((same.container == io::cgns::Container::adf) == (container == CG_FILE_ADF));
    // Only the coordinate that changed differs.
    file.mesh.coordinates.set_xy(3, {0.75, 0.125});
    CHECK(io::write_mesh(folder / "b.cgns", file.mesh, file.details.get()).empty());
    CHECK(differences(before.root, tree_of(folder / "b.cgns").root) ==
          std::vector<std::string>{"/Base/blk/GridCoordinates/CoordinateX",
                                   "/Base/blk/GridCoordinates/CoordinateY"});
    CHECK(io::read_mesh(folder / "b.cgns").mesh.coordinates == file.mesh.coordinates);
  }
}

TEST_CASE("CGNS: the container is that of the source, or what the options say") {
  const TemporaryFolder folder;
  const Mesh mesh = make_mesh(cgns_square());
  io::WriteOptions options;
  options.cgns_container = "adf";
  io::write_mesh(folder / "a.cgns", mesh, nullptr, options);
  const auto adf = tree_of(folder / "a.cgns");
  CHECK(adf.container == io::cgns::Container::adf);
  const io::MeshFile file = io::read_mesh(folder / "a.cgns");
  check_same_mesh(file.mesh, mesh);
  options.cgns_container = "hdf5";
  io::write_mesh(folder / "b.cgns", file.mesh, file.details.get(), options);
  const auto hdf5 = tree_of(folder / "b.cgns");
  CHECK(hdf5.container == io::cgns::Container::hdf5);
  auto found = differences(adf.root, hdf5.root);
  // The root is called by its container, and ADF keeps the order of nodes that HDF5 keeps, too.
  std::erase(found, "");
  CHECK(found.empty());
  options.cgns_container = "tar";
  CHECK_THROWS_WITH_AS(io::write_mesh(folder / "c.cgns", mesh, nullptr, options),
                       doctest::Contains("unknown CGNS container"), UsageError);
}

TEST_CASE("CGNS: compressed files, and files of another extension") {
  const TemporaryFolder folder;
  const Mesh mesh = make_mesh(cgns_square());
  io::write_mesh(folder / "a.cgns.gz", mesh, nullptr);
  CHECK(io::read_mesh(folder / "a.cgns.gz").mesh.coordinates == mesh.coordinates);
  io::write_mesh(folder / "a.cgns", mesh, nullptr);
  std::filesystem::rename(folder / "a.cgns", folder / "a.su2");
  CHECK(any_contains(io::read_mesh(folder / "a.su2").warnings, "that of a .cgns file"));
  write_square(folder / "b.cgns", CG_FILE_ADF, cgns_square());
  std::filesystem::rename(folder / "b.cgns", folder / "b.su2");
  CHECK(any_contains(io::read_mesh(folder / "b.su2").warnings, "that of a .cgns file"));
}

TEST_CASE("CGNS: what a file says beyond the mesh survives a motion") {
  for (const int container : cgns_containers) {
    const TemporaryFolder folder;
    const MeshData data = cgns_square();
    write_square(folder / "a.cgns", container, data);
    int file = 0, number = 0;
    require_cgns(cg_open((folder / "a.cgns").c_str(), CG_MODE_MODIFY, &file));
    require_cgns(cg_goto(file, 1, "Zone_t", 1, "end"));
    require_cgns(cg_descriptor_write("remark", "made by hand"));
    require_cgns(cg_famname_write("fluid"));
    require_cgns(cg_goto(file, 1, "Zone_t", 1, "GridCoordinates_t", 1, "end"));
    require_cgns(cg_units_write(Kilogram, Millimeter, Second, Kelvin, Degree));
    require_cgns(cg_family_write(file, 1, "wall", &number));
    require_cgns(cg_fambc_write(file, 1, number, "FamBC", BCWallViscousHeatFlux, &number));
    require_cgns(cg_sol_write(file, 1, 1, "Flow", Vertex, &number));
    const std::vector<double> pressure(at(data.node_count()), 101325.0);
    require_cgns(
        cg_field_write(file, 1, 1, number, RealDouble, "Pressure", pressure.data(), &number));
    const std::vector<double> normals(at(data.node_count()) * 2, 1.0);
    require_cgns(cg_boco_normal_write(file, 1, 1, 1, nullptr, 1, RealDouble, normals.data()));
    require_cgns(cg_close(file));

    io::MeshFile read = io::read_mesh(folder / "a.cgns");
    CHECK(io::write_mesh(folder / "b.cgns", read.mesh, read.details.get()).empty());
    CHECK(differences(tree_of(folder / "a.cgns").root, tree_of(folder / "b.cgns").root).empty());
    read.mesh.coordinates.set_xy(6, {0.3, 0.3});
    const auto warnings = io::write_mesh(folder / "b.cgns", read.mesh, read.details.get());
    CHECK(any_contains(warnings, "\"Flow\" of the file was computed before the mesh moved"));
    CHECK(any_contains(warnings, "normals (InwardNormalList) of \"bc wall\""));
    const auto root = tree_of(folder / "b.cgns").root;
    CHECK(io::cgns::text_of(node_at(root, "/Base/blk/remark")) == "made by hand");
    CHECK(node_at(root, "/Base/blk/GridCoordinates/DimensionalUnits").data.find("Millimeter") !=
          std::string::npos);
    CHECK(io::cgns::text_of(node_at(root, "/Base/wall/FamBC")) == "BCWallViscousHeatFlux");
    CHECK(io::cgns::reals_of(node_at(root, "/Base/blk/Flow/Pressure")) == pressure);
    CHECK(!io::cgns::child_named(node_at(root, "/Base/blk/ZoneBC/bc wall"), "InwardNormalList"));
  }
}

TEST_CASE("CGNS: single precision stays as long as the numbers fit in it") {
  const TemporaryFolder folder;
  const MeshData data = cgns_square();
  write_square(folder / "a.cgns", CG_FILE_HDF5, data, true);
  io::MeshFile file = io::read_mesh(folder / "a.cgns");
  const auto type_written = [&] {
    return node_at(tree_of(folder / "b.cgns").root, "/Base/blk/GridCoordinates/CoordinateY").type;
  };
  file.mesh.coordinates.set_xy(6, {0.25, 0.3125});
  CHECK(io::write_mesh(folder / "b.cgns", file.mesh, file.details.get()).empty());
  CHECK(type_written() == "R4");
  file.mesh.coordinates.set_xy(6, {0.25, 0.3});
  CHECK(any_contains(io::write_mesh(folder / "b.cgns", file.mesh, file.details.get()),
                     "they are written in double (R8)"));
  CHECK(type_written() == "R8");
  CHECK(io::read_mesh(folder / "b.cgns").mesh.coordinates == file.mesh.coordinates);
}

TEST_CASE("CGNS: a changed mesh keeps of its zone what does not depend on the elements") {
  const TemporaryFolder folder;
  MeshData data = cgns_square();
  write_square(folder / "a.cgns", CG_FILE_ADF, data);
  int handle = 0, number = 0;
  require_cgns(cg_open((folder / "a.cgns").c_str(), CG_MODE_MODIFY, &handle));
  require_cgns(cg_goto(handle, 1, "Zone_t", 1, "end"));
  require_cgns(cg_descriptor_write("remark", "made by hand"));
  require_cgns(cg_sol_write(handle, 1, 1, "Flow", Vertex, &number));
  require_cgns(cg_close(handle));
  const io::MeshFile file = io::read_mesh(folder / "a.cgns");

  data = grid_with_holes(5, Cells::mixed, [](Index, Index) { return false; });
  mark_boundary(data, [](const Vec2& p) { return std::string(p.y() == 0 ? "wall" : "new"); });
  const Mesh other = make_mesh(data);
  const auto warnings = io::write_mesh(folder / "b.cgns", other, file.details.get());
  CHECK(
      any_contains(warnings, "the mesh has changed: \"Flow\" of the zone \"blk\" is not written"));
  const io::MeshFile back = io::read_mesh(folder / "b.cgns");
  CHECK(back.warnings.empty());
  check_same_mesh(back.mesh, other);
  const auto root = tree_of(folder / "b.cgns").root;
  CHECK(io::cgns::text_of(node_at(root, "/Base/blk/ZoneBC/bc wall")) == "BCWallViscous");
  CHECK(io::cgns::text_of(node_at(root, "/Base/blk/ZoneBC/bc wall/FamilyName")) == "wall");
  CHECK(io::cgns::text_of(node_at(root, "/Base/blk/ZoneBC/new")) == "FamilySpecified");
  CHECK(io::cgns::text_of(node_at(root, "/Base/blk/remark")) == "made by hand");
  CHECK(node_at(root, "/Base/new").label == "Family_t");
}

TEST_CASE("CGNS: the plane z = constant is kept, also from and to other formats") {
  const TemporaryFolder folder;
  const MeshData data = cgns_square();
  {
    LibraryFile file(folder / "a.cgns", CG_FILE_HDF5, 2, 3);
    file.start_zone("blk", data.node_count(), data.element_count());
    file.coordinates(data.coordinates);
    file.coordinate("CoordinateZ", std::vector<double>(at(data.node_count()), 0.7));
    write_mixed(file, data);
  }
  const io::MeshFile a = io::read_mesh(folder / "a.cgns");
  CHECK(a.details->plane_z == std::vector<double>{0.7});
  io::write_mesh(folder / "b.vtu", a.mesh, a.details.get());
  const io::MeshFile b = io::read_mesh(folder / "b.vtu");
  io::write_mesh(folder / "c.cgns", b.mesh, b.details.get());
  CHECK(io::read_mesh(folder / "c.cgns").details->plane_z == std::vector<double>{0.7});
}

TEST_CASE("CGNS: a mesh in another plane is moved in it and put back there") {
  const TemporaryFolder folder;
  const MeshData data = cgns_square();
  {
    LibraryFile file(folder / "a.cgns", CG_FILE_HDF5, 2, 3);
    file.start_zone("blk", data.node_count(), data.element_count());
    std::vector<double> x, y, z;  // the plane y = 0.25
    for (Index i = 0; i < data.node_count(); ++i) {
      x.push_back(data.coordinates.xy(i).x());
      y.push_back(0.25);
      z.push_back(data.coordinates.xy(i).y());
    }
    file.coordinate("CoordinateX", x);
    file.coordinate("CoordinateY", y);
    file.coordinate("CoordinateZ", z);
    write_mixed(file, data);
  }
  io::MeshFile a = io::read_mesh(folder / "a.cgns");
  REQUIRE(a.details->plane);
  const Coordinates before = a.mesh.coordinates;
  const Index moved = 1;
  a.mesh.coordinates.set_xy(moved, before.xy(moved) + Vec2(0.01, 0.02));
  // Into the file's own tree, and into a new one by way of a format without one.
  io::write_mesh(folder / "b.cgns", a.mesh, a.details.get());
  io::write_mesh(folder / "c.vtu", a.mesh, a.details.get());
  const io::MeshFile c = io::read_mesh(folder / "c.vtu");
  io::write_mesh(folder / "d.cgns", c.mesh, c.details.get());
  for (const char* name : {"b.cgns", "d.cgns"}) {
    CAPTURE(name);
    const io::MeshFile again = io::read_mesh(folder / name);
    REQUIRE(again.details->plane);
    CHECK(largest_difference(again.mesh.coordinates, a.mesh.coordinates) < 1e-15);
    CHECK(again.details->plane->plane_text() == "the plane y = 0.25");
  }
}

TEST_CASE("CGNS: links within the file are followed, and stay links; others are refused") {
  const TemporaryFolder folder;
  const MeshData data = cgns_square();
  write_square(folder / "a.cgns", CG_FILE_HDF5, data);
  int file = 0;
  require_cgns(cg_open((folder / "a.cgns").c_str(), CG_MODE_MODIFY, &file));
  int zone = 0;
  const CgnsNumbers size{data.node_count(), data.element_count(), 0};
  require_cgns(cg_zone_write(file, 1, "copy", size.data(), Unstructured, &zone));
  require_cgns(cg_goto(file, 1, "Zone_t", zone, "end"));
  for (const char* name : {"GridCoordinates", "cells"})
    require_cgns(cg_link_write(name, "", ("/Base/blk/" + std::string(name)).c_str()));
  require_cgns(cg_close(file));
  io::MeshFile copy = io::read_mesh(folder / "a.cgns", {.zone = 2});
  CHECK(copy.mesh.coordinates == data.coordinates);
  copy.mesh.coordinates.set_xy(6, {0.3, 0.3});
  io::write_mesh(folder / "b.cgns", copy.mesh, copy.details.get());
  const auto root = tree_of(folder / "b.cgns").root;
  CHECK(node_at(root, "/Base/copy/cells").is_link());
  CHECK(!node_at(root, "/Base/copy/GridCoordinates").is_link());
  CHECK(io::read_mesh(folder / "b.cgns", {.zone = 1}).mesh.coordinates == data.coordinates);
  CHECK(io::read_mesh(folder / "b.cgns", {.zone = 2}).mesh.coordinates == copy.mesh.coordinates);

  require_cgns(cg_open((folder / "a.cgns").c_str(), CG_MODE_MODIFY, &file));
  require_cgns(cg_goto(file, 1, "Zone_t", 1, "end"));
  require_cgns(cg_link_write("Other", "grid.cgns", "/Base/blk/Other"));
  require_cgns(cg_close(file));
  try {
    io::read_mesh(folder / "a.cgns");
    FAIL("a link to another file was taken");
  } catch (const InputError& error) {
    CHECK_CONTAINS(error.what(), "/Base/blk/Other: found a link to 'grid.cgns:/Base/blk/Other'");
  }
}

}  // namespace winslow::test

#else

namespace winslow::test {

TEST_CASE("CGNS: this build is without it and says so (the tests of the format are left out)") {
  MESSAGE("skipped: libcgns was not found");
  const TemporaryFolder folder;
  write_text(folder / "a.cgns", "\x89HDF\r\n\x1a\n and more");
  const Mesh mesh = make_mesh(grid_with_holes(2, Cells::quads, [](Index, Index) { return false; }));
  const std::string sentence = "a.cgns: this winslow was built without CGNS; install libcgns";
  CHECK_CONTAINS(input_error("a.cgns", "\x89HDF\r\n\x1a\n and more"), sentence);
  CHECK_THROWS_WITH_AS(io::write_mesh(folder / "b.cgns", mesh, nullptr),
                       doctest::Contains("built without CGNS"), UsageError);
  CHECK(!std::filesystem::exists(folder / "b.cgns"));
}

}  // namespace winslow::test

#endif
