#pragma once

#include "gui/files/file_kinds.h"
#include "gui/menu/panel_context.h"
#include "gui/panels/files/file_browser.h"

namespace winslow::gui {

/// Chooses a file to open or to write: a dialog of our own, since the system has none that every
/// desktop shares. Made for the keyboard: letters jump to a name, Tab completes it, arrow keys
/// choose, a slash or Enter goes into a folder, Backspace in an empty field goes up, Esc leaves.
class FileDialog {
 public:
  FileDialog() = default;
  FileDialog(const FileDialog&) = delete;  // its parts know its choice
  FileDialog& operator=(const FileDialog&) = delete;
  /// Shows the dialog from the next frame on. `suggested`: folder and name to start with. `step`:
  /// of the history, that a recording is to be made of. mesh: what is open.
  void open(FilePurpose purpose, const std::filesystem::path& suggested,
            std::optional<std::size_t> step = std::nullopt, MeshKind mesh = MeshKind::plane);
  bool is_open() const { return open_; }
  /// A mesh that is saved is saved to go on with what asked for that: see action::SaveMesh.
  void set_proceed(bool proceed) { proceed_ = proceed; }
  /// A folder, or a mesh for its picture, is being read.
  bool busy() const { return open_ && (choice_.folder.listing().busy() || browser_.busy()); }
  const std::filesystem::path& folder() const { return choice_.folder.listing().folder(); }
  void draw(const PanelContext& context);

 private:
  void draw_content(const PanelContext& context);
  void draw_footer(const PanelContext& context, bool entered);
  void draw_filter(const PanelContext& context);
  void set_filter(std::size_t filter);
  void accept(const PanelContext& context);
  void choose(const PanelContext& context, const std::filesystem::path& path);
  void close();

  bool open_ = false, wanted_ = false;
  FilePurpose purpose_ = FilePurpose::open_mesh;
  std::optional<std::size_t> step_;  // of the history, that a recording is of
  bool proceed_ = false;             // as action::SaveMesh
  DialogKind kind_;
  std::size_t filter_ = 0;  // of kind_.kinds
  FileChoice choice_;
  FileBrowser browser_{choice_};
  FileNameField name_field_{choice_};
};

}  // namespace winslow::gui
