#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "core/command/command.h"
#include "gui/files/file_stamp.h"

namespace winslow::gui {

/// Reference surfaces in files, for all threads that need them. The one read last is kept, since
/// drags, jobs and panels name it many times over, and read again once its file has changed.
class ReferenceFiles {
 public:
  /// May take long. Throws InputError as io::read_mesh() does, with file and line.
  std::shared_ptr<const ReferenceSurface> read(const std::filesystem::path& file);
  /// Reads what the options name; nothing where they name none.
  void load(SlideOptions& slide);
  void load(Command& command);

 private:
  struct Known {
    std::filesystem::path file;
    std::optional<FileStamp> stamp;  // none: of a mesh in several files, which is not kept
    std::shared_ptr<const ReferenceSurface> surface;
  };

  std::mutex mutex_;  // held while a file is read: who wants the same one waits for it
  Known known_;
};

}  // namespace winslow::gui
