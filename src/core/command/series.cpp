#include "core/command/series.h"

#include <chrono>
#include <condition_variable>
#include <deque>

#include "core/error.h"
#include "core/motion/body_ways.h"
#include "core/parallel/parallel_for.h"
#include "core/quality/quality.h"

namespace winslow {

namespace {

using Bodies = std::vector<MovingBody>;
using KnownMesh = std::shared_ptr<const Coordinates>;

constexpr double farthest_turn = 90;   // degrees, from a neighbour
constexpr double largest_whole = 180;  // degrees, of a step that begins from a neighbour
constexpr std::size_t most_known = 4;  // meshes that predict the next one
constexpr double sliver = 0.1;         // of the smallest sine of the mesh as given

/// The steps as a tree: each begins from its parent's mesh.
class SeriesTree {
 public:
  /// steps: with pivots. neighbours: false if all steps begin from the mesh as given.
  SeriesTree(std::span<const Bodies> steps, const Mesh& mesh, bool neighbours)
      : steps_(steps), mesh_(mesh), parent_(steps.size()), children_(steps.size()) {
    for (const Bodies& bodies : steps)
      for (const MovingBody& body : bodies) boxes_.try_emplace(body.markers, box_of(body.markers));
    for (const Marker& marker : mesh.topology->markers())
      if (!marker.faces.empty()) finest_ = std::min(finest_, box_of({marker.name}).size().norm());
    if (neighbours) span();
    for (std::size_t i = 0; i < steps.size(); ++i)
      (parent_[i] ? children_[*parent_[i]] : roots_).push_back(i);
    find_heirs();
  }

  const std::vector<std::size_t>& roots() const { return roots_; }
  std::optional<std::size_t> parent(std::size_t step) const { return parent_[step]; }
  const std::vector<std::size_t>& children(std::size_t step) const { return children_[step]; }
  /// The child that goes on with the solvers of its parent: the one with most steps behind it.
  std::optional<std::size_t> heir(std::size_t step) const { return heirs_[step]; }

  /// How a step gets to another; none: it should not begin there.
  std::optional<NearStart> way(std::size_t from, std::size_t to) const {
    const auto found = ways_between(steps_[from], steps_[to]);
    if (!found || largest_turn(*found) > farthest_turn) return std::nullopt;
    NearStart start{.way = *found, .as_without = true};
    if (on_one_way(steps_[from], steps_[to])) return start;
    // Bodies thinner than the way between two of these would not be noticed.
    constexpr int ways_beside = 3;
    if (length(*found, steps_[from]) > 0.5 * (ways_beside + 1) * finest_) return std::nullopt;
    for (int k = 1; k <= ways_beside; ++k)
      start.beside.push_back(
          part_of_way(steps_[from], *found, static_cast<double>(k) / (ways_beside + 1)));
    return start;
  }

 private:
  Box<3> box_of(const std::vector<std::string>& markers) const {
    return body_box(mesh_.coordinates, mesh_.topology->markers().nodes_of(markers));
  }
  double length(const Bodies& way, const Bodies& from) const {
    return longest_way(way, from,
                       [this](const MovingBody& body) { return boxes_.at(body.markers); });
  }

  /// Prim's algorithm from the mesh as given.
  void span() {
    const std::size_t count = steps_.size();
    std::vector<double> distance(count);
    std::vector<bool> done(count, false);
    for (std::size_t i = 0; i < count; ++i) distance[i] = length(steps_[i], {});
    for (std::size_t round = 0; round < count; ++round) {
      std::size_t next = count;
      for (std::size_t i = 0; i < count; ++i)
        if (!done[i] && (next == count || distance[i] < distance[next])) next = i;
      done[next] = true;
      for (std::size_t i = 0; i < count; ++i) {
        if (done[i] || distance[i] == 0 || largest_turn(steps_[i]) > largest_whole) continue;
        const auto way = ways_between(steps_[next], steps_[i]);
        if (!way || largest_turn(*way) > farthest_turn) continue;
        const double there = length(*way, steps_[next]);
        if (there >= distance[i] || !this->way(next, i)) continue;
        distance[i] = there;
        parent_[i] = next;
      }
    }
  }

  void find_heirs() {
    heirs_.resize(steps_.size());
    std::vector<std::size_t> order = roots_;
    for (std::size_t k = 0; k < order.size(); ++k)
      order.insert(order.end(), children_[order[k]].begin(), children_[order[k]].end());
    std::vector<std::size_t> size(steps_.size(), 1);
    for (auto step = order.rbegin(); step != order.rend(); ++step) {
      for (const std::size_t child : children_[*step]) {
        size[*step] += size[child];
        if (!heirs_[*step] || size[child] > size[*heirs_[*step]]) heirs_[*step] = child;
      }
    }
  }

  std::span<const Bodies> steps_;
  const Mesh& mesh_;
  double finest_ = std::numeric_limits<double>::infinity();  // extent of the smallest marker
  std::vector<std::optional<std::size_t>> parent_;           // none: the mesh as given
  std::vector<std::vector<std::size_t>> children_;
  std::vector<std::size_t> roots_;
  std::vector<std::optional<std::size_t>> heirs_;
  std::map<std::vector<std::string>, Box<3>> boxes_;  // around bodies, by their markers
};

/// The bodies of all steps with their pivots. Throws UsageError as run_series() does.
std::vector<Bodies> with_pivots(const Series& series, const MeshState& state) {
  const MeshState* states = &state;
  std::vector<Bodies> steps;
  for (std::size_t i = 0; i < series.steps.size(); ++i) {
    try {
      const Mesh& mesh = state.mesh;
      make_motion(*mesh.topology, mesh.coordinates, std::span(series.steps[i]));
    } catch (const UsageError& error) {
      throw UsageError("step " + std::to_string(i + 1) + ": " + error.what());
    }
    MoveCommand command;
    command.bodies = series.steps[i];
    steps.push_back(
        std::get<MoveCommand>(with_pivot(std::move(command), std::span(&states, 1))).bodies);
  }
  return steps;
}

SeriesStatus status_of(const SmoothResult& smooth) {
  if (smooth.inverted > 0) return SeriesStatus::inverted;
  if (smooth.fraction_reached < 1 || !smooth.limited_by.empty()) return SeriesStatus::incomplete;
  return smooth.converged ? SeriesStatus::done : SeriesStatus::not_converged;
}

std::string message_of(const SmoothResult& smooth, SeriesStatus status) {
  switch (status) {
    case SeriesStatus::incomplete:
      return why_incomplete(smooth);
    case SeriesStatus::inverted:
      return std::to_string(smooth.inverted) + " inverted element" +
             (smooth.inverted == 1 ? "" : "s");
    case SeriesStatus::not_converged:
      return gains_no_more(smooth) ? "neither the energy nor the residual gains any more"
                                   : "the limit of iterations was reached";
    default:
      return {};
  }
}

/// Passes the iterations of one step on. Ends them if the series has ended.
class StepMonitor final : public SolverMonitor {
 public:
  StepMonitor(SeriesMonitor& monitor, std::size_t step, const std::atomic<bool>& ended)
      : monitor_(monitor), step_(step), ended_(ended) {}
  bool on_iteration(const IterationRecord& record, const Coordinates& x) override {
    return !ended_ && monitor_.on_iteration(step_, record, x);
  }
  bool cancelled() override { return ended_ || monitor_.cancelled(); }

 private:
  SeriesMonitor& monitor_;
  std::size_t step_;
  const std::atomic<bool>& ended_;
};

/// Carries out the steps of a tree on several threads. A chain of steps, each the heir of the one
/// before, shares solvers, and its steps come one after another. So all that a step gets from
/// others is given by the tree, whatever the number of threads.
class SeriesRun {
 public:
  SeriesRun(const Series& series, const MeshState& state, SeriesMonitor& monitor)
      : series_(series),
        state_(state),
        monitor_(monitor),
        steps_(with_pivots(series, state)),
        tree_(steps_, state.mesh, starts_at_neighbours(series, state)),
        status_(steps_.size(), SeriesStatus::failed) {
    common_.how = series.how;
    // Which step begins from which other one must not be seen in the meshes.
    common_.smooth = independent_of_start(series.smooth);
    smallest_sine_given_ = smallest_sine(state.mesh);
  }

  std::vector<SeriesStatus> run() {
    const std::size_t most = std::max<std::size_t>(1, steps_.size());
    const std::size_t jobs = std::min(most, static_cast<std::size_t>(thread_count(series_.jobs)));
    if (jobs > 1) common_.smooth.threads = 1;
    const Line rest{{{}, std::make_shared<const Coordinates>(state_.mesh.coordinates)}};
    for (const std::size_t root : tree_.roots())
      waiting_.push_back({root, begin_chain(), rest, nullptr});
    left_ = steps_.size();
    {
      std::vector<std::jthread> others;
      try {
        for (std::size_t k = 1; k < jobs; ++k) others.emplace_back([this] { work(); });
      } catch (const std::system_error&) {
        // The threads that there are do the work.
      }
      work();
    }
    if (error_) std::rethrow_exception(error_);
    return status_;
  }

 private:
  using Cache = std::shared_ptr<SolverCache>;
  struct Known {
    std::optional<std::size_t> step;  // none: the mesh as given
    KnownMesh mesh;
  };
  /// The meshes of the steps before one in the tree that have reached their ends, the nearest
  /// first.
  using Line = std::vector<Known>;
  /// What a thread does next: carry a step out, or hand its result over.
  struct Task {
    std::size_t step;
    Cache cache;
    Line before;
    std::shared_ptr<const SeriesResult> result;  // null: carry it out
  };

  static Cache begin_chain() { return std::make_shared<SolverCache>(); }

  void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      wake_.wait(lock, [&] { return ended_ || left_ == 0 || !waiting_.empty(); });
      if (ended_ || left_ == 0) return;
      Task task = std::move(waiting_.front());
      waiting_.pop_front();
      lock.unlock();
      std::exception_ptr error;
      try {
        task.result ? monitor_.on_result(*task.result) : carry_out(task);
      } catch (...) {
        error = std::current_exception();
      }
      lock.lock();
      if (error && !ended_) error_ = error;
      ended_ = ended_ || error;
      if (task.result) --left_;
      if (ended_ || left_ == 0) wake_.notify_all();
    }
  }

  void carry_out(const Task& task) {
    monitor_.on_begin(task.step);
    const auto begin = std::chrono::steady_clock::now();
    const auto result = std::make_shared<SeriesResult>(execute_step(task));
    result->seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const std::vector<std::size_t>& children = tree_.children(task.step);
    Line line = task.before;
    if (!children.empty() && result->run && serves_others(*result->run)) {
      line.insert(
          line.begin(),
          {task.step, std::make_shared<const Coordinates>(result->run->state.mesh.coordinates)});
      line.resize(std::min(line.size(), most_known));
    }
    const std::lock_guard lock(mutex_);
    status_[task.step] = result->status;
    // Results first, and then on along the chain: few meshes wait.
    const auto heir = tree_.heir(task.step);
    for (const std::size_t child : children)
      if (child != *heir) waiting_.push_back({child, begin_chain(), line, nullptr});
    if (heir) waiting_.push_front({*heir, task.cache, line, nullptr});
    waiting_.push_front({task.step, nullptr, {}, result});
    wake_.notify_all();
  }

  SeriesResult execute_step(const Task& task) {
    SeriesResult result;
    result.step = task.step;
    result.bodies = steps_[task.step];
    MoveCommand command = common_;
    command.bodies = steps_[task.step];
    const ResolvedCommand resolved(std::move(command), series_.files);
    StepMonitor monitor(monitor_, task.step, ended_);
    RunOptions options;
    options.monitor = &monitor;
    options.cache = task.cache.get();
    options.all_or_nothing = !series_.accept_partial;
    int solves = 0, iterations = 0;
    try {
      if (!from_neighbour(resolved, options, task.before, result)) {
        if (result.run) {
          solves = result.run->smooth.linear_solves;
          iterations = result.run->smooth.outer_iterations;
        }
        result.begins.reset();
        result.run = execute(resolved, state_, options);
      }
      SmoothResult& smooth = result.run->smooth;
      smooth.linear_solves += solves;
      smooth.outer_iterations += iterations;
      result.status = status_of(smooth);
      result.message = message_of(smooth, result.status);
    } catch (const Cancelled&) {
      throw;
    } catch (const Error& error) {
      result.run.reset();
      result.status = SeriesStatus::failed;
      result.message = error.what();
    }
    return result;
  }

  /// Returns false if the step has to begin from the mesh as given; result.run is then what was
  /// tried in vain, if anything.
  bool from_neighbour(const ResolvedCommand& command, RunOptions options, const Line& before,
                      SeriesResult& result) {
    const Known& nearest = before.front();
    if (!tree_.parent(result.step) || !nearest.step) return false;
    auto start = tree_.way(*nearest.step, result.step);
    if (!start) return false;
    result.begins = nearest.step;
    options.start = nearest.mesh.get();
    options.near = std::move(*start);
    for (auto known = before.begin() + 1; known != before.end(); ++known)
      options.near.earlier.push_back(known->mesh);
    options.all_or_nothing = true;
    try {
      result.run = execute(command, state_, options);
    } catch (const Cancelled&) {
      throw;
    } catch (const Error&) {
      return false;
    }
    return serves_others(*result.run);
  }

  /// Whether the mesh is the only solution as far as we know: among meshes with slivers there may
  /// be several.
  bool serves_others(const CommandResult& run) const {
    if (status_of(run.smooth) != SeriesStatus::done) return false;
    return smallest_sine(run.state.mesh) >= sliver * smallest_sine_given_;
  }
  double smallest_sine(const Mesh& mesh) const {
    return check_validity(*mesh.topology, mesh.coordinates, common_.smooth.threads).min_sine;
  }

  const Series& series_;
  const MeshState& state_;
  SeriesMonitor& monitor_;
  MoveCommand common_;
  std::vector<Bodies> steps_;
  SeriesTree tree_;
  double smallest_sine_given_ = 0;
  std::mutex mutex_;  // guards all below
  std::condition_variable wake_;
  std::deque<Task> waiting_;
  std::vector<SeriesStatus> status_;
  std::size_t left_ = 0;  // results that were not handed over yet
  std::atomic<bool> ended_ = false;
  std::exception_ptr error_;
};

/// Hands results over to a function, one at a time.
class FunctionMonitor final : public SeriesMonitor {
 public:
  explicit FunctionMonitor(const std::function<void(const SeriesResult&)>& on_result)
      : on_result_(on_result) {}
  void on_result(const SeriesResult& result) override {
    const std::lock_guard lock(mutex_);
    on_result_(result);
  }

 private:
  const std::function<void(const SeriesResult&)>& on_result_;
  std::mutex mutex_;
};

}  // namespace

std::string_view status_name(SeriesStatus status) {
  constexpr std::array<std::string_view, 5> names{"done", "not converged", "incomplete", "inverted",
                                                  "failed"};
  return names[static_cast<std::size_t>(status)];
}

bool starts_at_neighbours(const Series& series, const MeshState& state) {
  const SmoothOptions& smooth = series.smooth;
  const Mesh& mesh = state.mesh;
  return follows_path(series.how, smooth) && !series.how.floor.given() &&
         smooth.formulation == Formulation::variational &&
         smooth.targets.or_else(TargetBlend::keeping()).keep > 0 && !smooth.raise_worst &&
         !holds_layers(state) && smooth.slide.reference.empty() &&
         check_validity(*mesh.topology, mesh.coordinates, smooth.threads).inverted == 0;
}

void check_series(const Series& series, const MeshState& state) {
  if (series.steps.empty()) throw UsageError("a series without steps: what is to move?");
  if (series.jobs < 0) throw UsageError("the number of jobs is negative");
  const std::vector<Bodies> steps = with_pivots(series, state);
  MoveCommand rest;  // checks the options
  rest.bodies = steps.front();
  for (MovingBody& body : rest.bodies) body.motion = at_rest(body.motion);
  rest.how = series.how;
  rest.smooth = series.smooth;
  execute(ResolvedCommand(std::move(rest), series.files), state);
}

std::vector<SeriesStatus> run_series(const Series& series, const MeshState& state,
                                     SeriesMonitor& monitor) {
  check_series(series, state);
  return SeriesRun(series, state, monitor).run();
}

std::vector<SeriesStatus> run_series(const Series& series, const MeshState& state,
                                     const std::function<void(const SeriesResult&)>& on_result) {
  FunctionMonitor monitor(on_result);
  return run_series(series, state, monitor);
}

}  // namespace winslow
