#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gui/panels/panel.h"

namespace winslow::gui {

/// Chooses a file to open or to write: a dialog of our own, since the system has none that every
/// desktop shares.
class FileDialog : public Panel {
 public:
  FileDialog();
  /// Shows the dialog from the next frame on. `suggested`: folder and name to start with. `step`:
  /// of the history, that a recording is to be made of.
  void open(action::FilePurpose purpose, const std::filesystem::path& suggested,
            std::optional<std::size_t> step = std::nullopt);
  bool is_open() const { return open_; }
  const std::filesystem::path& folder() const { return folder_; }
  void draw(const PanelContext& context) override;

 private:
  struct Entry {
    std::string name;
    bool folder = false;
    std::uintmax_t size = 0;
  };
  void go(const std::filesystem::path& folder);
  void draw_places(const PanelContext& context);
  void draw_list(const PanelContext& context);
  void draw_entry(const PanelContext& context, const Entry& entry);
  void draw_footer(const PanelContext& context);
  bool accepts(const Entry& entry) const;
  void accept(const PanelContext& context);
  void close();

  bool open_ = false, wanted_ = false, focus_name_ = false;
  bool all_files_ = false;
  action::FilePurpose purpose_ = action::FilePurpose::open_mesh;
  std::optional<std::size_t> step_;
  std::filesystem::path folder_;
  std::string typed_folder_, name_, error_;
  std::vector<Entry> entries_;
};

}  // namespace winslow::gui
