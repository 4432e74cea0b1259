// A callback that shows every outer iteration and ends the run when it has had enough: here after a
// number of iterations, elsewhere when a user or a batch system says so.
//
//     ./progress_and_cancel three_element.su2 5
#include <winslow/winslow.h>

#include <cstdio>
#include <cstdlib>

namespace {

class Progress : public winslow::SolverMonitor {
 public:
  explicit Progress(int most) : most_(most) {}

  /// Called on the thread that solves. The coordinates are those of all nodes after the iteration.
  bool on_iteration(const winslow::IterationRecord& record,
                    const winslow::Coordinates& coordinates) override {
    std::printf("%3d  %3.0f %% of the way, residual %.1e, %d inverted of %d nodes' elements\n",
                record.iteration, 100 * record.fraction, record.residual, record.inverted,
                coordinates.size());
    return record.iteration < most_;  // false: execute() throws Cancelled
  }

 private:
  int most_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: progress_and_cancel MESH MOST_ITERATIONS\n");
    return 2;
  }
  try {
    const auto state = winslow::make_state(winslow::io::read_mesh(argv[1]).mesh);
    winslow::MoveCommand move;
    move.bodies[0].markers = {"flap"};
    move.bodies[0].motion.rotate = -10;
    Progress progress(std::atoi(argv[2]));
    winslow::RunOptions options;
    options.monitor = &progress;
    const auto result = winslow::execute(move, state, options);
    std::printf("done in %d iterations\n", result.smooth.outer_iterations);
  } catch (const winslow::Cancelled&) {
    std::printf("cancelled; the state is as it was\n");
  } catch (const winslow::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
