#pragma once

#include "core/command/command.h"

/// Undo and redo over commands:
///
///     winslow::History history(state);
///     history.push(command, winslow::execute(command, history.state()));
///     history.undo();  // history.state() is the mesh before
namespace winslow {

/// The commands applied to a mesh, with undo and redo to any point. Topology is shared, so a step
/// costs one copy of the coordinates. A copy of a history shares its steps.
class History {
 public:
  explicit History(MeshState initial);

  const MeshState& state() const;
  const MeshState& initial() const { return steps_.front()->state; }

  /// Appends a finished command; drops the steps that could have been redone.
  void push(Command command, CommandResult result);

  /// Drops the steps after the present position.
  void forget_redo() { steps_.resize(position_ + 1); }

  bool can_undo() const { return position_ > 0; }
  bool can_redo() const { return position_ + 1 < steps_.size(); }
  void undo();
  void redo();
  /// Position 0 is the mesh as loaded; position k is the mesh after command k. Throws UsageError if
  /// there is no such position.
  void go_to(std::size_t position);
  std::size_t position() const { return position_; }
  std::size_t size() const { return steps_.size(); }

  /// Command that led to a position (1 .. size() - 1), and how its solve went.
  const Command& command(std::size_t position) const;
  const SmoothResult& result(std::size_t position) const;
  /// Mesh at a position (0 .. size() - 1).
  const MeshState& state(std::size_t position) const;
  /// Position of the mesh whose shapes motions keep (MeshState::reference): 0 is the mesh as
  /// loaded.
  std::size_t reference_position() const;
  /// Commands up to the present position: a recipe.
  std::vector<Command> recipe() const;

 private:
  struct Step {
    std::optional<Command> command;
    SmoothResult smooth;
    MeshState state;
  };
  const Step& step(std::size_t position) const;

  std::vector<std::shared_ptr<const Step>> steps_;
  std::size_t position_ = 0;
};

}  // namespace winslow
