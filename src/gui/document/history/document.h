#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/command/history.h"
#include "core/quality/quality.h"
#include "gui/files/file_stamp.h"
#include "io/format/mesh_file.h"

namespace winslow::gui {

/// An open mesh: where it came from, what was done to it, what of that is saved.
class Document {
 public:
  /// What is prepared on the loader's thread.
  struct Loaded {
    std::filesystem::path path;
    io::MeshFile file;
    MeshState state;
    QualityReport quality;
    std::optional<FileStamp> stamp;  ///< of the file that was read; empty: it changed meanwhile
  };
  /// Reads and prepares a mesh. Throws what io::read_mesh throws.
  static Loaded load(const std::filesystem::path& path);

  explicit Document(Loaded loaded);

  /// Where the mesh is saved, or else came from.
  const std::filesystem::path& path() const { return path_; }
  /// The file that was opened.
  const std::filesystem::path& source() const { return source_; }
  /// That file as it was read; empty: none is known that holds just that.
  const std::optional<FileStamp>& source_stamp() const { return source_stamp_; }
  /// Where to save it from now on; nothing is saved there yet.
  void set_path(std::filesystem::path path) { path_ = std::move(path); }
  std::string name() const { return path_.filename().string(); }
  const std::shared_ptr<const io::FormatDetails>& details() const { return details_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  const QualityReport& loaded_quality() const { return loaded_quality_; }

  const History& history() const { return history_; }
  const MeshState& state() const { return history_.state(); }
  const std::shared_ptr<const Topology>& topology() const { return state().mesh.topology; }

  /// seconds: what the command took, on the clock on the wall.
  void push(Command command, CommandResult result, double seconds);
  /// What the command that led to a position took.
  double seconds(std::size_t position) const { return tags_[position].seconds; }
  void undo();
  void redo();
  void go_to(std::size_t position);
  /// Drops the steps after the present position.
  void forget_redo();

  /// What is known of a position besides the mesh.
  struct Tag {
    std::uint64_t revision = 0;
    double seconds = 0;
  };
  const std::vector<Tag>& tags() const { return tags_; }

  /// A history that a change of a past step replaced.
  struct Kept {
    std::string why;  ///< "Before step 2 was changed"
    History history;
    std::vector<Tag> tags;
  };
  /// The last few, oldest first.
  const std::vector<Kept>& kept() const { return kept_; }
  static constexpr std::size_t most_kept = 8;
  /// Keeps the present history beside itself; of more than most_kept the oldest goes.
  void keep(std::string why);
  /// Changes places with a kept one.
  void bring_back(std::size_t kept);
  /// Puts the one that was kept last in place of the present history, which goes.
  void take_back();

  /// Identifies the present mesh among all that this document has had.
  std::uint64_t revision() const { return tags_[history_.position()].revision; }
  bool modified() const { return revision() != saved_revision_; }
  void mark_saved(const std::filesystem::path& path, std::uint64_t revision);
  /// True if this document wrote that file before: it may be replaced without asking.
  bool wrote(const std::filesystem::path& path) const;

 private:
  std::filesystem::path source_, path_;
  std::optional<FileStamp> source_stamp_;
  std::shared_ptr<const io::FormatDetails> details_;
  std::vector<std::string> warnings_;
  QualityReport loaded_quality_;
  History history_;
  std::vector<Kept> kept_;
  std::vector<Tag> tags_{Tag{}};  // of each position of the history
  std::uint64_t last_revision_ = 0;
  std::uint64_t saved_revision_ = 0;
  std::set<std::filesystem::path> written_;
};

}  // namespace winslow::gui
