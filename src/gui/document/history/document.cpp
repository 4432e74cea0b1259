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

Document::Loaded Document::load(const std::filesystem::path& path) {
  Loaded loaded;
  loaded.path = path;
  loaded.stamp = stamp_of(path);
  loaded.file = io::read_mesh(path);
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
      history_(std::move(loaded.state)) {}

void Document::push(Command command, CommandResult result, double seconds) {
  tags_.resize(history_.position() + 1);
  history_.push(std::move(command), std::move(result));
  tags_.push_back({++last_revision_, seconds});
}

void Document::undo() {
  if (history_.can_undo()) history_.undo();
}

void Document::redo() {
  if (history_.can_redo()) history_.redo();
}

void Document::go_to(std::size_t position) {
  if (position < history_.size()) history_.go_to(position);
}

void Document::forget_redo() {
  history_.forget_redo();
  tags_.resize(history_.size());
}

void Document::keep(std::string why) {
  if (kept_.size() == most_kept) kept_.erase(kept_.begin());
  kept_.push_back({std::move(why), history_, tags_});
}

void Document::bring_back(std::size_t kept) {
  Kept& other = kept_.at(kept);
  std::swap(other.history, history_);
  std::swap(other.tags, tags_);
  other.why = "Before the other one was brought back";
}

void Document::take_back() {
  history_ = std::move(kept_.back().history);
  tags_ = std::move(kept_.back().tags);
  kept_.pop_back();
}

void Document::mark_saved(const std::filesystem::path& path, std::uint64_t revision) {
  path_ = path;
  saved_revision_ = revision;
  written_.insert(resolved(path));
}

bool Document::wrote(const std::filesystem::path& path) const {
  return written_.contains(resolved(path));
}

}  // namespace winslow::gui
