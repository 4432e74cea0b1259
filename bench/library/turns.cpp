// What a SolverCache saves: turns of the flap of a wing, one command each, with and without one.
// Seconds are those of the processor, over all threads; the least of three runs counts.
//
//     ./turns coarse/wing.su2.gz 20 -1
#include <winslow/winslow.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace {

struct Outcome {
  winslow::Coordinates mesh;
  int linear_solves = 0;
  double seconds = 1e300;
};

/// Throws Error for a turn that does not come to its end.
Outcome turn(const winslow::MeshState& start, int turns, double degrees, bool kept) {
  winslow::MoveCommand command;
  command.markers = {"flap"};
  command.motion.rotate = degrees;
  command.motion.axis = winslow::Vec3(0.2555, 0.038, 1.5);
  winslow::SolverCache cache;
  winslow::RunOptions options;
  if (kept) options.cache = &cache;
  Outcome outcome;
  winslow::MeshState state = start;
  const std::clock_t begin = std::clock();
  for (int k = 0; k < turns; ++k) {
    winslow::CommandResult result = winslow::execute(command, state, options);
    if (result.smooth.inverted > 0 || result.smooth.fraction_reached < 1)
      throw winslow::Error(winslow::why_incomplete(result.smooth));
    outcome.linear_solves += result.smooth.linear_solves;
    state = std::move(result.state);
  }
  outcome.seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  outcome.mesh = state.mesh.coordinates;
  return outcome;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: turns WING TURNS DEGREES\n");
    return 2;
  }
  try {
    const auto state = winslow::make_state(winslow::io::read_mesh(argv[1]).mesh);
    const int turns = std::atoi(argv[2]);
    const double degrees = std::atof(argv[3]);
    Outcome without, with;
    for (int run = 0; run < 3; ++run) {
      for (const bool kept : {false, true}) {
        Outcome outcome = turn(state, turns, degrees, kept);
        Outcome& best = kept ? with : without;
        outcome.seconds = std::min(outcome.seconds, best.seconds);
        best = std::move(outcome);
      }
    }
    std::printf("%d turns by %g degrees, %d linear solves\n", turns, degrees, with.linear_solves);
    std::printf("CPU seconds without a cache %.3f, with one %.3f: %.1f %% less\n", without.seconds,
                with.seconds, 100 * (1 - with.seconds / without.seconds));
    std::printf("the meshes are %s\n", without.mesh == with.mesh ? "the same bits" : "DIFFERENT");
    return without.mesh == with.mesh ? 0 : 1;
  } catch (const winslow::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
