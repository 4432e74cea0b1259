// Threads: one run uses all cores, or several runs go on at the same time, one thread and one cache
// each. The meshes are the same, bit for bit.
//
//     ./threads naca0012.su2 airfoil
#include <winslow/winslow.h>

#include <cstdio>
#include <exception>
#include <future>
#include <vector>

namespace {

winslow::MeshState turned(const winslow::MeshState& state, const char* body, double degrees,
                          int threads) {
  winslow::MoveCommand move;
  move.bodies[0].markers = {body};
  move.bodies[0].motion.rotate = degrees;
  move.smooth.threads = threads;  // 0: all cores
  winslow::SolverCache cache;     // of this run alone: a cache serves one call at a time
  winslow::RunOptions options;
  options.cache = &cache;
  return winslow::execute(move, state, options).state;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: threads MESH BODY\n");
    return 2;
  }
  try {
    const auto state = winslow::make_state(winslow::io::read_mesh(argv[1]).mesh);
    // States are values and share what never changes, so that runs may begin from one at once.
    std::vector<std::future<winslow::MeshState>> runs;
    for (const double degrees : {-10.0, 10.0, 20.0})
      runs.push_back(std::async(std::launch::async, turned, state, argv[2], degrees, 1));
    std::vector<winslow::MeshState> results;
    for (auto& run : runs) results.push_back(run.get());  // throws what the run has thrown

    const winslow::MeshState again = turned(state, argv[2], 20, 0);
    const bool same = again.mesh.coordinates == results.back().mesh.coordinates;
    std::printf("%d runs at once; on all cores the last one gives %s mesh\n",
                static_cast<int>(results.size()), same ? "the same" : "ANOTHER");
    return same ? 0 : 1;
  } catch (const std::exception& error) {  // of winslow, or of a thread that cannot be started
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
