// convert IN OUT [--binary] [--ascii] [--msh VERSION] [--fresh]: reads a mesh and writes it again,
// for the scripts beside it. --fresh forgets what the source's format said beyond the mesh.
#include <cstring>
#include <exception>
#include <iostream>

#include "core/error.h"
#include "io/format/mesh_file.h"

int main(int argc, char** argv) {
  using namespace winslow;
  if (argc < 3) {
    std::cerr << "usage: convert IN OUT [--binary] [--ascii] [--msh VERSION] [--fresh]\n";
    return 2;
  }
  io::WriteOptions options;
  bool fresh = false;
  for (int i = 3; i < argc; ++i) {
    if (std::strcmp(argv[i], "--binary") == 0) options.binary = true;
    if (std::strcmp(argv[i], "--ascii") == 0) options.keep_encoding = false;
    if (std::strcmp(argv[i], "--fresh") == 0) fresh = true;
    if (std::strcmp(argv[i], "--msh") == 0 && i + 1 < argc) options.gmsh_version = argv[++i];
  }
  try {
    const io::MeshFile file = io::read_mesh(argv[1]);
    for (const auto& warning : file.warnings) std::cerr << "warning: " << warning << '\n';
    const auto warnings =
        io::write_mesh(argv[2], file.mesh, fresh ? nullptr : file.details.get(), options);
    for (const auto& warning : warnings) std::cerr << "warning: " << warning << '\n';
  } catch (const InputError& error) {
    std::cerr << error.what() << '\n';
    return 3;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  return 0;
}
