#include "gui/shell/workbench/dialogs.h"

#include "gui/files/assets.h"
#include "gui/panels/about_panel.h"
#include "gui/panels/command_palette.h"
#include "gui/panels/files/file_dialog.h"
#include "gui/panels/help_panel.h"
#include "gui/panels/history_panel.h"
#include "gui/panels/menus.h"
#include "gui/panels/message_panels.h"
#include "gui/panels/picture_dialogs.h"
#include "gui/picture/capture/capture.h"

namespace winslow::gui {

struct Dialogs::Windows {
  PictureDialog picture;
  RecordDialog record;
  FileDialog file;
  StepEditor step;
  PromptPanel prompt;
  HelpPanel help;
  CommandPalette palette;
  AboutPanel about;
  ContextMenu context;
};

Dialogs::Dialogs(const Session& session)
    : session_(session), windows_(std::make_unique<Windows>()) {}

Dialogs::~Dialogs() = default;

const FileDialog& Dialogs::file_dialog() const { return windows_->file; }

void Dialogs::draw(const PanelContext& context, const ScreenVector& window,
                   const ScreenVector& mesh) {
  Windows& w = *windows_;
  w.picture.set_extents(window, mesh);
  w.record.set_extents(window, mesh);
  w.picture.draw(context);
  w.record.draw(context);
  // It makes room for the dialog in which a file is chosen for it, and does not take the key that
  // closed that one.
  if (!w.file.is_open()) w.step.show_again();
  w.file.draw(context);
  w.step.draw(context);
  // One dialog at a time: what there is to say waits until a file is chosen.
  if (!w.file.is_open() && !w.step.is_open()) w.prompt.draw(context);
  w.help.draw(context);
  w.palette.draw(context);
  w.about.draw(context);
  w.context.draw(context);
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
  // What is written does not belong among the meshes that come with the program.
  std::error_code ignored;
  const std::string& reference = session_.solver_settings().smooth_options().slide.reference;
  if (a.purpose == FilePurpose::reference && !reference.empty()) suggested = reference;
  const std::string of_step = windows_->step.reference();
  if (a.purpose == FilePurpose::step_reference && !of_step.empty()) suggested = of_step;
  const bool reads =
      a.purpose == FilePurpose::open_mesh || a.purpose == FilePurpose::replay_recipe ||
      a.purpose == FilePurpose::reference || a.purpose == FilePurpose::step_reference;
  if (!reads && bundled(suggested))
    suggested = std::filesystem::current_path(ignored) / suggested.filename();
  if (!a.extension.empty()) suggested.replace_extension(a.extension);
  windows_->file.open(a.purpose, suggested, recorded_step_, session_.kind());
  windows_->file.set_proceed(a.proceed);
}

void Dialogs::on(const action::ShowStepEditor& a) {
  if (!session_.document()) return;
  const History& history = session_.document()->history();
  if (a.position > 0 && a.position < history.size())
    windows_->step.open(a.position, history.command(a.position));
}

void Dialogs::on(const action::ChooseStepReference& a) { windows_->step.set_reference(a.file); }

void Dialogs::on(const action::ShowRecordDialog& a) {
  recorded_step_ = a.step;
  windows_->record.open(a.step);
}

void Dialogs::on(const action::ShowPictureDialog&) { windows_->picture.open(); }

void Dialogs::on(const action::ShowContextMenu& a) { windows_->context.open(a.place); }

void Dialogs::on(const action::ShowHelp&) { windows_->help.open(); }

void Dialogs::on(const action::ShowPalette&) { windows_->palette.open(); }

void Dialogs::on(const action::ShowAbout&) { windows_->about.open(); }

}  // namespace winslow::gui
