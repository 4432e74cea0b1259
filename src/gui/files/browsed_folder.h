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

/// The folder that a dialog shows: which of its entries are listed, and the row that letters and
/// arrow keys have reached.
class BrowsedFolder {
 public:
  /// At the working folder, nothing of which is read yet.
  BrowsedFolder();

  void go(const std::filesystem::path& folder);
  /// Where the last go() went.
  const std::filesystem::path& wanted() const { return wanted_; }
  /// Takes what was read. Returns why the folder cannot be shown; empty: it can, or nothing is new.
  std::string poll();
  /// What is listed and whether more is being read.
  const FolderListing& listing() const { return listing_; }
  void sort(SortBy by, bool reversed) { listing_.sort(by, reversed); }

  /// Only files of a kind are listed, and files whose names begin with a dot or not.
  void set_filter(FileKind kind) { filter_ = std::move(kind); }
  void show_hidden(bool hidden) { hidden_ = hidden; }
  bool shows_hidden() const { return hidden_; }
  std::vector<const FolderEntry*> shown() const;

  /// Name of the row that was reached; none: no row was.
  const std::optional<std::string>& chosen() const { return chosen_; }
  void choose(std::string name) { chosen_ = std::move(name); }
  /// Chooses the first row that begins with a text, letters of either case; empty: none.
  void find(const std::string& text);
  /// Chooses a row so many places further down; from none, the first or the last.
  void step(int by);
  /// The row has to be scrolled into sight. True once for each that find() or step() chose.
  bool take_reveal() { return std::exchange(reveal_, false); }

  /// What a text goes on with as far as all names that begin so go on alike.
  struct Completion {
    std::string text;
    bool single = false;  ///< one name only begins so
  };
  /// None if no name begins so.
  std::optional<Completion> complete(const std::string& text) const;
  /// The folder that a typed text names if it ends in a slash: "meshes/", "/", "~/".
  std::optional<std::filesystem::path> typed_folder(const std::string& text) const;

 private:
  FolderListing listing_;
  std::filesystem::path wanted_;
  FileKind filter_;
  bool hidden_ = false, reveal_ = false;
  std::optional<std::string> chosen_;
};

}  // namespace winslow::gui
