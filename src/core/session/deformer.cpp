#include "core/session/deformer.h"

#include "core/error.h"
#include "core/motion/body_ways.h"
#include "core/quality/validity.h"

namespace winslow {

namespace {

constexpr std::size_t most_kept = 8;  // meshes from which the next one is predicted

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

}  // namespace

// Without a temporary DeformerOptions, of which g++ 12 says that it may not be initialised.
Deformer::Deformer(MeshState given)
    : given_(std::move(given)),
      given_coordinates_(std::make_shared<const Coordinates>(given_.mesh.coordinates)) {}
Deformer::Deformer(MeshState given, DeformerOptions options)
    : given_(std::move(given)),
      options_(std::move(options)),
      given_coordinates_(std::make_shared<const Coordinates>(given_.mesh.coordinates)) {}
Deformer::~Deformer() = default;
Deformer::Deformer(Deformer&&) noexcept = default;
Deformer& Deformer::operator=(Deformer&&) noexcept = default;

void Deformer::set_motion(std::vector<MovingBody> bodies) {
  set_ = MoveCommand{std::move(bodies), options_.how, options_.smooth};
}

void Deformer::set_shape(std::vector<std::string> markers,
                         std::variant<SineDeformation, DisplacementTable, PositionTable> shape) {
  set_ = DeformCommand{std::move(markers), std::move(shape), options_.how, options_.smooth};
}

void Deformer::set_boundary(std::span<const Index> nodes, const Coordinates& places) {
  const int dimension = given_.mesh.coordinates.dimension();
  if (at(places.size()) != nodes.size() || places.dimension() != dimension)
    throw UsageError("found " + std::to_string(places.size()) + " places with " +
                     std::to_string(places.dimension()) + " components for " +
                     std::to_string(nodes.size()) + " nodes, expected one with " +
                     std::to_string(dimension) + " for each");
  PositionTable table;
  table.entries.reserve(nodes.size());
  Index row = 0;
  for (const Index node : nodes)
    table.entries.push_back({node, GivenVector::of(dimension, place_of(places, row++))});
  set_shape({}, std::move(table));
}

ResolvedCommand Deformer::next(double tolerance) const {
  if (!set_)
    throw UsageError("no boundary is set: call set_motion(), set_shape() or set_boundary() first");
  Command command = *set_;
  SmoothOptions& smooth = *smooth_options(command);
  if (tolerance > 0) smooth.tolerance = tolerance;
  // Bodies that move forth and back get their mesh back.
  smooth = independent_of_start(std::move(smooth));
  return {std::move(command), options_.files};
}

/// None: no path leads from the last mesh to the boundary that was set.
std::optional<CommandResult> Deformer::from_last(const ResolvedCommand& command,
                                                 const RunOptions& options) const {
  RunOptions run = options;
  run.start = coordinates().get();
  run.near.only_near = last_.empty();
  run.near.earlier = last_;
  run.near.earlier.push_back(given_coordinates_);
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

CommandResult Deformer::step(double tolerance, SolverMonitor* monitor) {
  const ResolvedCommand command = next(tolerance);
  RunOptions options;
  options.cache = &cache_;
  options.monitor = monitor;
  std::optional<CommandResult> found = from_last(command, options);
  CommandResult result = found ? std::move(*found) : execute(command, given_, options);
  if (complete(result)) {
    last_.insert(last_.begin(), std::make_shared<const Coordinates>(result.state.mesh.coordinates));
    if (last_.size() > most_kept) last_.resize(most_kept);
    bodies_ = bodies_of(command.command(), given_);
    reached_ = std::make_shared<const Reached>(Reached{command, result});
    sensitivity_.reset();
  }
  return result;
}

const std::shared_ptr<const Coordinates>& Deformer::coordinates() const {
  return last_.empty() ? given_coordinates_ : last_.front();
}

Coordinates Deformer::displacement() const {
  Coordinates out = *coordinates();
  const Coordinates& before = last_.size() > 1 ? *last_[1] : *given_coordinates_;
  for (std::size_t i = 0; i < out.values().size(); ++i) out.values()[i] -= before.values()[i];
  return out;
}

std::shared_ptr<const MeshSensitivity> Deformer::sensitivity(SolverMonitor* monitor) {
  if (!reached_)
    throw UsageError("the mesh has no motion yet whose derivative could be taken: call step()");
  RunOptions options;
  options.cache = &cache_;
  options.monitor = monitor;
  if (!sensitivity_)
    sensitivity_ = std::make_shared<const MeshSensitivity>(given_, reached_->command,
                                                           reached_->result, options);
  return sensitivity_;
}

double Deformer::largest_valid(const Coordinates& places) {
  const Coordinates& x = *coordinates();
  if (!places.alike(x))
    throw UsageError("found places of " + std::to_string(places.size()) + " nodes with " +
                     std::to_string(places.dimension()) + " components, expected " +
                     std::to_string(x.size()) + " with " + std::to_string(x.dimension()));
  Coordinates way = places;
  for (std::size_t i = 0; i < way.values().size(); ++i) way.values()[i] -= x.values()[i];
  Coordinates end = velocities(way);
  for (std::size_t i = 0; i < end.values().size(); ++i) end.values()[i] += x.values()[i];
  return largest_valid_step(*given_.mesh.topology, x, end, 1);
}

Deformer::Checkpoint Deformer::checkpoint() {
  cache_.forget_matrices();
  Checkpoint checkpoint;
  checkpoint.last = last_;
  checkpoint.bodies = bodies_;
  checkpoint.reached = reached_;
  return checkpoint;
}

void Deformer::restore(const Checkpoint& checkpoint) {
  cache_.forget_matrices();
  last_ = checkpoint.last;
  bodies_ = checkpoint.bodies;
  reached_ = checkpoint.reached;
  sensitivity_.reset();
}

}  // namespace winslow
