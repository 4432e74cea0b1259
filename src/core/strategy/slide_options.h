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

/// A surface from a file, by its name until somebody who can read files has read it.
struct ReferenceFile {
  std::string name;  ///< empty: none
  std::shared_ptr<const ReferenceSurface> surface;

  bool operator==(const ReferenceFile& other) const { return name == other.name; }
};

/// The very same surface, however often it was read.
bool same_surface(const ReferenceFile& a, const ReferenceFile& b);

/// Periodic sides that the file of the mesh names. Which those are is known when somebody who can
/// read files has read it.
struct FilePairs {
  bool wanted = false;
  std::shared_ptr<const GivenPeriodicity> found;

  bool operator==(const FilePairs& other) const { return wanted == other.wanted; }
};

/// Whether the spacing of nodes along curves that they slide on is held.
enum class SlideSpacing {
  automatic,  ///< of walls (is_wall())
  held,
  free
};

/// Nodes of the boundary that move while the mesh is smoothed: those of some markers slide on what
/// they lie on in the mesh that the command is given, those of periodic pairs move together.
struct SlideOptions {
  std::vector<std::string> markers;
  double feature_angle = 40;  ///< degrees by which a marker turns at a corner, which stays
  SlideSpacing spacing = SlideSpacing::automatic;
  std::vector<std::string> held_markers;  ///< whose spacing is held whatever `spacing` says
  bool features = false;       ///< in space nodes slide along the edges of the markers, too
  bool surface_first = false;  ///< of a volume mesh, the sliding boundary before the interior
  ReferenceFile reference;     ///< in space: the surface to slide on instead of the mesh's own
  /// Nodes of the mesh that the command is given, counted from 0.
  std::vector<Index> hold_nodes;      ///< stay, inside the mesh as well
  std::vector<Index> smooth_nodes;    ///< of what slides: no corners, however much it turns there
  std::vector<std::string> periodic;  ///< names of markers, pair after pair
  FilePairs file_pairs;               ///< besides these

  bool has_pairs() const { return !periodic.empty() || file_pairs.wanted; }
  /// Asked for; `automatic` may do so as well.
  bool holds_spacing() const { return spacing == SlideSpacing::held || !held_markers.empty(); }
  bool given() const { return !markers.empty() || has_pairs(); }
  bool operator==(const SlideOptions&) const = default;
};

OptionTable option_table(SlideOptions& slide);

FeatureRules feature_rules(const SlideOptions& slide);
/// Takes a marker out of those that slide. Returns whether it was one.
bool stop_sliding(SlideOptions& slide, const std::string& marker);

/// The reference surface; null: none. Throws UsageError for one that was not read.
const ReferenceSurface* reference_of(const SlideOptions& slide);

/// The pairs of the file, if they are wanted, but for those that are also named. Throws UsageError
/// if it names none, or was not read.
std::vector<GivenPairs> wanted_pairs(const SlideOptions& slide);

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
MovingBoundary make_boundary_move(const SlideOptions& slide, const Mesh& mesh,
                                  std::span<const Index> moving, NodeClasses& classes);

}  // namespace winslow
