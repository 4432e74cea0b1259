#pragma once

#include <ctime>
#include <utility>

#include "gui/base/background.h"
#include "gui/files/file_kinds.h"

namespace winslow::gui {

struct FolderEntry {
  std::string name;
  bool folder = false;
  std::uintmax_t size = 0;  ///< bytes
  std::time_t changed = 0;  ///< 0: unknown
};

enum class SortBy { name, date, size };

/// Lists a folder on a separate thread, since a folder may be on a slow network.
class FolderListing {
 public:
  /// Requests a folder. The previous list remains until the new one is read.
  void go(const std::filesystem::path& folder);
  /// Collects a list that was read. True if anything has changed.
  bool poll();
  bool busy() const { return reader_.busy(); }

  /// The folder of entries(); after a failure, the previous one.
  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<FolderEntry>& entries() const { return entries_; }
  /// Why the folder requested last is not shown; empty: it is shown.
  const std::string& error() const { return error_; }

  /// Sorts folders first; names alphabetically, dates from the newest, sizes from the largest.
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

/// The folder shown in a dialog: its filtered entries, and the row chosen by letters or arrow keys.
class BrowsedFolder {
 public:
  /// Starts at the working folder, not read yet.
  BrowsedFolder();

  void go(const std::filesystem::path& folder);
  /// The folder of the last go().
  const std::filesystem::path& wanted() const { return wanted_; }
  /// Collects a list that was read. Returns why the folder cannot be shown; empty: no error, or
  /// nothing new.
  std::string poll();
  /// The list, and whether another one is being read.
  const FolderListing& listing() const { return listing_; }
  void sort(SortBy by, bool reversed) { listing_.sort(by, reversed); }

  /// Filters: only files of a kind; with or without files whose names begin with a dot.
  void set_filter(FileKind kind) { filter_ = std::move(kind); }
  void show_hidden(bool hidden) { hidden_ = hidden; }
  bool shows_hidden() const { return hidden_; }
  std::vector<const FolderEntry*> shown() const;

  /// Name of the chosen row; none: no row.
  const std::optional<std::string>& chosen() const { return chosen_; }
  void choose(std::string name) { chosen_ = std::move(name); }
  /// Chooses the first row that begins with a text, ignoring case; empty: no row.
  void find(const std::string& text);
  /// Moves the chosen row down by `by`; without a chosen row, chooses the first or the last.
  void step(int by);
  /// True once for each row chosen by find() or step(), which must be scrolled into view.
  bool take_reveal() { return std::exchange(reveal_, false); }

  /// The longest common beginning of all names that begin with a text.
  struct Completion {
    std::string text;
    bool single = false;  ///< only one name begins with the text
  };
  /// None if no name begins with the text.
  std::optional<Completion> complete(const std::string& text) const;
  /// The folder named by a typed text that ends in a slash: "meshes/", "/", "~/".
  std::optional<std::filesystem::path> typed_folder(const std::string& text) const;

 private:
  FolderListing listing_;
  std::filesystem::path wanted_;
  FileKind filter_;
  bool hidden_ = false, reveal_ = false;
  std::optional<std::string> chosen_;
};

}  // namespace winslow::gui
