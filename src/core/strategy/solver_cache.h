#pragma once

#include <memory>

/// What one call of execute() leaves to the next, for programs that change one mesh many times.
/// Bodies that move again and again are the affair of a MovingMesh, which has a cache of its own.
///
///     winslow::SolverCache cache;
///     winslow::RunOptions options;
///     options.cache = &cache;
///     for (int step = 0; step < steps; ++step)
///       state = winslow::execute(bend_wing, state, options).state;
///
/// It keeps the patterns of matrices, their orderings, symbolic factorisations and factors, targets
/// of elements and the virtual control volumes of volume meshes. Every call finds out by itself
/// what of it still holds and makes the rest anew, so that any command, any options and any state
/// may come next. Matrices stay useful as long as two calls share the topology (the same object, as
/// a state and the result made from it do) and the same nodes may move in the same directions. Only
/// the last such pair is kept: two meshes, or two bodies that move in turn, are worth two caches.
///
/// RESULTS are those without a cache, to within the tolerances. Factorisations give the same bits;
/// iterations may not, since the aggregates of a multigrid solver are those of the first matrix,
/// and the solver `automatic` remembers on which mesh iterations were slow. The same calls in the
/// same order give the same bits, at any number of threads.
///
/// MEMORY is what the last call needed beside the mesh; clear() gives it back. The cache also keeps
/// alive the topology and the coordinates that the last call was given.
///
/// THREADS: one call at a time. Calls at once on several threads need a cache each.
///
/// ERRORS: a call that throws, Cancelled included, leaves a cache that can be used again.
namespace winslow {

class SmoothingWorkspace;

/// What is kept from call to call.
class SolverCache {
 public:
  SolverCache();
  ~SolverCache();
  /// What was moved from is as after clear().
  SolverCache(SolverCache&& other) noexcept;
  SolverCache& operator=(SolverCache&& other) noexcept;
  SolverCache(const SolverCache&) = delete;
  SolverCache& operator=(const SolverCache&) = delete;

  /// Forgets everything.
  void clear();

  /// For winslow itself: clients have no definition of the class.
  SmoothingWorkspace& workspace();

 private:
  std::unique_ptr<SmoothingWorkspace> workspace_;  // null: nothing is kept
};

}  // namespace winslow
