#pragma once

#include "gui/files/browsed_folder.h"
#include "gui/files/thumbnails.h"
#include "gui/menu/panel_context.h"

struct ImGuiInputTextCallbackData;

namespace winslow::gui {

/// The present input of a file dialog.
struct FileChoice {
  BrowsedFolder folder;
  std::string address;      ///< of the folder, as typed in its field
  std::string name;         ///< of the file, as typed in its field
  std::string error;        ///< why the choice is invalid; empty: it is valid
  bool focus_name = false;  ///< focus the name's field in the next frame

  void go(const std::filesystem::path& to) {
    folder.go(to);
    address = folder.wanted().string();
    error.clear();
    focus_name = true;
  }
  void go_up() {
    if (folder.wanted().has_parent_path()) go(folder.wanted().parent_path());
  }
};

/// The folder view of a file dialog: address, frequent places, list of entries.
class FileBrowser {
 public:
  explicit FileBrowser(FileChoice& choice) : choice_(choice) {}
  /// Called when the dialog opens. new_folders: the user can create folders.
  void open(bool new_folders);

  /// Draws the address, and the name of a new folder while one is created.
  void draw_address(const PanelContext& context);
  /// Draws places and list side by side. True if the user has confirmed a file.
  bool draw(const PanelContext& context, float height);
  /// The chosen file is still being read for its preview.
  bool busy() const { return preview_.busy(); }

 private:
  float draw_preview(const PanelContext& context, float height);
  void draw_new_folder(const PanelContext& context);
  void draw_places(const PanelContext& context, float height);
  bool draw_list(const PanelContext& context, float height);
  void draw_headers(const PanelContext& context);
  bool draw_entry(const PanelContext& context, const FolderEntry& entry, bool chosen);
  void draw_sort_arrow() const;
  /// Widths of the columns right of the names, pixels; 0: no room.
  struct Columns {
    float date = 0, size = 0;
    bool whole_date = true;  ///< with the time of day
  };
  /// Names have priority: dates are first shortened, then omitted, then sizes are omitted.
  static Columns columns_for(const Theme& theme, float width, float longest_name);

  FileChoice& choice_;
  Columns columns_;
  bool new_folders_ = false;
  MeshPreview preview_;
  std::optional<std::string> new_folder_;  // being named
  SortBy sort_ = SortBy::name;
  bool reversed_ = false;
};

/// The text field for a file name. Letters find a row of the folder, Tab completes, arrow keys
/// choose, a slash enters a folder, Backspace in an empty field goes up.
class FileNameField {
 public:
  explicit FileNameField(FileChoice& choice) : choice_(choice) {}
  /// True if Enter was pressed.
  bool draw(const PanelContext& context);

 private:
  int edit(ImGuiInputTextCallbackData& data);
  void complete(ImGuiInputTextCallbackData& data, const std::string& text);
  void step(ImGuiInputTextCallbackData& data, int by);
  bool enter_typed_folder(const std::string& text);

  FileChoice& choice_;
};

}  // namespace winslow::gui
