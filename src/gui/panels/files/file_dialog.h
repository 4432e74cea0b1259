#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gui/files/file_kinds.h"
#include "gui/files/folder_listing.h"
#include "gui/panels/panel.h"

struct ImGuiInputTextCallbackData;

namespace winslow::gui {

/// Chooses a file to open or to write: a dialog of our own, since the system has none that every
/// desktop shares. Made for the keyboard: letters jump to a name, Tab completes it, arrow keys
/// choose, a slash or Enter goes into a folder, Backspace in an empty field goes up, Esc leaves.
class FileDialog : public Panel {
 public:
  FileDialog();
  /// Shows the dialog from the next frame on. `suggested`: folder and name to start with. `step`:
  /// of the history, that a recording is to be made of.
  void open(FilePurpose purpose, const std::filesystem::path& suggested,
            std::optional<std::size_t> step = std::nullopt);
  bool is_open() const { return open_; }
  /// A folder is being read.
  bool busy() const { return open_ && listing_.busy(); }
  const std::filesystem::path& folder() const { return listing_.folder(); }
  void draw(const PanelContext& context) override;

 private:
  void go(const std::filesystem::path& folder);
  void go_up();
  void draw_content(const PanelContext& context);

  // The folder shown (file_dialog_list.cpp)
  void draw_bar(const PanelContext& context);
  void draw_new_folder(const PanelContext& context);
  void draw_places(const PanelContext& context, float height);
  void draw_list(const PanelContext& context, float height);
  void draw_headers(const PanelContext& context);
  bool draw_entry(const PanelContext& context, const FolderEntry& entry, bool chosen);
  std::vector<const FolderEntry*> shown() const;

  // The name being typed (file_dialog_name.cpp)
  void draw_name(const PanelContext& context);
  int edit(ImGuiInputTextCallbackData& data);
  void complete(ImGuiInputTextCallbackData& data);
  void step(ImGuiInputTextCallbackData& data, int by);
  bool enter_typed_folder(const std::string& text);
  void find_typed(const std::string& text);

  void draw_footer(const PanelContext& context);
  void draw_filter(const PanelContext& context);
  void accept(const PanelContext& context);
  void choose(const PanelContext& context, const std::filesystem::path& path);
  void close();

  bool open_ = false, wanted_ = false, focus_name_ = false, scroll_ = false, entered_ = false;
  bool hidden_files_ = false;
  FilePurpose purpose_ = FilePurpose::open_mesh;
  std::optional<std::size_t> step_;  // of the history, that a recording is of
  DialogKind kind_;
  std::size_t filter_ = 0;  // of kind_.kinds
  FolderListing listing_;
  std::filesystem::path wanted_folder_;
  SortBy sort_ = SortBy::name;
  bool reversed_ = false;
  std::optional<std::string> chosen_;  // name of the row that keys have reached
  std::string typed_folder_, name_, error_;
  std::optional<std::string> new_folder_;  // being named
};

}  // namespace winslow::gui
