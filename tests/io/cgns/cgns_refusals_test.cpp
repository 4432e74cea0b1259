#include "io/support/samples.h"

#ifdef WINSLOW_HAS_CGNS

#include "io/cgns/cgns.h"
#include "io/cgns/library_file.h"
#include "io/support/mutations.h"

namespace winslow::test {
namespace {

/// What the InputError of a file says, without its folder; `write` fills the file.
std::string refusal(const std::function<void(const std::filesystem::path&)>& write) {
  const TemporaryFolder folder;
  const auto path = folder / "a.cgns";
  write(path);
  try {
    io::read_mesh(path);
  } catch (const InputError& error) {
    const std::string what = error.what();
    REQUIRE(what.starts_with(path.string()));
    return what.substr(folder.path().string().size() + 1);
  }
  FAIL("nothing was refused");
  return {};
}

const MeshData& plain_square() {
  static const MeshData data = [] {
    MeshData square = grid_with_holes(3, Cells::quads, [](Index, Index) { return false; });
    mark_boundary(square, [](const Vec2&) { return std::string("wall"); });
    return square;
  }();
  return data;
}

/// The square with other elements than its own.
std::string refusal_of_section(ElementType_t type, const CgnsNumbers& nodes, cgsize_t count) {
  return refusal([&](const auto& path) {
    LibraryFile file(path, CG_FILE_HDF5);
    file.start_zone("blk", plain_square().node_count(), static_cast<Index>(count));
    file.coordinates(plain_square().coordinates);
    file.section("cells", type, nodes, count);
  });
}

std::string square_bytes(int container) {
  const TemporaryFolder folder;
  {
    const MeshData& data = plain_square();
    LibraryFile file(folder / "a.cgns", container);
    file.start_zone("blk", data.node_count(), data.element_count());
    file.coordinates(data.coordinates);
    write_mixed(file, data);
    const cgsize_t first = file.next;
    file.lines("wall", data.markers[0].faces);
    file.condition("bc", BCWall, PointRange, {first, file.next - 1}, EdgeCenter, "wall");
  }
  return read_text(folder / "a.cgns");
}

}  // namespace

TEST_CASE("CGNS: what is refused is named, with what was expected") {
  CHECK(refusal([](const auto& path) {
          LibraryFile file(path, CG_FILE_HDF5, 3, 3);
          file.start_zone("blk", 8, 1);
        }) == "a.cgns: /Base/blk: found no GridCoordinates, expected coordinates");
  CHECK(refusal([](const auto& path) {
          LibraryFile file(path, CG_FILE_HDF5, 1, 3);
          file.start_zone("blk", 8, 1);
        }) == "a.cgns: /Base: found CellDimension 1, expected 2 or 3");
  CHECK(refusal([](const auto& path) { LibraryFile file(path, CG_FILE_ADF); }) ==
        "a.cgns: /: found no Zone_t node in any base, expected a mesh");
  const std::string second = refusal_of_section(QUAD_9, cgns_range(1, 9), 1);
  CHECK_CONTAINS(second,
                 "a.cgns: /Base/blk/cells: found QUAD_9 (second or higher order), expected BAR_2, "
                 "TRI_3, QUAD_4, MIXED or NGON_n of them; Gmsh makes elements of first order: echo "
                 "'Merge \"a.cgns\"; SetOrder 1;");
  CHECK_CONTAINS(refusal_of_section(TETRA_4, cgns_range(1, 4), 1), "found TETRA_4 (a 3D mesh)");
  CHECK(refusal_of_section(TRI_3, {1, 2, 17}, 1) ==
        "a.cgns: /Base/blk/cells/ElementConnectivity: found vertex 17 in element 1, expected 1 to "
        "16");
  CHECK_CONTAINS(refusal_of_section(BAR_2, {1, 2}, 1), "/Base/blk: found no elements");
  CHECK(refusal([](const auto& path) {
          LibraryFile file(path, CG_FILE_HDF5);
          file.start_zone("blk", 16, 1);
          file.coordinates(plain_square().coordinates);
          file.poly_section("cells", NGON_n, {1, 2, 3, 7, 6}, {0, 5});
        }) ==
        "a.cgns: /Base/blk/cells: found element 1 with 5 corners, expected triangles and "
        "quadrilaterals");
  CHECK(refusal([](const auto& path) {
          LibraryFile file(path, CG_FILE_HDF5);
          file.start_zone("blk", 16, 9);
          file.coordinate("CoordinateR", std::vector<double>(16, 1.0));
          file.coordinate("CoordinateTheta", std::vector<double>(16, 1.0));
          write_mixed(file, plain_square());
        }) ==
        "a.cgns: /Base/blk/GridCoordinates: found CoordinateR, CoordinateTheta, expected "
        "CoordinateX and CoordinateY");
  CHECK_CONTAINS(
      refusal([](const auto& path) {
        LibraryFile file(path, CG_FILE_HDF5, 2, 3);
        file.start_zone("blk", 16, 9);
        file.coordinates(plain_square().coordinates);
        std::vector<double> z(16, 0.0);
        z[7] = 0.5;
        file.coordinate("CoordinateZ", z);
        write_mixed(file, plain_square());
      }),
      "a.cgns: /Base/blk/GridCoordinates: found z = 0.5 after z = 0 (a surface in space)");
  CHECK(refusal([](const auto& path) {
          LibraryFile file(path, CG_FILE_HDF5);
          file.start_zone("blk", 16, 9);
          file.coordinates(plain_square().coordinates);
          write_mixed(file, plain_square());
          file.lines("wall", plain_square().markers[0].faces);
          file.condition("bc", BCWall, PointList, {10, 99}, EdgeCenter);
        }) ==
        "a.cgns: /Base/blk/ZoneBC/bc/PointList: found element 99, expected 1 to 21, as the "
        "sections have them");
  // What make_mesh refuses is named by its zone.
  CHECK_CONTAINS(refusal_of_section(TRI_3, {1, 2, 2}, 1), "a.cgns: /Base/blk: element 0 ");
}

TEST_CASE("CGNS: what is no CGNS file is refused") {
  const std::string hdf5 = square_bytes(CG_FILE_HDF5), adf = square_bytes(CG_FILE_ADF);
  for (const std::string& bytes : {hdf5.substr(0, 200), adf.substr(0, 200), adf.substr(0, 5000)}) {
    CHECK_CONTAINS(refusal([&](const auto& path) { write_text(path, bytes); }), "a.cgns: ");
  }
  CHECK_CONTAINS(refusal([](const auto& path) { write_text(path, "hello"); }),
                 "a.cgns: found neither an HDF5 nor an ADF file, expected a CGNS file");
}

TEST_CASE("CGNS: no damaged file does anything but give a mesh or an InputError") {
  const TemporaryFolder folder;
  const auto path = folder / "a.cgns";
  for (const int container : {CG_FILE_HDF5, CG_FILE_ADF}) {
    const std::string original = square_bytes(container);
    int meshes = 0, refused = 0;
    for (std::uint64_t seed = 0; seed < mutation_count(400); ++seed) {
      CAPTURE(container);
      CAPTURE(seed);
      Random random(seed);
      std::string bytes = original;
      for (Index k = 1 + random.index(4); k > 0; --k) {
        const auto place = at(random.index(static_cast<Index>(bytes.size())));
        if (random.index(8) == 0) {
          bytes.resize(place + 1);
        } else {
          bytes[place] = static_cast<char>(random.index(2) == 0 ? random.index(256)
                                                                : bytes[place] ^ (1 << (k + 1)));
        }
      }
      write_text(path, bytes);
      try {
        const io::MeshFile file = io::read_mesh(path);
        ++meshes;
        io::write_mesh(folder / "b.cgns", file.mesh, file.details.get());
        CHECK(io::read_mesh(folder / "b.cgns").mesh.coordinates == file.mesh.coordinates);
      } catch (const InputError& error) {
        ++refused;
        CHECK(std::string(error.what()).find(path.string()) == 0);
      }
    }
    MESSAGE(meshes, " meshes, ", refused, " refused");
    CHECK(refused > 20);
  }
}

}  // namespace winslow::test

#endif
