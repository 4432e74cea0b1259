#include "core/job/solver_thread.h"

#include <chrono>
#include <condition_variable>
#include <thread>

#include "core/error.h"

namespace winslow {

namespace {

constexpr int unlimited = -1;

using Clock = std::chrono::steady_clock;

/// Limits the size of snapshots in long drags.
constexpr std::size_t longest_history = 4000;

}  // namespace

/// The thread and the data shared with its owner. `mutex_` guards all members below it; those above
/// belong to the worker alone.
class SolverThread::Impl final : public SolverMonitor {
 public:
  Impl() : worker_([this] { work(); }) {}
  ~Impl() override {
    {
      const std::lock_guard lock(mutex_);
      quit_ = true;
    }
    wake_.notify_all();
    worker_.join();
  }

  std::uint64_t run(std::shared_ptr<const MeshState> state, Command command,
                    std::optional<Coordinates> start, bool paused) {
    std::uint64_t job = 0;
    {
      const std::lock_guard lock(mutex_);
      job = ++last_job_;
      cancel_ = false;
      retarget_.reset();
      allowed_ = paused ? 0 : unlimited;
      Snapshot first;
      first.job = job;
      first.state = JobState::running;
      // Shares the mesh of the state to avoid copying a large mesh.
      first.mesh = start ? std::make_shared<const Mesh>(Mesh{state->mesh.topology, *start})
                         : std::shared_ptr<const Mesh>(state, &state->mesh);
      first.command = command;
      publish_locked(std::move(first));
      base_ = state;
      request_ = Request{job, std::move(state), std::move(command), std::move(start), resolve_};
    }
    wake_.notify_all();
    return job;
  }

  void retarget(Command command) {
    std::optional<std::pair<std::shared_ptr<const MeshState>, Coordinates>> again;
    {
      const std::lock_guard lock(mutex_);
      if (!base_) return;
      if (request_) {
        request_->command = std::move(command);
        cancel_ = false;
        return;
      }
      // A job that is being cancelled would discard the new target.
      if (active_ && !cancel_) {
        retarget_ = std::move(command);
      } else {
        again.emplace(base_, latest_->mesh->coordinates);
      }
    }
    if (again) {  // the command was not moved from in this case
      // NOLINTNEXTLINE(bugprone-use-after-move)
      run(std::move(again->first), std::move(command), std::move(again->second), false);
    } else {
      wake_.notify_all();
    }
  }

  void allow(int iterations) {
    {
      const std::lock_guard lock(mutex_);
      allowed_ = iterations > 0 && allowed_ > 0 ? allowed_ + iterations : iterations;
    }
    wake_.notify_all();
  }

  void cancel() {
    {
      const std::lock_guard lock(mutex_);
      cancel_ = true;
    }
    wake_.notify_all();
  }

  void set_pace(double iterations_per_second) {
    {
      const std::lock_guard lock(mutex_);
      interval_ = Clock::duration::zero();
      if (iterations_per_second > 0)
        interval_ = std::chrono::duration_cast<Clock::duration>(
            std::chrono::duration<double>(1 / iterations_per_second));
    }
    wake_.notify_all();
  }

  void resolve(Resolve with) {
    const std::lock_guard lock(mutex_);
    resolve_ = std::move(with);
  }

  void wait_for_viewer(std::optional<std::uint64_t> seen) {
    {
      const std::lock_guard lock(mutex_);
      viewer_saw_ = seen;
    }
    wake_.notify_all();
  }

  bool busy() const {
    const std::lock_guard lock(mutex_);
    return active_ || request_.has_value();
  }

  std::shared_ptr<const Snapshot> latest() const {
    const std::lock_guard lock(mutex_);
    return latest_;
  }

  void on_topology(const std::shared_ptr<const Topology>& topology) override {
    topology_ = topology;
  }

  bool on_iteration(const IterationRecord& record, const Coordinates& coordinates) override {
    const bool opening = std::exchange(fresh_target_, false);
    IterationRecord numbered = record;
    numbered.iteration = first_iteration_ + record.iteration;
    const bool iterated = numbered.iteration > iterations_;
    iterations_ = numbered.iteration;
    if (history_.size() >= longest_history) history_.erase(history_.begin());
    history_.push_back(numbered);
    reached_ = coordinates;

    std::unique_lock lock(mutex_);
    if (iterated && allowed_ > 0) --allowed_;
    publish_progress(JobState::running);
    keep_pace(lock, opening);
    wake_.wait(lock, [&] {
      return !viewer_saw_ || *viewer_saw_ >= latest_->serial || allowed_ == 0 ||
             interrupted(opening);
    });
    if (allowed_ == 0 && !interrupted(opening)) {
      publish_progress(JobState::paused);
      wake_.wait(lock, [&] { return allowed_ != 0 || interrupted(opening); });
      if (!interrupted(opening)) publish_progress(JobState::running);
    }
    return !interrupted(opening);
  }
  bool cancelled() override {
    const std::lock_guard lock(mutex_);
    return interrupted(fresh_target_);
  }

 private:
  struct Request {
    std::uint64_t job = 0;
    std::shared_ptr<const MeshState> state;
    Command command;
    std::optional<Coordinates> start;
    Resolve resolve;
  };

  /// A new target waits until the old one has had one iteration; otherwise a fast mouse would
  /// starve the solver.
  bool interrupted(bool opening) const {
    return quit_ || cancel_ || request_.has_value() || (retarget_.has_value() && !opening);
  }

  /// Waits after a published snapshot according to the pace, unless interrupted. A change of the
  /// pace applies at once. Called with the mutex held.
  void keep_pace(std::unique_lock<std::mutex>& lock, bool opening) {
    while (interval_ > Clock::duration::zero() && allowed_ != 0 && !interrupted(opening)) {
      const Clock::time_point due = last_shown_ + interval_;
      if (Clock::now() >= due) break;
      wake_.wait_until(lock, due);
    }
    last_shown_ = Clock::now();
  }

  void publish_locked(Snapshot snapshot) {
    snapshot.serial = latest_->serial + 1;
    latest_ = std::make_shared<const Snapshot>(std::move(snapshot));
  }

  /// Called with the mutex held.
  void publish_progress(JobState state) {
    if (!request_) publish_locked(picture(state));
  }

  /// Snapshot of the job from the worker's data.
  Snapshot picture(JobState state) const {
    Snapshot snapshot;
    snapshot.job = current_.job;
    snapshot.state = state;
    snapshot.mesh = std::make_shared<const Mesh>(Mesh{topology_, reached_});
    snapshot.history = history_;
    snapshot.command = current_.command;
    return snapshot;
  }

  void work() {
    for (;;) {
      {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [&] { return quit_ || request_.has_value(); });
        if (quit_) return;
        current_ = std::move(*request_);
        request_.reset();
        active_ = true;
      }
      history_.clear();
      iterations_ = 0;
      topology_ = current_.state->mesh.topology;
      reached_ = current_.start ? *current_.start : current_.state->mesh.coordinates;
      while (run_once()) {
      }
    }
  }

  /// Executes the current command once. Returns true if a new target arrived meanwhile.
  bool run_once() {
    std::optional<CommandResult> result;
    JobState state = JobState::done;
    std::string error;
    fresh_target_ = true;
    first_iteration_ = iterations_;
    try {
      const RunOptions options{this, current_.start ? &*current_.start : nullptr, &cache_};
      const Command& command = current_.command;
      result = execute(current_.resolve ? current_.resolve(command) : ResolvedCommand(command),
                       *current_.state, options);
      reached_ = result->state.mesh.coordinates;
      topology_ = result->state.mesh.topology;
    } catch (const Cancelled&) {
      state = JobState::cancelled;
    } catch (const std::bad_alloc&) {
      state = JobState::failed;
      error = "not enough memory";
    } catch (const std::exception& e) {
      state = JobState::failed;
      error = e.what();
    }
    const std::lock_guard lock(mutex_);
    if (retarget_ && !cancel_ && !quit_ && !request_) {
      current_.command = std::move(*retarget_);
      current_.start = reached_;
      retarget_.reset();
      return true;
    }
    retarget_.reset();
    active_ = false;
    if (request_) return false;
    Snapshot snapshot = picture(state);
    snapshot.result = std::move(result);
    snapshot.error = std::move(error);
    publish_locked(std::move(snapshot));
    return false;
  }

  SolverCache cache_;
  Request current_;
  std::shared_ptr<const Topology> topology_;  // of reached_
  Coordinates reached_;
  std::vector<IterationRecord> history_;
  int iterations_ = 0;         // of this job, for all its targets
  int first_iteration_ = 0;    // number of the present execution's opening record
  bool fresh_target_ = false;  // the next record opens an execution

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool quit_ = false;
  bool cancel_ = false;
  bool active_ = false;
  Clock::duration interval_{};               // between two outer iterations; 0: none
  Clock::time_point last_shown_{};           // when the worker last continued
  int allowed_ = unlimited;                  // outer iterations until the next pause
  std::optional<std::uint64_t> viewer_saw_;  // serial; none: there is no viewer
  std::uint64_t last_job_ = 0;
  std::shared_ptr<const MeshState> base_;
  std::optional<Request> request_;
  Resolve resolve_;
  std::optional<Command> retarget_;
  std::shared_ptr<const Snapshot> latest_ = std::make_shared<const Snapshot>();

  std::thread worker_;  // last: starts after all other members are initialised
};

SolverThread::SolverThread() : impl_(std::make_unique<Impl>()) {}
SolverThread::~SolverThread() = default;

std::uint64_t SolverThread::run(std::shared_ptr<const MeshState> state, Command command,
                                std::optional<Coordinates> start, bool paused) {
  return impl_->run(std::move(state), std::move(command), std::move(start), paused);
}
void SolverThread::retarget(Command command) { impl_->retarget(std::move(command)); }
void SolverThread::pause() { impl_->allow(0); }
void SolverThread::resume() { impl_->allow(unlimited); }
void SolverThread::step(int n) {
  if (n > 0) impl_->allow(n);
}
void SolverThread::cancel() { impl_->cancel(); }
void SolverThread::set_pace(double rate) { impl_->set_pace(rate); }
void SolverThread::resolve(Resolve with) { impl_->resolve(std::move(with)); }
void SolverThread::wait_for_viewer(std::optional<std::uint64_t> seen) {
  impl_->wait_for_viewer(seen);
}
bool SolverThread::busy() const { return impl_->busy(); }
std::shared_ptr<const Snapshot> SolverThread::latest() const { return impl_->latest(); }

}  // namespace winslow
