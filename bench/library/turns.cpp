// What a kept object saves: the flap of a wing turns step by step,
// - by a command each on the mesh as given,
// - by a command each on the mesh of the step before, without and with a SolverCache (the elements
//   then strive for other shapes from step to step),
// - by one Deformer.
// Seconds are those of the processor, over all threads; the least of three runs counts.
//
//     ./turns coarse/wing.su2.gz 20 -1
#include <winslow/winslow.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace {

struct Outcome {
  winslow::Coordinates mesh;
  int linear_solves = 0;
  double seconds = 1e300;
};

winslow::MoveCommand turned(double degrees) {
  winslow::MoveCommand command;
  command.bodies[0].markers = {"flap"};
  command.bodies[0].motion.rotate = degrees;
  command.bodies[0].motion.axis = winslow::Vec3(0.2555, 0.038, 1.5);
  command.smooth.tolerance = 1e-10;  // that of a Deformer
  return command;
}

/// step(k): the result of step k. Throws Error for one that does not come to its end.
template <class Step>
Outcome timed(int turns, const Step& step) {
  Outcome outcome;
  const std::clock_t begin = std::clock();
  for (int k = 1; k <= turns; ++k) {
    winslow::CommandResult result = step(k);
    if (result.smooth.inverted > 0 || result.smooth.fraction_reached < 1)
      throw winslow::Error(winslow::why_incomplete(result.smooth));
    outcome.linear_solves += result.smooth.linear_solves;
    outcome.mesh = std::move(result.state.mesh.coordinates);
  }
  outcome.seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  return outcome;
}

Outcome from_given(const winslow::MeshState& start, int turns, double degrees) {
  return timed(turns, [&](int k) { return winslow::execute(turned(k * degrees), start); });
}

Outcome one_by_one(const winslow::MeshState& start, int turns, double degrees, bool cached) {
  winslow::SolverCache cache;
  winslow::RunOptions options;
  if (cached) options.cache = &cache;
  winslow::MeshState state = start;
  return timed(turns, [&](int) {
    winslow::CommandResult result = winslow::execute(turned(degrees), state, options);
    state = result.state;
    return result;
  });
}

Outcome steps(const winslow::MeshState& start, int turns, double degrees) {
  winslow::Deformer deformer(start);
  return timed(turns, [&](int k) {
    deformer.set_motion(turned(k * degrees).bodies);
    return deformer.step();
  });
}

double difference(const winslow::Coordinates& a, const winslow::Coordinates& b) {
  double largest = 0;
  for (std::size_t k = 0; k < a.values().size(); ++k)
    largest = std::max(largest, std::abs(a.values()[k] - b.values()[k]));
  return largest;
}

void keep_best(Outcome& best, Outcome outcome) {
  if (outcome.seconds < best.seconds) best = std::move(outcome);
}

void print(const char* what, const Outcome& outcome, const Outcome& reference) {
  std::printf("%-38s %4d linear solves  %7.3f s  %5.1f %% less\n", what, outcome.linear_solves,
              outcome.seconds, 100 * (1 - outcome.seconds / reference.seconds));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: turns WING TURNS DEGREES\n");
    return 2;
  }
  try {
    const auto start = winslow::make_state(winslow::io::read_mesh(argv[1]).mesh);
    const int turns = std::atoi(argv[2]);
    const double degrees = std::atof(argv[3]);
    Outcome given, chain, cached, moving;
    for (int run = 0; run < 3; ++run) {
      keep_best(given, from_given(start, turns, degrees));
      keep_best(chain, one_by_one(start, turns, degrees, false));
      keep_best(cached, one_by_one(start, turns, degrees, true));
      keep_best(moving, steps(start, turns, degrees));
    }
    print("from the mesh as given", given, given);
    print("from the mesh before", chain, given);
    print("from the mesh before, SolverCache", cached, given);
    print("Deformer", moving, given);
    const double apart =
        std::max(difference(given.mesh, moving.mesh), difference(chain.mesh, cached.mesh));
    std::printf("nodes are %.1e apart at most, with and without\n", apart);
    return apart < 1e-8 ? 0 : 1;
  } catch (const winslow::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
