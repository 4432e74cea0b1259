// A time loop: the flap of a wing swings, and every step begins from the mesh of the step before,
// with what the solver had prepared for it. Angles are told from the mesh as given, so that nothing
// drifts.
//
//     ./time_loop coarse/wing.su2.gz
#include <winslow/winslow.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace {

/// The flap turned from where it is in the mesh as given, in degrees.
winslow::MovingBody turned_flap(double degrees) {
  winslow::MovingBody flap;
  flap.markers = {"flap"};
  flap.motion.rotate = degrees;
  flap.motion.axis = winslow::Vec3(0.2555, 0.038, 1.5);  // the swept hinge
  return flap;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: time_loop WING\n");
    return 2;
  }
  try {
    winslow::Deformer deformer(winslow::make_state(winslow::io::read_mesh(argv[1]).mesh));
    constexpr int steps = 4;
    for (int step = 1; step <= steps; ++step) {
      const double time = 0.0125 * step;
      const double angle = -10 * std::sin(2 * std::numbers::pi * time);
      deformer.set_motion({turned_flap(angle)});
      const winslow::CommandResult now = deformer.step();
      if (now.smooth.inverted > 0 || now.smooth.fraction_reached < 1) {
        std::fprintf(stderr, "t = %.4f: %s\n", time, winslow::why_incomplete(now.smooth).c_str());
        return 4;
      }
      std::printf("t = %.4f: flap at %6.2f degrees, %d linear solves\n", time, angle,
                  now.smooth.linear_solves);
      // Here the flow solver takes its step on now.state.mesh.
    }
  } catch (const winslow::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
