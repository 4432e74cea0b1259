#pragma once

#include "core/layers/layer_spacing.h"
#include "core/mesh/mesh.h"

/// The walls of a volume mesh that get layers:
///
///     const std::vector<winslow::LayerWall> walls{{{"wing"}, {.count = 20, .first = 1e-5}}};
///     const winslow::WallSurface surface = winslow::find_wall_surface(mesh, walls);
///     for (const winslow::WallEdge& edge : surface.edges)
///       if (edge.turning > winslow::radians(60)) std::puts("a sharp convex ridge");
namespace winslow {

/// A triangle or quadrilateral of a wall.
struct WallFace {
  Face nodes;            ///< counter-clockwise seen from the mesh
  Index face = -1;       ///< as in Topology::face()
  Index element = -1;    ///< on the face
  int wall = 0;          ///< index in the list of walls
  Vec3 normal{0, 0, 0};  ///< unit vector into the mesh
  /// The face of the walls beyond the edge from corner k to the next one, index into
  /// WallSurface::faces; -1: the wall ends there.
  std::array<Index, 4> beside{-1, -1, -1, -1};
};

/// An edge of a wall.
struct WallEdge {
  std::array<Index, 2> nodes{-1, -1};  ///< lower first
  std::array<Index, 2> faces{-1, -1};  ///< the second is -1 at the rim, where the wall ends
  /// Angle between the normals of both faces, radians. It is positive where the wall turns away
  /// from the mesh (convex ridge) and negative in a concave corner; 0 at the rim.
  double turning = 0;

  bool at_rim() const { return faces[1] < 0; }
};

/// A boundary face without layers at the rim of a wall.
struct RimFace {
  Face nodes;            ///< counter-clockwise seen from the mesh
  Index face = -1;       ///< as in Topology::face()
  Vec3 normal{0, 0, 0};  ///< unit vector into the mesh
};

/// All walls that get layers, together.
struct WallSurface {
  std::vector<WallFace> faces;
  std::vector<WallEdge> edges;  ///< in the order of their nodes
  std::vector<Index> nodes;     ///< ascending
  CompressedRows faces_at;      ///< #nodes: indices into faces
  CompressedRows edges_at;      ///< #nodes: indices into edges
  std::vector<RimFace> rim_faces;
  CompressedRows rim_faces_at;  ///< #nodes: indices into rim_faces; empty rows away from the rim

  /// Position of a node in `nodes`; -1: it is on none of the walls.
  Index number(Index node) const;
};

/// Finds the faces of all walls together. A part of a wall (LayerWall::part) has the faces with all
/// nodes in its box, whatever their z. Throws UsageError for an unknown marker, a face of two
/// walls, a marker face inside the mesh, a polygon or a polyhedron at a wall, a wall without a
/// face, a face without area, walls that touch along an edge, and a mesh that is no volume mesh.
WallSurface find_wall_surface(const Mesh& mesh, std::span<const LayerWall> walls);

/// "node 7 at (0, 0.5, 1)", for messages.
std::string node_text(const Mesh& mesh, Index node);

}  // namespace winslow
