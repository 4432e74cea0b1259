#pragma once

#include <initializer_list>

#include "core/mesh/topology.h"
#include "gui/document/actions/actions.h"
#include "gui/document/session/files.h"
#include "gui/document/session/history_editor.h"
#include "gui/document/session/inspection.h"
#include "gui/document/session/jobs.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/mesh_layers.h"
#include "gui/document/session/message_board.h"
#include "gui/document/session/motions.h"
#include "gui/document/session/quality_watch.h"
#include "gui/document/session/selection.h"
#include "gui/document/session/solver_settings.h"

namespace winslow::gui {

/// The state of the studio, without a window. Owns the parts, passes actions to their handlers and
/// collects the threads' results. Only actions and poll() change it. No function waits.
class Session {
 public:
  Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void apply(const DocumentAction& action);
  /// Collects the threads' results since the last call. True if anything changed.
  bool poll();
  /// True while a thread works for this session.
  bool working() const;
  /// Shows other coordinates of the mesh on screen, for a picture; none: the actual ones.
  void show_instead(std::optional<Coordinates> coordinates) {
    mesh_.show_instead(std::move(coordinates));
  }

  const LiveMesh& mesh() const { return mesh_; }
  const Selection& selection() const { return selection_; }
  const SolverSettings& solver_settings() const { return settings_; }
  const MeshLayers& layers() const { return layers_; }
  const Jobs& jobs() const { return jobs_; }
  const Motions& motions() const { return motions_; }
  const Files& files() const { return files_; }
  Files& files() { return files_; }
  const Inspection& inspection() const { return inspection_; }
  const QualityWatch& quality() const { return quality_; }
  QualityWatch& quality() { return quality_; }
  const MessageBoard& messages() const { return messages_; }
  MessageBoard& messages() { return messages_; }

  // Shortcuts for frequent queries of mesh() and selection().
  const Document* document() const { return mesh_.document(); }
  std::uint64_t generation() const { return mesh_.generation(); }
  std::uint64_t shape() const { return mesh_.shape(); }
  const Coordinates& coordinates() const { return mesh_.coordinates(); }
  const std::shared_ptr<const Topology>& topology() const { return mesh_.topology(); }
  std::shared_ptr<const VirtualControlVolumes> vcv() const { return mesh_.vcv(); }
  const JobRunner& job() const { return work_.job(); }
  /// A mesh in space is open, a volume mesh or a surface mesh.
  bool in_space() const { return winslow::gui::in_space(mesh_); }
  /// Kind of the open mesh; plane if none is open.
  MeshKind kind() const { return kind_of(mesh_); }
  bool in_motion() const { return mesh_.in_motion(); }
  bool dragging() const { return work_.held().body; }
  const NodeSelection& nodes() const { return selection_.nodes(); }

 private:
  void apply_group(const FileAction& action) { Dispatch::to(files_, action); }
  void apply_group(const SelectionAction& action) { Dispatch::to(selection_, action); }
  void apply_group(const MotionAction& action) { Dispatch::to(motions_, action); }
  void apply_group(const VcvAction& action) { Dispatch::to(vcvs_, action); }
  void apply_group(const JobAction& action) { Dispatch::to(jobs_, action); }
  void apply_group(const SettingsAction& action) { Dispatch::to(settings_, action); }
  void apply_group(const LayerAction& action) { Dispatch::to(layers_, action); }
  void apply_group(const HistoryAction& action) { Dispatch::to(history_, action); }
  void apply_group(const MessageAction& action) { Dispatch::to(messages_, action); }

  // Each part refers only to parts above it.
  OngoingWork work_;
  LiveMesh mesh_{work_};
  MessageBoard messages_{mesh_};
  QualityWatch quality_{mesh_};
  Selection selection_{mesh_, messages_};
  SolverSettings settings_{mesh_, messages_};
  MeshLayers layers_{mesh_};
  Inspection inspection_{mesh_, settings_, selection_};
  Jobs jobs_{work_, mesh_, messages_, selection_, settings_};
  Motions motions_{work_, mesh_, messages_, selection_, settings_, jobs_};
  VcvEditor vcvs_{work_, mesh_, messages_, settings_, jobs_};
  HistoryEditor history_{mesh_, messages_, settings_, jobs_, motions_};
  Files files_{mesh_, messages_, selection_, settings_, jobs_};
};

/// The present activity of the studio, for the status bar.
struct Activity {
  enum class Kind { idle, busy, blocked };
  Kind kind = Kind::idle;
  std::string text;  ///< empty if idle
};
Activity activity_of(const Session& session);

/// A set of mesh kinds, for example those that a command supports.
class MeshKinds {
 public:
  constexpr MeshKinds(std::initializer_list<MeshKind> kinds) {
    for (const MeshKind kind : kinds) bits_ |= bit(kind);
  }
  constexpr bool contains(MeshKind kind) const { return (bits_ & bit(kind)) != 0; }

 private:
  static constexpr unsigned bit(MeshKind kind) { return 1U << static_cast<unsigned>(kind); }
  unsigned bits_ = 0;
};

inline constexpr MeshKinds all_meshes{MeshKind::plane, MeshKind::surface, MeshKind::volume};
inline constexpr MeshKinds plane_meshes{MeshKind::plane};
inline constexpr MeshKinds volume_meshes{MeshKind::volume};
inline constexpr MeshKinds meshes_in_space{MeshKind::surface, MeshKind::volume};
/// Kinds whose boundary can be moved: a surface mesh keeps its shape.
inline constexpr MeshKinds movable_meshes{MeshKind::plane, MeshKind::volume};

}  // namespace winslow::gui
