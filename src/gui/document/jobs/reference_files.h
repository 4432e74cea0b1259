#pragma once

#include "gui/base/background.h"
#include "gui/files/file_kinds.h"
#include "io/tables/slide_files.h"

namespace winslow::gui {

/// What options ask of files, for the mesh that was open when it was made: io::resolve_files(). May
/// take long; for any thread.
using ResolveFiles = std::function<SlideFiles(const SlideOptions&)>;
inline SlideFiles no_files(const SlideOptions&) { return {}; }

/// Reference surfaces in files, for all threads that need them. The one read last is kept, since
/// drags, jobs and panels name it many times over, and read again once its file has changed.
class ReferenceFiles {
 public:
  /// May take long. Throws InputError as io::read_mesh() does, with file and line.
  std::shared_ptr<const ReferenceSurface> read(const std::filesystem::path& file);

 private:
  struct Known {
    std::filesystem::path file;
    std::optional<FileStamp> stamp;  // none: of a mesh in several files, which is not kept
    std::shared_ptr<const ReferenceSurface> surface;
  };

  std::mutex mutex_;  // held while a file is read: who wants the same one waits for it
  Known known_;
};

/// A reference surface that the user has chosen: it is read behind the frame loop's back, and used
/// only once that has gone well.
class ReferenceChoice {
 public:
  struct Outcome {
    std::filesystem::path file;
    std::string error;  ///< why it is none; empty: it is one
    Index nodes = 0;    ///< of the surface
    Index faces = 0;
    double coarser = 0;  ///< mean length of its edges over that of the mesh's that slide on it
  };

  /// Begins to read a file, in place of what is being read. markers: of the volume mesh, that
  /// slide; a surface mesh slides as a whole. A relative path is one from the working folder.
  void choose(std::filesystem::path file, std::shared_ptr<const Mesh> mesh,
              std::vector<std::string> markers, std::shared_ptr<ReferenceFiles> files);
  /// What is being read is not wanted any longer.
  void drop() { wanted_.reset(); }
  /// The file that is being read; empty: none.
  std::filesystem::path pending() const {
    return wanted_ ? wanted_->file : std::filesystem::path();
  }
  bool busy() const { return reader_.busy(); }
  /// What came of the file that was chosen last, once.
  std::optional<Outcome> poll();

 private:
  struct Wanted {
    std::uint64_t number;
    std::filesystem::path file;
    std::shared_ptr<const Mesh> mesh;
    std::vector<std::string> markers;
    std::shared_ptr<ReferenceFiles> files;
  };
  struct Read {
    std::uint64_t number;
    Outcome outcome;
  };
  static Outcome read(const Wanted& wanted);
  void start();

  std::uint64_t count_ = 0;
  std::optional<Wanted> wanted_;
  Background<Read> reader_;
};

/// Its shape between its nodes counts where the mesh is finer.
bool is_coarse(const ReferenceChoice::Outcome& read);
/// "Nodes slide on hull.stl: 1,200 nodes, 2,396 faces", and what is to be minded.
std::string describe(const ReferenceChoice::Outcome& read);

}  // namespace winslow::gui
