#pragma once

#include <set>

#include "core/quality/quality.h"
#include "core/quality/surface_distance.h"
#include "gui/document/history/edit_history.h"
#include "gui/files/file_kinds.h"
#include "gui/render/space/volume_scene.h"
#include "io/format/mesh_file.h"

namespace winslow::gui {

/// The file that a mesh was opened from, as it was read.
struct SourceFile {
  std::filesystem::path path;
  std::optional<FileStamp> stamp;  ///< empty: no file is known that holds just that
  std::shared_ptr<const io::FormatDetails> details;
  std::vector<std::string> warnings;

  /// Numbers of its zones; empty: the file is one mesh.
  std::span<const int> zones() const;
  /// The one that is open; 0: the file is one mesh.
  int zone() const;
  /// "zone 2 of 3"; empty: the file is one mesh.
  std::string zone_text() const;
};

/// Where a mesh is saved, and which of its revisions (EditHistory::revision()) need no saving.
class SavedFile {
 public:
  explicit SavedFile(std::filesystem::path path) : path_(std::move(path)) {}

  /// Where the mesh is saved, or else came from.
  const std::filesystem::path& path() const { return path_; }
  /// Where to save it from now on; nothing is saved there yet.
  void set_path(std::filesystem::path path) { path_ = std::move(path); }
  /// This revision was written to that file, to which it is saved from now on.
  void mark_saved(const std::filesystem::path& path, std::uint64_t revision);
  /// This revision is no work of the user's: there is nothing to save.
  void mark_shown_only(std::uint64_t revision) { shown_only_.insert(revision); }

  /// This revision has changes of the user's that are saved nowhere.
  bool lacks(std::uint64_t revision) const {
    return revision != saved_revision_ && !shown_only_.contains(revision);
  }
  /// The mesh was written to that file before: it may be replaced without asking.
  bool wrote(const std::filesystem::path& path) const;

 private:
  std::filesystem::path path_;
  std::uint64_t saved_revision_ = 0;
  std::set<std::uint64_t> shown_only_;  // that a demo made
  std::set<std::filesystem::path> written_;
};

/// The file that holds all zones of a mesh: where it is saved if those went along, else its source.
const std::filesystem::path& zone_file(const SourceFile& source, const SavedFile& saved);

/// An open mesh: its files, what was done to it, what is known of it from the start.
class Document {
 public:
  /// What is prepared on the loader's thread.
  struct Loaded {
    std::filesystem::path path;
    io::MeshFile file;
    MeshState state;
    QualityReport quality;
    std::optional<FileStamp> stamp;  ///< of the file that was read; empty: it changed meanwhile
    /// Of a mesh in space; null: of a plane one.
    std::shared_ptr<const VolumeBoundary> boundary;
    std::shared_ptr<const SurfaceDistance> given;  ///< of a surface mesh as opened; else null
  };
  /// Reads and prepares a mesh, of a file of several zones that one; 0: the first. Throws what
  /// io::read_mesh throws.
  static Loaded load(const std::filesystem::path& path, int zone = 0);

  explicit Document(Loaded loaded);

  /// The file that was opened.
  const SourceFile& source() const { return source_; }
  /// Where the mesh is saved.
  const SavedFile& saved() const { return saved_; }
  SavedFile& saved() { return saved_; }
  const std::filesystem::path& path() const { return saved_.path(); }
  std::string name() const { return path().filename().string(); }
  /// It has changes of the user's that are saved nowhere.
  bool modified() const { return saved_.lacks(edits_.revision()); }

  /// Of the mesh as it was opened.
  const QualityReport& loaded_quality() const { return loaded_quality_; }
  /// Of a mesh in space, whose faces no command changes; null: it is a plane mesh.
  const std::shared_ptr<const VolumeBoundary>& boundary() const { return boundary_; }
  /// Distances to a surface mesh as it was opened; null: it is another kind of mesh.
  const std::shared_ptr<const SurfaceDistance>& given() const { return given_; }

  /// What was done to the mesh.
  const EditHistory& edits() const { return edits_; }
  EditHistory& edits() { return edits_; }
  const History& history() const { return edits_.history(); }
  const MeshState& state() const { return history().state(); }
  const std::shared_ptr<const Topology>& topology() const { return state().mesh.topology; }

 private:
  SourceFile source_;
  SavedFile saved_;
  QualityReport loaded_quality_;
  std::shared_ptr<const VolumeBoundary> boundary_;
  std::shared_ptr<const SurfaceDistance> given_;
  EditHistory edits_;
};

/// Finds what there is to know of a mesh beside what its file says, of the state it is opened in.
void examine(Document::Loaded& loaded);

/// A session read back after a crash.
struct RestoredSession {
  Document::Loaded loaded;     ///< the mesh as it was opened
  std::filesystem::path path;  ///< where it was saved last, or came from
  struct Step {
    Command command;
    CommandResult result;
    double seconds = 0;
  };
  std::vector<Step> steps;
  std::size_t position = 0;
  std::string damage;  ///< what could not be read; empty: nothing
};

}  // namespace winslow::gui
