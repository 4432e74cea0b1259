#pragma once

#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include "gui/base/background.h"

namespace winslow::gui {

struct FolderEntry {
  std::string name;
  bool folder = false;
  std::uintmax_t size = 0;  ///< bytes
  std::time_t changed = 0;  ///< 0: unknown
};

enum class SortBy { name, date, size };

/// What is in a folder, read on a thread of its own: a folder may lie at the other end of a slow
/// network.
class FolderListing {
 public:
  /// Asks for a folder. What was listed before stays until it is there.
  void go(const std::filesystem::path& folder);
  /// Collects what was read. True if anything has changed.
  bool poll();
  bool busy() const { return reader_.busy(); }

  /// The folder that `entries` are of; when reading failed, the one before.
  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<FolderEntry>& entries() const { return entries_; }
  /// Why the folder asked for last is not shown; empty: it is.
  const std::string& error() const { return error_; }

  /// Folders first; names in alphabetical order, dates and sizes from the newest and the largest.
  void sort(SortBy by, bool reversed);

 private:
  struct Read {
    std::filesystem::path folder;
    std::vector<FolderEntry> entries;
    std::string error;
  };
  static Read read(const std::filesystem::path& folder);
  void apply_order();

  std::filesystem::path folder_, next_;
  std::vector<FolderEntry> entries_;
  std::string error_;
  SortBy by_ = SortBy::name;
  bool reversed_ = false;
  Background<Read> reader_;
};

/// "2026-11-22 09:05", in local time. Empty for an unknown time.
std::string date_text(std::time_t time);
/// "12 kB", "3.4 MB".
std::string size_text(std::uintmax_t bytes);

}  // namespace winslow::gui
