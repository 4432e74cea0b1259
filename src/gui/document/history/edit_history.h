#pragma once

#include "core/command/command.h"
#include "core/command/history.h"
#include "gui/document/actions/actions.h"

namespace winslow::gui {

/// What was done to a mesh, when each command was, and the histories that a change of a past step
/// replaced.
class EditHistory {
 public:
  explicit EditHistory(MeshState initial) : history_(std::move(initial)) {}

  const History& history() const { return history_; }

  /// What is known of a position besides the mesh.
  struct Tag {
    std::uint64_t revision = 0;
    double seconds = 0;  ///< that the command took which led there, on the clock on the wall
  };
  /// Of each position.
  const std::vector<Tag>& tags() const { return tags_; }
  /// Identifies the present mesh among all that this history has had.
  std::uint64_t revision() const { return tags_[history_.position()].revision; }

  void push(Command command, CommandResult result, double seconds);
  void undo();
  void redo();
  void go_to(std::size_t position);
  /// Drops the steps after the present position.
  void forget_redo();

  /// A history that a change of a past step replaced.
  struct Kept {
    std::string why;  ///< "Before step 2 was changed"
    History history;
    std::vector<Tag> tags;
  };
  /// The last few, oldest first.
  const std::vector<Kept>& kept() const { return kept_; }
  static constexpr std::size_t most_kept = 8;
  /// Keeps the present history beside itself; of more than most_kept the oldest goes.
  void keep(std::string why);
  /// Changes places with a kept one.
  void bring_back(std::size_t kept);
  /// Puts the one that was kept last in place of the present history, which goes.
  void take_back();

 private:
  History history_;
  std::vector<Tag> tags_{Tag{}};
  std::vector<Kept> kept_;
  std::uint64_t last_revision_ = 0;
};

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

/// "Replaying wing.json: 3 commands carried out", once all are.
std::string finished_text(const CommandQueue::Plan& plan);
/// What the user is told who has cancelled the command under way.
std::string cancelled_text(const CommandQueue& queue, const Command& under_way);
/// Says that the command after `done` others could not be carried out. error: why; empty: that was
/// said already. kept: histories that are kept, of which a revision's last one can be brought back.
Prompt stopped_prompt(const CommandQueue::Plan& plan, std::size_t done, const std::string& error,
                      std::size_t kept);

}  // namespace winslow::gui
