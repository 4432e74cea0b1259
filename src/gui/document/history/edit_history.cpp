#include "gui/document/history/edit_history.h"

#include "gui/base/text.h"

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

std::string finished_text(const CommandQueue::Plan& plan) {
  if (plan.commands.empty()) return "The step is deleted";
  return plan.title + ": " + counted(plan.commands.size(), "command") + " carried out";
}

std::string cancelled_text(const CommandQueue& queue, const Command& under_way) {
  if (!queue.active())
    return "Cancelled: " + describe(under_way) + ". The mesh is as it was before.";
  if (queue.plan().revision) return "Cancelled. The history is as it was before the change.";
  return "Cancelled after " + counted(queue.done(), "command") + " of " +
         std::to_string(queue.total()) + "; those stay in the history.";
}

Prompt stopped_prompt(const CommandQueue::Plan& plan, std::size_t done, const std::string& error,
                      std::size_t kept) {
  std::string text = "Step " + std::to_string(plan.start + done + 1) + " (" +
                     describe(plan.commands[done]) + ") failed";
  text += error.empty() ? "." : ": " + error;
  text += done == 0
              ? "\nNothing before it was run."
              : "\nThe history ends before it, after " + counted(done, "command") + " carried out.";
  Prompt prompt{Prompt::Kind::error, plan.title + " stopped", {}, {}};
  if (plan.revision) {
    text += "\nThe history from before the change is kept.";
    prompt.choices.push_back({"Bring it back", {action::BringBack{kept - 1}}, true});
    prompt.choices.push_back({"Leave it so", {}, false});
  } else {
    prompt.choices.push_back({"OK", {}, true});
  }
  prompt.text = std::move(text);
  return prompt;
}

}  // namespace winslow::gui
