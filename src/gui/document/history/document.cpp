#include "gui/document/history/document.h"

#include <system_error>
#include <utility>

namespace winslow::gui {

namespace {

std::filesystem::path resolved(const std::filesystem::path& path) {
  std::error_code ignored;
  auto result = std::filesystem::weakly_canonical(path, ignored);
  return ignored ? path : result;
}

}  // namespace

Document::Loaded Document::load(const std::filesystem::path& path, int zone) {
  Loaded loaded;
  loaded.path = path;
  loaded.stamp = stamp_of(path);
  loaded.file = io::read_mesh(path, {.zone = zone});
  if (zone == 0) {
    for (std::string& text : io::zones_left(loaded.file, path))
      loaded.file.warnings.push_back(std::move(text));
  }
  loaded.quality = measure_quality(loaded.file.mesh);
  loaded.state = make_state(loaded.file.mesh);
  if (stamp_of(path) != loaded.stamp) loaded.stamp.reset();
  return loaded;
}

Document::Document(Loaded loaded)
    : source_(loaded.path),
      path_(std::move(loaded.path)),
      source_stamp_(loaded.stamp),
      details_(std::move(loaded.file.details)),
      warnings_(std::move(loaded.file.warnings)),
      loaded_quality_(std::move(loaded.quality)),
      edits_(std::move(loaded.state)) {}

void Document::mark_saved(const std::filesystem::path& path, std::uint64_t revision) {
  path_ = path;
  saved_revision_ = revision;
  written_.insert(resolved(path));
}

bool Document::wrote(const std::filesystem::path& path) const {
  return written_.contains(resolved(path));
}

}  // namespace winslow::gui
