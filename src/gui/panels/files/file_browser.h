#pragma once

#include <optional>
#include <string>

#include "gui/files/mesh_preview.h"
#include "gui/panels/files/file_choice.h"
#include "gui/panels/panel.h"

namespace winslow::gui {

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

}  // namespace winslow::gui
