#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/command/command.h"

namespace winslow::gui {

/// Commands to be carried out one after the other, each on the mesh that the one before it left:
/// those after an edited step, or those of a recipe.
class CommandQueue {
 public:
  struct Plan {
    std::string title;  ///< "Replaying wing.json"
    std::vector<Command> commands;
    /// Position in the history before the first command.
    std::size_t start = 0;
    /// A past step was changed: if it is cancelled, all is to be as before.
    bool revision = false;
    /// Position of the history to end at; none: that of the last command.
    std::optional<std::size_t> end;
  };

  bool active() const { return plan_.has_value(); }
  const Plan& plan() const { return *plan_; }
  void start(Plan plan) {
    plan_ = std::move(plan);
    done_ = 0;
  }
  /// Empties the queue and returns what it was.
  Plan stop() { return *std::exchange(plan_, std::nullopt); }

  /// Commands carried out so far.
  std::size_t done() const { return done_; }
  std::size_t total() const { return plan_->commands.size(); }
  bool finished() const { return done_ == total(); }
  /// The command to carry out now; the queue must not be finished.
  const Command& next() const { return plan_->commands[done_]; }
  void advance() { ++done_; }

 private:
  std::optional<Plan> plan_;
  std::size_t done_ = 0;
};

}  // namespace winslow::gui
