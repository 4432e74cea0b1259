#pragma once

#include "gui/base/background.h"
#include "gui/files/file_kinds.h"
#include "io/tables/slide_files.h"

namespace winslow::gui {

/// Resolves the files named by slide options, for the mesh open at its creation:
/// io::resolve_files(). May take long; callable from any thread.
using ResolveFiles = std::function<SlideFiles(const SlideOptions&)>;
inline SlideFiles no_files(const SlideOptions&) { return {}; }

/// Reads reference surfaces from files; thread-safe. Caches the last surface, since drags, jobs and
/// panels request it repeatedly, and reads it again when its file has changed.
class ReferenceFiles {
 public:
  /// May take long. Throws InputError as io::read_mesh() does, with file and line.
  std::shared_ptr<const ReferenceSurface> read(const std::filesystem::path& file);

 private:
  struct Known {
    std::filesystem::path file;
    std::optional<FileStamp> stamp;  // none: a mesh in several files, which is not cached
    std::shared_ptr<const ReferenceSurface> surface;
  };

  std::mutex mutex_;  // held while a file is read: other threads wait for the result
  Known known_;
};

/// A reference surface that the user has chosen. It is read in the background and used only after
/// it was read without error.
class ReferenceChoice {
 public:
  struct Outcome {
    std::filesystem::path file;
    std::string error;  ///< why the file is unusable; empty: no error
    Index nodes = 0;    ///< of the surface
    Index faces = 0;
    double coarser = 0;  ///< mean edge length over that of the mesh's sliding edges
  };

  /// Begins to read a file, replacing a read in progress. markers: the sliding ones of the volume
  /// mesh; a surface mesh slides as a whole. A relative path starts at the working folder.
  void choose(std::filesystem::path file, std::shared_ptr<const Mesh> mesh,
              std::vector<std::string> markers, std::shared_ptr<ReferenceFiles> files);
  /// Discards the read in progress.
  void drop() { wanted_.reset(); }
  /// The file that is being read; empty: none.
  std::filesystem::path pending() const {
    return wanted_ ? wanted_->file : std::filesystem::path();
  }
  bool busy() const { return reader_.busy(); }
  /// The outcome of the file chosen last, once.
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

/// True if the surface is coarser than the mesh: its shape between its nodes then matters.
bool is_coarse(const ReferenceChoice::Outcome& read);
/// "Nodes slide on hull.stl: 1,200 nodes, 2,396 faces", and a caution if necessary.
std::string describe(const ReferenceChoice::Outcome& read);

}  // namespace winslow::gui
