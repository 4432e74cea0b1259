#include "gui/shell/workbench/dialogs.h"

#include "gui/files/assets.h"
#include "gui/picture/capture/capture.h"

namespace winslow::gui {

void Dialogs::draw(const PanelContext& context, const ScreenVector& window,
                   const ScreenVector& mesh) {
  picture_.draw(context, window, mesh);
  record_.draw(context, window, mesh);
  // The step editor is hidden while its file dialog is open, and must not handle the key that
  // closed the file dialog.
  if (!file_.is_open()) step_.show_again();
  file_.draw(context);
  step_.draw(context);
  // One dialog at a time: prompts wait until the other dialogs are closed.
  if (!file_.is_open() && !step_.is_open()) draw_prompt(context);
  help_.draw(context);
  palette_.draw(context);
  about_.draw(context);
  context_.draw(context);
}

void Dialogs::on(const action::ShowFileDialog& a) {
  const Document* document = session_.document();
  std::filesystem::path suggested = document ? document->path() : std::filesystem::path();
  if (a.purpose == FilePurpose::export_recipe) suggested.replace_extension(".json");
  if (a.purpose == FilePurpose::export_convergence) suggested.replace_extension(".csv");
  if (a.purpose == FilePurpose::picture) suggested = Capture::new_picture_name();
  if (a.purpose == FilePurpose::recording) suggested.replace_extension(".mp4");
  if (a.purpose == FilePurpose::export_markers)
    suggested.replace_filename(suggested.stem().string() + "_markers.csv");
  // Do not suggest the folder of the bundled meshes for writing.
  std::error_code ignored;
  const std::string& reference = session_.solver_settings().smooth_options().slide.reference;
  if (a.purpose == FilePurpose::reference && !reference.empty()) suggested = reference;
  const std::string of_step = step_.reference();
  if (a.purpose == FilePurpose::step_reference && !of_step.empty()) suggested = of_step;
  const bool reads =
      a.purpose == FilePurpose::open_mesh || a.purpose == FilePurpose::replay_recipe ||
      a.purpose == FilePurpose::displacements || a.purpose == FilePurpose::positions ||
      a.purpose == FilePurpose::reference || a.purpose == FilePurpose::step_reference;
  if (!reads && bundled(suggested))
    suggested = std::filesystem::current_path(ignored) / suggested.filename();
  if (!a.extension.empty()) suggested.replace_extension(a.extension);
  file_.open(a.purpose, suggested, recorded_step_, session_.kind());
  file_.set_proceed(a.proceed);
}

void Dialogs::on(const action::ShowStepEditor& a) {
  if (!session_.document()) return;
  const History& history = session_.document()->history();
  if (a.position > 0 && a.position < history.size())
    step_.open(a.position, history.command(a.position));
}

void Dialogs::on(const action::ShowRecordDialog& a) {
  recorded_step_ = a.step;
  record_.open(a.step);
}

}  // namespace winslow::gui
