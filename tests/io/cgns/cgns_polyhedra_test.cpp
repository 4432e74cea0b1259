#ifdef WINSLOW_HAS_CGNS

#include <set>

#include "core/quality/quality.h"
#include "io/cgns/polyhedra_file.h"
#include "io/support/polyhedra_samples.h"

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

TEST_CASE("CGNS: faces that bound no cell, and that a zone does not have, are refused by number") {
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
                 "/Base/blk/cells: found 1 face at the edge between nodes ");
  CHECK_CONTAINS(refusal({1, 2, 3, 4, 5}),
                 " in element 7, a polyhedron, expected two: the faces of a cell close");
  CHECK_CONTAINS(refusal({1, 2, 3, 4, 5, 5}), "at the edge between nodes ");
  CHECK_CONTAINS(
      refusal({1, 2, 3, 4, 5, 5, 5}),
      "/Base/blk/cells/ElementConnectivity: found face 5 in element 7, which two cells have "
      "already, expected at most two cells at a face");
  CHECK_CONTAINS(refusal({1, 2, 3}), "found 3 faces in element 7, a polyhedron, expected four");
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
  CHECK_CONTAINS(refusal(open), place + "1 face at the edge between nodes ");
  CHECK_CONTAINS(refusal(open), " in cell 1, a polyhedron, expected two");
  CHECK_CONTAINS(refusal(replaced(8, 7)), " in cell 7, a polyhedron, expected two");
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

TEST_CASE("CGNS: cells of any faces, before the faces and behind them") {
  const TemporaryFolder folder;
  for (const PolyhedraSample& sample : polyhedra_samples()) {
    CAPTURE(sample.name);
    const Mesh mesh = make_mesh(sample.data);
    for (const bool cells_first : {false, true}) {
      {
        LibraryFile file(folder / "a.cgns", CG_FILE_HDF5, 3, 3);
        write_places(file, sample.data);
        write_polyhedra(file, sample.data, cells_first);
      }
      const io::MeshFile file = io::read_mesh(folder / "a.cgns");
      check_same_cells(file.mesh, mesh);
      CHECK_FALSE(any_contains(file.warnings, "turned"));
      CHECK(marker_named(file, "wall").faces.size() == 1);
      CHECK(file.mesh.topology->markers().size() == 1);
      io::write_mesh(folder / "b.cgns", file.mesh, file.details.get());
      CHECK(differences(tree_of(folder / "a.cgns").root, tree_of(folder / "b.cgns").root).empty());
    }
    write_parents(folder / "a.cgns", sample.data, Polyhedra(sample.data).parents(1));
    check_same_cells(io::read_mesh(folder / "a.cgns").mesh, mesh);
  }
}

namespace {

/// Writes faces, and the cells by the signed numbers of these.
void write_cells_of_faces(const std::filesystem::path& path, const MeshData& data,
                          const Polyhedra& all) {
  LibraryFile file(path, CG_FILE_HDF5, 3, 3);
  write_places(file, data);
  write_faces(file, all);
  CgnsNumbers sides, starts{0};
  for (const auto& cell : all.cells) {
    sides.insert(sides.end(), cell.begin(), cell.end());
    starts.push_back(static_cast<cgsize_t>(sides.size()));
  }
  file.poly_section("cells", NFACE_n, sides, starts);
}

}  // namespace

TEST_CASE("CGNS: signs of faces that are turned, all of a cell or some") {
  const MeshData data = stacked_prisms(7);
  const Mesh mesh = make_mesh(data);
  const TemporaryFolder folder;
  const auto read = [&](const Polyhedra& all) {
    write_cells_of_faces(folder / "a.cgns", data, all);
    return io::read_mesh(folder / "a.cgns");
  };
  Polyhedra inside(data);
  for (cgsize_t& face : inside.cells[1]) face = -face;
  const io::MeshFile whole = read(inside);
  check_same_cells(whole.mesh, mesh);
  CHECK(any_contains(whole.warnings, "1 elements with mirrored corners were turned inside out"));
  Polyhedra some(data);
  some.cells[0][2] = -some.cells[0][2];
  some.cells[1][4] = -some.cells[1][4];
  const io::MeshFile turned = read(some);
  check_same_cells(turned.mesh, mesh);
  CHECK(any_contains(turned.warnings, "2 cells have faces of which the signs (NFACE_n) or the"));
}

TEST_CASE("CGNS: a face of three cells and a polygon of two corners are refused") {
  const MeshData data = stacked_prisms(5);
  const TemporaryFolder folder;
  const auto refusal = [&](const std::function<void(Polyhedra&)>& damage) {
    Polyhedra all(data);
    damage(all);
    write_cells_of_faces(folder / "a.cgns", data, all);
    try {
      io::read_mesh(folder / "a.cgns");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  CHECK_CONTAINS(
      refusal([](Polyhedra& all) { all.cells.push_back(all.cells[1]); }),
      "/Base/blk/cells/ElementConnectivity: found face -2 in element 16, which two cells "
      "have already, expected at most two cells at a face");
  CHECK_CONTAINS(refusal([](Polyhedra& all) { all.faces[3] = Face(0, 1); }),
                 "/Base/blk/faces: found element 4 with 2 corners, expected three or more");
  CHECK_CONTAINS(
      refusal([](Polyhedra& all) { all.faces[3] = Face(0, 1, 0, 6); }),
      "/Base/blk/cells: found a face with a node twice: nodes 1, 2, 1 and 7 in element 14");
}

TEST_CASE("CGNS: a condition at vertices finds the polygons of polyhedra") {
  const MeshData data = stacked_prisms(6);
  const TemporaryFolder folder;
  {
    LibraryFile file(folder / "a.cgns", CG_FILE_HDF5, 3, 3);
    write_places(file, data);
    const Polyhedra all(data);
    write_faces(file, all);
    CgnsNumbers sides, starts{0};
    for (const auto& cell : all.cells) {
      sides.insert(sides.end(), cell.begin(), cell.end());
      starts.push_back(static_cast<cgsize_t>(sides.size()));
    }
    file.poly_section("cells", NFACE_n, sides, starts);
    file.condition("lid", BCWall, PointList, {13, 14, 15, 16, 17, 18}, Vertex, "Lid");
  }
  const io::MeshFile file = io::read_mesh(folder / "a.cgns");
  const Marker& lid = marker_named(file, "Lid");
  REQUIRE(lid.faces.size() == 1);
  CHECK(lid.faces[0].size() == 6);
}

TEST_CASE("CGNS: a mesh with polyhedra is written as NGON_n with parents and NFACE_n") {
  const TemporaryFolder folder;
  const MeshData data = with_odd_numbers(all_types(), 8);
  const Mesh mesh = make_mesh(data);
  io::write_mesh(folder / "a.cgns", mesh, nullptr);
  int file = 0;
  require_cgns(cg_open((folder / "a.cgns").c_str(), CG_MODE_READ, &file));
  int sections = 0;
  require_cgns(cg_nsections(file, 1, 1, &sections));
  REQUIRE(sections == 2);
  std::array<CgnsNumbers, 2> entries, starts;
  CgnsNumbers parents;
  for (const int section : {1, 2}) {
    std::array<char, 33> name{};
    ElementType_t type = ElementTypeNull;
    cgsize_t first = 0, last = 0, size = 0;
    int boundary = 0, parent = 0;
    require_cgns(cg_section_read(file, 1, 1, section, name.data(), &type, &first, &last, &boundary,
                                 &parent));
    CHECK(parent == (section == 1 ? 1 : 0));
    CHECK(type == (section == 1 ? NGON_n : NFACE_n));
    const Index faces = mesh.topology->face_count();
    CHECK(first == (section == 1 ? 1 : faces + 1));
    CHECK(last == (section == 1 ? faces : faces + mesh.topology->element_count()));
    require_cgns(cg_ElementDataSize(file, 1, 1, section, &size));
    const auto s = at(section - 1);
    entries[s].resize(static_cast<std::size_t>(size));
    starts[s].resize(static_cast<std::size_t>(last - first + 2));
    if (section == 1) parents.resize(4 * static_cast<std::size_t>(faces));
    require_cgns(cg_poly_elements_read(file, 1, 1, section, entries[s].data(), starts[s].data(),
                                       section == 1 ? parents.data() : nullptr));
  }
  cg_close(file);
  // The faces of each cell, by the sections and by the parents.
  const std::size_t faces = starts[0].size() - 1;
  std::vector<std::set<cgsize_t>> of_parents(starts[1].size() - 1);
  for (std::size_t k = 0; k < 2 * faces; ++k) {
    if (parents[k] == 0) continue;
    const auto face = static_cast<cgsize_t>(k % faces) + 1;
    const std::size_t cell = static_cast<std::size_t>(parents[k]) - faces - 1;
    of_parents[cell].insert(k < faces ? face : -face);
    // The second half is the place of the face in the list of the cell, from 1 on.
    const cgsize_t place = starts[1][cell] + parents[2 * faces + k] - 1;
    CHECK(entries[1][static_cast<std::size_t>(place)] == (k < faces ? face : -face));
  }
  for (std::size_t c = 0; c < of_parents.size(); ++c) {
    const auto begin = entries[1].begin() + starts[1][c],
               end = entries[1].begin() + starts[1][c + 1];
    CHECK(std::set<cgsize_t>(begin, end) == of_parents[c]);
    std::set<Face> found;
    std::for_each(begin, end, [&](cgsize_t face) {
      const auto f = static_cast<std::size_t>(std::abs(face)) - 1;
      std::vector<Index> nodes;
      for (cgsize_t k = starts[0][f]; k < starts[0][f + 1]; ++k)
        nodes.push_back(static_cast<Index>(entries[0][static_cast<std::size_t>(k)]) - 1);
      found.insert(Face(std::span<const Index>(nodes)).sorted());
    });
    std::set<Face> expected;
    for (const Face& face : faces_of(data, static_cast<Index>(c))) expected.insert(face.sorted());
    CHECK(found == expected);
  }
}

TEST_CASE("CGNS: markers that share faces or lie between cells, offsets of CGNS 4, one cell") {
  const TemporaryFolder folder;
  MeshData data = stacked_prisms(9);
  // Between the two cells, and once more the lid with a part of the side.
  data.markers.push_back({"middle", 4, {faces_of(data, 0)[1].reversed()}});
  data.markers.push_back({"some", 5, {data.markers[2].faces[0], data.markers[1].faces[3]}});
  const Mesh mesh = make_mesh(data);
  io::write_mesh(folder / "a.cgns", mesh, nullptr);
  const io::MeshFile file = io::read_mesh(folder / "a.cgns");
  check_same_cells(file.mesh, mesh);
  REQUIRE(file.mesh.topology->markers().size() == 5);
  for (const Marker& marker : data.markers) {
    const Marker& found = marker_named(file, marker.name);
    REQUIRE(found.faces.size() == marker.faces.size());
    for (std::size_t f = 0; f < marker.faces.size(); ++f)
      CHECK(found.faces[f].sorted() == marker.faces[f].sorted());
  }
  // The file is of CGNS 4 now, and its zone gets other cells: offsets stand beside the entries.
  edit_node(folder / "a.cgns", "/CGNSLibraryVersion", [](io::cgns::Node& node) {
    node = *io::cgns::make_single_reals(node.name, node.label, {3.4F});
  });
  for (const char* section : {"NgonElements", "NfaceElements"})
    edit_node(folder / "a.cgns", "/Base/Zone/" + std::string(section), [](io::cgns::Node& node) {
      const auto mixed_in =
          io::cgns::integers_of(*io::cgns::child_named(node, "ElementConnectivity"));
      std::vector<std::int32_t> entries, starts{0};
      for (std::size_t k = 0; k < mixed_in.size();) {
        const auto size = static_cast<std::size_t>(mixed_in[k++]);
        for (std::size_t n = 0; n < size; ++n)
          entries.push_back(static_cast<std::int32_t>(mixed_in[k++]));
        starts.push_back(static_cast<std::int32_t>(entries.size()));
      }
      for (io::cgns::NodePtr& child : node.children)
        if (child->name == "ElementConnectivity")
          child = io::cgns::make_integers(child->name, child->label, entries);
      node.children.push_back(io::cgns::make_integers("ElementStartOffset", "DataArray_t", starts));
    });
  const io::MeshFile offsets = io::read_mesh(folder / "a.cgns");
  check_same_cells(offsets.mesh, mesh);
  const Mesh other = make_mesh(stacked_prisms(8));
  io::write_mesh(folder / "b.cgns", other, offsets.details.get());
  node_at(tree_of(folder / "b.cgns").root, "/Base/Zone/NgonElements/ElementStartOffset");
  check_same_cells(io::read_mesh(folder / "b.cgns").mesh, other);
  // The only section of a mesh of one cell is no marker.
  MeshData one;
  one.coordinates = data.coordinates;
  one.add_polyhedron(faces_of(data, 0));
  io::write_mesh(folder / "c.cgns", make_mesh(one), nullptr);
  CHECK_FALSE(io::read_mesh(folder / "c.cgns").mesh.topology->markers().from_file());
}

}  // namespace winslow::test

#endif
