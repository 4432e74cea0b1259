#include "gui/files/browsed_folder.h"

#include <algorithm>
#include <system_error>

#include "gui/files/places.h"

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
  if (common.size() < text.size()) return std::nullopt;  // they differ in upper and lower case
  return Completion{common, names.size() == 1};
}

std::optional<fs::path> BrowsedFolder::typed_folder(const std::string& text) const {
  if (!text.ends_with('/')) return std::nullopt;
  const fs::path folder = text == "~/" ? home_folder() : wanted_ / text;
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return std::nullopt;
  return folder;
}

}  // namespace winslow::gui
