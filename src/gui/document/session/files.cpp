#include "gui/document/session/files.h"

#include <utility>

#include "gui/base/file_work.h"
#include "gui/base/text.h"
#include "gui/document/actions/actions.h"
#include "gui/files/assets.h"

namespace winslow::gui {

bool Files::poll() {
  bool changed = poll_loader();
  changed |= poll_saver();
  changed |= poll_csv();
  return changed;
}

bool Files::unsaved() const {
  const Document* document = std::as_const(mesh_).document();
  return document && (document->modified() || mesh_.in_motion());
}

void Files::on(const action::OpenMesh& a) {
  if (a.path.empty()) return;
  if (unsaved() && !a.discard_changes) {
    messages_.ask({Prompt::Kind::question,
                   "Discard the changes?",
                   mesh_.document()->name() + " has changes that are not saved. Opening " +
                       a.path.filename().string() + " would lose them.",
                   {{"Discard and open", {action::OpenMesh{a.path, true, a.zone}}, false},
                    {"Cancel", {}, true}}});
    return;
  }
  if (loader_.busy()) {
    next_path_ = a.path;
    next_zone_ = a.zone;
    return;
  }
  loading_path_ = a.path;
  loader_.start([path = a.path, zone = a.zone] {
    LoadOutcome outcome;
    outcome.error = error_of(
        [&] { outcome.loaded = std::make_shared<Document::Loaded>(Document::load(path, zone)); });
    return outcome;
  });
}

bool Files::poll_loader() {
  auto outcome = loader_.poll();
  if (!outcome) return false;
  const auto path = std::exchange(loading_path_, {});
  if (!next_path_.empty()) {
    on(action::OpenMesh{std::exchange(next_path_, {}), true, next_zone_});
  } else if (outcome->loaded) {
    adopt(std::move(*outcome->loaded));
  } else {
    messages_.report_error("Cannot open " + path.filename().string(), outcome->error);
  }
  return true;
}

void Files::adopt(Document::Loaded loaded) {
  // The new one stands before the old one goes.
  auto document = std::make_unique<Document>(std::move(loaded));
  jobs_.stop();
  messages_.clear_banner();
  mesh_.open(std::move(document));
  jobs_.show_position();
  const Document& opened = *mesh_.document();
  const auto& warnings = opened.warnings();
  std::string name = opened.name();
  if (const std::string zone = opened.zone_text(); !zone.empty())
    name += ", " + zone + " (others: \"Zone\" on the left)";
  if (warnings.empty()) {
    messages_.tell(Notice::Kind::success, "Opened " + name);
  } else {
    messages_.tell(Notice::Kind::warning,
                   "Opened " + name + ", with " + counted(warnings.size(), "warning"));
    messages_.ask({Prompt::Kind::information,
                   "Opened with " + counted(warnings.size(), "warning"),
                   joined(warnings),
                   {{"OK", {}, true}}});
  }
}

void Files::restore(RestoredSession restored) {
  restored.loaded.file.warnings.clear();  // they were read when the mesh was opened
  adopt(std::move(restored.loaded));
  Document& document = *mesh_.document();
  const std::size_t count = restored.steps.size();
  for (auto& step : restored.steps)
    document.edits().push(std::move(step.command), std::move(step.result), step.seconds);
  document.edits().go_to(restored.position);
  document.set_path(restored.path);
  jobs_.show_position();
  messages_.tell(Notice::Kind::success, "The session of " + document.name() +
                                            " is restored, with " + counted(count, "command"));
  if (!restored.damage.empty()) messages_.report_error("Restored in part", restored.damage);
}

void Files::on(const action::CloseMesh& a) {
  if (!mesh_.document()) return;
  if (unsaved() && !a.discard_changes) {
    messages_.ask(
        {Prompt::Kind::question,
         "Close without saving?",
         mesh_.document()->name() + " has changes that are not saved.",
         {{"Close without saving", {action::CloseMesh{true}}, false}, {"Cancel", {}, true}}});
    return;
  }
  jobs_.stop();
  messages_.clear_banner();
  mesh_.close();
  messages_.forget_notice();
  mesh_.changed();
}

void Files::on(const action::SaveMesh& a) {
  if (!mesh_.document()) return;
  if (mesh_.in_motion() || saver_.busy()) {
    messages_.tell(Notice::Kind::warning,
                   "Wait until the solver is done, or cancel it, before saving.");
    return;
  }
  const Document& document = *mesh_.document();
  const std::filesystem::path path = a.path.empty() ? document.path() : a.path;
  if (!may_write(path)) return;
  const Mesh& mesh = document.state().mesh;
  const Validity validity = check_validity(*mesh.topology, mesh.coordinates);
  if (validity.inverted > 0 && !a.allow_inverted) {
    messages_.ask({Prompt::Kind::question,
                   "Save a mesh with inverted elements?",
                   "The mesh has " + counted(validity.inverted, "inverted element") +
                       ". Flow solvers refuse such a mesh, or fail on it.",
                   {{"Save it anyway", {action::SaveMesh{path, a.overwrite, true}}, false},
                    {"Cancel", {}, true}}});
    return;
  }
  const bool overwrite = a.overwrite || document.wrote(path);
  if (may_export(path, overwrite, "Saving", action::SaveMesh{path, true, a.allow_inverted}))
    start_saver(path, false);
}

/// copy: the document stays where it is.
void Files::start_saver(const std::filesystem::path& path, bool copy) {
  const Document& document = *mesh_.document();
  saver_.start([path, mesh = document.state().mesh, details = document.details(),
                generation = mesh_.generation(), revision = document.edits().revision(), copy] {
    SaveOutcome outcome{path, generation, revision, {}, {}, copy};
    outcome.error = error_of([&] { outcome.warnings = io::write_mesh(path, mesh, details.get()); });
    return outcome;
  });
}

bool Files::poll_saver() {
  auto outcome = saver_.poll();
  if (!outcome) return false;
  const std::string name = outcome->path.filename().string();
  if (!outcome->error.empty()) {
    messages_.report_error("Cannot save " + name, outcome->error);
    return true;
  }
  if (mesh_.document() && mesh_.generation() == outcome->generation && !outcome->copy)
    mesh_.document()->mark_saved(outcome->path, outcome->revision);
  messages_.tell(Notice::Kind::success, (outcome->copy ? "Exported " : "Saved ") + name);
  if (!outcome->warnings.empty())
    messages_.ask({Prompt::Kind::information,
                   "Saved with " + counted(outcome->warnings.size(), "warning"),
                   joined(outcome->warnings),
                   {{"OK", {}, true}}});
  return true;
}

void Files::on(const action::Quit& a) {
  const Document* document = mesh_.document();
  if (a.discard_changes || !document || !document->modified()) {
    quit_ = true;
    return;
  }
  messages_.ask({Prompt::Kind::question,
                 "Leave without saving?",
                 document->name() + " has changes that are not saved.",
                 {{"Leave without saving", {action::Quit{true}}, false}, {"Cancel", {}, true}}});
}

}  // namespace winslow::gui
