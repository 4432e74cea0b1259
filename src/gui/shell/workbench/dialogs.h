#pragma once

#include "gui/document/actions/document_actions.h"
#include "gui/panels/dialogs.h"
#include "gui/panels/files/file_dialog.h"

namespace winslow::gui {

/// Owns the windows that open above the studio: dialogs, the palette of commands, prompts.
class Dialogs {
 public:
  explicit Dialogs(const Session& session) : session_(session) {}

  void apply(const DialogAction& action) { Dispatch::to(*this, action); }
  const FileDialog& file_dialog() const { return file_; }
  /// Draws the open ones. window, mesh: their sizes on screen, pixels.
  void draw(const PanelContext& context, const ScreenVector& window, const ScreenVector& mesh);

  void on(const action::ShowFileDialog& a);
  void on(const action::ShowPictureDialog&) { picture_.open(); }
  void on(const action::ShowRecordDialog& a);
  void on(const action::ShowStepEditor& a);
  void on(const action::ChooseStepReference& a) { step_.set_reference(a.file); }
  void on(const action::ShowContextMenu& a) { context_.open(a.place); }
  void on(const action::ShowHelp&) { help_.open(); }
  void on(const action::ShowPalette&) { palette_.open(); }
  void on(const action::ShowAbout&) { about_.open(); }

 private:
  const Session& session_;
  PictureDialog picture_;
  RecordDialog record_;
  FileDialog file_;
  StepEditor step_;
  HelpPanel help_;
  CommandPalette palette_;
  AboutPanel about_;
  ContextMenu context_;
  std::optional<std::size_t> recorded_step_;  // for which the file dialog is open
};

}  // namespace winslow::gui
