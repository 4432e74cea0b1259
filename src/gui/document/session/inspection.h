#pragma once

#include "core/inspect/nodal_view.h"
#include "core/inspect/node_roles.h"
#include "core/strategy/smooth_options.h"
#include "core/vcv/sphere/link_matching.h"
#include "gui/base/background.h"
#include "gui/document/session/live_mesh.h"
#include "gui/document/session/selection.h"
#include "gui/document/session/solver_settings.h"

namespace winslow::gui {

/// Determines in the background the roles of the nodes of the history's mesh in the next run, from
/// the solver's settings (sliding markers, periodic pairs) and the selected markers.
class BoundaryRoles {
 public:
  BoundaryRoles(const LiveMesh& mesh, const SolverSettings& settings, const Selection& selection)
      : mesh_(mesh), settings_(settings), selection_(selection) {}

  /// The latest known roles for this mesh; null: none yet. Call it in every frame that shows them:
  /// the last call determines what is computed.
  std::shared_ptr<const NodeRoles> find() const;
  /// The result matches the present settings.
  bool up_to_date() const { return answer_.roles && answer_.question == asked_; }

  /// True if there is a new result.
  bool poll();
  bool busy() const { return worker_.busy(); }

 private:
  struct Question {
    std::uint64_t generation = 0, shape = 0;
    SlideOptions slide;
    std::vector<std::string> moving;
    bool operator==(const Question&) const = default;
  };
  struct Answer {
    Question question;
    std::shared_ptr<const NodeRoles> roles;
  };
  Question question() const;

  const LiveMesh& mesh_;
  const SolverSettings& settings_;
  const Selection& selection_;
  mutable Question asked_;
  mutable Answer answer_;
  mutable Background<Answer> worker_;
};

/// Data for the inspection of nodes of a volume mesh: the VCVs that a run from the history's mesh
/// would use (of the kind set in the solver, or as edited), with the mesh on screen. Each is
/// computed on first request, since few nodes of a mesh are inspected.
class SphereInspector {
 public:
  SphereInspector(const LiveMesh& mesh, const SolverSettings& settings)
      : mesh_(mesh), settings_(settings) {}

  /// Valid until the next call in a later frame. Throws UsageError for a node without a VCV,
  /// MeshError for a star that admits none.
  const VolumeNodalView& view_of(Index node) const;

 private:
  /// The inputs of the VCVs.
  struct Source {
    std::uint64_t generation = 0;
    std::uint64_t shape = 0;  // of the mesh of the history
    std::size_t position = 0, steps = 0;
    VcvKind kind = VcvKind::automatic;
    double lengths = 0;
    std::shared_ptr<const SphereStencils> by_hand;
    bool operator==(const Source&) const = default;
  };
  void forget_stale() const;
  const NodeVcv& vcv(Index node) const;

  const LiveMesh& mesh_;
  const SolverSettings& settings_;
  mutable Source source_;
  mutable std::uint64_t shape_ = 0;
  mutable std::map<Index, NodeVcv> vcvs_;
  mutable std::map<Index, VolumeNodalView> views_;
};

/// Finds the nodes of a volume mesh that can use the VCV of a given node (matching_stars()).
/// Searches the history's mesh in the background, since a mesh has many stars.
class StarMatches {
 public:
  explicit StarMatches(const LiveMesh& mesh) : mesh_(mesh) {}
  ~StarMatches() { stop(); }
  StarMatches(const StarMatches&) = delete;
  StarMatches& operator=(const StarMatches&) = delete;

  struct Wish {
    Index node = -1;
    std::optional<std::vector<Index>> among = std::nullopt;  ///< none: all inner nodes
    std::optional<double> radius = std::nullopt;             ///< largest distance from the node
    bool operator==(const Wish&) const = default;
  };
  using Found = std::vector<MatchedStar>;
  /// Null while the search runs. Valid until the next call.
  const Found* find(const Wish& wish) const;

  /// True if a search has ended.
  bool poll();
  bool busy() const { return worker_.busy(); }

 private:
  /// A wish and its mesh.
  struct Question {
    Wish wish;
    std::uint64_t generation = 0, shape = 0;
    bool operator==(const Question&) const = default;
  };
  struct Answer {
    Question question;
    Found found;
  };
  void stop() const {
    if (stop_) *stop_ = true;
  }

  const LiveMesh& mesh_;
  mutable Question asked_;
  mutable std::optional<Answer> answer_;
  mutable std::shared_ptr<std::atomic<bool>> stop_;
  mutable Background<Answer> worker_;
};

/// Data on inspected nodes, computed on request.
struct Inspection {
  Inspection(const LiveMesh& mesh, const SolverSettings& settings, const Selection& selection)
      : spheres(mesh, settings), star_matches(mesh), roles(mesh, settings, selection) {}

  /// Collects the threads' results since the last call. True if anything changed.
  bool poll() {
    const bool matched = star_matches.poll();
    return roles.poll() || matched;
  }
  bool busy() const { return star_matches.busy() || roles.busy(); }

  SphereInspector spheres;   ///< nodes of a volume mesh with their VCVs
  StarMatches star_matches;  ///< nodes that can use the VCV of another
  BoundaryRoles roles;       ///< roles of nodes in the next run
};

}  // namespace winslow::gui
