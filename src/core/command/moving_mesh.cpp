#include "core/command/moving_mesh.h"

#include "core/error.h"

namespace winslow {

namespace {

bool complete(const CommandResult& result) {
  return result.smooth.inverted == 0 && result.smooth.fraction_reached >= 1;
}

}  // namespace

/// None: no path leads from the last mesh to the end of the motion.
std::optional<CommandResult> MovingMesh::from_last(const ResolvedCommand& command,
                                                   const RunOptions& options) const {
  if (!last_) return std::nullopt;
  RunOptions run = options;
  run.start = &*last_;
  try {
    CommandResult result = execute(command, given_, run);
    if (complete(result)) return result;
  } catch (const NumericError&) {
    // Falls back to the path from the mesh as given.
  }
  return std::nullopt;
}

CommandResult MovingMesh::to(const ResolvedCommand& command, RunOptions options) {
  options.cache = &cache_;
  options.start = nullptr;
  std::optional<CommandResult> found = from_last(command, options);
  CommandResult result = found ? std::move(*found) : execute(command, given_, options);
  if (complete(result) && result.state.mesh.topology == given_.mesh.topology)
    last_ = result.state.mesh.coordinates;
  return result;
}

}  // namespace winslow
