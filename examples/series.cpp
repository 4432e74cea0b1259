// A mesh for each of many angles of a flap, as for a polar. Each is the mesh of a single motion
// from the mesh as given; neighbours help one another, so that a step needs two or three linear
// solves.
//
//     ./series three_element.su2 flap -9 6 3
#include <winslow/winslow.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fprintf(stderr, "usage: series IN MARKER FROM TO STEP\n");
    return 2;
  }
  try {
    const winslow::io::MeshFile file = winslow::io::read_mesh(argv[1]);
    const winslow::MeshState state = winslow::make_state(file.mesh);
    const double from = std::atof(argv[3]), to = std::atof(argv[4]), step = std::atof(argv[5]);

    winslow::Series series;
    for (int k = 0; from + k * step <= to; ++k) {
      winslow::MovingBody body;
      body.markers = {argv[2]};
      body.motion.rotate = from + k * step;  // about the body's own centre
      series.steps.push_back({body});
    }
    const auto status =
        winslow::run_series(series, state, [&](const winslow::SeriesResult& result) {
          const double angle = result.bodies[0].motion.rotate;
          if (result.status != winslow::SeriesStatus::done) {  // the others go on
            std::fprintf(stderr, "%g degrees: %s\n", angle, result.message.c_str());
            return;
          }
          const std::string name = "turned_" + std::to_string(result.step) + ".su2";
          winslow::io::write_mesh(name, result.run->state.mesh, file.details.get());
          std::printf("%g degrees: %s, %d linear solves\n", angle, name.c_str(),
                      result.run->smooth.linear_solves);
        });
    for (const winslow::SeriesStatus one : status)
      if (one != winslow::SeriesStatus::done) return 4;
  } catch (const winslow::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
