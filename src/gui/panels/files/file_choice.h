#pragma once

#include <filesystem>
#include <string>

#include "gui/files/browsed_folder.h"

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

}  // namespace winslow::gui
