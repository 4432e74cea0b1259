#include <string>
#include <system_error>
#include <utility>

#include "gui/base/file_work.h"
#include "gui/base/text.h"
#include "gui/document/actions/actions.h"
#include "gui/document/session/files.h"
#include "gui/files/assets.h"
#include "io/recipe/recipe.h"
#include "io/tables/boundary_file.h"
#include "io/tables/convergence_csv.h"

namespace winslow::gui {

/// Nothing is written among the meshes that come with the program.
bool Files::may_write(const std::filesystem::path& path) {
  if (!bundled(path)) return true;
  messages_.tell(Notice::Kind::warning, bundled_text);
  return false;
}

/// Asks before a file is replaced. how: "Saving". again: what to do then.
bool Files::may_export(const std::filesystem::path& path, bool overwrite, const char* how,
                       Action again) {
  if (overwrite || !is_there(path)) return true;
  messages_.ask({Prompt::Kind::question,
                 "Replace the file?",
                 path.filename().string() + " exists already. " + how + " replaces what is in it.",
                 {{"Replace", {std::move(again)}, false}, {"Cancel", {}, true}}});
  return false;
}

void Files::on(const action::ExportMesh& a) {
  if (!mesh_.document() || a.path.empty()) return;
  if (mesh_.in_motion() || saver_.busy()) {
    messages_.tell(Notice::Kind::warning,
                   "Wait until the solver is done, or cancel it, before exporting.");
    return;
  }
  if (may_write(a.path) &&
      may_export(a.path, a.overwrite, "Exporting", action::ExportMesh{a.path, true}))
    start_saver(a.path, true);
}

void Files::on(const action::ExportMarkers& a) {
  if (!mesh_.document() || a.path.empty() || !may_write(a.path)) return;
  if (!may_export(a.path, a.overwrite, "Exporting", action::ExportMarkers{a.path, a.markers, true}))
    return;
  const auto& markers = mesh_.topology()->markers();
  std::vector<Index> wanted = a.markers.empty() ? selection_.markers() : a.markers;
  if (wanted.empty())
    for (Index m = 0; m < static_cast<Index>(markers.size()); ++m) wanted.push_back(m);
  std::vector<std::string> names;
  for (Index m : wanted)
    if (m >= 0 && m < static_cast<Index>(markers.size()))
      names.push_back(markers[static_cast<std::size_t>(m)].name);
  const Mesh mesh{mesh_.topology(), mesh_.coordinates()};
  const std::string error = error_of([&] { io::write_boundary(a.path, mesh, names); });
  if (!error.empty()) return messages_.report_error("Cannot export the markers", error);
  messages_.tell(Notice::Kind::success, "Exported " + counted(names.size(), "marker") + " to " +
                                            a.path.filename().string());
}

void Files::on(const action::ExportRecipe& a) {
  if (!mesh_.document() || a.path.empty() || !may_write(a.path)) return;
  if (!may_export(a.path, a.overwrite, "Saving", action::ExportRecipe{a.path, true})) return;
  const Document& document = *mesh_.document();
  io::Recipe recipe;
  std::error_code ignored;
  const auto folder = std::filesystem::absolute(a.path, ignored).parent_path();
  recipe.input = std::filesystem::proximate(document.source(), folder, ignored).string();
  recipe.commands = document.history().recipe();
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
  if (!may_write(a.path)) return;
  if (!may_export(a.path, a.overwrite, "Saving", action::ExportConvergence{a.path, true})) return;
  const int number =
      static_cast<int>(mesh_.document()->history().position()) + (mesh_.job().active() ? 1 : 0);
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
