#pragma once

#include <optional>
#include <string>

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

 private:
  void draw_new_folder(const PanelContext& context);
  void draw_places(const PanelContext& context, float height);
  bool draw_list(const PanelContext& context, float height);
  void draw_headers(const PanelContext& context);
  bool draw_entry(const PanelContext& context, const FolderEntry& entry, bool chosen);

  FileChoice& choice_;
  bool new_folders_ = false;
  std::optional<std::string> new_folder_;  // being named
  SortBy sort_ = SortBy::name;
  bool reversed_ = false;
};

}  // namespace winslow::gui
