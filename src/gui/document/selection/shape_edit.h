#pragma once

#include <optional>

#include "core/drag/drag_grip.h"
#include "core/mesh/mesh.h"
#include "gui/document/selection/boundary_index.h"

namespace winslow::gui {

/// A run of nodes along a closed boundary loop, forward from `first` to `last`.
struct BoundaryArc {
  Index body = 0;                   ///< of BoundaryIndex::bodies()
  std::size_t first = 0, last = 0;  ///< positions in the body's nodes

  bool contains(std::size_t position) const;
  bool operator==(const BoundaryArc&) const = default;
};

/// The arc grown to take in another position of a loop of n nodes, the shorter way round.
BoundaryArc extended(const BoundaryArc& arc, std::size_t position, std::size_t n);

/// Nodes of the boundary of a volume mesh that are held together, and the markers over which a drag
/// of them fades.
struct SurfacePatch {
  std::vector<Index> nodes;    ///< ascending
  std::vector<Index> markers;  ///< ascending

  bool contains(Index node) const;
  bool operator==(const SurfacePatch&) const = default;
};

/// Shape editing: pieces of boundary are dragged instead of whole bodies.
struct ShapeEdit {
  bool active = false;
  double radius = 0;  ///< beyond what is held, along the boundary, over which a drag fades
  std::optional<BoundaryArc> arc;     ///< of a plane mesh
  std::optional<SurfacePatch> patch;  ///< of a volume mesh

  bool holds() const { return arc.has_value() || patch.has_value(); }
};

/// What a drag of the arc holds.
DragGrip grip_of(const BoundaryArc& arc, double radius, const BoundaryIndex& boundary,
                 const Topology& topology, const Coordinates& rest);
/// What a drag of the patch holds.
DragGrip grip_of(const SurfacePatch& patch, double radius, const Mesh& rest);

}  // namespace winslow::gui
