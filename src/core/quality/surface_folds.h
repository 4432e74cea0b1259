#pragma once

#include "core/mesh/mesh.h"

/// Where a surface mesh is folded:
///
///     const winslow::SurfaceFolds folds = winslow::find_folds(mesh);
///     if (folds.any()) std::puts(winslow::describe(folds).c_str());
namespace winslow {

/// Folds of a surface mesh: places where it turns back on itself by about 180 degrees.
///
/// A surface mesh read from a file says nowhere which side of an element is right, so a triangle
/// that was turned over is not inverted (QualityReport::inverted). But it lies on its neighbours:
/// at the edge between them the surface turns by about 180 degrees.
///
/// So it does along a thin sharp edge, such as the trailing edge of a wing. Such an edge is a line
/// of several edges that runs on without bends, has its sharp side always on the same side of the
/// surface, and no narrow strip beside it that is bent back again. It is no fold, and neither is an
/// edge between two parts of one smooth patch, or one between the two large sides of a thin body.
struct SurfaceFolds {
  static constexpr double turn = 150;  ///< degrees: the surface turns by more than this

  /// An edge with the elements on both sides.
  struct Edge {
    std::array<Index, 2> nodes, elements;
    Vec3 centre;
  };
  Index edges = 0;           ///< where the surface is folded
  Index elements = 0;        ///< elements behind these edges, the smaller side of each fold by area
  Index of = 0;              ///< elements of the mesh
  Index thin_edges = 0;      ///< that turn as much, but belong to thin sharp edges
  std::vector<Edge> places;  ///< the first 100 of the folded edges
  std::vector<Index> behind;  ///< the first 100 of the elements behind, ascending

  bool any() const { return edges > 0; }
};

/// Finds the folds of a surface mesh; none in other meshes.
SurfaceFolds find_folds(const Mesh& mesh);

/// "the surface is folded: it turns back on itself at 12 edges, by more than 150 degrees, and 5 of
/// 1384 elements lie behind them". Empty if there are no folds.
std::string describe(const SurfaceFolds& folds);

}  // namespace winslow
