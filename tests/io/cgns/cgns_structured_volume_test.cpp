#ifdef WINSLOW_HAS_CGNS

#include "core/quality/quality.h"
#include "io/cgns/polyhedra_file.h"
#include "io/support/mutations.h"
#include "io/support/polyhedra_samples.h"
#include "support/paths.h"

namespace winslow::test {
namespace {

/// A block of ni by nj by nk vertices. The place of a vertex is a function of its indices from 0.
struct Block {
  Index ni, nj, nk;
  std::function<Vec3(Index, Index, Index)> place;

  void write(LibraryFile& file, const char* name) const {
    const CgnsNumbers size{ni, nj, nk, ni - 1, nj - 1, nk - 1, 0, 0, 0};
    require_cgns(cg_zone_write(file.file, file.base, name, size.data(), Structured, &file.zone));
    constexpr std::array names{"CoordinateX", "CoordinateY", "CoordinateZ"};
    for (int d = 0; d < 3; ++d) {
      std::vector<double> values;
      for (Index k = 0; k < nk; ++k)
        for (Index j = 0; j < nj; ++j)
          for (Index i = 0; i < ni; ++i) values.push_back(place(i, j, k)[d]);
      file.coordinate(names[at(d)], values);
    }
  }
  /// The six sides, as conditions at vertices.
  void write_sides(LibraryFile& file) const {
    const auto side = [&](const char* name, const CgnsNumbers& range) {
      file.condition(name, BCWall, PointRange, range, GridLocationNull, nullptr, 3);
    };
    side("i low", {1, 1, 1, 1, nj, nk});
    side("i high", {ni, 1, 1, ni, nj, nk});
    side("j low", {1, 1, 1, ni, 1, nk});
    side("j high", {1, nj, 1, ni, nj, nk});
    side("k low", {1, 1, 1, ni, nj, 1});
    side("k high", {1, 1, nk, ni, nj, nk});
  }
};

Vec3 straight(Index i, Index j, Index k) { return {1.0 * i, 2.0 * j, 0.5 * k}; }

/// All nodes of a marker have this coordinate.
bool lies_at(const io::MeshFile& file, const char* marker, int direction, double value) {
  const auto m = file.mesh.topology->markers().find(marker);
  REQUIRE(m);
  return std::ranges::all_of(file.mesh.topology->markers().nodes(*m), [&](Index node) {
    return file.mesh.coordinates.xyz(node)[direction] == value;
  });
}

std::size_t faces_of(const io::MeshFile& file, const char* marker) {
  const auto m = file.mesh.topology->markers().find(marker);
  return m ? file.mesh.topology->markers()[at(*m)].faces.size() : 0;
}

}  // namespace

TEST_CASE("CGNS: structured zones of three directions are hexahedra, and go back as they were") {
  const TemporaryFolder folder;
  for (const int container : cgns_containers) {
    {
      LibraryFile file(folder / "a.cgns", container, 3, 3);
      const Block block{4, 3, 5, straight};
      block.write(file, "blk");
      block.write_sides(file);
    }
    io::MeshFile file = io::read_mesh(folder / "a.cgns");
    CHECK(file.warnings.empty());
    const Topology& topology = *file.mesh.topology;
    CHECK(topology.node_count() == 60);
    CHECK(topology.element_count() == 24);
    CHECK(topology.element_type(0) == ElementType::hexahedron);
    CHECK(measure_quality(file.mesh).inverted == 0);
    CHECK(topology.markers().size() == 6);
    CHECK(topology.markers().unmarked_faces() == 0);
    CHECK(faces_of(file, "i low") == 8);
    CHECK(faces_of(file, "j high") == 12);
    CHECK(faces_of(file, "k high") == 6);
    CHECK(lies_at(file, "i high", 0, 3));
    CHECK(lies_at(file, "j high", 1, 4));
    CHECK(lies_at(file, "k high", 2, 2));

    io::write_mesh(folder / "same.cgns", file.mesh, file.details.get());
    CHECK(differences(tree_of(folder / "a.cgns").root, tree_of(folder / "same.cgns").root).empty());
    // Vertex (2, 3, 4) is number 1 + 4 * (2 + 3 * 3) from 0.
    const Index moved = 1 + 4 * (2 + 3 * 3);
    CHECK(file.mesh.coordinates.xyz(moved) == straight(1, 2, 3));
    file.mesh.coordinates.set_xyz(moved, {1.25, 4, 1.5});
    io::write_mesh(folder / "b.cgns", file.mesh, file.details.get());
    CHECK(differences(tree_of(folder / "a.cgns").root, tree_of(folder / "b.cgns").root).size() ==
          1);
    const io::cgns::NodePtr root = tree_of(folder / "b.cgns").root;
    const auto x = io::cgns::reals_of(node_at(root, "/Base/blk/GridCoordinates/CoordinateX"));
    CHECK(x[at(moved)] == 1.25);
  }
}

TEST_CASE("CGNS: a structured zone one cell thick, also with left-handed indices") {
  const TemporaryFolder folder;
  for (const bool left_handed : {false, true}) {
    {
      LibraryFile file(folder / "a.cgns", CG_FILE_HDF5, 3, 3);
      const Block block{5, 4, 2, [&](Index i, Index j, Index k) {
                          return Vec3(1.0 * i, 1.0 * j, left_handed ? -0.1 * k : 0.1 * k);
                        }};
      block.write(file, "blk");
      block.write_sides(file);
    }
    const io::MeshFile file = io::read_mesh(folder / "a.cgns");
    CHECK(file.warnings.empty());
    CHECK(file.mesh.topology->element_count() == 12);
    CHECK(measure_quality(file.mesh).inverted == 0);
    CHECK(faces_of(file, "k low") == 12);
    CHECK(faces_of(file, "i low") == 3);
    CHECK(file.mesh.topology->markers().unmarked_faces() == 0);
  }
}

TEST_CASE("CGNS: faces of a structured zone in every way of the standard") {
  const TemporaryFolder folder;
  const Block block{3, 3, 2, straight};
  {
    LibraryFile file(folder / "a.cgns", CG_FILE_HDF5, 3, 3);
    block.write(file, "blk");
    // Two cells in each of i and j, one in k.
    file.condition("i low", BCWall, PointRange, {1, 1, 1, 1, 2, 1}, FaceCenter, nullptr, 3);
    file.condition("k high", BCWall, PointList, {1, 1, 2, 2, 1, 2, 1, 2, 2, 2, 2, 2}, FaceCenter,
                   nullptr, 3);
    // A single face: the side on which it can be decides.
    file.condition("one", BCWall, PointRange, {3, 2, 1, 3, 2, 1}, FaceCenter, nullptr, 3);
    file.condition("line", BCWall, PointRange, {1, 1, 1, 3, 1, 1}, GridLocationNull, nullptr, 3);
    CgnsNumbers vertices;
    for (cgsize_t k = 1; k <= 2; ++k)
      for (cgsize_t i = 1; i <= 3; ++i) vertices.insert(vertices.end(), {i, 3, k});
    file.condition("j high", BCWall, PointList, vertices, Vertex, nullptr, 3);
  }
  edit_node(folder / "a.cgns", "/Base/blk/ZoneBC/i low/GridLocation", [](io::cgns::Node& node) {
    node = *io::cgns::make_text(node.name, node.label, "IFaceCenter");
  });
  const io::MeshFile file = io::read_mesh(folder / "a.cgns");
  CHECK(faces_of(file, "i low") == 2);
  CHECK(lies_at(file, "i low", 0, 0));
  CHECK(faces_of(file, "k high") == 4);
  CHECK(lies_at(file, "k high", 2, 0.5));
  CHECK(faces_of(file, "one") == 1);
  CHECK(lies_at(file, "one", 0, 2));
  CHECK(faces_of(file, "j high") == 2);
  CHECK(any_contains(file.warnings, "is no side of the zone, (1, 1, 1) to (3, 1, 1)"));
  CHECK_FALSE(file.mesh.topology->markers().find("line"));
  edit_node(folder / "a.cgns", "/Base/blk/ZoneBC/one/PointRange",
            [](io::cgns::Node& node) { node.data[0] = 9; });
  CHECK_THROWS_WITH_AS(io::read_mesh(folder / "a.cgns"),
                       doctest::Contains("found index (9, 2, 1), expected (1, 1, 1) to (3, 3, 2)"),
                       InputError);
}

TEST_CASE("CGNS: the cut of an O-grid in space is closed") {
  const TemporaryFolder folder;
  {
    LibraryFile file(folder / "a.cgns", CG_FILE_HDF5, 3, 3);
    const Block ring{9, 3, 3, [](Index i, Index j, Index k) {
                       const double angle = 2 * pi * (i % 8) / 8, r = 1 + 0.5 * j;
                       return Vec3(r * std::cos(angle), r * std::sin(angle), 1.0 * k);
                     }};
    ring.write(file, "ring");
    const CgnsNumbers range{1, 1, 1, 1, 3, 3}, donor{9, 1, 1, 9, 3, 3};
    const std::array<int, 3> transform{1, 2, 3};
    int number = 0;
    require_cgns(cg_1to1_write(file.file, file.base, file.zone, "cut", "ring", range.data(),
                               donor.data(), transform.data(), &number));
    ring.write_sides(file);
  }
  const io::MeshFile file = io::read_mesh(folder / "a.cgns");
  CHECK(file.mesh.topology->node_count() == 8 * 9);
  CHECK(file.mesh.topology->element_count() == 32);
  CHECK(measure_quality(file.mesh).inverted == 0);
  CHECK(faces_of(file, "j low") == 16);
  edit_node(folder / "a.cgns", "/Base/ring/ZoneGridConnectivity/cut/Transform",
            [](io::cgns::Node& node) { node.data[4] = 3; });
  CHECK_THROWS_WITH_AS(io::read_mesh(folder / "a.cgns"),
                       doctest::Contains("do not fit a zone of three indices"), InputError);
}

TEST_CASE("CGNS: a condition on the faces of a section of cells and faces has its own name") {
  const TemporaryFolder folder;
  const MeshData data = cube(1, Volumes::hexahedra);
  {
    LibraryFile file(folder / "a.cgns", CG_FILE_HDF5, 3, 3);
    write_places(file, data);
    CgnsNumbers nodes{HEXA_8}, offsets{0};
    for (const Index node : data.element(0)) nodes.push_back(node + 1);
    offsets.push_back(static_cast<cgsize_t>(nodes.size()));
    for (const Marker& marker : data.markers) {
      for (const Face& face : marker.faces) {
        nodes.push_back(QUAD_4);
        for (const Index node : face) nodes.push_back(node + 1);
        offsets.push_back(static_cast<cgsize_t>(nodes.size()));
      }
    }
    file.poly_section("El", MIXED, nodes, offsets);
    file.condition("all", BCWall, PointRange, {2, 7}, FaceCenter);
  }
  const io::MeshFile file = io::read_mesh(folder / "a.cgns");
  CHECK(faces_of(file, "all") == 6);
  CHECK(file.mesh.topology->markers().size() == 1);
}

TEST_CASE("CGNS: what a zone of several is refused for comes with the way to the others") {
  const TemporaryFolder folder;
  {
    LibraryFile file(folder / "a.cgns", CG_FILE_HDF5, 3, 3);
    Block{2, 2, 2, straight}.write(file, "a");
    Block{2, 2, 2, [](Index, Index, Index) { return Vec3(0, 0, 0); }}.write(file, "b");
    file.section("cells", HEXA_27, cgns_range(1, 27), 1);
  }
  CHECK(io::read_mesh(folder / "a.cgns", {.zone = 1}).mesh.topology->element_count() == 1);
  edit_node(folder / "a.cgns", "/Base/b/ZoneType", [](io::cgns::Node& node) {
    node = *io::cgns::make_text(node.name, node.label, "Chimera");
  });
  CHECK_THROWS_WITH_AS(io::read_mesh(folder / "a.cgns", {.zone = 2}),
                       doctest::Contains("(zone 2 of 2; --zone N reads another one alone)"),
                       InputError);
}

namespace {

/// A copy of a tree in which some bytes of data are others.
io::cgns::NodePtr damaged(const io::cgns::Node& node, Random& random, Index odds) {
  auto copy = std::make_shared<io::cgns::Node>(node);
  if (!copy->data.empty() && copy->type != "C1" && random.index(odds) == 0) {
    const auto place = at(random.index(static_cast<Index>(copy->data.size())));
    copy->data[place] =
        static_cast<char>(random.index(3) == 0 ? random.index(256) : copy->data[place] ^ 1);
  }
  for (io::cgns::NodePtr& child : copy->children) child = damaged(*child, random, odds);
  return copy;
}

}  // namespace

TEST_CASE("CGNS: damaged numbers of structured zones and polyhedra give a mesh or an InputError") {
  const TemporaryFolder folder;
  {
    LibraryFile file(folder / "0.cgns", CG_FILE_ADF, 3, 3);
    const Block block{3, 3, 2, straight};
    block.write(file, "blk");
    block.write_sides(file);
    const CgnsNumbers range{1, 1, 1, 1, 3, 2}, donor{3, 1, 1, 3, 3, 2};
    const std::array<int, 3> transform{1, 2, 3};
    int number = 0;
    require_cgns(cg_1to1_write(file.file, file.base, file.zone, "cut", "blk", range.data(),
                               donor.data(), transform.data(), &number));
  }
  const MeshData data = cube(1, Volumes::pyramids);
  {
    LibraryFile file(folder / "1.cgns", CG_FILE_ADF, 3, 3);
    write_places(file, data);
    write_polyhedra(file, data, false);
  }
  write_parents(folder / "2.cgns", data, Polyhedra(data).parents(1), CG_FILE_ADF);
  const MeshData prisms = stacked_prisms(5);
  {
    LibraryFile file(folder / "3.cgns", CG_FILE_ADF, 3, 3);
    write_places(file, prisms);
    write_polyhedra(file, prisms, false);
  }
  write_parents(folder / "4.cgns", prisms, Polyhedra(prisms).parents(1), CG_FILE_ADF);
  for (const char* name : {"0.cgns", "1.cgns", "2.cgns", "3.cgns", "4.cgns"}) {
    const io::cgns::NodePtr root = tree_of(folder / name).root;
    int meshes = 0, refused = 0;
    for (std::uint64_t seed = 0; seed < mutation_count(300); ++seed) {
      CAPTURE(name);
      CAPTURE(seed);
      Random random(seed);
      const io::cgns::NodePtr tree = damaged(*root, random, 8);
      write_text(folder / "d.cgns", io::cgns::write_tree(*tree, io::cgns::Container::adf));
      try {
        io::read_mesh(folder / "d.cgns");
        ++meshes;
      } catch (const InputError&) {
        ++refused;
      }
    }
    MESSAGE(meshes, " meshes, ", refused, " refused");
    CHECK(meshes > 5);
    CHECK(refused > 20);
  }
}

}  // namespace winslow::test

#endif
