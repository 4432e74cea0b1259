#pragma once

#include "core/command/command.h"
#include "core/command/history.h"
#include "gui/document/actions/actions.h"

namespace winslow::gui {

/// The commands carried out on a mesh, the duration of each, and the histories that changes of past
/// steps replaced.
class EditHistory {
 public:
  explicit EditHistory(MeshState initial) : history_(std::move(initial)) {}

  const History& history() const { return history_; }

  /// Data of a position other than the mesh.
  struct Tag {
    std::uint64_t revision = 0;
    double seconds = 0;  ///< wall time of the command that led there
  };
  /// The tags of all positions.
  const std::vector<Tag>& tags() const { return tags_; }
  /// Identifies the present mesh among all meshes of this history.
  std::uint64_t revision() const { return tags_[history_.position()].revision; }

  void push(Command command, CommandResult result, double seconds);
  void undo();
  void redo();
  void go_to(std::size_t position);
  /// Drops the steps after the present position.
  void forget_redo();

  /// A history replaced by a change of a past step.
  struct Kept {
    std::string why;  ///< "Before step 2 was changed"
    History history;
    std::vector<Tag> tags;
  };
  /// The latest ones, oldest first.
  const std::vector<Kept>& kept() const { return kept_; }
  static constexpr std::size_t most_kept = 8;
  /// Keeps a copy of the present history; beyond most_kept copies the oldest is dropped.
  void keep(std::string why);
  /// Exchanges the present history with a kept one.
  void bring_back(std::size_t kept);
  /// Replaces the present history by the one kept last; the present one is dropped.
  void take_back();

 private:
  History history_;
  std::vector<Tag> tags_{Tag{}};
  std::vector<Kept> kept_;
  std::uint64_t last_revision_ = 0;
};

/// Commands to carry out one after the other, each on the result of the previous one: the commands
/// after an edited step, or those of a recipe.
class CommandQueue {
 public:
  struct Plan {
    std::string title;  ///< "Replaying wing.json"
    std::vector<Command> commands;
    /// Position in the history before the first command.
    std::size_t start = 0;
    /// The queue reruns a changed past step: cancelling restores the previous history.
    bool revision = false;
    /// Position of the history afterwards; none: that of the last command.
    std::optional<std::size_t> end;
  };

  bool active() const { return plan_.has_value(); }
  const Plan& plan() const { return *plan_; }
  void start(Plan plan) {
    plan_ = std::move(plan);
    done_ = 0;
  }
  /// Empties the queue and returns its plan.
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

/// "Replaying wing.json: 3 commands carried out", for a completed plan.
std::string finished_text(const CommandQueue::Plan& plan);
/// Message for the user who has cancelled the running command.
std::string cancelled_text(const CommandQueue& queue, const Command& under_way);
/// Reports that the command after `done` others could not be carried out. error: the reason; empty:
/// already reported. kept: number of kept histories; after a revision the last one can be restored.
Prompt stopped_prompt(const CommandQueue::Plan& plan, std::size_t done, const std::string& error,
                      std::size_t kept);

}  // namespace winslow::gui
