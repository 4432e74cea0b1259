#include "gui/document/history/document_files.h"

#include <system_error>

namespace winslow::gui {

namespace {

std::filesystem::path resolved(const std::filesystem::path& path) {
  std::error_code ignored;
  auto result = std::filesystem::weakly_canonical(path, ignored);
  return ignored ? path : result;
}

}  // namespace

std::span<const int> SourceFile::zones() const {
  if (!details) return {};
  return details->zones;
}

int SourceFile::zone() const { return zones().empty() ? 0 : details->zone; }

std::string SourceFile::zone_text() const {
  const auto all = zones();
  if (all.size() < 2) return {};
  return "zone " + std::to_string(zone()) + " of " + std::to_string(all.size());
}

void SavedFile::mark_saved(const std::filesystem::path& path, std::uint64_t revision) {
  path_ = path;
  saved_revision_ = revision;
  written_.insert(resolved(path));
}

bool SavedFile::wrote(const std::filesystem::path& path) const {
  return written_.contains(resolved(path));
}

const std::filesystem::path& zone_file(const SourceFile& source, const SavedFile& saved) {
  const bool kept =
      saved.wrote(saved.path()) && source.details && io::keeps_zones(saved.path(), *source.details);
  return kept ? saved.path() : source.path;
}

}  // namespace winslow::gui
