#include "core/parallel/parallel_for.h"

#include <condition_variable>
#include <cstdlib>
#include <deque>
#include <mutex>
#include <system_error>

namespace winslow {

int mpi_processes() {
  int most = 1;
  // Open MPI; MPICH, Intel MPI and Slurm; MVAPICH; Intel MPI on one machine.
  for (const char* name :
       {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE", "MPI_LOCALNRANKS"})
    if (const char* size = std::getenv(name)) most = std::max(most, std::atoi(size));
  return most;
}

int thread_count(int requested) {
  if (requested > 0) return requested;
  static const int cores =
      mpi_processes() > 1 ? 1 : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return cores;
}

namespace {

/// One call of run_on_threads. It lies on the caller's stack: only threads with a share may access
/// it.
struct Job {
  void (*work)(void*, Index);
  void* data;
  Index count;
  Index next = 0;                 // first share not claimed yet; guarded by the pool's mutex
  std::atomic<Index> unfinished;  // number of shares not finished yet

  Job(Index shares, void (*call)(void*, Index), void* argument)
      : work(call), data(argument), count(shares), unfinished(shares) {}
};

/// Pauses briefly, so that the processor can run another hardware thread.
void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#else
  std::this_thread::yield();
#endif
}

/// Polls condition() for some 20 microseconds and returns true as soon as it holds. Waking a thread
/// takes as long, and solvers run one loop after another.
template <typename Condition>
bool soon(Condition&& condition) {
  constexpr int tries = 500;
  for (int i = 0; i < tries; ++i) {
    if (condition()) return true;
    pause();
  }
  return false;
}

class ThreadPool {
 public:
  static ThreadPool& of_process() {
    static ThreadPool pool;
    return pool;
  }

  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  ~ThreadPool() {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    wake_.notify_all();
  }

  void run(Job& job) {
    {
      const std::lock_guard lock(mutex_);
      grow(job.count - 1);
      jobs_.push_back(&job);
      untaken_ += job.count;
    }
    wake_.notify_all();
    for (Index share = claim(job); share >= 0; share = claim(job)) finish(job, share);
    const auto ended = [&] { return job.unfinished.load(std::memory_order_acquire) == 0; };
    if (soon(ended)) return;
    std::unique_lock lock(mutex_);
    ended_.wait(lock, ended);
  }

 private:
  ThreadPool() = default;

  /// With more threads than cores, threads do not poll for work.
  bool may_ask() const { return workers_.size() < std::thread::hardware_concurrency(); }

  /// Starts threads until there are `count`, or until memory is exhausted. Called with the mutex
  /// held.
  void grow(Index count) {
    constexpr Index most = 256;
    try {
      while (static_cast<Index>(workers_.size()) < std::min(count, most)) {
        workers_.emplace_back([this] { serve(); });
      }
    } catch (const std::system_error&) {
      // The existing threads and the caller do the work.
    }
    asking_.store(may_ask(), std::memory_order_relaxed);
  }

  /// Claims a share of the job for the caller; -1: none left. Called with the mutex held.
  Index claim_locked(Job& job) {
    if (job.next == job.count) return -1;
    --untaken_;
    const Index share = job.next++;
    if (job.next == job.count) std::erase(jobs_, &job);
    return share;
  }
  Index claim(Job& job) {
    const std::lock_guard lock(mutex_);
    return claim_locked(job);
  }

  void finish(Job& job, Index share) {
    job.work(job.data, share);
    // After the last share the job may no longer exist.
    if (job.unfinished.fetch_sub(1, std::memory_order_acq_rel) > 1) return;
    const std::lock_guard lock(mutex_);
    ended_.notify_all();
  }

  /// The main loop of each thread.
  void serve() {
    for (;;) {
      if (asking_.load(std::memory_order_relaxed)) {
        soon([&] { return untaken_.load(std::memory_order_relaxed) > 0; });
      }
      Job* job = nullptr;
      Index share = -1;
      {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [&] { return ending_ || !jobs_.empty(); });
        if (jobs_.empty()) return;
        job = jobs_.front();
        share = claim_locked(*job);
      }
      finish(*job, share);
    }
  }

  std::mutex mutex_;
  std::condition_variable wake_, ended_;
  std::deque<Job*> jobs_;           // with unclaimed shares
  std::atomic<Index> untaken_ = 0;  // unclaimed shares of all jobs
  std::atomic<bool> asking_ = false;
  bool ending_ = false;
  std::vector<std::jthread> workers_;  // last: joined before the other members are destroyed
};

}  // namespace

void run_on_threads(Index count, void (*work)(void* data, Index share), void* data) {
  if (count <= 1) {
    if (count == 1) work(data, 0);
    return;
  }
  Job job(count, work, data);
  ThreadPool::of_process().run(job);
}

}  // namespace winslow
