#include "gui/files/folder_listing.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <system_error>
#include <utility>

#include "gui/base/text.h"
#include "gui/files/file_kinds.h"

namespace winslow::gui {

namespace fs = std::filesystem;

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
