#include "gui/document/session/history_editor.h"

#include "io/recipe/recipe.h"
#include "io/tables/file_defaults.h"

namespace winslow::gui {

void HistoryEditor::on(const action::Undo&) {
  if (!mesh_.document()) return;
  if (mesh_.work().held().body) return motions_.cancel_drag();
  if (mesh_.work().job().active()) return jobs_.cancel();
  if (!settings_.overrides().undoable(mesh_.document()->edits().revision()).empty())
    return settings_.on(action::StepOverride{false});
  const History& history = mesh_.document()->history();
  if (!history.can_undo()) return;
  const std::string undone = describe(history.command(history.position()));
  mesh_.document()->edits().undo();
  jobs_.show_position();
  messages_.tell(Notice::Kind::information, "Undone: " + undone);
}

void HistoryEditor::on(const action::Redo&) {
  if (!mesh_.document() || mesh_.work().job().active() || mesh_.work().held().body) return;
  if (!settings_.overrides().redoable(mesh_.document()->edits().revision()).empty())
    return settings_.on(action::StepOverride{true});
  if (!mesh_.document()->history().can_redo()) return;
  mesh_.document()->edits().redo();
  jobs_.show_position();
  const History& history = mesh_.document()->history();
  messages_.tell(Notice::Kind::information,
                 "Done again: " + describe(history.command(history.position())));
}

void HistoryEditor::on(const action::GoToStep& a) {
  if (!mesh_.document()) return;
  jobs_.stop();
  mesh_.document()->edits().go_to(a.position);
  jobs_.show_position();
  const History& history = mesh_.document()->history();
  messages_.tell(Notice::Kind::information,
                 history.position() == 0 ? "The mesh is as it was opened."
                                         : "The mesh is as it was after: " +
                                               describe(history.command(history.position())));
}

bool HistoryEditor::may_change() {
  if (!mesh_.document()) return false;
  if (!mesh_.in_motion() && !mesh_.work().held().body) return true;
  messages_.tell(Notice::Kind::warning, "Wait until the solver is done, or cancel it.");
  return false;
}

void HistoryEditor::on(const action::EditStep& a) {
  if (!may_change()) return;
  const History& history = mesh_.document()->history();
  if (a.position == 0 || a.position >= history.size()) return;
  CommandQueue::Plan plan;
  plan.title = "Running again from step " + std::to_string(a.position);
  plan.commands.push_back(a.command);
  plan.end = std::max(history.position(), a.position);
  revise(a.position, "Before step " + std::to_string(a.position) + " was changed", std::move(plan));
}

void HistoryEditor::on(const action::DeleteStep& a) {
  if (!may_change()) return;
  const History& history = mesh_.document()->history();
  if (a.position == 0 || a.position >= history.size()) return;
  CommandQueue::Plan plan;
  plan.title = "Running again without step " + std::to_string(a.position);
  plan.end = history.position() - (history.position() >= a.position ? 1 : 0);
  revise(a.position, "Before step " + std::to_string(a.position) + " was deleted", std::move(plan));
}

/// Keeps a copy of the history, goes back to the position before a step, and carries out the plan
/// and then all commands after that step.
void HistoryEditor::revise(std::size_t step, std::string why, CommandQueue::Plan plan) {
  const History& history = mesh_.document()->history();
  for (std::size_t k = step + 1; k < history.size(); ++k)
    plan.commands.push_back(history.command(k));
  plan.start = step - 1;
  plan.revision = true;
  mesh_.document()->edits().keep(std::move(why));
  mesh_.document()->edits().go_to(plan.start);
  mesh_.document()->edits().forget_redo();
  jobs_.start(std::move(plan));
}

void HistoryEditor::on(const action::BringBack& a) {
  if (!mesh_.document() || a.kept >= mesh_.document()->edits().kept().size() || !may_change())
    return;
  mesh_.document()->edits().bring_back(a.kept);
  jobs_.show_position();
  messages_.tell(Notice::Kind::success,
                 "The earlier history is back; the other one is kept in its place.");
}

void HistoryEditor::on(const action::ReplayRecipe& a) {
  if (!mesh_.document() || recipe_reader_.busy() || !may_change()) return;
  recipe_reader_.start([path = a.path, generation = mesh_.generation()] {
    RecipeOutcome outcome{path, generation, {}, {}};
    outcome.error = error_of([&] { outcome.commands = io::read_recipe(path).commands; });
    return outcome;
  });
}

bool HistoryEditor::poll() {
  auto outcome = recipe_reader_.poll();
  if (!outcome) return false;
  const std::string name = outcome->path.filename().string();
  if (!outcome->error.empty()) {
    messages_.report_error("Cannot replay " + name, outcome->error);
  } else if (outcome->commands.empty()) {
    messages_.tell(Notice::Kind::warning, name + " has no commands.");
  } else if (mesh_.document() && outcome->generation == mesh_.generation() && may_change()) {
    // The first command clears the redo steps.
    if (mesh_.document()->history().can_redo())
      mesh_.document()->edits().keep("Before " + name + " was replayed");
    CommandQueue::Plan plan;
    plan.title = "Replaying " + name;
    const Document& document = *mesh_.document();
    plan.commands = io::with_names_expanded(std::move(outcome->commands),
                                            document.source().details.get(), *document.topology());
    plan.start = mesh_.document()->history().position();
    jobs_.start(std::move(plan));
  }
  return true;
}

}  // namespace winslow::gui
