#include <algorithm>
#include <cstring>

#include "io/format/mesh_format.h"
#include "io/support/volume_samples.h"

namespace winslow::test {
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
      std::vector<std::string> warnings;  // of regions that meet in faces of no marker
      const Mesh mesh = make_mesh(data, &warnings);
      CHECK(warnings.empty() == !with_regions);
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
