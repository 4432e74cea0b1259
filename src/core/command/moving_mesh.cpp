#include "core/command/moving_mesh.h"

#include "core/error.h"
#include "core/motion/body_ways.h"

namespace winslow {

namespace {

constexpr std::size_t most_kept = 4;  // meshes from which the next one is extrapolated

bool complete(const CommandResult& result) {
  return result.smooth.inverted == 0 && result.smooth.fraction_reached >= 1;
}

/// The bodies that a command moves, with their pivots; empty for other commands.
std::vector<MovingBody> bodies_of(const Command& command, const MeshState& state) {
  const MeshState* states = &state;
  const Command whole = with_pivot(command, std::span(&states, 1));
  const auto* move = std::get_if<MoveCommand>(&whole);
  return move ? move->bodies : std::vector<MovingBody>();
}

/// The same command, with a result that does not depend on the mesh that it begins from: bodies
/// that move forth and back get their mesh back.
ResolvedCommand independent_of_start(const ResolvedCommand& command) {
  Command independent = command.command();
  if (SmoothOptions* smooth = smooth_options(independent))
    *smooth = winslow::independent_of_start(*smooth);
  return {std::move(independent), command.files()};
}

}  // namespace

/// None: no path leads from the last mesh to the end of the motion.
std::optional<CommandResult> MovingMesh::from_last(const ResolvedCommand& command,
                                                   const RunOptions& options) const {
  if (last_.empty()) return std::nullopt;
  RunOptions run = options;
  run.start = last_.front().get();
  run.near.earlier.assign(last_.begin() + 1, last_.end());
  if (last_.size() < most_kept)
    run.near.earlier.push_back(std::make_shared<const Coordinates>(given_.mesh.coordinates));
  const std::vector<MovingBody> bodies = bodies_of(command.command(), given_);
  if (!bodies.empty() && !bodies_.empty())
    run.near.way = ways_between(bodies_, bodies).value_or(std::vector<MovingBody>());
  try {
    CommandResult result = execute(command, given_, run);
    if (complete(result)) return result;
  } catch (const NumericError&) {
    // Falls back to the path from the mesh as given.
  }
  return std::nullopt;
}

CommandResult MovingMesh::to(const ResolvedCommand& asked, RunOptions options) {
  const ResolvedCommand command = independent_of_start(asked);
  options.cache = &cache_;
  options.start = nullptr;
  options.near = {};
  std::optional<CommandResult> found = from_last(command, options);
  CommandResult result = found ? std::move(*found) : execute(command, given_, options);
  if (complete(result) && result.state.mesh.topology == given_.mesh.topology) {
    last_.insert(last_.begin(), std::make_shared<const Coordinates>(result.state.mesh.coordinates));
    last_.resize(std::min(last_.size(), most_kept));
    bodies_ = bodies_of(command.command(), given_);
  }
  return result;
}

MovingMesh::Checkpoint MovingMesh::checkpoint() {
  cache_.forget_matrices();
  Checkpoint checkpoint;
  checkpoint.last = last_;
  checkpoint.bodies = bodies_;
  return checkpoint;
}

void MovingMesh::restore(const Checkpoint& checkpoint) {
  cache_.forget_matrices();
  last_ = checkpoint.last;
  bodies_ = checkpoint.bodies;
}

}  // namespace winslow
