#include "gui/document/jobs/reference_files.h"

#include <algorithm>

#include "io/format/mesh_format.h"
#include "io/tables/reference_file.h"

namespace winslow::gui {

namespace {

/// The one file that a mesh is in; none where it is in several, of which any may change.
std::optional<FileStamp> whole_stamp(const std::filesystem::path& file) {
  const auto formats = io::mesh_formats();
  const bool folder = std::ranges::any_of(formats, [&](const io::MeshFormat* format) {
    return format->find_folder != nullptr && !format->find_folder(file).empty();
  });
  return folder ? std::nullopt : stamp_of(file);
}

}  // namespace

std::shared_ptr<const ReferenceSurface> ReferenceFiles::read(const std::filesystem::path& file) {
  const std::lock_guard lock(mutex_);
  const std::optional<FileStamp> before = whole_stamp(file);
  if (known_.surface && known_.file == file && before && known_.stamp == before)
    return known_.surface;
  known_ = {};
  Known now{file, before, io::read_reference(file)};
  // What was written to meanwhile is read again the next time.
  if (whole_stamp(file) != before) now.stamp.reset();
  known_ = std::move(now);
  return known_.surface;
}

void ReferenceFiles::load(SlideOptions& slide) {
  slide.reference.surface = slide.reference.name.empty() ? nullptr : read(slide.reference.name);
}

void ReferenceFiles::load(Command& command) {
  if (SmoothOptions* smooth = smooth_options(command)) load(smooth->slide);
}

}  // namespace winslow::gui
