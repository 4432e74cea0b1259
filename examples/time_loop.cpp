// A time loop: the flap of a wing swings, and every step starts from the mesh of the step before.
// What the solver has prepared (patterns, orderings, factors) is kept from step to step in a
// SolverCache.
//
//     ./time_loop coarse/wing.su2.gz
#include <winslow/winslow.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace {

/// Where the flap is at a time, in degrees.
double angle_at(double time) { return -10 * std::sin(2 * std::numbers::pi * time); }

winslow::MoveCommand turn_flap(double degrees) {
  winslow::MoveCommand move;
  move.markers = {"flap"};
  move.motion.rotate = degrees;
  move.motion.axis = winslow::Vec3(0.2555, 0.038, 1.5);  // the swept hinge
  return move;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: time_loop WING\n");
    return 2;
  }
  try {
    winslow::MeshState state = winslow::make_state(winslow::io::read_mesh(argv[1]).mesh);
    winslow::SolverCache cache;
    winslow::RunOptions options;
    options.cache = &cache;

    constexpr double step = 0.0125;
    for (double time = 0; time < 0.05; time += step) {
      const auto turn = turn_flap(angle_at(time + step) - angle_at(time));
      winslow::CommandResult result = winslow::execute(turn, state, options);
      if (result.smooth.inverted > 0 || result.smooth.fraction_reached < 1) {
        std::fprintf(stderr, "t = %.4f: %s\n", time,
                     winslow::why_incomplete(result.smooth).c_str());
        return 4;
      }
      std::printf("t = %.4f: flap at %6.2f degrees, %d linear solves\n", time + step,
                  angle_at(time + step), result.smooth.linear_solves);
      state = std::move(result.state);  // here the flow solver takes its step on state.mesh
    }
  } catch (const winslow::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
