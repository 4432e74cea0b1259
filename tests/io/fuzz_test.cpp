#include <cstring>

#include "io/format/parsed_mesh.h"
#include "io/support/mutations.h"
#include "io/support/samples.h"
#include "io/support/volume_samples.h"
#include "support/paths.h"

namespace winslow::test {
namespace {

const std::vector<std::string>& seeds() {
  static const std::vector<std::string> names{
      "square.su2",         "square_22.msh", "square_22b.msh", "square_41.msh",
      "square_41b.msh",     "square.vtk",    "square_b.vtk",   "square.vtu",
      "square_b.vtu",       "square.obj",    "square.off",     "square.ply",
      "square_b.ply",       "square.stl",    "square_b.stl",   "partitioned_41.msh",
      "partitioned_41b.msh"};
  return names;
}

}  // namespace

TEST_CASE("no damaged file does anything but give a mesh or an InputError") {
  const TemporaryFolder folder;
  int meshes = 0;
  int refused = 0;
  for (const std::string& name : seeds()) {
    const std::string original = read_text(test::test_data(name));
    const auto path = folder / name;
    for (std::uint64_t seed = 0; seed < mutation_count(400); ++seed) {
      CAPTURE(name);
      CAPTURE(seed);
      Random random(seed);
      const std::string text = mutated(original, random);
      write_text(path, text);
      try {
        const io::MeshFile file = io::read_mesh(path);
        ++meshes;
        // What was read can be written and read again.
        const auto again = folder / ("again" + std::filesystem::path(name).extension().string());
        io::write_mesh(again, file.mesh, file.details.get());
        CHECK(io::read_mesh(again).mesh.topology->element_count() >=
              file.mesh.topology->element_count());
      } catch (const InputError& error) {
        ++refused;
        const std::string what = error.what();
        CHECK(what.find(path.string()) == 0);
        CHECK(what.size() < 1000);
      }
    }
  }
  MESSAGE(meshes, " meshes, ", refused, " refused");
  CHECK(meshes > 100);
  CHECK(refused > 1000);
}

TEST_CASE("every beginning of a file is refused, or a mesh") {
  const TemporaryFolder folder;
  for (const std::string& name : seeds()) {
    const std::string original = read_text(test::test_data(name));
    const auto path = folder / name;
    int meshes = 0;
    for (std::size_t size = 0; size < original.size(); size += 3) {
      CAPTURE(name);
      CAPTURE(size);
      write_text(path, original.substr(0, size));
      try {
        io::read_mesh(path);
        ++meshes;
      } catch (const InputError&) {
        continue;
      }
    }
    // Where the mesh comes first, what is cut off may be markers, names or a last newline only.
    CHECK(meshes < static_cast<int>(original.size()) / 6);
  }
}

namespace {

/// Small files of every format that holds volume meshes: two cubes of each type of element.
struct VolumeSeed {
  std::string name, text;
};

std::vector<VolumeSeed> volume_seeds() {
  Random random(12);
  MeshData data = cube(2, Volumes::prisms);
  data.regions = {{"air", 3}};
  data.element_region.assign(data.types.size(), 0);
  const Mesh prisms = make_mesh(data);
  const Mesh pyramids = make_mesh(volume_sample(random, Volumes::pyramids, false));
  const TemporaryFolder folder;
  std::vector<VolumeSeed> seeds;
  for (const Kind& kind : std::vector<Kind>{{"su2", "", false},
                                            {"msh", "2.2", false},
                                            {"msh", "2.2", true},
                                            {"msh", "4.1", false},
                                            {"msh", "4.1", true},
                                            {"vtk", "", false},
                                            {"vtk", "", true},
                                            {"vtu", "", false},
                                            {"vtu", "", true},
                                            {"ugrid", "", false},
                                            {"lb8.ugrid", "", false},
                                            {"b4.ugrid", "", false},
                                            {"r8.ugrid", "", false},
                                            {"lr4l.ugrid", "", false},
                                            {"lb8l.ugrid", "", false},
#ifdef WINSLOW_HAS_CGNS
                                            {"cgns", "", false},
#endif
                                            {"mesh", "", false}}) {
    for (const Mesh* mesh : {&prisms, &pyramids}) {
      const std::string name = "a." + std::string(kind.extension);
      io::write_mesh(folder / name, *mesh, nullptr, options_of(kind));
      seeds.push_back({name, read_text(folder / name)});
    }
  }
  return seeds;
}

}  // namespace

TEST_CASE("volumes: no damaged file does anything but give a mesh or an InputError") {
  const TemporaryFolder folder;
  int meshes = 0, refused = 0;
  for (const VolumeSeed& given : volume_seeds()) {
    const std::string &name = given.name, &original = given.text;
    const auto path = folder / name;
    for (std::uint64_t seed = 0; seed < mutation_count(200); ++seed) {
      CAPTURE(name);
      CAPTURE(seed);
      Random random(seed);
      write_text(path, mutated(original, random));
      try {
        const io::MeshFile file = io::read_mesh(path);
        ++meshes;
        const auto again = folder / ("again" + name.substr(1));
        io::write_mesh(again, file.mesh, file.details.get());
        CHECK(io::read_mesh(again).mesh.topology->element_count() >=
              file.mesh.topology->element_count());
      } catch (const InputError& error) {
        ++refused;
        CHECK(std::string(error.what()).find(path.string()) == 0);
      }
    }
  }
  MESSAGE(meshes, " meshes, ", refused, " refused");
  CHECK(meshes > 50);
  CHECK(refused > 1000);
}

TEST_CASE("volumes: no damage to one file of several does more than to give an InputError") {
  const Mesh mesh = make_mesh(cube(2, Volumes::prisms));
  const TemporaryFolder folder;
  io::write_mesh(folder / "polyMesh", mesh, nullptr);
  io::write_mesh(folder / "a.ugrid", mesh, nullptr);
  int good = 0, refused = 0;
  const auto damage = [&](const std::string& whole, const std::string& part,
                          const std::string& again) {
    const std::string original = read_text(folder / part);
    for (std::uint64_t seed = 0; seed < mutation_count(150); ++seed) {
      CAPTURE(part);
      CAPTURE(seed);
      Random random(seed);
      write_text(folder / part, mutated(original, random));
      ++(survives(folder / whole, folder.path(), folder / again) ? good : refused);
    }
    write_text(folder / part, original);
  };
  for (const char* part : {"points", "faces", "owner", "neighbour", "boundary"})
    damage("polyMesh", "polyMesh/" + std::string(part), "again/polyMesh");
  damage("a.ugrid", "a.mapbc", "again.ugrid");
  MESSAGE(good, " meshes, ", refused, " refused");
  CHECK(good > 20);
  CHECK(refused > 300);
}

TEST_CASE("volumes: every beginning of a file is refused, or a mesh") {
  const TemporaryFolder folder;
  for (const VolumeSeed& given : volume_seeds()) {
    const std::string &name = given.name, &original = given.text;
    const auto path = folder / name;
    int meshes = 0, all = 0;
    for (std::size_t size = 0; size < original.size(); size += 29, ++all) {
      CAPTURE(name);
      CAPTURE(size);
      write_text(path, original.substr(0, size));
      try {
        io::read_mesh(path);
        ++meshes;
      } catch (const InputError&) {
        continue;
      }
    }
    // Where the mesh comes first, what is cut off may be markers and names.
    CHECK(2 * meshes < all);
  }
}

}  // namespace winslow::test
