// Moves a body of a mesh as `winslow move` does, but by incremental linear elasticity
// (linear_elasticity.h): plane meshes and meshes of tetrahedra, from file to file.
//
//   bench/elastic_move MESH --marker NAME... [--rotate DEG] [--axis X Y Z] [--pivot X Y [Z]]
//                      [--translate X Y [Z]] [--increments N] [--modulus volume|distance]
//                      [--tolerance RELATIVE_RESIDUAL] -o OUT
//
// default: about the origin, in space about the z axis; 50 increments; stiffness 1/volume; linear
// systems in space to 1e-6. Exit status: 0 done, inverted elements or not; 1 the motion was not
// completed, or a file cannot be read or written; 2 wrong usage.
#include <cstdio>

#include "core/error.h"
#include "elasticity/elasticity_case.h"
#include "io/format/mesh_file.h"

namespace {

using namespace winslow;
using namespace winslow::bench;

void move(const ElasticityCase& wanted) {
  if (wanted.output.empty()) throw UsageError("where does the mesh go? Say -o OUT");
  io::MeshFile file = io::read_mesh(wanted.mesh);
  const ElasticityResult result = move_elastically(wanted, file.mesh);
  if (!result.fault.empty()) throw Error("not to the end: " + result.fault);
  io::write_mesh(wanted.output, file.mesh, file.details.get());
}

}  // namespace

int main(int count, char** arguments) {
  try {
    move(read_case({arguments + 1, arguments + count},
                   "usage: elastic_move MESH --marker NAME ... -o OUT"));
    return 0;
  } catch (const UsageError& error) {
    std::fprintf(stderr, "elastic_move: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "elastic_move: %s\n", error.what());
    return 1;
  }
}
