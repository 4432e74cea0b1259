#pragma once

#include "core/mesh/mesh.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/slide_options.h"

namespace winslow {

/// What a node does while a mesh is smoothed, told apart as one who looks at it wants to know.
enum class NodeRole : std::uint8_t {
  free,    ///< inside: moves as it likes
  fixed,   ///< on a boundary that stays
  corner,  ///< on a sliding marker, and stays: at a corner, or on an edge that nothing slides along
  on_curve,    ///< slides along a curve
  on_surface,  ///< slides on a surface
  periodic,    ///< moves together with its partner across a periodic boundary
  moves,       ///< goes where a motion takes it
  held         ///< stays because it was named to
};
inline constexpr std::size_t node_role_count = 8;

struct NodeRoles {
  std::vector<NodeRole> roles;  ///< #nodes; those of no element are fixed
  std::array<Index, node_role_count> counts{};
  std::vector<Index> overridden;  ///< nodes that were named to stay, or to be no corners; ascending
  /// Nodes that stay because of the feature angle alone, and could slide; ascending.
  std::vector<Index> bends;
  /// Edges of sliding markers of a volume mesh, or of a surface mesh, at which they turn by more
  /// than the feature angle, end, or meet one another.
  std::vector<std::array<Index, 2>> features;
  /// What was recognised: "far: circle of radius 10", "lower and upper: translation by (0, 1)".
  std::vector<std::string> found;
  /// Why the boundary cannot move as it is asked to; empty if it can. The boundary then stays.
  std::string fault;
};

/// The same of a state of any mesh; nodes of a surface mesh stay on the shape that it was given.
NodeRoles node_roles(const MeshState& state, const ResolvedSlide& slide,
                     const std::vector<std::string>& moving);
/// moving: markers that a motion takes. Of a plane mesh or a volume mesh.
NodeRoles node_roles(const Mesh& mesh, const ResolvedSlide& slide,
                     const std::vector<std::string>& moving);

}  // namespace winslow
