#pragma once

#include "gui/base/background.h"
#include "gui/document/actions/document_actions.h"
#include "gui/document/session/jobs.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/message_board.h"
#include "gui/document/session/motions.h"

namespace winslow::gui {

/// Moves through the history of the open mesh, changes past steps and replays recipes.
class HistoryEditor {
 public:
  HistoryEditor(LiveMesh& mesh, MessageBoard& messages, SolverSettings& settings, Jobs& jobs,
                Motions& motions)
      : mesh_(mesh), messages_(messages), settings_(settings), jobs_(jobs), motions_(motions) {}

  /// Collects a recipe read in the background. True if anything changed.
  bool poll();
  bool busy() const { return recipe_reader_.busy(); }

  void on(const action::Undo&);
  void on(const action::Redo&);
  void on(const action::GoToStep& a);
  void on(const action::EditStep& a);
  void on(const action::DeleteStep& a);
  void on(const action::BringBack& a);
  void on(const action::ReplayRecipe& a);

 private:
  bool may_change();
  void revise(std::size_t step, std::string why, CommandQueue::Plan plan);

  struct RecipeOutcome {
    std::filesystem::path path;
    std::uint64_t generation = 0;
    std::vector<Command> commands;
    std::string error;
  };

  LiveMesh& mesh_;
  MessageBoard& messages_;
  SolverSettings& settings_;
  Jobs& jobs_;
  Motions& motions_;
  Background<RecipeOutcome> recipe_reader_;
};

}  // namespace winslow::gui
