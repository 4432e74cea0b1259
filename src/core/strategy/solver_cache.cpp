#include "core/strategy/solver_cache.h"

#include "core/strategy/workspace.h"

namespace winslow {

SolverCache::SolverCache() = default;
SolverCache::~SolverCache() = default;
SolverCache::SolverCache(SolverCache&& other) noexcept = default;
SolverCache& SolverCache::operator=(SolverCache&& other) noexcept = default;

void SolverCache::clear() { workspace_.reset(); }

SmoothingWorkspace& SolverCache::workspace() {
  if (!workspace_) workspace_ = std::make_unique<SmoothingWorkspace>();
  return *workspace_;
}

}  // namespace winslow
