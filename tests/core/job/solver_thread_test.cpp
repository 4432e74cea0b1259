#include "core/job/solver_thread.h"

#include <doctest/doctest.h>

#include <chrono>
#include <functional>
#include <limits>
#include <thread>

#include "core/error.h"
#include "support/coordinate.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

using Clock = std::chrono::steady_clock;

MeshState hole_state(Index n = 20) {
  return make_state(make_mesh(square_with_hole(n, Cells::triangles)));
}

MoveCommand shift(double by) {
  MoveCommand command;
  command.bodies[0].markers = {"hole"};
  command.bodies[0].motion.translate = {by, 0};
  command.smooth.threads = 1;
  return command;
}

/// A job that goes on for minutes if it is let.
SmoothCommand endless() {
  SmoothCommand command;
  command.smooth.formulation = Formulation::pointwise;
  command.smooth.outer = OuterMethod::picard;
  command.smooth.threads = 1;
  command.smooth.damping = 1e-6;
  command.smooth.acceleration = 0;
  command.smooth.adapt_damping = false;
  command.smooth.max_iterations = 10000000;
  return command;
}

MeshState perturbed_state(Index n = 20) {
  MeshState state = hole_state(n);
  Random random(3);
  perturb(state.mesh, random);
  return state;
}

/// Waits for a snapshot that is as wanted; fails after a time that no healthy run needs.
std::shared_ptr<const Snapshot> wait_for(const SolverThread& thread,
                                         const std::function<bool(const Snapshot&)>& wanted) {
  const auto limit = Clock::now() + std::chrono::minutes(10);
  while (Clock::now() < limit) {
    const auto snapshot = thread.latest();
    if (wanted(*snapshot)) return snapshot;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  FAIL("the snapshot did not come");
  return nullptr;
}

std::shared_ptr<const Snapshot> wait_for(const SolverThread& thread, std::uint64_t job,
                                         JobState state) {
  return wait_for(thread, [&](const Snapshot& s) { return s.job == job && s.state == state; });
}

int last_iteration(const Snapshot& snapshot) {
  return snapshot.history.empty() ? -1 : snapshot.history.back().iteration;
}

std::shared_ptr<const Snapshot> wait_paused_at(const SolverThread& thread, int iteration) {
  return wait_for(thread, [&](const Snapshot& s) {
    return s.state == JobState::paused && last_iteration(s) == iteration;
  });
}

}  // namespace

TEST_CASE("a new thread is idle and its snapshot is empty") {
  SolverThread thread;
  CHECK_FALSE(thread.busy());
  const auto snapshot = thread.latest();
  REQUIRE(snapshot);
  CHECK(snapshot->state == JobState::idle);
  CHECK(snapshot->job == 0);
  thread.pause();
  thread.resume();
  thread.step(3);
  thread.cancel();
  thread.retarget(SmoothCommand{});
  CHECK_FALSE(thread.busy());
  CHECK(thread.latest()->state == JobState::idle);
}

TEST_CASE("a job's result is that of execute, to the bit") {
  const MeshState state = hole_state();
  SolverThread thread;
  for (const Command& command : {Command(shift(0.1)), Command(ScrambleCommand{2}),
                                 Command(SmoothCommand{}), Command(shift(-0.05))}) {
    const CommandResult expected = execute(command, state);
    const std::uint64_t job = thread.run(state, command);
    const auto snapshot = wait_for(thread, job, JobState::done);
    REQUIRE(snapshot->result.has_value());
    CHECK(snapshot->result->state.mesh.coordinates == expected.state.mesh.coordinates);
    CHECK(snapshot->mesh->coordinates == expected.state.mesh.coordinates);
    CHECK(snapshot->result->smooth.outer_iterations == expected.smooth.outer_iterations);
    CHECK(snapshot->history.size() == expected.smooth.history.size());
    CHECK(snapshot->mesh->topology == state.mesh.topology);
    CHECK(snapshot->command.has_value());
    CHECK(snapshot->error.empty());
    CHECK_FALSE(thread.busy());
  }
}

TEST_CASE("a job's first snapshot is there when run returns") {
  const MeshState state = hole_state();
  SolverThread thread;
  const std::uint64_t job = thread.run(state, shift(0.1), {}, true);
  const auto snapshot = thread.latest();
  CHECK(snapshot->job == job);
  CHECK((snapshot->state == JobState::running || snapshot->state == JobState::paused));
  CHECK(thread.busy());
}

TEST_CASE("a job started paused waits before its first iteration; steps are counted exactly") {
  const MeshState state = perturbed_state();
  SolverThread thread;
  thread.run(state, endless(), {}, true);
  const auto first = wait_paused_at(thread, 0);
  CHECK(first->mesh->coordinates == state.mesh.coordinates);
  int expected = 0;
  for (const int n : {1, 1, 5, 2}) {
    thread.step(n);
    expected += n;
    wait_paused_at(thread, expected);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(last_iteration(*thread.latest()) == expected);
    CHECK(thread.latest()->history.size() == static_cast<std::size_t>(expected) + 1);
    CHECK(thread.busy());
  }
  thread.step(0);
  thread.step(-2);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  CHECK(last_iteration(*thread.latest()) == expected);
}

TEST_CASE("steps asked for in quick succession add up") {
  SolverThread thread;
  thread.run(perturbed_state(), endless(), {}, true);
  wait_paused_at(thread, 0);
  for (int k = 0; k < 10; ++k) thread.step(1);
  wait_paused_at(thread, 10);
}

TEST_CASE("pause holds, resume goes on, and the result is the same") {
  const MeshState state = hole_state();
  const CommandResult expected = execute(shift(0.1), state);
  SolverThread thread;
  const std::uint64_t job = thread.run(state, shift(0.1), {}, true);
  wait_paused_at(thread, 0);
  thread.step(3);
  wait_paused_at(thread, 3);
  thread.resume();
  const auto done = wait_for(thread, job, JobState::done);
  CHECK(done->mesh->coordinates == expected.state.mesh.coordinates);

  thread.run(perturbed_state(), endless());
  wait_for(thread, [](const Snapshot& s) { return last_iteration(s) > 2; });
  thread.pause();
  const auto paused =
      wait_for(thread, [](const Snapshot& s) { return s.state == JobState::paused; });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  CHECK(thread.latest()->serial == paused->serial);
  thread.resume();
  wait_for(thread, [&](const Snapshot& s) {
    return s.state == JobState::running && last_iteration(s) > last_iteration(*paused) + 2;
  });
}

TEST_CASE("cancel ends a running and a paused job without a result") {
  for (const bool paused : {false, true}) {
    CAPTURE(paused);
    SolverThread thread;
    const std::uint64_t job = thread.run(perturbed_state(), endless(), {}, paused);
    if (paused) {
      wait_paused_at(thread, 0);
    } else {
      wait_for(thread, [](const Snapshot& s) { return last_iteration(s) > 0; });
    }
    thread.cancel();
    const auto snapshot = wait_for(thread, job, JobState::cancelled);
    CHECK_FALSE(snapshot->result.has_value());
    CHECK(snapshot->error.empty());
    CHECK_FALSE(thread.busy());
    const std::uint64_t next = thread.run(hole_state(), shift(0.05));
    CHECK(wait_for(thread, next, JobState::done)->result.has_value());
  }
}

TEST_CASE("retargeting during a run ends at the last target") {
  const MeshState state = hole_state();
  const CommandResult expected = execute(shift(0.12), state);
  SolverThread thread;
  const std::uint64_t job = thread.run(state, shift(0.01));
  for (int k = 2; k <= 12; ++k) {
    thread.retarget(shift(0.01 * k));
    if (k % 3 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const auto done = wait_for(thread, [&](const Snapshot& s) {
    return s.state == JobState::done && s.command && describe(*s.command) == describe(shift(0.12));
  });
  CHECK(done->job >= job);
  REQUIRE(done->result.has_value());
  CHECK(done->result->smooth.converged);
  CHECK(largest_difference(done->mesh->coordinates, expected.state.mesh.coordinates) < 1e-8);
  CHECK_FALSE(thread.busy());
}

TEST_CASE("retargeting a paused job keeps its number and its pause, and numbers iterations on") {
  const MeshState state = hole_state();
  SolverThread thread;
  const std::uint64_t job = thread.run(state, shift(0.05), {}, true);
  wait_paused_at(thread, 0);
  thread.step(2);
  wait_paused_at(thread, 2);
  thread.retarget(shift(0.1));
  wait_for(thread, [](const Snapshot& s) {
    return s.state == JobState::paused && s.command && describe(*s.command) == describe(shift(0.1));
  });
  thread.step(1);
  const auto after = wait_paused_at(thread, 3);
  CHECK(after->job == job);
  for (std::size_t k = 1; k < after->history.size(); ++k) {
    CHECK(after->history[k].iteration >= after->history[k - 1].iteration);
  }
  thread.resume();
  const auto done = wait_for(thread, job, JobState::done);
  const CommandResult expected = execute(shift(0.1), state);
  CHECK(largest_difference(done->mesh->coordinates, expected.state.mesh.coordinates) < 1e-8);
}

TEST_CASE("retargeting after the end starts again on the same state, from where it got to") {
  const MeshState state = hole_state();
  // Targets `keep` would have a start by a twist, which is as near.
  const auto along_path = [](double way) {
    auto command = shift(way);
    command.smooth.targets = TargetBlend::automatically();
    return command;
  };
  SolverThread thread;
  const std::uint64_t job = thread.run(state, along_path(0.05));
  wait_for(thread, job, JobState::done);
  thread.retarget(along_path(0.06));
  const auto done = wait_for(thread, job + 1, JobState::done);
  // On the state of the first run, not on its result: 0.06 in all.
  const CommandResult expected = execute(along_path(0.06), state);
  CHECK(largest_difference(done->mesh->coordinates, expected.state.mesh.coordinates) < 1e-8);
  CHECK(done->result->smooth.outer_iterations < expected.smooth.outer_iterations);
}

TEST_CASE("a target set right after a cancel is not lost") {
  const MeshState state = perturbed_state();
  SolverThread thread;
  for (int k = 0; k < 20; ++k) {
    thread.run(state, endless());
    if (k % 2 == 0) wait_for(thread, [](const Snapshot& s) { return !s.history.empty(); });
    thread.cancel();
    thread.retarget(shift(0.05));
    const auto done = wait_for(thread, [](const Snapshot& s) {
      return s.command && command_name(*s.command) == "move" && s.state != JobState::running;
    });
    CHECK(done->state == JobState::done);
  }
}

TEST_CASE("a new run supersedes the one under way") {
  const MeshState state = hole_state();
  const CommandResult expected = execute(shift(0.1), state);
  SolverThread thread;
  std::uint64_t job = thread.run(perturbed_state(), endless());
  for (int k = 0; k < 5; ++k) {
    const std::uint64_t next = thread.run(perturbed_state(), endless(), {}, k % 2 == 0);
    CHECK(next == job + 1);
    CHECK(thread.latest()->job == next);
    job = next;
  }
  job = thread.run(state, shift(0.1));
  const auto done = wait_for(thread, job, JobState::done);
  CHECK(done->mesh->coordinates == expected.state.mesh.coordinates);
}

TEST_CASE("a run on another topology leaves nothing of the first") {
  const MeshState first = hole_state(), second = hole_state(10);
  SolverThread thread;
  thread.run(first, endless());
  const std::uint64_t job = thread.run(second, shift(0.05));
  const auto done = wait_for(thread, job, JobState::done);
  CHECK(done->mesh->topology == second.mesh.topology);
  CHECK(done->mesh->coordinates == execute(shift(0.05), second).state.mesh.coordinates);
}

TEST_CASE("a start leads to the same mesh") {
  const MeshState state = hole_state();
  const CommandResult expected = execute(shift(0.1), state);
  SolverThread thread;
  const std::uint64_t job =
      thread.run(state, shift(0.1), execute(shift(0.09), state).state.mesh.coordinates);
  const auto done = wait_for(thread, job, JobState::done);
  CHECK(largest_difference(done->mesh->coordinates, expected.state.mesh.coordinates) < 1e-8);
}

TEST_CASE("a snapshot never changes after it was published, serials grow") {
  SolverThread thread;
  thread.run(perturbed_state(), endless());
  struct Kept {
    std::shared_ptr<const Snapshot> snapshot;
    Coordinates coordinates;
    std::size_t records;
    JobState state;
  };
  std::vector<Kept> kept;
  while (kept.size() < 20) {
    const auto s = thread.latest();
    if (!kept.empty() && s->serial == kept.back().snapshot->serial) continue;
    if (!kept.empty()) CHECK(s->serial > kept.back().snapshot->serial);
    kept.push_back({s, s->mesh->coordinates, s->history.size(), s->state});
  }
  thread.cancel();
  wait_for(thread, [](const Snapshot& s) { return s.state == JobState::cancelled; });
  for (const Kept& k : kept) {
    CHECK(k.snapshot->mesh->coordinates == k.coordinates);
    CHECK(k.snapshot->history.size() == k.records);
    CHECK(k.snapshot->state == k.state);
  }
}

TEST_CASE("the destructor ends running, paused, pending and finished jobs") {
  for (int k = 0; k < 8; ++k) {
    CAPTURE(k);
    SolverThread thread;
    thread.run(perturbed_state(), endless(), {}, k % 2 == 1);
    if (k / 2 % 2 == 1) {
      wait_for(thread, [](const Snapshot& s) { return !s.history.empty(); });
    }
    if (k >= 4) thread.retarget(shift(0.05));
  }
  SolverThread finished;
  const std::uint64_t job = finished.run(hole_state(), shift(0.01));
  wait_for(finished, job, JobState::done);
}

TEST_CASE("a job that fails says why, and the thread lives on") {
  SolverThread thread;
  MoveCommand bad = shift(0.1);
  bad.bodies[0].markers = {"wing"};
  const std::uint64_t job = thread.run(hole_state(), bad);
  const auto failed = wait_for(thread, job, JobState::failed);
  CHECK(failed->error == "no marker named 'wing'; the mesh has: outer, hole");
  CHECK_FALSE(failed->result.has_value());
  CHECK_FALSE(thread.busy());
  MeshState broken = hole_state();
  coordinate(broken.mesh.coordinates, broken.mesh.topology->interior_nodes()[0], 0) =
      std::numeric_limits<double>::quiet_NaN();
  const std::uint64_t second = thread.run(broken, SmoothCommand{});
  CHECK(!wait_for(thread, second, JobState::failed)->error.empty());
  const std::uint64_t third = thread.run(hole_state(), shift(0.1));
  CHECK(wait_for(thread, third, JobState::done)->result.has_value());
}

TEST_CASE("no member waits for an iteration") {
  // Iterations of this mesh take milliseconds each, calls microseconds. A member that waited for
  // an iteration to end would find another one published after every call.
  SolverThread thread;
  thread.run(perturbed_state(60), endless());
  const auto within_an_iteration = [&](const std::function<void()>& call) {
    int count = 0;
    for (int k = 0; k < 50; ++k) {
      const int before = last_iteration(*thread.latest());
      call();
      if (last_iteration(*thread.latest()) == before) ++count;
      thread.resume();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return count;
  };
  CHECK(within_an_iteration([&] { thread.latest(); }) > 0);
  CHECK(within_an_iteration([&] { thread.busy(); }) > 0);
  CHECK(within_an_iteration([&] { thread.pause(); }) > 0);
  CHECK(within_an_iteration([&] { thread.resume(); }) > 0);
  CHECK(within_an_iteration([&] { thread.retarget(endless()); }) > 0);
  CHECK(thread.busy());
  thread.cancel();
}

TEST_CASE("a pace holds iterations back; pause, cancel and another pace act at once") {
  const MeshState state = perturbed_state();
  SolverThread thread;
  thread.set_pace(50);
  const auto start = Clock::now();
  const std::uint64_t job = thread.run(state, endless());
  wait_for(thread, [](const Snapshot& s) { return last_iteration(s) >= 5; });
  CHECK(Clock::now() - start >= std::chrono::milliseconds(80));
  // One in a thousand seconds: only what acts at once ends these waits.
  thread.set_pace(1e-3);
  thread.pause();
  const int at = last_iteration(*wait_for(thread, job, JobState::paused));
  thread.step(2);
  thread.set_pace(0);
  wait_paused_at(thread, at + 2);
  thread.set_pace(1e-3);
  thread.resume();
  thread.cancel();
  wait_for(thread, job, JobState::cancelled);
}

TEST_CASE("a follower misses no iteration; nobody is waited for once it has left") {
  const MeshState state = perturbed_state();
  SolverThread thread;
  thread.wait_for_viewer(0);
  const std::uint64_t job = thread.run(state, endless());
  int seen = -1;
  for (int k = 0; k < 8; ++k) {
    const auto snapshot =
        wait_for(thread, [&](const Snapshot& s) { return last_iteration(s) > seen; });
    // A worker that did not wait would be some iterations further by now.
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    CHECK(thread.latest()->serial == snapshot->serial);
    CHECK(last_iteration(*snapshot) == seen + 1);
    seen = last_iteration(*snapshot);
    thread.wait_for_viewer(snapshot->serial);
  }
  thread.pause();  // while the worker waits for its follower
  const int at = last_iteration(*wait_for(thread, job, JobState::paused));
  thread.resume();
  thread.wait_for_viewer({});
  wait_for(thread, [&](const Snapshot& s) { return last_iteration(s) >= at + 20; });
  thread.wait_for_viewer(0);
  thread.cancel();
  wait_for(thread, job, JobState::cancelled);
}
