#include <string>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "gui/base/file_work.h"
#include "gui/base/text.h"
#include "gui/document/session/session.h"
#include "gui/files/assets.h"
#include "io/recipe.h"

namespace winslow::gui {

void Session::on(const action::OpenMesh& a) {
  if (a.path.empty()) return;
  const bool unsaved = document_ && (document_->modified() || in_motion());
  if (unsaved && !a.discard_changes) {
    ask({Prompt::Kind::question,
         "Discard the changes?",
         document_->name() + " has changes that are not saved. Opening " +
             a.path.filename().string() + " would lose them.",
         {{"Discard and open", {action::OpenMesh{a.path, true}}, false}, {"Cancel", {}, true}}});
    return;
  }
  if (loader_.busy()) {
    next_path_ = a.path;
    return;
  }
  loading_path_ = a.path;
  loader_.start([path = a.path] {
    LoadOutcome outcome;
    outcome.error = error_of(
        [&] { outcome.loaded = std::make_shared<Document::Loaded>(Document::load(path)); });
    return outcome;
  });
}

bool Session::poll_loader() {
  auto outcome = loader_.poll();
  if (!outcome) return false;
  const auto path = std::exchange(loading_path_, {});
  if (!next_path_.empty()) {
    on(action::OpenMesh{std::exchange(next_path_, {}), true});
  } else if (outcome->loaded) {
    adopt(std::move(*outcome->loaded));
  } else {
    report_error("Cannot open " + path.filename().string(), outcome->error);
  }
  return true;
}

/// Lets go of the open mesh and of all that refers to it.
void Session::forget_mesh() {
  stop_job();
  quality_.clear();
  document_.reset();
  boundary_.reset();
  passing_vcv_.reset();
  selection_.clear();
  hovered_.clear();
  nodes_ = {};
  lost_nodes_.clear();
  anchors_.reset();
  pivot_place_ = PivotPlace::centre;
  shape_edit_ = {};
  preview_.reset();
  layer_preview_.want({});
  banner_.reset();
  ++generation_;
}

void Session::adopt(Document::Loaded loaded) {
  // The new one stands before the old one goes.
  auto document = std::make_unique<Document>(std::move(loaded));
  auto boundary = std::make_unique<BoundaryIndex>(document->topology());
  forget_mesh();
  document_ = std::move(document);
  boundary_ = std::move(boundary);
  position_changed();
  const auto& warnings = document_->warnings();
  if (warnings.empty()) {
    tell(Notice::Kind::success, "Opened " + document_->name());
  } else {
    tell(Notice::Kind::warning,
         "Opened " + document_->name() + ", with " + counted(warnings.size(), "warning"));
    ask({Prompt::Kind::information,
         "Opened with " + counted(warnings.size(), "warning"),
         joined(warnings),
         {{"OK", {}, true}}});
  }
}

void Session::restore(RestoredSession restored) {
  restored.loaded.file.warnings.clear();  // they were read when the mesh was opened
  adopt(std::move(restored.loaded));
  const std::size_t count = restored.steps.size();
  for (auto& step : restored.steps)
    document_->push(std::move(step.command), std::move(step.result), step.seconds);
  document_->go_to(restored.position);
  document_->set_path(restored.path);
  position_changed();
  tell(Notice::Kind::success,
       "The session of " + document_->name() + " is restored, with " + counted(count, "command"));
  if (!restored.damage.empty()) report_error("Restored in part", restored.damage);
}

void Session::on(const action::SaveMesh& a) {
  if (!document_) return;
  if (in_motion() || saver_.busy()) {
    tell(Notice::Kind::warning, "Wait until the solver is done, or cancel it, before saving.");
    return;
  }
  const std::filesystem::path path = a.path.empty() ? document_->path() : a.path;
  if (bundled(path)) return tell(Notice::Kind::warning, bundled_text);
  const Mesh& mesh = document_->state().mesh;
  const Validity validity = check_validity(*mesh.topology, mesh.coordinates);
  if (validity.inverted > 0 && !a.allow_inverted) {
    ask({Prompt::Kind::question,
         "Save a mesh with inverted elements?",
         "The mesh has " + counted(validity.inverted, "inverted element") +
             ". Flow solvers refuse such a mesh, or fail on it.",
         {{"Save it anyway", {action::SaveMesh{path, a.overwrite, true}}, false},
          {"Cancel", {}, true}}});
    return;
  }
  if (!a.overwrite && is_there(path) && !document_->wrote(path)) {
    ask({Prompt::Kind::question,
         "Replace the file?",
         path.filename().string() + " exists already. Saving replaces what is in it.",
         {{"Replace", {action::SaveMesh{path, true, a.allow_inverted}}, false},
          {"Cancel", {}, true}}});
    return;
  }
  saver_.start([path, mesh, details = document_->details(), generation = generation_,
                revision = document_->revision()] {
    SaveOutcome outcome{path, generation, revision, {}, {}};
    outcome.error = error_of([&] { outcome.warnings = io::write_mesh(path, mesh, details.get()); });
    return outcome;
  });
}

bool Session::poll_saver() {
  auto outcome = saver_.poll();
  if (!outcome) return false;
  const std::string name = outcome->path.filename().string();
  if (!outcome->error.empty()) {
    report_error("Cannot save " + name, outcome->error);
    return true;
  }
  if (document_ && generation_ == outcome->generation && !outcome->copy)
    document_->mark_saved(outcome->path, outcome->revision);
  tell(Notice::Kind::success, (outcome->copy ? "Exported " : "Saved ") + name);
  if (!outcome->warnings.empty())
    ask({Prompt::Kind::information,
         "Saved with " + counted(outcome->warnings.size(), "warning"),
         joined(outcome->warnings),
         {{"OK", {}, true}}});
  return true;
}

void Session::on(const action::ExportRecipe& a) {
  if (!document_ || a.path.empty()) return;
  if (bundled(a.path)) return tell(Notice::Kind::warning, bundled_text);
  if (!a.overwrite && is_there(a.path)) {
    ask({Prompt::Kind::question,
         "Replace the file?",
         a.path.filename().string() + " exists already. Saving replaces what is in it.",
         {{"Replace", {action::ExportRecipe{a.path, true}}, false}, {"Cancel", {}, true}}});
    return;
  }
  io::Recipe recipe;
  std::error_code ignored;
  const auto folder = std::filesystem::absolute(a.path, ignored).parent_path();
  recipe.input = std::filesystem::proximate(document_->source(), folder, ignored).string();
  recipe.commands = document_->history().recipe();
  const std::string error = error_of([&] { io::write_recipe(a.path, recipe); });
  if (!error.empty()) return report_error("Cannot write the recipe", error);
  tell(Notice::Kind::success, "Recipe of " + counted(recipe.commands.size(), "command") +
                                  " written to " + a.path.filename().string());
}

void Session::on(const action::Quit& a) {
  if (a.discard_changes || !document_ || !document_->modified()) {
    quit_ = true;
    return;
  }
  ask({Prompt::Kind::question,
       "Leave without saving?",
       document_->name() + " has changes that are not saved.",
       {{"Leave without saving", {action::Quit{true}}, false}, {"Cancel", {}, true}}});
}

}  // namespace winslow::gui
