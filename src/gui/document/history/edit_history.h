#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/command/history.h"

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

}  // namespace winslow::gui
