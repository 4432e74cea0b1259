// Reads a mesh of any format, turns a body of it, repairs the mesh around the body, and writes it.
//
//     ./read_move_write three_element.su2 moved.su2 flap -10
//
// Writes nothing if the result has inverted elements.
#include <winslow/winslow.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: read_move_write IN OUT MARKER DEGREES\n");
    return 2;
  }
  try {
    const winslow::io::MeshFile file = winslow::io::read_mesh(argv[1]);
    for (const std::string& warning : file.warnings)
      std::fprintf(stderr, "warning: %s\n", warning.c_str());

    winslow::MoveCommand move;
    move.bodies[0].markers = {argv[3]};
    move.bodies[0].motion.rotate = std::atof(argv[4]);  // about the body's own centre
    const winslow::CommandResult result = winslow::execute(move, winslow::make_state(file.mesh));

    if (result.smooth.inverted > 0 || result.smooth.fraction_reached < 1) {
      std::fprintf(stderr, "not written: %s\n", winslow::why_incomplete(result.smooth).c_str());
      return 4;
    }
    winslow::io::write_mesh(argv[2], result.state.mesh, file.details.get());
    std::printf("%s turned by %s degrees in %d linear solves\n", argv[3], argv[4],
                result.smooth.linear_solves);
  } catch (const winslow::Error& error) {  // no such file, unknown marker, wrong numbers, ...
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
