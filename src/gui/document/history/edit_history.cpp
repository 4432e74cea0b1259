#include "gui/document/history/edit_history.h"

#include <utility>

namespace winslow::gui {

void EditHistory::push(Command command, CommandResult result, double seconds) {
  tags_.resize(history_.position() + 1);
  history_.push(std::move(command), std::move(result));
  tags_.push_back({++last_revision_, seconds});
}

void EditHistory::undo() {
  if (history_.can_undo()) history_.undo();
}

void EditHistory::redo() {
  if (history_.can_redo()) history_.redo();
}

void EditHistory::go_to(std::size_t position) {
  if (position < history_.size()) history_.go_to(position);
}

void EditHistory::forget_redo() {
  history_.forget_redo();
  tags_.resize(history_.size());
}

void EditHistory::keep(std::string why) {
  if (kept_.size() == most_kept) kept_.erase(kept_.begin());
  kept_.push_back({std::move(why), history_, tags_});
}

void EditHistory::bring_back(std::size_t kept) {
  Kept& other = kept_.at(kept);
  std::swap(other.history, history_);
  std::swap(other.tags, tags_);
  other.why = "Before the other one was brought back";
}

void EditHistory::take_back() {
  history_ = std::move(kept_.back().history);
  tags_ = std::move(kept_.back().tags);
  kept_.pop_back();
}

}  // namespace winslow::gui
