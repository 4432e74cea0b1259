#include "core/command/history.h"

#include "core/error.h"

namespace winslow {

History::History(MeshState initial)
    : steps_{std::make_shared<const Step>(Step{std::nullopt, {}, std::move(initial)})} {}

const MeshState& History::state() const { return steps_[position_]->state; }

void History::push(Command command, CommandResult result) {
  forget_redo();
  steps_.push_back(std::make_shared<const Step>(
      Step{std::move(command), std::move(result.smooth), std::move(result.state)}));
  ++position_;
}

void History::undo() {
  if (!can_undo()) throw UsageError("there is nothing to undo");
  --position_;
}

void History::redo() {
  if (!can_redo()) throw UsageError("there is nothing to redo");
  ++position_;
}

void History::go_to(std::size_t position) {
  if (position >= steps_.size()) throw UsageError("the history has no such step");
  position_ = position;
}

const History::Step& History::step(std::size_t position) const {
  if (position >= steps_.size()) throw UsageError("the history has no such step");
  return *steps_[position];
}

const Command& History::command(std::size_t position) const {
  if (position == 0) throw UsageError("the history has no such step");
  return *step(position).command;
}

const SmoothResult& History::result(std::size_t position) const { return step(position).smooth; }

const MeshState& History::state(std::size_t position) const { return step(position).state; }

std::size_t History::reference_position() const {
  std::size_t position = position_;
  while (position > 0 && keeps_reference(command(position))) --position;
  return position;
}

std::vector<Command> History::recipe() const {
  std::vector<Command> commands;
  for (std::size_t k = 1; k <= position_; ++k) commands.push_back(*steps_[k]->command);
  return commands;
}

}  // namespace winslow
