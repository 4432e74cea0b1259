#include <cstring>
#include <set>

#include "io/format/mesh_format.h"
#include "io/support/mutations.h"
#include "io/support/polyhedra_samples.h"
#include "support/paths.h"

/// Meshes with polyhedra in all formats that hold them, and the refusals of the others.
namespace winslow::test {
namespace {

/// A format that holds polyhedra, and what of a mesh comes back from it.
struct PolyhedraKind {
  std::string path;
  bool binary = false;
  bool as_given = true;  ///< corners of cells and types are those of the mesh
  bool tags = true, regions = true;
};

std::vector<PolyhedraKind> polyhedra_kinds() {
  return {{"mesh.vtk"},
          {"mesh.vtk", true},
          {"mesh.vtu"},
          {"mesh.vtu", true},
#ifdef WINSLOW_HAS_CGNS
          {"mesh.cgns", false, false, false},
#endif
          {"case/constant/polyMesh", false, false, false, false}};
}

/// The place of a mesh in a subfolder, which is made.
std::filesystem::path place_in(const TemporaryFolder& folder, const std::string& subfolder,
                               const PolyhedraKind& kind) {
  const auto path = folder / (subfolder + "/" + kind.path);
  std::filesystem::create_directories(path.parent_path());
  return path;
}

io::WriteOptions options_of(const PolyhedraKind& kind) {
  io::WriteOptions options;
  options.binary = kind.binary;
  options.keep_encoding = false;
  return options;
}

/// The faces of markers, in their order and direction; names and tags, and regions.
void check_groups(const Mesh& found, const Mesh& expected, const PolyhedraKind& kind) {
  const Topology &a = *found.topology, &b = *expected.topology;
  REQUIRE(a.markers().size() == b.markers().size());
  for (std::size_t m = 0; m < a.markers().size(); ++m) {
    CHECK(a.markers()[m].name == b.markers()[m].name);
    CHECK(a.markers()[m].faces == b.markers()[m].faces);
    if (kind.tags) CHECK(a.markers()[m].tag == b.markers()[m].tag);
  }
  if (!kind.regions) return;
  REQUIRE(a.regions().size() == b.regions().size());
  for (std::size_t r = 0; r < a.regions().size(); ++r) {
    CHECK(a.regions()[r].name == b.regions()[r].name);
    if (kind.tags) CHECK(a.regions()[r].tag == b.regions()[r].tag);
  }
  CHECK(std::ranges::equal(a.element_regions(), b.element_regions()));
}

void check_mesh(const Mesh& found, const Mesh& expected, const PolyhedraKind& kind) {
  check_same_cells(found, expected);
  CHECK(std::memcmp(found.coordinates.values().data(), expected.coordinates.values().data(),
                    expected.coordinates.values().size_bytes()) == 0);
  check_groups(found, expected, kind);
  if (!kind.as_given) return;
  CHECK(std::ranges::equal(found.topology->element_types(), expected.topology->element_types()));
}

}  // namespace

TEST_CASE("polyhedra: every format gives back what it got, to the last bit") {
  for (const PolyhedraSample& sample : polyhedra_samples()) {
    CAPTURE(sample.name);
    const Mesh mesh = make_mesh(sample.data);
    for (const PolyhedraKind& kind : polyhedra_kinds()) {
      CAPTURE(kind.path);
      CAPTURE(kind.binary);
      const TemporaryFolder folder;
      const auto warnings = io::write_mesh(folder / kind.path, mesh, nullptr, options_of(kind));
      CHECK(warnings.empty() == kind.regions);
      const io::MeshFile first = io::read_mesh(folder / kind.path);
      CHECK(first.details->binary == kind.binary);
      check_mesh(first.mesh, mesh, kind);
      const auto again = place_in(folder, "again", kind);
      io::write_mesh(again, first.mesh, first.details.get());
      check_mesh(io::read_mesh(again).mesh, mesh, kind);
      if (kind.as_given) CHECK(read_text(again) == read_text(folder / kind.path));
    }
  }
}

TEST_CASE("polyhedra: from any format to any other, what both can say comes back") {
  const PolyhedraSample sample = polyhedra_samples()[2];
  const Mesh mesh = make_mesh(sample.data);
  for (const PolyhedraKind& from : polyhedra_kinds()) {
    const TemporaryFolder folder;
    io::write_mesh(place_in(folder, "a", from), mesh, nullptr, options_of(from));
    const io::MeshFile first = io::read_mesh(place_in(folder, "a", from));
    for (const PolyhedraKind& to : polyhedra_kinds()) {
      CAPTURE(from.path);
      CAPTURE(to.path);
      const auto second = place_in(folder, "b", to);
      io::write_mesh(second, first.mesh, first.details.get(), options_of(to));
      const PolyhedraKind what{"", false, from.as_given && to.as_given, from.tags && to.tags,
                               from.regions && to.regions};
      check_mesh(io::read_mesh(second).mesh, mesh, what);
    }
  }
}

TEST_CASE("polyhedra: nodes that move are written where they are, all else stays") {
  const Mesh mesh = make_mesh(polyhedra_samples()[1].data);
  for (const PolyhedraKind& kind : polyhedra_kinds()) {
    CAPTURE(kind.path);
    const TemporaryFolder folder;
    io::write_mesh(folder / kind.path, mesh, nullptr, options_of(kind));
    io::MeshFile file = io::read_mesh(folder / kind.path);
    file.mesh.coordinates.set_xyz(3, file.mesh.coordinates.xyz(3) + Vec3(1.0 / 3, -1.0 / 7, 1e-3));
    const auto moved = place_in(folder, "moved", kind);
    io::write_mesh(moved, file.mesh, file.details.get());
    check_mesh(io::read_mesh(moved).mesh, file.mesh, kind);
  }
}

TEST_CASE("polyhedra: cells that a mesh has inside out are written as the others") {
  MeshData data = with_odd_numbers(stacked_prisms(12), 5);
  const Mesh mesh = make_mesh(data);
  for (std::size_t f = at(data.face_offsets[1]); f < data.faces.size(); ++f)
    data.faces[f] = data.faces[f].reversed();
  std::vector<std::string> warnings;
  const Mesh turned = make_mesh(data, &warnings);
  REQUIRE(any_contains(warnings, "turned inside out"));
  for (const PolyhedraKind& kind : polyhedra_kinds()) {
    CAPTURE(kind.path);
    const TemporaryFolder folder;
    io::write_mesh(folder / kind.path, turned, nullptr, options_of(kind));
    const io::MeshFile file = io::read_mesh(folder / kind.path);
    check_same_cells(file.mesh, mesh);
    CHECK_FALSE(any_contains(file.warnings, "turned"));
  }
}

TEST_CASE("polyhedra: the formats that hold none refuse them by name and count") {
  const Mesh mesh = make_mesh(polyhedra_samples()[2].data);
  const auto& types = mesh.topology->element_types();
  const auto polyhedra = std::ranges::count(types, ElementType::polyhedron);
  std::set<std::string> holders;
  for (const io::MeshFormat* format : io::mesh_formats()) {
    CAPTURE(format->name);
    if (format->polyhedra) {
      holders.insert(std::string(format->name));
      continue;
    }
    const TemporaryFolder folder;
    for (const std::string& name :
         {"a." + std::string(format->name), "a." + std::string(format->name) + ".gz"}) {
      std::string refusal = "none";
      try {
        io::write_mesh(folder / name, mesh, nullptr);
      } catch (const UsageError& error) {
        refusal = error.what();
      }
      CHECK_CONTAINS(refusal, name + ": " + std::string(format->title) + " files cannot hold the " +
                                  std::to_string(polyhedra) + " polyhedra of this mesh of " +
                                  std::to_string(types.size()) + " elements; formats that can: ");
      CHECK_CONTAINS(refusal, "VTK (vtk), VTK XML (vtu), ");
      CHECK_CONTAINS(refusal, "(foam)");
      CHECK(std::filesystem::is_empty(folder.path()));
    }
  }
  CHECK(holders == std::set<std::string>{"cgns", "foam", "vtk", "vtu"});
  const TemporaryFolder folder;
  MeshData one = stacked_prisms(7);
  one.markers.clear();
  CHECK_THROWS_WITH_AS(io::write_mesh(folder / "a.lb8.ugrid", make_mesh(one), nullptr),
                       doctest::Contains("the 2 polyhedra of this mesh of 2 elements"), UsageError);
}

namespace {

struct Seed {
  std::string name, text;
};

/// Files that VTK has written, one in the form of VTK 9.4 (version 2.3), and some of our own. All
/// have a few cells.
const std::vector<std::string> vtk_files{"version_42.vtk",  "version_42b.vtk", "version_51.vtk",
                                         "version_51b.vtk", "text.vtu",        "appended.vtu",
                                         "inline_lz4.vtu",  "version_23.vtu"};

std::vector<Seed> seeds() {
  std::vector<Seed> seeds;
  for (const std::string& name : vtk_files)
    seeds.push_back({name, read_text(test_data("polyhedra/" + name))});
  const Mesh mesh = make_mesh(with_odd_numbers(stacked_prisms(5), 6));
  const TemporaryFolder folder;
  for (const PolyhedraKind& kind : polyhedra_kinds()) {
    if (contains(kind.path, "polyMesh")) continue;  // several files
    io::write_mesh(folder / kind.path, mesh, nullptr, options_of(kind));
    seeds.push_back({kind.path, read_text(folder / kind.path)});
  }
  return seeds;
}

}  // namespace

TEST_CASE("polyhedra: files of VTK in all encodings are the same mesh") {
  const io::MeshFile expected = io::read_mesh(test_data("polyhedra/text.vtu"));
  const Topology& topology = *expected.mesh.topology;
  REQUIRE(topology.element_count() == 2);
  CHECK(topology.element_type(0) == ElementType::hexahedron);
  CHECK(topology.element_type(1) == ElementType::polyhedron);
  CHECK(topology.shape(1).faces.size() == 8);
  REQUIRE(topology.markers().size() == 2);
  CHECK(topology.markers()[1].faces == std::vector{Face(std::array<Index, 5>{8, 9, 13, 10, 11})});
  for (const std::string& name : vtk_files) {
    CAPTURE(name);
    const io::MeshFile file = io::read_mesh(test_data("polyhedra/" + name));
    check_mesh(file.mesh, expected.mesh, {});
    CHECK(file.details->data_names() == "T");
    CHECK_FALSE(any_contains(file.warnings, "turned"));
  }
}

TEST_CASE("polyhedra: no damaged file does anything but give a mesh or an InputError") {
  const TemporaryFolder folder;
  for (const Seed& given : seeds()) {
    int meshes = 0, refused = 0;
    const auto path = folder / given.name, again = folder / ("again_" + given.name);
    for (std::uint64_t seed = 0; seed < mutation_count(100); ++seed) {
      CAPTURE(given.name);
      CAPTURE(seed);
      Random random(seed);
      write_text(path, mutated(given.text, random));
      ++(survives(path, path, again) ? meshes : refused);
    }
    MESSAGE(given.name, ": ", meshes, " meshes, ", refused, " refused");
    CHECK(refused > 20);
  }
}

TEST_CASE("polyhedra: no damage to one file of a polyMesh does more than to give an InputError") {
  const TemporaryFolder folder;
  io::write_mesh(folder / "polyMesh", make_mesh(with_odd_numbers(stacked_prisms(5), 6)), nullptr);
  int meshes = 0, refused = 0;
  for (const char* part : {"points", "faces", "owner", "neighbour", "boundary"}) {
    const auto path = folder / ("polyMesh/" + std::string(part));
    const std::string original = read_text(path);
    for (std::uint64_t seed = 0; seed < mutation_count(50); ++seed) {
      CAPTURE(part);
      CAPTURE(seed);
      Random random(seed);
      write_text(path, mutated(original, random));
      ++(survives(folder / "polyMesh", folder.path(), folder / "again/polyMesh") ? meshes
                                                                                 : refused);
    }
    write_text(path, original);
  }
  MESSAGE(meshes, " meshes, ", refused, " refused");
  CHECK(refused > 50);
}

TEST_CASE("polyhedra: every beginning of a file is refused, or a mesh") {
  const TemporaryFolder folder;
  for (const Seed& given : seeds()) {
    CAPTURE(given.name);
    int meshes = 0, all = 0;
    for (std::size_t size = 0; size < given.text.size(); size += 17, ++all) {
      write_text(folder / given.name, given.text.substr(0, size));
      try {
        io::read_mesh(folder / given.name);
        ++meshes;
      } catch (const InputError&) {
        continue;
      }
    }
    // Where the mesh comes first, what is cut off may be data arrays, markers and names.
    CHECK(2 * meshes < all);
  }
}

}  // namespace winslow::test
