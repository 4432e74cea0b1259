#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gui/document/history/document.h"

namespace winslow::gui {

/// A session read back after a crash.
struct RestoredSession {
  Document::Loaded loaded;     ///< the mesh as it was opened
  std::filesystem::path path;  ///< where it was saved last, or came from
  struct Step {
    Command command;
    CommandResult result;
    double seconds = 0;
  };
  std::vector<Step> steps;
  std::size_t position = 0;
  std::string damage;  ///< what could not be read; empty: nothing
};

}  // namespace winslow::gui
