#pragma once

#include "gui/base/screen.h"
#include "gui/document/actions/actions.h"
#include "gui/document/actions/document_actions.h"
#include "gui/menu/panel_context.h"

namespace winslow::gui {

class FileDialog;

/// The windows that come up over the studio: dialogs, the palette of commands, prompts.
class Dialogs {
 public:
  explicit Dialogs(const Session& session);
  ~Dialogs();
  Dialogs(const Dialogs&) = delete;
  Dialogs& operator=(const Dialogs&) = delete;

  void apply(const DialogAction& action) { Dispatch::to(*this, action); }
  const FileDialog& file_dialog() const;
  /// Draws those that are up. window, mesh: their sizes on screen, pixels.
  void draw(const PanelContext& context, const ScreenVector& window, const ScreenVector& mesh);

  void on(const action::ShowFileDialog& a);
  void on(const action::ShowPictureDialog&);
  void on(const action::ShowRecordDialog& a);
  void on(const action::ShowStepEditor& a);
  void on(const action::ChooseStepReference& a);
  void on(const action::ShowContextMenu& a);
  void on(const action::ShowHelp&);
  void on(const action::ShowPalette&);
  void on(const action::ShowAbout&);

 private:
  struct Windows;
  const Session& session_;
  std::unique_ptr<Windows> windows_;
  std::optional<std::size_t> recorded_step_;  // that the file dialog is open for
};

}  // namespace winslow::gui
