#pragma once

#include "core/geometry/sliding_boundary.h"
#include "core/mesh/mesh.h"
#include "core/options/option.h"
#include "core/problem/node_classes.h"

/// Nodes of the far field slide along it:
///
///     winslow::MoveCommand move;
///     move.smooth.slide.markers = {"farfield"};
namespace winslow {

/// Whether the spacing of nodes along curves that they slide on is held.
enum class SlideSpacing {
  automatic,  ///< of walls (is_wall())
  held,
  free
};

/// Nodes of the boundary that move while the mesh is smoothed: those of some markers slide on what
/// they lie on in the mesh that the command is given, those of periodic pairs move together. What
/// is asked of files stands here by name; what is in them is SlideFiles.
struct SlideOptions {
  std::vector<std::string> markers;
  double feature_angle = 40;  ///< degrees by which a marker turns at a corner, which stays
  SlideSpacing spacing = SlideSpacing::automatic;
  std::vector<std::string> held_markers;  ///< whose spacing is held whatever `spacing` says
  bool features = false;       ///< in space nodes slide along the edges of the markers, too
  bool surface_first = false;  ///< of a volume mesh, the sliding boundary before the interior
  std::string reference;  ///< in space: file of the surface to slide on instead of the mesh's own
  /// Nodes of the mesh that the command is given, counted from 0.
  std::vector<Index> hold_nodes;      ///< stay, inside the mesh as well
  std::vector<Index> smooth_nodes;    ///< of what slides: no corners, however much it turns there
  std::vector<std::string> periodic;  ///< names of markers, pair after pair
  bool periodic_from_file = false;    ///< besides these, those that the file of the mesh names

  bool has_pairs() const { return !periodic.empty() || periodic_from_file; }
  /// Asked for; `automatic` may do so as well.
  bool holds_spacing() const { return spacing == SlideSpacing::held || !held_markers.empty(); }
  bool given() const { return !markers.empty() || has_pairs(); }
  bool operator==(const SlideOptions&) const = default;
};

OptionTable option_table(SlideOptions& slide);

FeatureRules feature_rules(const SlideOptions& slide);
/// Takes a marker out of those that slide. Returns whether it was one.
bool stop_sliding(SlideOptions& slide, const std::string& marker);

/// What slide options ask of files, as it was found there: io::resolve_files() reads it. A surface
/// of one's own, from no file, goes by any name in SlideOptions::reference.
struct SlideFiles {
  std::shared_ptr<const ReferenceSurface> reference = nullptr;  ///< null: none
  std::shared_ptr<const GivenPeriodicity> periodic = nullptr;   ///< null: none
};

/// Slide options with all that they ask of files: what a run is given. There are none of which a
/// surface is named and not there.
class ResolvedSlide : public SlideOptions {
 public:
  ResolvedSlide() = default;
  /// What `slide` does not ask for is left out. Throws UsageError where it asks for what is not in
  /// `files`.
  ResolvedSlide(SlideOptions slide, SlideFiles files = {});

  const SlideFiles& files() const { return files_; }

 private:
  SlideFiles files_;
};

/// What the nodes of the boundary that move were found to do.
struct MovingBoundary {
  std::vector<SlidingPart> sliding;
  std::vector<PeriodicPairs> periodic;
  std::vector<Index> bends;  ///< as SlidingBoundary has them
  Index held = 0;            ///< number of nodes that were named to stay
  /// Nodes that slide and give way to a body that stands among them: see let_bodies_slide().
  std::vector<Index> yielding;
};

/// Has the nodes of the markers slide and those of the pairs move together, and holds the nodes
/// that are to stay. Throws UsageError as SlidingBoundary::find(), PeriodicPairs::find() and
/// PeriodicPairs::of() do, and for a node of them that `moving`, the nodes of a motion, has.
MovingBoundary make_boundary_move(const ResolvedSlide& slide, const Mesh& mesh,
                                  std::span<const Index> moving, NodeClasses& classes);

}  // namespace winslow
