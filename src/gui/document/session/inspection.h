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

/// What the nodes of the mesh of the history will do in the next run: of markers that slide and of
/// periodic pairs as the solver is set to, of those that are selected. Looked for in the
/// background.
class BoundaryRoles {
 public:
  BoundaryRoles(const LiveMesh& mesh, const SolverSettings& settings, const Selection& selection)
      : mesh_(mesh), settings_(settings), selection_(selection) {}

  /// The latest that is known of this mesh; null: nothing yet. Asked for in every frame in which it
  /// is shown: what was asked last is looked for.
  std::shared_ptr<const NodeRoles> find() const;
  /// It is what the settings say now.
  bool up_to_date() const { return answer_.roles && answer_.question == asked_; }

  /// True if something new is known.
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

/// What an inspection of nodes of a volume mesh shows: their VCVs as a run from the mesh of the
/// history would have them (of the kind that the solver is set to, or as edited), over the mesh on
/// screen. Each is worked out when it is first asked for: a whole mesh has more VCVs than one looks
/// at.
class SphereInspector {
 public:
  SphereInspector(const LiveMesh& mesh, const SolverSettings& settings)
      : mesh_(mesh), settings_(settings) {}

  /// Valid until the next call of a later frame. Throws UsageError for a node that has no VCV,
  /// MeshError for a star that has none.
  const VolumeNodalView& view_of(Index node) const;

 private:
  /// What VCVs depend on.
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

/// The nodes of a volume mesh that can take the VCV of one of them (matching_stars()), looked for
/// in the background, in the mesh of the history: a whole mesh has many.
class StarMatches {
 public:
  explicit StarMatches(const LiveMesh& mesh) : mesh_(mesh) {}
  ~StarMatches() { stop(); }
  StarMatches(const StarMatches&) = delete;
  StarMatches& operator=(const StarMatches&) = delete;

  struct Wish {
    Index node = -1;
    std::optional<std::vector<Index>> among = std::nullopt;  ///< none: all inner nodes
    std::optional<double> radius = std::nullopt;             ///< as far as this from the node
    bool operator==(const Wish&) const = default;
  };
  using Found = std::vector<MatchedStar>;
  /// Null: they are being looked for. Valid until the next call.
  const Found* find(const Wish& wish) const;

  /// True if some were found.
  bool poll();
  bool busy() const { return worker_.busy(); }

 private:
  /// A wish, and the mesh that it is of.
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

/// What is found out about nodes that one looks at, as it is asked for.
struct Inspection {
  Inspection(const LiveMesh& mesh, const SolverSettings& settings, const Selection& selection)
      : spheres(mesh, settings), star_matches(mesh), roles(mesh, settings, selection) {}

  /// Collects what the threads have done since the last call. True if anything changed.
  bool poll() {
    const bool matched = star_matches.poll();
    return roles.poll() || matched;
  }
  bool busy() const { return star_matches.busy() || roles.busy(); }

  SphereInspector spheres;   ///< nodes of a volume mesh with their VCVs
  StarMatches star_matches;  ///< nodes that can take the VCV of another
  BoundaryRoles roles;       ///< what nodes do in the next run
};

}  // namespace winslow::gui
