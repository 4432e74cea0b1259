#include <cstring>

#include "io/format/parsed_mesh.h"
#include "io/support/mutations.h"
#include "io/support/samples.h"

namespace winslow::test {
namespace {

const std::vector<std::string>& seeds() {
  static const std::vector<std::string> names{
      "square.su2", "square_22.msh", "square_22b.msh", "square_41.msh", "square_41b.msh",
      "square.vtk", "square_b.vtk",  "square.vtu",     "square_b.vtu",  "square.obj",
      "square.off", "square.ply",    "square_b.ply",   "square.stl",    "square_b.stl"};
  return names;
}

}  // namespace

TEST_CASE("no damaged file does anything but give a mesh or an InputError") {
  const TemporaryFolder folder;
  int meshes = 0;
  int refused = 0;
  for (const std::string& name : seeds()) {
    const std::string original = read_text(std::string(WINSLOW_TEST_DATA "/") + name);
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
    const std::string original = read_text(std::string(WINSLOW_TEST_DATA "/") + name);
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

}  // namespace winslow::test
