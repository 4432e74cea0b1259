#include "gui/document/session/files.h"

#include "core/strategy/surface_shape.h"
#include "gui/base/text.h"
#include "gui/document/actions/actions.h"
#include "gui/files/assets.h"
#include "io/recipe/recipe.h"
#include "io/tables/table_files.h"

namespace winslow::gui {

bool Files::poll() {
  if (waiting_ && !mesh_.in_motion() && !saver_.busy()) on(*std::exchange(waiting_, std::nullopt));
  bool changed = poll_loader();
  changed |= poll_saver();
  changed |= poll_csv();
  return changed;
}

bool Files::unsaved() const {
  const Document* document = std::as_const(mesh_).document();
  return document && (document->modified() || (mesh_.in_motion() && !jobs_.shown_only()));
}

void Files::ask_to_save(Action next, Action discard) {
  const Document& document = *mesh_.document();
  asked_ = std::move(next);
  saved_ = false;
  // Files of the program are not overwritten: ask for another path.
  ActionQueue save;
  if (bundled(document.path()))
    save.emplace_back(action::ShowFileDialog{FilePurpose::save_mesh, {}, true});
  else
    save.emplace_back(action::SaveMesh{document.path(), true, false, true});
  const std::string text = bundled(document.path())
                               ? "The mesh has changes that are saved nowhere."
                               : "The mesh has changes. Saving them replaces the file.";
  messages_.ask({Prompt::Kind::question,
                 "Save changes to " + document.name() + "?",
                 text,
                 {{"Save", std::move(save), true},
                  {"Don't save", {std::move(discard)}, false},
                  {"Cancel", {}, false}}});
}

std::optional<Action> Files::take_next() {
  if (!saved_) return std::nullopt;
  saved_ = false;
  return std::exchange(asked_, std::nullopt);
}

void Files::on(const action::OpenMesh& a) {
  if (a.path.empty()) return;
  if (unsaved() && !a.discard_changes) {
    ask_to_save(a, action::OpenMesh{a.path, true, a.reading});
    return;
  }
  if (loader_.busy()) {
    next_ = a;
    return;
  }
  loading_path_ = a.path;
  loader_.start([a] {
    LoadOutcome outcome{a, nullptr, {}};
    outcome.error = error_of([&] {
      try {
        outcome.loaded = std::make_shared<Document::Loaded>(Document::load(a.path, a.reading));
      } catch (const io::MendableError& error) {
        outcome.mendable = true;
        throw InputError(error.fault());
      }
    });
    return outcome;
  });
}

/// The answer "Repair" opens the file again, with its mesh mended.
void Files::offer_repair(const LoadOutcome& outcome) {
  action::OpenMesh again = outcome.request;
  again.reading.defects = io::Defects::repair;
  messages_.ask({Prompt::Kind::error,
                 "Cannot open " + again.path.filename().string(),
                 outcome.error +
                     ". Repair (--repair) mends it in memory and counts what it changes; the file "
                     "stays as it is until you save.",
                 {{"Repair", {again}, true}, {"Cancel", {}, false}}});
}

bool Files::poll_loader() {
  auto outcome = loader_.poll();
  if (!outcome) return false;
  const auto path = std::exchange(loading_path_, {});
  if (auto next = std::exchange(next_, std::nullopt)) {
    next->discard_changes = true;
    on(*next);
  } else if (outcome->loaded) {
    adopt(std::move(*outcome->loaded));
  } else if (outcome->mendable) {
    offer_repair(*outcome);
  } else {
    messages_.report_error("Cannot open " + path.filename().string(), outcome->error);
  }
  return true;
}

void Files::adopt(Document::Loaded loaded) {
  // Construct the new document before the old one is destroyed.
  auto document = std::make_unique<Document>(std::move(loaded));
  waiting_.reset();
  jobs_.stop();
  messages_.clear_banner();
  mesh_.open(std::move(document));
  settings_.forget_mesh();
  jobs_.show_position();
  const Document& opened = *mesh_.document();
  const auto& warnings = opened.source().warnings;
  std::string name = opened.name();
  if (const std::string zone = opened.source().zone_text(); !zone.empty())
    name += ", " + zone + " (others: \"Zone\" on the left)";
  if (warnings.empty()) {
    messages_.tell(Notice::Kind::success, "Opened " + name);
  } else {
    messages_.tell(Notice::Kind::warning,
                   "Opened " + name + ", with " + counted(warnings.size(), "warning"));
    messages_.remark("Opened with " + counted(warnings.size(), "warning"), warnings);
  }
}

namespace {

/// The slide options of the last command that has such options; none: no such command.
std::optional<SlideOptions> last_slide(const History& history) {
  for (std::size_t k = history.position(); k > 0; --k) {
    Command command = history.command(k);
    if (const SmoothOptions* options = smooth_options(command)) return options->slide;
  }
  return std::nullopt;
}

}  // namespace

void Files::restore(RestoredSession restored) {
  restored.loaded.file.warnings.clear();  // the user saw them when the mesh was opened
  adopt(std::move(restored.loaded));
  Document& document = *mesh_.document();
  const std::size_t count = restored.steps.size();
  for (auto& step : restored.steps)
    document.edits().push(std::move(step.command), std::move(step.result), step.seconds);
  document.edits().go_to(restored.position);
  document.saved().set_path(restored.path);
  if (const auto slide = last_slide(document.history())) {
    SmoothOptions after = settings_.smooth_options();
    after.slide = *slide;
    settings_.on(action::EditSmoothOptions{difference(settings_.smooth_options(), after)});
  }
  jobs_.show_position();
  messages_.tell(Notice::Kind::success, "The session of " + document.name() +
                                            " is restored, with " + counted(count, "command"));
  if (!restored.damage.empty()) messages_.report_error("Restored in part", restored.damage);
}

void Files::on(const action::CloseMesh& a) {
  if (!mesh_.document()) return;
  if (unsaved() && !a.discard_changes) {
    ask_to_save(a, action::CloseMesh{true});
    return;
  }
  waiting_.reset();
  jobs_.stop();
  messages_.clear_banner();
  mesh_.close();
  messages_.forget_notice();
  mesh_.changed();
}

void Files::on(const action::SaveMesh& a) {
  if (!mesh_.document()) return;
  if (a.proceed && (mesh_.in_motion() || saver_.busy())) {
    waiting_ = a;
    messages_.tell(Notice::Kind::information,
                   mesh_.document()->name() + " is saved once the solver is done");
    return;
  }
  if (mesh_.in_motion() || saver_.busy()) {
    messages_.tell(Notice::Kind::warning,
                   "Wait until the solver is done, or cancel it, before saving.");
    return;
  }
  const Document& document = *mesh_.document();
  const std::filesystem::path path = a.path.empty() ? document.path() : a.path;
  if (!messages_.may_write(path)) return;
  const Mesh& mesh = document.state().mesh;
  const Validity validity = check_validity(*mesh.topology, mesh.coordinates, 0,
                                           reference_normals(document.state(), mesh.coordinates));
  if (validity.inverted > 0 && !a.allow_inverted) {
    messages_.ask(
        {Prompt::Kind::question,
         "Save a mesh with inverted elements?",
         "The mesh has " + counted(validity.inverted, "inverted element") +
             ". Flow solvers refuse such a mesh, or fail on it.",
         {{"Save it anyway", {action::SaveMesh{path, a.overwrite, true, a.proceed}}, false},
          {"Cancel", {}, true}}});
    return;
  }
  const bool overwrite = a.overwrite || document.saved().wrote(path);
  if (messages_.may_replace(path, overwrite, " Saving replaces what is in it.",
                            action::SaveMesh{path, true, a.allow_inverted, a.proceed}))
    start_saver(path, false, a.proceed);
}

/// copy: the document keeps its path.
void Files::start_saver(const std::filesystem::path& path, bool copy, bool proceed) {
  const Document& document = *mesh_.document();
  saver_.start([path, mesh = document.state().mesh, details = document.source().details,
                generation = mesh_.generation(), revision = document.edits().revision(), copy,
                proceed] {
    SaveOutcome outcome{path, generation, revision, {}, {}, copy, proceed};
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
    mesh_.document()->saved().mark_saved(outcome->path, outcome->revision);
  messages_.tell(Notice::Kind::success, (outcome->copy ? "Exported " : "Saved ") + name);
  if (!outcome->warnings.empty())
    messages_.remark("Saved with " + counted(outcome->warnings.size(), "warning"),
                     outcome->warnings);
  saved_ = outcome->proceed && asked_.has_value();
  return true;
}

void Files::on(const action::Quit& a) {
  const Document* document = mesh_.document();
  if (a.discard_changes || !document || !document->modified()) {
    quit_ = true;
    return;
  }
  ask_to_save(a, action::Quit{true});
}

void Files::on(const action::ExportMesh& a) {
  if (!mesh_.document() || a.path.empty()) return;
  if (mesh_.in_motion() || saver_.busy()) {
    messages_.tell(Notice::Kind::warning,
                   "Wait until the solver is done, or cancel it, before exporting.");
    return;
  }
  if (messages_.may_write(a.path) &&
      messages_.may_replace(a.path, a.overwrite, " Exporting replaces what is in it.",
                            action::ExportMesh{a.path, true}))
    start_saver(a.path, true);
}

void Files::on(const action::ExportMarkers& a) {
  if (!mesh_.document() || a.path.empty() || !messages_.may_write(a.path)) return;
  if (!messages_.may_replace(a.path, a.overwrite, " Exporting replaces what is in it.",
                             action::ExportMarkers{a.path, a.markers, true}))
    return;
  const auto& markers = mesh_.topology()->markers();
  std::vector<Index> wanted = a.markers.empty() ? selection_.markers() : a.markers;
  if (wanted.empty())
    for (Index m = 0; m < static_cast<Index>(markers.size()); ++m) wanted.push_back(m);
  std::erase_if(wanted, [&](Index m) { return m < 0 || at(m) >= markers.size(); });
  const std::vector<std::string> names = marker_names(*mesh_.topology(), wanted);
  const Mesh mesh{mesh_.topology(), mesh_.coordinates()};
  const std::string error = error_of([&] { io::write_boundary(a.path, mesh, names); });
  if (!error.empty()) return messages_.report_error("Cannot export the markers", error);
  messages_.tell(Notice::Kind::success, "Exported " + counted(names.size(), "marker") + " to " +
                                            a.path.filename().string());
}

void Files::on(const action::ExportRecipe& a) {
  if (!mesh_.document() || a.path.empty() || !messages_.may_write(a.path)) return;
  if (!messages_.may_replace(a.path, a.overwrite, " Saving replaces what is in it.",
                             action::ExportRecipe{a.path, true}))
    return;
  const Document& document = *mesh_.document();
  io::Recipe recipe;
  std::error_code ignored;
  const auto folder = std::filesystem::absolute(a.path, ignored).parent_path();
  recipe.input = std::filesystem::proximate(document.source().path, folder, ignored).string();
  recipe.commands = document.history().recipe();
  recipe.zone = document.source().zone();
  recipe.regions = document.source().reading.regions;
  const std::string error = error_of([&] { io::write_recipe(a.path, recipe); });
  if (!error.empty()) return messages_.report_error("Cannot write the recipe", error);
  messages_.tell(Notice::Kind::success, "Recipe of " + counted(recipe.commands.size(), "command") +
                                            " written to " + a.path.filename().string());
}

void Files::on(const action::ExportConvergence& a) {
  const auto shown = mesh_.convergence();
  if (shown.empty() || a.path.empty()) return;
  if (csv_writer_.busy())
    return messages_.tell(Notice::Kind::warning, "Still writing the last one.");
  if (!messages_.may_write(a.path)) return;
  if (!messages_.may_replace(a.path, a.overwrite, " Saving replaces what is in it.",
                             action::ExportConvergence{a.path, true}))
    return;
  const int number = static_cast<int>(mesh_.document()->history().position()) +
                     (mesh_.work().job().active() ? 1 : 0);
  csv_writer_.start(
      [path = a.path, number, records = std::vector<IterationRecord>(shown.begin(), shown.end())] {
        return CsvOutcome{path, records.size(), error_of([&] {
                            io::write_convergence_csv(path, {{number, records}});
                          })};
      });
}

bool Files::poll_csv() {
  auto outcome = csv_writer_.poll();
  if (!outcome) return false;
  if (!outcome->error.empty())
    messages_.report_error("Cannot write the iterations", outcome->error);
  else
    messages_.tell(Notice::Kind::success, counted(outcome->rows, "iteration") + " written to " +
                                              outcome->path.filename().string());
  return true;
}

}  // namespace winslow::gui
