#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "core/command/command.h"
#include "core/mesh/topology.h"
#include "gui/document/actions/actions.h"
#include "gui/document/jobs/wall_layers.h"
#include "gui/document/session/files.h"
#include "gui/document/session/history_editor.h"
#include "gui/document/session/inspection.h"
#include "gui/document/session/jobs.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/message_board.h"
#include "gui/document/session/motions.h"
#include "gui/document/session/quality_watch.h"
#include "gui/document/session/selection.h"
#include "gui/document/session/vcv_editor.h"

namespace winslow::gui {

/// The state of the studio, without a window: the open mesh with its history, what is selected, the
/// solver, files, what is to be said. Changes by actions and by poll() alone. Nothing here waits.
class Session {
 public:
  Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void apply(const DocumentAction& action);
  /// Collects what the threads have done since the last call. True if anything changed.
  bool poll();
  /// True while some thread works on behalf of this session.
  bool working() const;

  const LiveMesh& mesh() const { return mesh_; }
  const Selection& selection() const { return selection_; }
  const Jobs& jobs() const { return jobs_; }
  const Files& files() const { return files_; }
  Files& files() { return files_; }
  const QualityWatch& quality() const { return quality_; }
  QualityWatch& quality() { return quality_; }
  const MessageBoard& messages() const { return messages_; }
  MessageBoard& messages() { return messages_; }

  // What is asked for most, of mesh() and selection().
  const Document* document() const { return mesh_.document(); }
  std::uint64_t generation() const { return mesh_.generation(); }
  std::uint64_t shape() const { return mesh_.shape(); }
  const Coordinates& coordinates() const { return mesh_.coordinates(); }
  const std::shared_ptr<const Topology>& topology() const { return mesh_.topology(); }
  std::shared_ptr<const VirtualControlVolumes> vcv() const { return mesh_.vcv(); }
  const JobRunner& job() const { return mesh_.job(); }
  /// A mesh in space is open, a volume mesh or a surface mesh.
  bool in_space() const { return winslow::gui::in_space(mesh_); }
  /// Of the open mesh; of what could be opened, where there is none, a plane one.
  MeshKind kind() const { return topology() ? kind_of(*topology()) : MeshKind::plane; }
  bool in_motion() const { return mesh_.in_motion(); }
  bool dragging() const { return mesh_.held().body; }
  const NodeSelection& nodes() const { return selection_.nodes(); }

 private:
  friend void show_between(Session& session, std::optional<Coordinates> coordinates) {
    session.mesh_.instead().coordinates = std::move(coordinates);
    session.mesh_.changed();
  }
  friend const SphereInspector& spheres(const Session& session) { return session.spheres_; }
  friend const StarMatches& star_matches(const Session& session) { return session.stars_; }
  friend const BoundaryRoles& boundary_roles(const Session& session) { return session.roles_; }
  void apply_group(const FileAction& action) { files_.apply(action); }
  void apply_group(const SelectionAction& action) { selection_.apply(action); }
  void apply_group(const MotionAction& action) { motions_.apply(action); }
  void apply_group(const VcvAction& action) { vcvs_.apply(action); }
  void apply_group(const JobAction& action) { jobs_.apply(action); }
  void apply_group(const HistoryAction& action) { history_.apply(action); }
  void apply_group(const MessageAction& action) { messages_.apply(action); }

  LiveMesh mesh_;
  MessageBoard messages_{mesh_};
  QualityWatch quality_{mesh_};
  Selection selection_{mesh_, messages_};
  Jobs jobs_{mesh_, messages_, selection_};
  BoundaryRoles roles_{mesh_, jobs_, selection_};
  Motions motions_{mesh_, messages_, selection_, jobs_};
  VcvEditor vcvs_{mesh_, messages_, jobs_};
  SphereInspector spheres_{mesh_, jobs_};
  StarMatches stars_{mesh_};
  HistoryEditor history_{mesh_, messages_, jobs_, motions_};
  Files files_{mesh_, messages_, selection_, jobs_};
};

/// Shows other coordinates of the mesh on screen, for a picture; none: no more.
void show_between(Session& session, std::optional<Coordinates> coordinates);
/// Nodes of a volume mesh with their VCVs.
const SphereInspector& spheres(const Session& session);
/// Nodes that can take the VCV of another.
const StarMatches& star_matches(const Session& session);
/// What nodes do in the next run.
const BoundaryRoles& boundary_roles(const Session& session);

/// What the studio is at, as the status bar says it.
struct Activity {
  enum class Kind { idle, busy, blocked };
  Kind kind = Kind::idle;
  std::string text;  ///< empty if idle
};
Activity activity_of(const Session& session);

/// What is known of the layers that walls have.

/// The layers of all these walls are held.
bool all_held(const Session& session, const std::vector<LayerWall>& walls);
/// Sets how many layers of each wall a command works on: those that are known to be there. Of
/// a wall without known ones: all that are found, to hold them; to space them anew, what the
/// wall's spacing says.
void limit_to_present_layers(const Session& session, LayersCommand& command);

/// Which meshes something is for.
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
/// Those whose boundary can be moved: a surface keeps its shape.
inline constexpr MeshKinds movable_meshes{MeshKind::plane, MeshKind::volume};

}  // namespace winslow::gui
