// Lets the nodes of some markers slide along the boundary while the mesh is smoothed, and says what
// they slid on.
//
//     ./sliding quads.su2 outer
#include <winslow/winslow.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: sliding MESH MARKER...\n");
    return 2;
  }
  try {
    const auto state = winslow::make_state(winslow::io::read_mesh(argv[1]).mesh);

    winslow::SmoothCommand smooth;
    smooth.smooth.slide.markers.assign(argv + 2, argv + argc);
    smooth.smooth.slide.feature_angle = 40;  // corners that turn by more stay, in degrees
    const winslow::CommandResult result = winslow::execute(smooth, state);

    for (const winslow::SlidingPart& part : result.smooth.boundary.sliding)
      std::printf("%s: %d nodes slid on %s\n", part.marker.c_str(),
                  static_cast<int>(part.sliding_nodes()), part.description.c_str());

    const auto before = winslow::measure_quality(state.mesh);
    const auto after = winslow::measure_quality(result.state.mesh);
    const auto sine = winslow::Metric::normalized_jacobian;
    std::printf("average sine %.4f before, %.4f after; %d inverted\n",
                before.of(sine).statistics.avg, after.of(sine).statistics.avg, after.inverted);
    return result.smooth.converged && after.inverted == 0 ? 0 : 5;
  } catch (const winslow::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
