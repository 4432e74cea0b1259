#pragma once

#include "gui/files/browsed_folder.h"
#include "gui/files/thumbnails.h"
#include "gui/menu/panel_context.h"

struct ImGuiInputTextCallbackData;

namespace winslow::gui {

/// What has been chosen in a file dialog so far.
struct FileChoice {
  BrowsedFolder folder;
  std::string address;      ///< of the folder, as it stands in its field
  std::string name;         ///< of the file, as it stands in its field
  std::string error;        ///< why it cannot be; empty: nothing is wrong
  bool focus_name = false;  ///< the name's field gets the keyboard in the next frame

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

/// The folder of a file dialog: its address, places that one may want, the list of its entries.
class FileBrowser {
 public:
  explicit FileBrowser(FileChoice& choice) : choice_(choice) {}
  /// The dialog comes up. new_folders: folders can be made.
  void open(bool new_folders);

  /// The address, and the name of a new folder while one is made.
  void draw_address(const PanelContext& context);
  /// Places and list side by side. True if a file was chosen for good.
  bool draw(const PanelContext& context, float height);
  /// A file that is chosen is still being read for its picture.
  bool busy() const { return preview_.busy(); }

 private:
  float draw_preview(const PanelContext& context, float height);
  void draw_new_folder(const PanelContext& context);
  void draw_places(const PanelContext& context, float height);
  bool draw_list(const PanelContext& context, float height);
  void draw_headers(const PanelContext& context);
  bool draw_entry(const PanelContext& context, const FolderEntry& entry, bool chosen);
  void draw_sort_arrow() const;
  /// Columns right of the names, pixels; 0: there is no room for it.
  struct Columns {
    float date = 0, size = 0;
    bool whole_date = true;  ///< with the hour
  };
  /// Names come first: dates are shortened for them, then left out, then sizes.
  static Columns columns_for(const Theme& theme, float width, float longest_name);

  FileChoice& choice_;
  Columns columns_;
  bool new_folders_ = false;
  MeshPreview preview_;
  std::optional<std::string> new_folder_;  // being named
  SortBy sort_ = SortBy::name;
  bool reversed_ = false;
};

/// Where the name of a file is typed. Letters find a row of the folder, Tab completes, arrow keys
/// choose, a slash goes into a folder, Backspace in an empty field goes up.
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
