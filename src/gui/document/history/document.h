#pragma once

#include <set>

#include "core/quality/quality.h"
#include "core/quality/surface_distance.h"
#include "gui/document/history/edit_history.h"
#include "gui/files/file_kinds.h"
#include "gui/render/space/volume_scene.h"
#include "io/format/mesh_file.h"

namespace winslow::gui {

/// The file from which a mesh was opened, at the time of reading.
struct SourceFile {
  std::filesystem::path path;
  std::optional<FileStamp> stamp;  ///< empty: no file is known to have this content
  std::shared_ptr<const io::FormatDetails> details;
  std::vector<std::string> warnings;
  io::ReadOptions reading = {};  ///< how it was read

  /// Numbers of its zones; empty: the file contains one mesh.
  std::span<const int> zones() const;
  /// The open zone; 0: the file contains one mesh.
  int zone() const;
  /// "zone 2 of 3"; empty: the file contains one mesh.
  std::string zone_text() const;
};

/// The file to which a mesh is saved, and the revisions (EditHistory::revision()) without unsaved
/// changes.
class SavedFile {
 public:
  explicit SavedFile(std::filesystem::path path) : path_(std::move(path)) {}

  /// The file to which the mesh is saved or, before that, from which it was opened.
  const std::filesystem::path& path() const { return path_; }
  /// Sets the file to save to; does not mark anything as saved there.
  void set_path(std::filesystem::path path) { path_ = std::move(path); }
  /// Records that this revision was written to `path`, which becomes the file to save to.
  void mark_saved(const std::filesystem::path& path, std::uint64_t revision);
  /// Records that this revision is not the user's work: it needs no saving.
  void mark_shown_only(std::uint64_t revision) { shown_only_.insert(revision); }

  /// True if this revision has unsaved changes of the user.
  bool lacks(std::uint64_t revision) const {
    return revision != saved_revision_ && !shown_only_.contains(revision);
  }
  /// True if the mesh was written to `path` before: the file may be replaced without asking.
  bool wrote(const std::filesystem::path& path) const;

 private:
  std::filesystem::path path_;
  std::uint64_t saved_revision_ = 0;
  std::set<std::uint64_t> shown_only_;  // revisions made by a demo
  std::set<std::filesystem::path> written_;
};

/// The file that holds all zones of a mesh: the saved file if it contains them, otherwise the
/// source.
const std::filesystem::path& zone_file(const SourceFile& source, const SavedFile& saved);

/// An open mesh: its files, its history, and the properties determined when it was opened.
class Document {
 public:
  /// The data prepared on the loader's thread.
  struct Loaded {
    std::filesystem::path path;
    io::ReadOptions reading = {};
    io::MeshFile file;
    MeshState state;
    QualityReport quality;
    std::optional<FileStamp> stamp;  ///< of the file; empty: it changed while being read
    /// Of a mesh in space; null for a plane mesh.
    std::shared_ptr<const VolumeBoundary> boundary;
    std::shared_ptr<const SurfaceDistance> given;  ///< of a surface mesh as opened; otherwise null
  };
  /// Reads and prepares a mesh. Throws the exceptions of io::read_mesh.
  static Loaded load(const std::filesystem::path& path, const io::ReadOptions& reading = {});

  explicit Document(Loaded loaded);

  /// The file that was opened.
  const SourceFile& source() const { return source_; }
  /// The file to which the mesh is saved.
  const SavedFile& saved() const { return saved_; }
  SavedFile& saved() { return saved_; }
  const std::filesystem::path& path() const { return saved_.path(); }
  std::string name() const { return path().filename().string(); }
  /// True if the mesh has unsaved changes of the user.
  bool modified() const { return saved_.lacks(edits_.revision()); }

  /// Quality of the mesh as opened.
  const QualityReport& loaded_quality() const { return loaded_quality_; }
  /// Boundary of a mesh in space, whose faces no command changes; null for a plane mesh.
  const std::shared_ptr<const VolumeBoundary>& boundary() const { return boundary_; }
  /// Distances to a surface mesh as opened; null for other kinds of mesh.
  const std::shared_ptr<const SurfaceDistance>& given() const { return given_; }

  /// The commands carried out on the mesh.
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

/// Computes properties of the mesh as opened that its file does not contain.
void examine(Document::Loaded& loaded);

/// A session read back after a crash.
struct RestoredSession {
  Document::Loaded loaded;     ///< the mesh as it was opened
  std::filesystem::path path;  ///< file last saved to, or else opened from
  struct Step {
    Command command;
    CommandResult result;
    double seconds = 0;
  };
  std::vector<Step> steps;
  std::size_t position = 0;
  std::string damage;  ///< parts that could not be read; empty: none
};

}  // namespace winslow::gui
