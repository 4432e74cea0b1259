#ifdef WINSLOW_HAS_CGNS

#include "io/cgns/library_file.h"
#include "io/support/volume_samples.h"

namespace winslow::test {
namespace {

CgnsNumbers nodes_of(const MeshData& data) {
  CgnsNumbers nodes;
  for (const Index node : data.element_nodes) nodes.push_back(node + 1);
  return nodes;
}

CgnsNumbers nodes_of(const Marker& marker) {
  CgnsNumbers nodes;
  for (const Face& face : marker.faces)
    for (const Index node : face) nodes.push_back(node + 1);
  return nodes;
}

/// Hexahedra, their markers as sections of quadrilaterals: one named by a condition with a family,
/// one by a condition at vertices, one by its section alone.
void write_hexahedra(const std::filesystem::path& path, int container, const MeshData& data) {
  LibraryFile file(path, container, 3, 3);
  write_places(file, data);
  file.section("cells", HEXA_8, nodes_of(data), data.element_count());
  std::vector<cgsize_t> firsts;
  for (const Marker& marker : data.markers) {
    firsts.push_back(file.next);
    file.section(marker.name.c_str(), QUAD_4, nodes_of(marker),
                 static_cast<cgsize_t>(marker.faces.size()));
  }
  file.condition("bc_1", BCWall, PointRange, {firsts[0], firsts[1] - 1}, FaceCenter, "ground");
  CgnsNumbers vertices;
  for (Index i = 0; i < data.node_count(); ++i)
    if (data.coordinates.xyz(i).z() > 0.999) vertices.push_back(i + 1);
  file.condition("top", BCInflow, PointList, vertices);
}

}  // namespace

TEST_CASE("CGNS of volumes: conditions at faces and at vertices, families, sections are markers") {
  const MeshData data = cube(2, Volumes::hexahedra);
  REQUIRE(data.markers[0].name == "floor");
  for (const int container : cgns_containers) {
    const TemporaryFolder folder;
    write_hexahedra(folder / "a.cgns", container, data);
    const io::MeshFile file = io::read_mesh(folder / "a.cgns");
    const Topology& topology = *file.mesh.topology;
    CHECK(topology.element_count() == 8);
    const auto size_of = [&](const char* name) {
      const auto m = topology.markers().find(name);
      return m ? topology.markers()[at(*m)].faces.size() : 0;
    };
    CHECK(size_of("ground") == 4);
    CHECK(size_of("top") == 4);  // the name of the condition, not that of its section
    CHECK(size_of("walls") == 16);
    io::write_mesh(folder / "b.cgns", file.mesh, file.details.get());
    CHECK(differences(tree_of(folder / "a.cgns").root, tree_of(folder / "b.cgns").root).empty());
  }
}

TEST_CASE("CGNS of volumes: nodes that move change their coordinates, z too, and nothing else") {
  const TemporaryFolder folder;
  write_hexahedra(folder / "a.cgns", CG_FILE_HDF5, cube(2, Volumes::hexahedra));
  io::MeshFile file = io::read_mesh(folder / "a.cgns");
  const Vec3 moved = file.mesh.coordinates.xyz(3) + Vec3(0, 0, 0.125);
  file.mesh.coordinates.set_xyz(3, moved);
  io::write_mesh(folder / "b.cgns", file.mesh, file.details.get());
  CHECK(io::read_mesh(folder / "b.cgns").mesh.coordinates.xyz(3) == moved);
  const auto changed =
      differences(tree_of(folder / "a.cgns").root, tree_of(folder / "b.cgns").root);
  REQUIRE(changed.size() == 1);
  CHECK_CONTAINS(changed[0], "CoordinateZ");
}

TEST_CASE("CGNS of volumes: cells of all types in MIXED sections and in sections of their own") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    Random random(6);
    const Mesh mesh = make_mesh(volume_sample(random, volumes, true));
    const TemporaryFolder folder;
    for (const char* container : {"hdf5", "adf"}) {
      io::WriteOptions options;
      options.cgns_container = container;
      CHECK(io::write_mesh(folder / "a.cgns", mesh, nullptr, options).empty());
      check_same_mesh(io::read_mesh(folder / "a.cgns").mesh, mesh, {.tags = false});
    }
  }
}

TEST_CASE("CGNS of volumes: what is refused is named") {
  const TemporaryFolder folder;
  const MeshData data = cube(1, Volumes::hexahedra);
  const auto refusal = [&](const auto& write) {
    {
      LibraryFile file(folder / "a.cgns", CG_FILE_HDF5, 3, 3);
      write(file);
    }
    try {
      io::read_mesh(folder / "a.cgns");
    } catch (const InputError& error) {
      return std::string(error.what()).substr((folder / "a.cgns").string().size() + 2);
    }
    return std::string("no error");
  };
  CHECK_CONTAINS(refusal([&](LibraryFile& file) {
                   write_places(file, data);
                   file.section("cells", HEXA_27, cgns_range(1, 27), 1);
                 }),
                 "/Base/blk/cells: found HEXA_27 (second or higher order), expected TETRA_4");
  CHECK_CONTAINS(refusal([&](LibraryFile& file) {
                   write_places(file, data);
                   file.section("sides", QUAD_4, {1, 2, 3, 4}, 1);
                 }),
                 "/Base/blk: found no elements, expected TETRA_4");
  CHECK_CONTAINS(
      refusal([&](LibraryFile& file) {
        file.start_zone("blk", 8, 1);
        file.coordinate("CoordinateX", std::vector<double>(8, 0.0));
        file.coordinate("CoordinateY", std::vector<double>(8, 0.0));
      }),
      "found CoordinateX, CoordinateY, expected CoordinateX, CoordinateY and CoordinateZ");
}

}  // namespace winslow::test

#endif
