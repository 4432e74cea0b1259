#pragma once

#include "gui/files/file_kinds.h"
#include "gui/menu/panel_context.h"
#include "gui/panels/files/file_browser.h"

namespace winslow::gui {

/// A dialog that chooses a file to open or to write; desktops have no common one. For keyboard use:
/// letters jump to a name, Tab completes it, arrow keys choose, a slash or Enter enters a folder,
/// Backspace in an empty field goes up, Esc closes.
class FileDialog {
 public:
  FileDialog() = default;
  FileDialog(const FileDialog&) = delete;  // its parts refer to choice_
  FileDialog& operator=(const FileDialog&) = delete;
  /// Shows the dialog from the next frame on. `suggested`: initial folder and name. `step`: of the
  /// history, to be recorded. mesh: kind of the open mesh.
  void open(FilePurpose purpose, const std::filesystem::path& suggested,
            std::optional<std::size_t> step = std::nullopt, MeshKind mesh = MeshKind::plane);
  bool is_open() const { return open_; }
  /// Whether a pending action continues after the save: see action::SaveMesh.
  void set_proceed(bool proceed) { proceed_ = proceed; }
  /// A folder, or a mesh for its preview, is being read.
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
  std::optional<std::size_t> step_;  // of the history, to be recorded
  bool proceed_ = false;             // see action::SaveMesh
  DialogKind kind_;
  std::size_t filter_ = 0;  // of kind_.kinds
  FileChoice choice_;
  FileBrowser browser_{choice_};
  FileNameField name_field_{choice_};
};

}  // namespace winslow::gui
