#ifdef WINSLOW_HAS_CGNS

#include "io/cgns/library_file.h"

namespace winslow::test {

TEST_CASE("CGNS: sections of every kind give the same mesh") {
  const MeshData data = cgns_square();
  const Mesh expected = make_mesh(data);
  for (const int container : cgns_containers) {
    const TemporaryFolder folder;
    {
      // One section for each run of elements of one type.
      LibraryFile file(folder / "runs.cgns", container);
      file.start_zone("z", data.node_count(), data.element_count());
      file.coordinates(data.coordinates);
      for (Index e = 0; e < data.element_count();) {
        const ElementType type = data.types[at(e)];
        const std::string name = "s" + std::to_string(e);
        CgnsNumbers nodes;
        cgsize_t count = 0;
        for (; e < data.element_count() && data.types[at(e)] == type; ++e, ++count)
          for (const Index node : data.element(e)) nodes.push_back(node + 1);
        file.section(name.c_str(), type == ElementType::triangle ? TRI_3 : QUAD_4, nodes, count);
      }
      for (const Marker& marker : data.markers) file.lines(marker.name.c_str(), marker.faces);
    }
    {
      LibraryFile file(folder / "polygons.cgns", container);
      file.start_zone("z", data.node_count(), data.element_count());
      file.coordinates(data.coordinates);
      CgnsNumbers nodes, offsets{0};
      for (Index e = 0; e < data.element_count(); ++e) {
        for (const Index node : data.element(e)) nodes.push_back(node + 1);
        offsets.push_back(static_cast<cgsize_t>(nodes.size()));
      }
      file.poly_section("polygons", NGON_n, nodes, offsets);
      for (const Marker& marker : data.markers) file.lines(marker.name.c_str(), marker.faces);
    }
    for (const char* name : {"runs.cgns", "polygons.cgns"}) {
      CAPTURE(name);
      const io::MeshFile file = io::read_mesh(folder / name);
      check_same_mesh(file.mesh, expected);  // markers are named by their sections
      io::write_mesh(folder / "again.cgns", file.mesh, file.details.get());
      CHECK(differences(tree_of(folder / name).root, tree_of(folder / "again.cgns").root).empty());
    }
  }
}

TEST_CASE("CGNS: polygons as CGNS 3 has them, with their numbers of corners between") {
  const TemporaryFolder folder;
  const MeshData data = cgns_square();
  write_square(folder / "a.cgns", CG_FILE_HDF5, data);
  auto file = tree_of(folder / "a.cgns");
  std::vector<std::int32_t> nodes;
  for (Index e = 0; e < data.element_count(); ++e) {
    nodes.push_back(static_cast<std::int32_t>(data.element(e).size()));
    for (const Index node : data.element(e)) nodes.push_back(node + 1);
  }
  auto section = io::cgns::make_integers("cells", "Elements_t", {NGON_n, 0});
  section->children = {
      io::cgns::make_integers("ElementRange", "IndexRange_t", {1, data.element_count()}),
      io::cgns::make_integers("ElementConnectivity", "DataArray_t", nodes)};
  const auto& base = node_at(file.root, "/Base");
  const auto& zone = node_at(file.root, "/Base/blk");
  const auto& cells = node_at(file.root, "/Base/blk/cells");
  const auto root = io::cgns::with_child(
      *file.root, base,
      io::cgns::with_child(base, zone, io::cgns::with_child(zone, cells, section)));
  write_text(folder / "b.cgns", io::cgns::write_tree(*root, file.container));
  check_same_mesh(io::read_mesh(folder / "b.cgns").mesh, make_mesh(data));
}

TEST_CASE("CGNS: boundary conditions say in every way of the standard where they are") {
  const MeshData data = cgns_square();
  const Marker& wall = data.markers[0];
  const auto count = static_cast<cgsize_t>(wall.faces.size());
  CgnsNumbers nodes;
  for (Index i = 0; i < data.node_count(); ++i)
    if (data.coordinates.xy(i).y() == 0) nodes.push_back(i + 1);
  struct Case {
    const char* name;  ///< of the point set
    bool range, by_nodes;
    GridLocation_t location;
  };
  const std::vector<Case> cases{{"PointRange", true, false, EdgeCenter},
                                {"PointList", false, false, EdgeCenter},
                                {"PointRange", true, false, FaceCenter},
                                {"PointList", false, false, FaceCenter},
                                {"PointList", false, true, Vertex},
                                {"PointList", false, true, GridLocationNull},
                                // Some programs list elements without saying so.
                                {"PointList", false, false, GridLocationNull},
                                {"ElementRange", true, false, GridLocationNull},
                                {"ElementList", false, false, GridLocationNull}};
  for (const Case& c : cases) {
    CAPTURE(std::string(c.name));
    CAPTURE(c.by_nodes);
    CAPTURE(static_cast<int>(c.location));
    const TemporaryFolder folder;
    {
      LibraryFile file(folder / "a.cgns", CG_FILE_HDF5);
      file.start_zone("z", data.node_count(), data.element_count());
      file.coordinates(data.coordinates);
      write_mixed(file, data);
      const cgsize_t first = file.next;
      file.lines("lower", wall.faces);
      file.lines("rest", data.markers[1].faces);
      // No vertex has numbers as high as these, so that they must be elements.
      REQUIRE(first + count - 1 > data.node_count());
      const CgnsNumbers points = c.by_nodes ? nodes
                                 : c.range  ? CgnsNumbers{first, first + count - 1}
                                            : cgns_range(first, count);
      file.condition("bc", BCWall, c.range ? PointRange : PointList, points,
                     c.location == FaceCenter ? EdgeCenter : c.location, "body");
    }
    // libcgns writes no FaceCenter here and no element sets; programs of old did.
    const std::string bc = "/Base/z/ZoneBC/bc/";
    edit_node(folder / "a.cgns", bc + (c.range ? "PointRange" : "PointList"),
              [&](io::cgns::Node& node) { node.name = c.name; });
    if (c.location == FaceCenter) {
      edit_node(folder / "a.cgns", bc + "GridLocation",
                [](io::cgns::Node& node) { node.data = "FaceCenter"; });
    }
    const io::MeshFile file = io::read_mesh(folder / "a.cgns");
    REQUIRE(file.mesh.topology->markers().size() == 2);
    std::vector<Face> found, expected;
    for (const Face& face : marker_named(file, "body").faces) found.push_back(face.sorted());
    for (const Face& face : wall.faces) expected.push_back(face.sorted());
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    CHECK(found == expected);
    // What no condition covers is a marker by the name of its section.
    CHECK(marker_named(file, "rest").faces == data.markers[1].faces);
    const bool unsaid = c.location == GridLocationNull && !c.by_nodes && c.name[0] == 'P';
    CHECK(any_contains(file.warnings, "taken for elements") == unsaid);
  }
}

TEST_CASE("CGNS: markers have the name of the family, or of the condition") {
  const MeshData data = cgns_square();
  const auto& faces = data.markers[1].faces;
  const TemporaryFolder folder;
  {
    LibraryFile file(folder / "a.cgns", CG_FILE_HDF5);
    file.start_zone("z", data.node_count(), data.element_count());
    file.coordinates(data.coordinates);
    write_mixed(file, data);
    const cgsize_t first = file.next, half = static_cast<cgsize_t>(faces.size()) / 2;
    file.lines("all of far", faces);
    file.condition("p1", BCFarfield, PointRange, {first, first + half - 1}, EdgeCenter, "outer");
    file.condition("p2", BCFarfield, PointRange, {first + half, file.next - 2}, EdgeCenter,
                   "outer");
    file.condition("p3", BCFarfield, PointRange, {file.next - 1, file.next - 1}, EdgeCenter);
    const cgsize_t wall = file.next;
    file.lines("wall", data.markers[0].faces);
    file.condition("wall-wall", BCWall, PointRange, {wall, file.next - 1}, EdgeCenter);
    file.condition("nowhere", BCDegeneratePoint, PointList, {1}, Vertex);
  }
  const io::MeshFile file = io::read_mesh(folder / "a.cgns");
  CHECK(any_contains(file.warnings, "\"nowhere\" covers no edge"));
  CHECK(marker_named(file, "outer").faces.size() == faces.size() - 1);
  CHECK(marker_named(file, "p3").faces == std::vector<Face>{faces.back()});
  CHECK(marker_named(file, "wall-wall").faces == data.markers[0].faces);
  CHECK(file.mesh.topology->markers().size() == 3);
}

}  // namespace winslow::test

#endif
