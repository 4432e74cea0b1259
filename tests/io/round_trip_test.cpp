#include <algorithm>
#include <cstring>

#include "io/format/mesh_format.h"
#include "io/support/samples.h"
#include "io/support/volume_samples.h"
#include "support/paths.h"

namespace winslow::test {
namespace {

bool is_surface(const Kind& kind) {
  return !io::format_of_extension("mesh." + std::string(kind.extension))->keeps_markers;
}
bool is_stl(const Kind& kind) { return std::string(kind.extension) == "stl"; }
bool is_su2(const Kind& kind) { return std::string(kind.extension) == "su2"; }

}  // namespace

TEST_CASE("every format gives back what it got, in order and to the last bit") {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Mesh mesh = make_mesh(shuffled_mesh(random, seed % 2 == 0));
    for (const Kind& kind : kinds()) {
      if (is_stl(kind)) continue;  // has no node numbers: a test of its own
      CAPTURE(text_of(kind));
      const TemporaryFolder folder;
      const auto path = folder / ("mesh." + std::string(kind.extension));
      const auto warnings = io::write_mesh(path, mesh, nullptr, options_of(kind));
      const io::MeshFile first = io::read_mesh(path);
      Comparison what;
      what.markers = !is_surface(kind);
      what.tags = !is_su2(kind);
      // Without regions MSH gets one of ours, or Gmsh would not save the elements.
      what.regions = !is_su2(kind) && !is_surface(kind) &&
                     (seed % 2 == 0 || std::string(kind.extension) != "msh");
      check_same_mesh(first.mesh, mesh, what);
      CHECK(any_contains(warnings, "markers: they are lost") == is_surface(kind));

      // With the details of the source, a second file is the same, byte for byte.
      const auto again = folder / ("again." + std::string(kind.extension));
      io::write_mesh(again, first.mesh, first.details.get());
      CHECK(read_text(again) == read_text(path));
    }
  }
}

TEST_CASE("SU2 to MSH and back keeps everything that SU2 can say") {
  for (std::uint64_t seed = 100; seed < 110; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Mesh mesh = make_mesh(shuffled_mesh(random, false));
    const TemporaryFolder folder;
    io::write_mesh(folder / "a.su2", mesh, nullptr);
    for (const char* version : {"2.2", "4.1"}) {
      for (const bool binary : {false, true}) {
        io::WriteOptions options;
        options.binary = binary;
        options.gmsh_version = version;
        const io::MeshFile a = io::read_mesh(folder / "a.su2");
        io::write_mesh(folder / "b.msh", a.mesh, a.details.get(), options);
        const io::MeshFile b = io::read_mesh(folder / "b.msh");
        io::write_mesh(folder / "c.su2", b.mesh, b.details.get());
        CHECK(read_text(folder / "c.su2") == read_text(folder / "a.su2"));
      }
    }
  }
}

TEST_CASE("coordinates with every bit pattern of a finite number come back") {
  Random random(7);
  MeshData data = grid_with_holes(2, Cells::triangles, [](Index, Index) { return false; });
  const std::vector<double> odd{5e-324, -2.2250738585072014e-308, 0.1, 1.0 / 3, 1e300, -0.0};
  // Unused nodes are not looked at by any check of the geometry.
  for (const double x : odd) data.coordinates.push_xy({x, -x});
  for (int i = 0; i < 200; ++i) {
    data.coordinates.push_xy(
        {random.uniform(-1, 1) * std::pow(10, random.uniform(-300, 300)), random.uniform(-1, 1)});
  }
  const Mesh mesh = make_mesh(data);
  for (const Kind& kind : kinds()) {
    if (is_stl(kind)) continue;
    CAPTURE(text_of(kind));
    const TemporaryFolder folder;
    const auto path = folder / ("mesh." + std::string(kind.extension));
    io::write_mesh(path, mesh, nullptr, options_of(kind));
    const io::MeshFile file = io::read_mesh(path);
    const auto found = file.mesh.coordinates.values();
    const auto expected = mesh.coordinates.values();
    REQUIRE(found.size() == expected.size());
    CHECK(std::memcmp(found.data(), expected.data(), found.size_bytes()) == 0);
    CHECK(any_contains(file.warnings, "belong to no element"));
  }
}

TEST_CASE("a plane z = constant is kept, also across formats") {
  const std::string source = read_text(test::test_data("square.obj"));
  std::string raised;
  for (std::size_t at = 0; at < source.size();) {
    const auto end = source.find('\n', at);
    std::string line = source.substr(at, end - at);
    if (line.starts_with("v ")) line = line.substr(0, line.rfind(' ')) + " 0.7";
    raised += line + "\n";
    at = end + 1;
  }
  const TemporaryFolder folder;
  write_text(folder / "a.obj", raised);
  const io::MeshFile a = io::read_mesh(folder / "a.obj");
  for (const char* name : {"b.msh", "b.vtk", "b.vtu", "b.off", "b.ply", "b.stl", "b.obj"}) {
    CAPTURE(name);
    io::write_mesh(folder / name, a.mesh, a.details.get());
    const io::MeshFile b = io::read_mesh(folder / name);
    REQUIRE(b.details->plane_z.size() == 1);
    CHECK(b.details->plane_z[0] == 0.7);
  }
}

TEST_CASE("STL: the same triangles come back, corners at one place become one node") {
  Random random(3);
  const Mesh mesh = make_mesh(shuffled_mesh(random, false));
  for (const bool binary : {false, true}) {
    const TemporaryFolder folder;
    io::WriteOptions options;
    options.binary = binary;
    const auto warnings = io::write_mesh(folder / "a.stl", mesh, nullptr, options);
    CHECK(any_contains(warnings, "single precision") == binary);
    const io::MeshFile a = io::read_mesh(folder / "a.stl");
    CHECK(a.mesh.coordinates.size() == mesh.coordinates.size());
    Index triangles = 0;
    for (Index e = 0; e < mesh.topology->element_count(); ++e) {
      triangles += static_cast<Index>(mesh.topology->element(e).size()) - 2;
    }
    CHECK(a.mesh.topology->element_count() == triangles);
    CHECK(io::write_mesh(folder / "b.stl", a.mesh, a.details.get()).empty());
    CHECK(read_text(folder / "b.stl") == read_text(folder / "a.stl"));
  }
}

TEST_CASE("a changed mesh does not get the details of its source") {
  const io::MeshFile square = io::read_mesh(test::test_data("square_41.msh"));
  MeshData data = grid_with_holes(3, Cells::mixed, [](Index, Index) { return false; });
  const Mesh other = make_mesh(data);
  const TemporaryFolder folder;
  const auto warnings = io::write_mesh(folder / "a.msh", other, square.details.get());
  CHECK(any_contains(warnings, "the mesh has changed"));
  Comparison what;
  what.regions = false;
  check_same_mesh(io::read_mesh(folder / "a.msh").mesh, other, what);
}

namespace {

/// Formats that hold volume meshes, and what of a mesh comes back from each.
struct VolumeKind {
  Kind kind;
  Comparison what;
  bool by_type = false;         ///< it holds elements, and faces of markers, type by type
  bool invents_region = false;  ///< a mesh without regions gets one
};

std::vector<VolumeKind> volume_kinds() {
  const Comparison no_tags{.tags = false, .regions = false};
  const Comparison no_regions{.regions = false};
  const Comparison all{};
  return {{{"su2", "", false}, no_tags},
          {{"msh", "2.2", false}, all, false, true},
          {{"msh", "2.2", true}, all, false, true},
          {{"msh", "4.1", false}, all, false, true},
          {{"msh", "4.1", true}, all, false, true},
          {{"vtk", "", false}, all},
          {{"vtk", "", true}, all},
          {{"vtu", "", false}, all},
          {{"vtu", "", true}, all},
#ifdef WINSLOW_HAS_CGNS
          {{"cgns", "", false}, {.tags = false}},
#endif
          {{"ugrid", "", false}, no_regions, true},
          {{"ugrid", "", true}, no_regions, true},
          {{"b8.ugrid", "", false}, no_regions, true},
          {{"lb8.ugrid", "", false}, no_regions, true},
          {{"mesh", "", false}, all, true}};
}

/// The same mesh with elements and faces of markers by their types, otherwise in the same order.
MeshData by_type(const MeshData& data) {
  MeshData sorted = data;
  sorted.types.clear();
  sorted.element_offsets = {0};
  sorted.element_nodes.clear();
  sorted.element_region.clear();
  for (const ElementType type : {ElementType::tetrahedron, ElementType::pyramid, ElementType::prism,
                                 ElementType::hexahedron}) {
    for (Index e = 0; e < data.element_count(); ++e) {
      if (data.types[at(e)] != type) continue;
      sorted.add_element(type, data.element(e));
      if (!data.element_region.empty()) sorted.element_region.push_back(data.element_region[at(e)]);
    }
  }
  for (Marker& marker : sorted.markers) {
    std::ranges::stable_sort(marker.faces, {}, [](const Face& face) { return face.size(); });
  }
  return sorted;
}

bool same_bits(const Coordinates& a, const Coordinates& b) {
  return a.values().size() == b.values().size() &&
         std::memcmp(a.values().data(), b.values().data(), a.values().size_bytes()) == 0;
}

MeshData sample_of(std::uint64_t seed, Volumes volumes, bool with_regions) {
  Random random(seed);
  return volume_sample(random, volumes, with_regions);
}
Mesh expected_of(const MeshData& data, bool sorted) {
  return make_mesh(sorted ? by_type(data) : data);
}

}  // namespace

TEST_CASE("volumes: every format gives back what it got, in order and to the last bit") {
  std::uint64_t seed = 0;
  for (const Volumes volumes : all_volumes) {
    for (const bool with_regions : {false, true}) {
      CAPTURE(name_of(volumes));
      const MeshData data = sample_of(++seed, volumes, with_regions);
      std::vector<std::string> warnings;
      const Mesh mesh = make_mesh(data, &warnings);
      CHECK(warnings.empty());
      for (const VolumeKind& format : volume_kinds()) {
        CAPTURE(text_of(format.kind));
        const TemporaryFolder folder;
        const std::string extension = format.kind.extension;
        const auto path = folder / ("mesh." + extension);
        io::write_mesh(path, mesh, nullptr, options_of(format.kind));
        const io::MeshFile first = io::read_mesh(path);
        Comparison what = format.what;
        if (!with_regions && format.invents_region) what.regions = false;
        check_same_mesh(first.mesh, expected_of(data, format.by_type), what);
        CHECK(same_bits(first.mesh.coordinates, mesh.coordinates));
        REQUIRE(first.warnings.size() == (what.regions ? warnings.size() : 0));
        for (std::size_t k = 0; k < first.warnings.size(); ++k)
          CHECK(first.warnings[k].ends_with(warnings[k]));
        // With the details of the source, a second file is the same, byte for byte.
        const auto again = folder / ("again." + extension);
        CHECK(io::write_mesh(again, first.mesh, first.details.get()).empty());
        // HDF5 notes the time of writing: trees of CGNS files are compared in their own tests.
        if (extension != "cgns") CHECK(read_text(again) == read_text(path));
      }
    }
  }
}

TEST_CASE("volumes: from any format to any other, what both can say comes back") {
  const MeshData data = sample_of(77, Volumes::mixed, true);
  const Mesh mesh = make_mesh(data);
  for (const VolumeKind& from : volume_kinds()) {
    const TemporaryFolder folder;
    const auto a = folder / ("a." + std::string(from.kind.extension));
    io::write_mesh(a, mesh, nullptr, options_of(from.kind));
    const io::MeshFile first = io::read_mesh(a);
    for (const VolumeKind& to : volume_kinds()) {
      CAPTURE(text_of(from.kind));
      CAPTURE(text_of(to.kind));
      const auto b = folder / ("b." + std::string(to.kind.extension));
      io::write_mesh(b, first.mesh, first.details.get(), options_of(to.kind));
      Comparison what;
      what.tags = from.what.tags && to.what.tags;
      what.regions = from.what.regions && to.what.regions;
      const io::MeshFile second = io::read_mesh(b);
      check_same_mesh(second.mesh, expected_of(data, from.by_type || to.by_type), what);
    }
  }
}

TEST_CASE("volumes: nodes that move are written where they are, all else stays") {
  const Mesh mesh = make_mesh(sample_of(5, Volumes::mixed, true));
  for (const VolumeKind& format : volume_kinds()) {
    CAPTURE(text_of(format.kind));
    const TemporaryFolder folder;
    const auto path = folder / ("mesh." + std::string(format.kind.extension));
    io::write_mesh(path, mesh, nullptr, options_of(format.kind));
    io::MeshFile file = io::read_mesh(path);
    const Vec3 moved = file.mesh.coordinates.xyz(3) + Vec3(1.0 / 3, -1.0 / 7, 1e-3);
    file.mesh.coordinates.set_xyz(3, moved);
    io::write_mesh(path, file.mesh, file.details.get());
    const io::MeshFile back = io::read_mesh(path);
    CHECK(back.mesh.coordinates.xyz(3) == moved);
    CHECK(same_bits(back.mesh.coordinates, file.mesh.coordinates));
  }
}

TEST_CASE("volumes: elements that a file has inside out are turned, with a warning") {
  Random random(9);
  const MeshData data = shuffled_volume(cube(4, Volumes::mixed), random, true);
  std::vector<std::string> warnings;
  const Mesh mesh = make_mesh(data, &warnings);
  REQUIRE(any_contains(warnings, "turned inside out"));
  const TemporaryFolder folder;
  io::write_mesh(folder / "a.vtk", mesh, nullptr);
  check_same_mesh(io::read_mesh(folder / "a.vtk").mesh, mesh);
}

}  // namespace winslow::test
