// Moves bodies at the same time, each by a motion of its own, as the leaflets of a valve or the
// slat and the flap of a wing.
//
//     ./several_bodies three_element.su2 moved.su2 slat 5 flap -10
//
// Bodies that would touch on their common way are named, and where.
#include <winslow/winslow.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  if (argc < 5 || argc % 2 == 0) {
    std::fprintf(stderr, "usage: several_bodies IN OUT MARKER DEGREES [MARKER DEGREES ...]\n");
    return 2;
  }
  try {
    const winslow::io::MeshFile file = winslow::io::read_mesh(argv[1]);

    winslow::MoveCommand move;
    move.bodies.clear();
    for (int k = 3; k + 1 < argc; k += 2) {
      winslow::MovingBody body;
      body.markers = {argv[k]};
      body.motion.rotate = std::atof(argv[k + 1]);  // about the body's own centre
      move.bodies.push_back(body);
    }
    // Looks for contact along the common motion before anything is solved.
    winslow::RunOptions run;
    run.all_or_nothing = true;
    const winslow::MeshState state = winslow::make_state(file.mesh);
    const winslow::CommandResult result = winslow::execute(move, state, run);

    if (result.smooth.contact) {
      std::fprintf(stderr, "%s\n", winslow::describe(*result.smooth.contact).c_str());
      return 4;
    }
    if (result.smooth.inverted > 0 || result.smooth.fraction_reached < 1) {
      std::fprintf(stderr, "not written: %s\n", winslow::why_incomplete(result.smooth).c_str());
      return 4;
    }
    winslow::io::write_mesh(argv[2], result.state.mesh, file.details.get());
    std::printf("%s, in %d linear solves\n", winslow::describe(winslow::Command(move)).c_str(),
                result.smooth.linear_solves);
  } catch (const winslow::Error& error) {  // a marker of two bodies, a shared node torn apart, ...
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
