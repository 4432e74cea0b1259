#pragma once

#include "core/geometry/footholds.h"
#include "core/mesh/mesh.h"
#include "core/options/option.h"
#include "core/problem/node_classes.h"

/// Lets nodes of the far field slide along it:
///
///     winslow::MoveCommand move;
///     move.smooth.slide.markers = {"farfield"};
namespace winslow {

/// Whether the spacing of sliding nodes along their curves is held.
enum class SlideSpacing {
  automatic,  ///< held at walls (is_wall())
  held,
  free
};

/// Boundary nodes that move while the mesh is smoothed. Nodes of the given markers slide on the
/// boundary of the mesh as given to the command; nodes of periodic pairs move together. Files are
/// given here by name; SlideFiles has their contents.
struct SlideOptions {
  std::vector<std::string> markers;
  double feature_angle = 40;  ///< degrees; where a marker turns by more, the corner is fixed
  SlideSpacing spacing = SlideSpacing::automatic;
  std::vector<std::string> held_markers;  ///< spacing held regardless of `spacing`
  /// Markers that stay where a moving body stands on them, instead of giving way.
  std::vector<std::string> fixed;
  bool features = false;       ///< in space: nodes also slide along the edges of the markers
  bool surface_first = false;  ///< volume mesh: smooth the sliding boundary before the interior
  std::string reference;  ///< in space: file of a surface to slide on, instead of the mesh's own
  /// Nodes of the mesh that the command is given, counted from 0.
  std::vector<Index> hold_nodes;      ///< fixed nodes, of the boundary or the interior
  std::vector<Index> smooth_nodes;    ///< sliding nodes that are never corners, whatever the angle
  std::vector<std::string> periodic;  ///< names of markers, pair after pair
  bool periodic_from_file = false;    ///< also the pairs that the mesh file names
  Interfaces interfaces = Interfaces::automatic;  ///< nodes in which regions of the mesh meet

  bool has_pairs() const { return !periodic.empty() || periodic_from_file; }
  /// True if the user asks for held spacing; `automatic` may hold it as well.
  bool holds_spacing() const { return spacing == SlideSpacing::held || !held_markers.empty(); }
  bool given() const { return !markers.empty() || has_pairs(); }
  bool operator==(const SlideOptions&) const = default;
};

OptionTable option_table(SlideOptions& slide);

/// The rules for sliding markers: these end where regions meet, unless the nodes there are free.
FeatureRules feature_rules(const SlideOptions& slide);
/// What nodes do in which regions meet, where the options leave it open (Interfaces::automatic): a
/// motion leaves them free, smoothing without one holds them.
Interfaces interfaces_in(Interfaces wanted, bool motion);
/// Throws UsageError for a marker of `fixed` that the mesh does not have, that slides or is
/// periodic as well, or that moves. moving: markers of a motion.
void require_fixed(const SlideOptions& slide, const Topology& topology,
                   std::span<const std::string> moving);
/// Removes a marker from the sliding ones. Returns whether it was one.
bool stop_sliding(SlideOptions& slide, const std::string& marker);

/// Contents of the files that slide options name, as read by io::resolve_files(). For a surface
/// that is not from a file, SlideOptions::reference may be any name.
struct SlideFiles {
  std::shared_ptr<const ReferenceSurface> reference = nullptr;  ///< null: none
  std::shared_ptr<const GivenPeriodicity> periodic = nullptr;   ///< null: none
};

/// Slide options with the contents of their files, as a run needs them. A surface that is named is
/// always present.
class ResolvedSlide : public SlideOptions {
 public:
  ResolvedSlide() = default;
  /// Drops contents that `slide` does not name. Throws UsageError if it names contents that `files`
  /// lacks.
  ResolvedSlide(SlideOptions slide, SlideFiles files = {});

  const SlideFiles& files() const { return files_; }

 private:
  SlideFiles files_;
};

/// The number of nodes in which regions meet that stay, slide and are free in a run. Nodes of the
/// boundary count if they are of a periodic side, or of a part that slides and is free there.
struct InterfaceNodes {
  std::string regions;  ///< Topology::name_of()
  Index held = 0, sliding = 0, free = 0;

  Index count() const { return held + sliding + free; }
};

/// What a run does with the nodes in which regions meet.
struct InterfaceReport {
  std::vector<InterfaceNodes> each;  ///< of each interface that has such nodes
  InterfaceNodes all;                ///< each node once; without a name
  std::vector<Index> held;           ///< nodes that stay because regions meet there, ascending
};

/// As a clause: "holds 42 nodes in which the regions rock and sand meet"; empty if there are none.
std::string text_of(const InterfaceReport& report);

/// A marker that stays although a moving body stands on it.
struct HeldFoothold {
  std::string body, marker;
  std::size_t nodes = 0;  ///< that they share
  std::string by;         ///< what holds it: "--fixed symmetry", "the pointwise form"

  /// "wing shares 24 nodes with symmetry, which stays (--fixed symmetry)".
  std::string description() const;
};

/// How the moving boundary nodes were classified.
struct MovingBoundary {
  std::vector<SlidingPart> sliding;
  std::vector<PeriodicPairs> periodic;
  std::vector<Index> bends;  ///< see SlidingBoundary
  Index held = 0;            ///< number of nodes that were named to stay
  /// Sliding nodes that give way to a body that stands on their boundary: see let_bodies_slide().
  std::vector<Index> yielding;
  InterfaceReport interfaces;
  /// What the bodies of a motion stand on, besides markers that slide anyway.
  std::vector<Foothold> footholds;
  std::vector<HeldFoothold> held_footholds;
};

/// The pairs of periodic sides that the options and the file name, but for those of markers that
/// are fixed; those of halo nodes last. Throws UsageError as PeriodicPairs::find() and
/// PeriodicPairs::of() do.
std::vector<PeriodicPairs> periodic_pairs(const ResolvedSlide& slide, const Mesh& mesh);

/// Sets the nodes of the markers to slide, couples those of the pairs, fixes the nodes to hold, and
/// holds nodes in which regions meet or lets them slide. `automatic` interfaces are free if
/// `moving` has nodes. A motion takes its nodes from an interface. Throws UsageError as
/// SlidingBoundary::find(), PeriodicPairs::find() and PeriodicPairs::of() do, and if one of these
/// nodes is in `moving`, the nodes of a motion.
MovingBoundary make_boundary_move(const ResolvedSlide& slide, const Mesh& mesh,
                                  std::span<const Index> moving, NodeClasses& classes);

}  // namespace winslow
