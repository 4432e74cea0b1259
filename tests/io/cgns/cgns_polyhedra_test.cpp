#ifdef WINSLOW_HAS_CGNS

#include <set>

#include "core/quality/quality.h"
#include "io/cgns/polyhedra_file.h"

/// Cells that are given by their faces: NFACE_n, or ParentElements of NGON_n.
namespace winslow::test {
namespace {

/// The same cells, whatever their first corner.
void check_cells(const io::MeshFile& file, const MeshData& data) {
  const Topology& topology = *file.mesh.topology;
  REQUIRE(topology.element_count() == data.element_count());
  CHECK(measure_quality(file.mesh).inverted == 0);
  for (Index e = 0; e < data.element_count(); ++e) {
    CHECK(topology.element_type(e) == data.types[at(e)]);
    const auto own = topology.element(e), given = data.element(e);
    CHECK(std::set<Index>(own.begin(), own.end()) == std::set<Index>(given.begin(), given.end()));
  }
}

}  // namespace

TEST_CASE("CGNS: polyhedra (NFACE_n) that are tetrahedra, pyramids, prisms or hexahedra") {
  const TemporaryFolder folder;
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::hexahedra, Volumes::mixed}) {
    for (const bool cells_first : {false, true}) {
      const MeshData data = cube(volumes == Volumes::mixed ? 4 : 2, volumes);
      {
        LibraryFile file(folder / "a.cgns", CG_FILE_HDF5, 3, 3);
        write_places(file, data);
        write_polyhedra(file, data, cells_first);
      }
      const io::MeshFile file = io::read_mesh(folder / "a.cgns");
      check_cells(file, data);
      CHECK(file.mesh.topology->markers().size() == 1);
      CHECK(marker_named(file, "wall").faces.size() == 1);
      io::write_mesh(folder / "b.cgns", file.mesh, file.details.get());
      CHECK(differences(tree_of(folder / "a.cgns").root, tree_of(folder / "b.cgns").root).empty());
    }
  }
}

TEST_CASE("CGNS: other polyhedra, and faces that a zone does not have, are refused by number") {
  const TemporaryFolder folder;
  const MeshData data = cube(1, Volumes::hexahedra);
  const auto refusal = [&](const CgnsNumbers& faces) {
    {
      LibraryFile file(folder / "a.cgns", CG_FILE_HDF5, 3, 3);
      write_places(file, data);
      write_faces(file, Polyhedra(data));
      file.poly_section("cells", NFACE_n, faces, {0, static_cast<cgsize_t>(faces.size())});
    }
    try {
      io::read_mesh(folder / "a.cgns");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  CHECK_CONTAINS(refusal({1, 2, 3, 4, 5}),
                 "/Base/blk/cells: found element 7, a polyhedron of 5 faces, expected tetrahedra");
  CHECK_CONTAINS(refusal({1, 2, 3, 4, 5, 5}), "a polyhedron of 6 faces");
  CHECK_CONTAINS(refusal({1, 2, 3, 4, 5, 9}), "found face 9 in element 7, expected the number");
  CHECK_CONTAINS(refusal({1, 2, 3, 4, 5, 0}), "found face 0 in element 7");
}

namespace {

/// The cells by their types, the wall as a section of one face.
void write_types(const std::filesystem::path& path, const MeshData& data) {
  const std::map<ElementType, ElementType_t> types{
      {ElementType::triangle, TRI_3},      {ElementType::quadrilateral, QUAD_4},
      {ElementType::tetrahedron, TETRA_4}, {ElementType::pyramid, PYRA_5},
      {ElementType::prism, PENTA_6},       {ElementType::hexahedron, HEXA_8}};
  LibraryFile file(path, CG_FILE_HDF5, 3, 3);
  write_places(file, data);
  CgnsNumbers nodes, offsets{0};
  for (Index e = 0; e < data.element_count(); ++e) {
    nodes.push_back(types.at(data.types[at(e)]));
    for (const Index node : data.element(e)) nodes.push_back(node + 1);
    offsets.push_back(static_cast<cgsize_t>(nodes.size()));
  }
  file.poly_section("cells", MIXED, nodes, offsets);
  const Face& wall = data.markers[0].faces[0];
  CgnsNumbers corners;
  for (const Index node : wall) corners.push_back(node + 1);
  file.section("wall", wall.size() == 3 ? TRI_3 : QUAD_4, corners, 1);
}

}  // namespace

TEST_CASE("CGNS: cells that the parents of faces alone give are those that their types give") {
  const TemporaryFolder folder;
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::hexahedra, Volumes::mixed}) {
    const MeshData data = cube(volumes == Volumes::mixed ? 4 : 2, volumes);
    write_types(folder / "types.cgns", data);
    const io::MeshFile typed = io::read_mesh(folder / "types.cgns");
    const Polyhedra all(data);
    const auto faces = static_cast<cgsize_t>(all.faces.size());
    // Cells with numbers of elements, behind the faces, and cells that are counted alone.
    for (const cgsize_t first : {faces + 1, cgsize_t{1}}) {
      for (const int container : cgns_containers) {
        CAPTURE(first);
        write_parents(folder / "a.cgns", data, all.parents(first), container);
        const io::MeshFile file = io::read_mesh(folder / "a.cgns");
        check_cells(file, data);
        CHECK(file.mesh.coordinates == typed.mesh.coordinates);
        const auto sines = [](const io::MeshFile& of) {
          return measure_quality(of.mesh).of(Metric::normalized_jacobian).statistics;
        };
        CHECK(sines(file).min == doctest::Approx(sines(typed).min).epsilon(1e-12));
        CHECK(sines(file).avg == doctest::Approx(sines(typed).avg).epsilon(1e-12));
        CHECK(file.mesh.topology->markers().size() == 1);
        CHECK(marker_named(file, "wall").faces[0].sorted() ==
              marker_named(typed, "wall").faces[0].sorted());
        io::write_mesh(folder / "b.cgns", file.mesh, file.details.get());
        CHECK(
            differences(tree_of(folder / "a.cgns").root, tree_of(folder / "b.cgns").root).empty());
      }
    }
  }
}

TEST_CASE("CGNS: a region names cells that parents give, by their numbers") {
  const TemporaryFolder folder;
  const MeshData data = cube(2, Volumes::hexahedra);
  const Polyhedra all(data);
  const auto faces = static_cast<cgsize_t>(all.faces.size());
  write_parents(folder / "a.cgns", data, all.parents(faces + 1));
  edit_node(folder / "a.cgns", "/Base/blk", [&](io::cgns::Node& zone) {
    auto part = io::cgns::make_integers("solid", "ZoneSubRegion_t", {3});
    part->children.push_back(io::cgns::make_text("GridLocation", "GridLocation_t", "CellCenter"));
    const auto first = static_cast<std::int32_t>(faces);
    part->children.push_back(
        io::cgns::make_integers("PointList", "IndexArray_t", {first + 2, first + 5}, {1, 2}));
    zone.children.push_back(part);
  });
  const io::MeshFile file = io::read_mesh(folder / "a.cgns");
  REQUIRE(file.mesh.topology->regions().size() == 1);
  const auto regions = file.mesh.topology->element_regions();
  for (Index e = 0; e < data.element_count(); ++e)
    CHECK(regions[at(e)] == (e == 1 || e == 4 ? 0 : -1));
}

TEST_CASE("CGNS: parents of faces that give no sound cells are refused with their place") {
  const TemporaryFolder folder;
  const MeshData data = cube(2, Volumes::hexahedra);
  const CgnsNumbers sound = Polyhedra(data).parents(1);
  const auto refusal = [&](const CgnsNumbers& parents) {
    write_parents(folder / "a.cgns", data, parents);
    try {
      io::read_mesh(folder / "a.cgns");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const auto replaced = [&](cgsize_t old, cgsize_t by) {
    CgnsNumbers parents = sound;
    std::ranges::replace(parents, old, by);
    return parents;
  };
  REQUIRE(refusal(sound) == "no error");
  CgnsNumbers open = sound;
  open[0] = 0;
  const std::string place = "/Base/blk/faces/ParentElements: found ";
  CHECK_CONTAINS(refusal(open), place + "cell 1, a polyhedron of 5 faces, expected tetrahedra");
  CHECK_CONTAINS(refusal(replaced(8, 7)), place + "cell 7, a polyhedron of ");
  CHECK_CONTAINS(refusal(replaced(8, -8)), place + "parent -8 of element ");
  CHECK_CONTAINS(refusal(replaced(4, 9)), "/Base/blk: found no face with the parent 4");
  CHECK_CONTAINS(refusal(replaced(8, 0)), "/Base/blk: found 7 cells in ParentElements, expected 8");
  CHECK_CONTAINS(refusal(CgnsNumbers(sound.size(), 0)), "/Base/blk: found no elements");
  edit_node(folder / "a.cgns", "/Base/blk/faces/ParentElements", [](io::cgns::Node& node) {
    node = *io::cgns::make_integers(node.name, node.label, {1, 2, 3});
  });
  CHECK_THROWS_WITH_AS(io::read_mesh(folder / "a.cgns"),
                       doctest::Contains("found 3 numbers, expected two for each of 36 faces"),
                       InputError);
}

}  // namespace winslow::test

#endif
