#include <algorithm>
#include <string>
#include <utility>

#include "core/error.h"
#include "gui/base/file_work.h"
#include "gui/base/text.h"
#include "gui/document/session/session.h"
#include "gui/files/assets.h"
#include "io/convergence_csv.h"
#include "io/recipe.h"

namespace winslow::gui {

bool Session::may_change_history() {
  if (!in_motion() && !dragging_) return true;
  tell(Notice::Kind::warning, "Wait until the solver is done, or cancel it.");
  return false;
}

void Session::on(const action::EditStep& a) {
  if (!document_ || !may_change_history()) return;
  const History& history = document_->history();
  if (a.position == 0 || a.position >= history.size()) return;
  CommandQueue::Plan plan;
  plan.title = "Running again from step " + std::to_string(a.position);
  plan.commands.push_back(a.command);
  plan.end = std::max(history.position(), a.position);
  revise(a.position, "Before step " + std::to_string(a.position) + " was changed", std::move(plan));
}

void Session::on(const action::DeleteStep& a) {
  if (!document_ || !may_change_history()) return;
  const History& history = document_->history();
  if (a.position == 0 || a.position >= history.size()) return;
  CommandQueue::Plan plan;
  plan.title = "Running again without step " + std::to_string(a.position);
  plan.end = history.position() - (history.position() >= a.position ? 1 : 0);
  revise(a.position, "Before step " + std::to_string(a.position) + " was deleted", std::move(plan));
}

/// Keeps the history as it is, goes back to before a step and carries out the plan followed by all
/// commands after that step.
void Session::revise(std::size_t step, std::string why, CommandQueue::Plan plan) {
  const History& history = document_->history();
  for (std::size_t k = step + 1; k < history.size(); ++k)
    plan.commands.push_back(history.command(k));
  plan.start = step - 1;
  plan.revision = true;
  document_->keep(std::move(why));
  document_->go_to(plan.start);
  document_->forget_redo();
  queue_.start(std::move(plan));
  run_queue(false);
}

void Session::on(const action::BringBack& a) {
  if (!document_ || a.kept >= document_->kept().size() || !may_change_history()) return;
  document_->bring_back(a.kept);
  position_changed();
  tell(Notice::Kind::success, "The earlier history is back; the other one is kept in its place.");
}

void Session::on(const action::ReplayRecipe& a) {
  if (!document_ || recipe_reader_.busy() || !may_change_history()) return;
  recipe_reader_.start([path = a.path, generation = generation_] {
    RecipeOutcome outcome{path, generation, {}, {}};
    try {
      outcome.commands = io::read_recipe(path).commands;
    } catch (const std::exception& error) {
      outcome.error = error.what();
    }
    return outcome;
  });
}

bool Session::poll_recipe() {
  auto outcome = recipe_reader_.poll();
  if (!outcome) return false;
  const std::string name = outcome->path.filename().string();
  if (!outcome->error.empty()) {
    report_error("Cannot replay " + name, outcome->error);
  } else if (outcome->commands.empty()) {
    tell(Notice::Kind::warning, name + " has no commands.");
  } else if (document_ && outcome->generation == generation_ && may_change_history()) {
    // The first command forgets what could have been redone.
    if (document_->history().can_redo()) document_->keep("Before " + name + " was replayed");
    CommandQueue::Plan plan;
    plan.title = "Replaying " + name;
    plan.commands = std::move(outcome->commands);
    plan.start = document_->history().position();
    queue_.start(std::move(plan));
    run_queue(false);
  }
  return true;
}

/// Starts the next command of the queue, or ends it. paused: the user goes step by step.
void Session::run_queue(bool paused) {
  if (!queue_.finished()) {
    if (!start_job(queue_.next(), paused)) stop_queue_at({});
    return;
  }
  const auto plan = queue_.stop();
  if (plan.end) document_->go_to(*plan.end);
  position_changed();
  tell(Notice::Kind::success,
       plan.commands.empty()
           ? "The step is deleted"
           : plan.title + ": " + counted(plan.commands.size(), "command") + " carried out");
}

/// The next command of the queue cannot be carried out. error: why, if that was not said yet.
void Session::stop_queue_at(const std::string& error) {
  const std::size_t done = queue_.done();
  const auto plan = queue_.stop();
  position_changed();
  std::string text = "Step " + std::to_string(plan.start + done + 1) + " (" +
                     describe(plan.commands[done]) + ") failed";
  text += error.empty() ? "." : ": " + error;
  text += done == 0
              ? "\nNothing before it was run."
              : "\nThe history ends before it, after " + counted(done, "command") + " carried out.";
  Prompt prompt{Prompt::Kind::error, plan.title + " stopped", {}, {}};
  if (plan.revision) {
    text += "\nThe history from before the change is kept.";
    prompt.choices.push_back(
        {"Bring it back", {action::BringBack{document_->kept().size() - 1}}, true});
    prompt.choices.push_back({"Leave it so", {}, false});
  } else {
    prompt.choices.push_back({"OK", {}, true});
  }
  prompt.text = std::move(text);
  ask(std::move(prompt));
}

/// Ends the queue on the user's behalf.
void Session::abandon_queue() {
  if (!queue_.active()) return;
  const auto plan = queue_.stop();
  // What was begun would be neither the old history nor the new one.
  if (plan.revision) document_->take_back();
  position_changed();
}

std::string Session::cancelled_text() const {
  if (!queue_.active())
    return "Cancelled: " + describe(job_.command()) + ". The mesh is as it was before.";
  if (queue_.plan().revision) return "Cancelled. The history is as it was before the change.";
  return "Cancelled after " + counted(queue_.done(), "command") + " of " +
         std::to_string(queue_.total()) + "; those stay in the history.";
}

void Session::on(const action::ExportConvergence& a) {
  const auto shown = convergence();
  if (shown.empty() || a.path.empty()) return;
  if (csv_writer_.busy()) return tell(Notice::Kind::warning, "Still writing the last one.");
  if (bundled(a.path)) return tell(Notice::Kind::warning, bundled_text);
  if (!a.overwrite && is_there(a.path)) {
    ask({Prompt::Kind::question,
         "Replace the file?",
         a.path.filename().string() + " exists already. Saving replaces what is in it.",
         {{"Replace", {action::ExportConvergence{a.path, true}}, false}, {"Cancel", {}, true}}});
    return;
  }
  const int number = static_cast<int>(document_->history().position()) + (job_.active() ? 1 : 0);
  csv_writer_.start(
      [path = a.path, number, records = std::vector<IterationRecord>(shown.begin(), shown.end())] {
        CsvOutcome outcome{path, records.size(), {}};
        try {
          io::write_convergence_csv(path, {{number, records}});
        } catch (const std::exception& error) {
          outcome.error = error.what();
        }
        return outcome;
      });
}

bool Session::poll_csv() {
  auto outcome = csv_writer_.poll();
  if (!outcome) return false;
  if (!outcome->error.empty())
    report_error("Cannot write the iterations", outcome->error);
  else
    tell(Notice::Kind::success,
         counted(outcome->rows, "iteration") + " written to " + outcome->path.filename().string());
  return true;
}

}  // namespace winslow::gui
