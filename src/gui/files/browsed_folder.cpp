#include "gui/files/browsed_folder.h"

#include <cmath>

#include "gui/base/text.h"
#include "gui/files/recent_files.h"

namespace winslow::gui {

namespace fs = std::filesystem;

namespace {

bool begins_with(const std::string& name, const std::string& begin) {
  return lower_case(name).starts_with(lower_case(begin));
}

}  // namespace

BrowsedFolder::BrowsedFolder() {
  std::error_code ignored;
  wanted_ = fs::current_path(ignored);
}

void BrowsedFolder::go(const fs::path& folder) {
  wanted_ = folder.lexically_normal();
  if (!wanted_.has_filename() && wanted_ != wanted_.root_path())
    wanted_ = wanted_.parent_path();  // "/a/b/" is "/a/b"
  chosen_.reset();
  listing_.go(wanted_);
}

std::string BrowsedFolder::poll() {
  if (!listing_.poll() || listing_.error().empty()) return {};
  wanted_ = listing_.folder();
  return listing_.error();
}

std::vector<const FolderEntry*> BrowsedFolder::shown() const {
  std::vector<const FolderEntry*> rows;
  for (const FolderEntry& entry : listing_.entries()) {
    if (entry.name.starts_with(".") && !hidden_) continue;
    if (entry.folder || matches(filter_, entry.name)) rows.push_back(&entry);
  }
  return rows;
}

void BrowsedFolder::find(const std::string& text) {
  chosen_.reset();
  if (text.empty()) return;
  for (const FolderEntry* entry : shown())
    if (begins_with(entry->name, text)) {
      chosen_ = entry->name;
      reveal_ = true;
      return;
    }
}

void BrowsedFolder::step(int by) {
  const auto rows = shown();
  if (rows.empty()) return;
  const auto at = std::find_if(rows.begin(), rows.end(), [this](const FolderEntry* entry) {
    return chosen_ && entry->name == *chosen_;
  });
  const auto last = static_cast<int>(rows.size()) - 1;
  int row = by > 0 ? 0 : last;
  if (at != rows.end()) row = std::clamp(static_cast<int>(at - rows.begin()) + by, 0, last);
  chosen_ = rows[static_cast<std::size_t>(row)]->name;
  reveal_ = true;
}

std::optional<BrowsedFolder::Completion> BrowsedFolder::complete(const std::string& text) const {
  std::vector<std::string> names;
  for (const FolderEntry* entry : shown())
    if (begins_with(entry->name, text)) names.push_back(entry->name);
  if (names.empty()) return std::nullopt;
  std::string common = names.front();
  for (const std::string& name : names) {
    std::size_t same = 0;
    while (same < std::min(common.size(), name.size()) && common[same] == name[same]) ++same;
    common.resize(same);
  }
  if (common.size() < text.size()) return std::nullopt;  // the names differ in case
  return Completion{common, names.size() == 1};
}

std::optional<fs::path> BrowsedFolder::typed_folder(const std::string& text) const {
  if (!text.ends_with('/')) return std::nullopt;
  const fs::path folder = text == "~/" ? home_folder() : wanted_ / text;
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return std::nullopt;
  return folder;
}

namespace {

FolderEntry describe_entry(const fs::directory_entry& found) {
  std::error_code failed;
  FolderEntry entry{found.path().filename().string(), found.is_directory(failed), 0, 0};
  if (!entry.folder && found.is_regular_file(failed)) {
    entry.size = found.file_size(failed);
    if (failed) entry.size = 0;
  }
  const auto changed = found.last_write_time(failed);
  if (!failed)
    entry.changed = std::chrono::system_clock::to_time_t(
        std::chrono::time_point_cast<std::chrono::system_clock::duration>(
            std::chrono::file_clock::to_sys(changed)));
  return entry;
}

}  // namespace

void FolderListing::go(const fs::path& folder) {
  if (reader_.busy()) {
    next_ = folder;
    return;
  }
  reader_.start([folder] { return read(folder); });
}

FolderListing::Read FolderListing::read(const fs::path& folder) {
  Read read{folder, {}, {}};
  std::error_code error;
  for (fs::directory_iterator it(folder, fs::directory_options::skip_permission_denied, error), end;
       !error && it != end; it.increment(error))
    read.entries.push_back(describe_entry(*it));
  if (error) read.error = "This folder cannot be read: " + error.message() + ".";
  return read;
}

bool FolderListing::poll() {
  auto read = reader_.poll();
  if (!read) return false;
  if (!next_.empty()) {
    go(std::exchange(next_, {}));
    return true;
  }
  error_ = read->error;
  if (!error_.empty()) return true;
  folder_ = std::move(read->folder);
  entries_ = std::move(read->entries);
  apply_order();
  return true;
}

void FolderListing::sort(SortBy by, bool reversed) {
  by_ = by;
  reversed_ = reversed;
  apply_order();
}

void FolderListing::apply_order() {
  const auto before = [this](const FolderEntry& a, const FolderEntry& b) {
    if (by_ == SortBy::date && a.changed != b.changed) return a.changed > b.changed;
    if (by_ == SortBy::size && a.size != b.size) return a.size > b.size;
    return lower_case(a.name) < lower_case(b.name);
  };
  std::stable_sort(entries_.begin(), entries_.end(), [&](const auto& a, const auto& b) {
    if (a.folder != b.folder) return a.folder;
    return reversed_ ? before(b, a) : before(a, b);
  });
}

std::string date_text(std::time_t time) {
  std::tm local{};
  if (time == 0 || !localtime_r(&time, &local)) return {};
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M", &local);
  return text.data();
}

std::string size_text(std::uintmax_t bytes) {
  const auto kilo = static_cast<double>(bytes) / 1024;
  if (kilo < 1000) return short_number(std::max(1.0, std::round(kilo))) + " kB";
  return short_number(std::round(kilo / 102.4) / 10) + " MB";
}

}  // namespace winslow::gui
