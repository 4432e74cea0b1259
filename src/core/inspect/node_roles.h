#pragma once

#include "core/mesh/mesh.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/slide_options.h"

namespace winslow {

/// Role of a node during smoothing, for display.
enum class NodeRole : std::uint8_t {
  free,        ///< inside: moves in all directions
  fixed,       ///< on a boundary that stays
  corner,      ///< stays on a sliding marker: at a corner, or on an edge where nothing slides
  on_curve,    ///< slides along a curve
  on_surface,  ///< slides on a surface
  periodic,    ///< moves together with its partner across a periodic boundary
  moves,       ///< moved by a motion
  held,        ///< stays because the options name it
  regions      ///< inside: stays because regions of the mesh meet there
};
inline constexpr std::size_t node_role_count = 9;

struct NodeRoles {
  std::vector<NodeRole> roles;  ///< #nodes; nodes that no element uses are fixed
  std::array<Index, node_role_count> counts{};
  std::vector<Index> overridden;  ///< nodes that the options hold or make smooth, ascending
  /// Nodes that stay only because of the feature angle, ascending.
  std::vector<Index> bends;
  /// Edges of a surface mesh, or of the sliding markers of a volume mesh, at which faces turn by
  /// more than the feature angle, a marker ends, or two markers meet.
  std::vector<std::array<Index, 2>> features;
  /// Recognised curves, surfaces, periodic sides and interfaces: "far: circle of radius 10", "lower
  /// and upper: translation by (0, 1)", "rock and sand: 42 nodes stay where these regions meet".
  std::vector<std::string> found;
  /// Fixed markers on which the moving ones stand, ascending by name: those that give way, and
  /// those that cannot because of their shape.
  std::vector<std::string> give_way, in_the_way;
  /// Why the boundary cannot move as the options say; empty if it can. If it cannot, it stays.
  std::string fault;
};

/// The roles of the nodes of a state with any kind of mesh. Nodes of a surface mesh slide on the
/// surface of the state.
NodeRoles node_roles(const MeshState& state, const ResolvedSlide& slide,
                     const std::vector<std::string>& moving);
/// The same for a plane mesh or a volume mesh. moving: markers that a motion moves.
NodeRoles node_roles(const Mesh& mesh, const ResolvedSlide& slide,
                     const std::vector<std::string>& moving);

}  // namespace winslow
