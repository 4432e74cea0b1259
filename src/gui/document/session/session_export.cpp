#include <string>
#include <utility>

#include "gui/base/file_work.h"
#include "gui/base/text.h"
#include "gui/document/session/session.h"
#include "gui/files/assets.h"
#include "io/boundary_file.h"

namespace winslow::gui {

namespace {

/// Asks before a file is replaced. `again`: what to do then.
Prompt may_replace(const std::filesystem::path& path, Action again) {
  return {Prompt::Kind::question,
          "Replace the file?",
          path.filename().string() + " exists already. Exporting replaces what is in it.",
          {{"Replace", {std::move(again)}, false}, {"Cancel", {}, true}}};
}

}  // namespace

void Session::on(const action::CloseMesh& a) {
  if (!document_) return;
  if ((document_->modified() || in_motion()) && !a.discard_changes) {
    ask({Prompt::Kind::question,
         "Close without saving?",
         document_->name() + " has changes that are not saved.",
         {{"Close without saving", {action::CloseMesh{true}}, false}, {"Cancel", {}, true}}});
    return;
  }
  forget_mesh();
  notice_.reset();
  shape_changed();
}

void Session::on(const action::ExportMesh& a) {
  if (!document_ || a.path.empty()) return;
  if (in_motion() || saver_.busy()) {
    tell(Notice::Kind::warning, "Wait until the solver is done, or cancel it, before exporting.");
    return;
  }
  if (bundled(a.path)) return tell(Notice::Kind::warning, bundled_text);
  if (!a.overwrite && is_there(a.path))
    return ask(may_replace(a.path, action::ExportMesh{a.path, true}));
  saver_.start([path = a.path, mesh = document_->state().mesh, details = document_->details(),
                generation = generation_, revision = document_->revision()] {
    SaveOutcome outcome{path, generation, revision, {}, {}, true};
    outcome.error = error_of([&] { outcome.warnings = io::write_mesh(path, mesh, details.get()); });
    return outcome;
  });
}

void Session::on(const action::ExportMarkers& a) {
  if (!document_ || a.path.empty()) return;
  if (bundled(a.path)) return tell(Notice::Kind::warning, bundled_text);
  if (!a.overwrite && is_there(a.path))
    return ask(may_replace(a.path, action::ExportMarkers{a.path, a.markers, true}));
  const auto& markers = topology()->markers();
  std::vector<Index> wanted = a.markers.empty() ? selection_ : a.markers;
  if (wanted.empty())
    for (Index m = 0; m < static_cast<Index>(markers.size()); ++m) wanted.push_back(m);
  std::vector<std::string> names;
  for (Index m : wanted)
    if (m >= 0 && m < static_cast<Index>(markers.size()))
      names.push_back(markers[static_cast<std::size_t>(m)].name);
  const Mesh mesh{topology(), coordinates()};
  const std::string error = error_of([&] { io::write_boundary(a.path, mesh, names); });
  if (!error.empty()) return report_error("Cannot export the markers", error);
  tell(Notice::Kind::success,
       "Exported " + counted(names.size(), "marker") + " to " + a.path.filename().string());
}

}  // namespace winslow::gui
