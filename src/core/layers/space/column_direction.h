#pragma once

#include "core/layers/space/wall_surface.h"

/// The directions of columns on the walls of a volume mesh:
///
///     const auto surface = winslow::find_wall_surface(mesh, walls);
///     const auto directions = winslow::column_directions(mesh, surface);
///     for (std::size_t i = 0; i < surface.nodes.size(); ++i)
///       std::printf("node %d: slant %g\n", surface.nodes[i], directions[i].slant);
namespace winslow {

/// A cone from the origin of the unit sphere, which cuts it in a circle.
struct Cone {
  Vec3 axis{0, 0, 0};  ///< unit vector
  double cosine = -1;  ///< of the angle between the axis and the cone
};

/// The narrowest cone around unit vectors, of which there is at least one: its axis d has the
/// largest smallest cosine d = argmax min_i d.n_i. Exact up to round-off, by adding one vector
/// after another (E. Welzl, "Smallest enclosing disks", LNCS 555, 1991). If the vectors lie in no
/// open half of the sphere the cosine is not positive, and the axis means nothing.
Cone narrowest_cone(std::span<const Vec3> normals);

/// Largest length along a column per unit of height.
inline constexpr double most_slant = 2.5;

/// The direction of a column on a wall.
struct ColumnDirection {
  Vec3 direction{0, 0, 0};  ///< unit vector
  double slant = 1;         ///< length along the column per unit of height
  /// The column lies in a boundary without layers, at the rim of its wall.
  bool along_boundary = false;
  /// Length of the boundary edge that the column follows; infinite for a column that lies in planes
  /// or in no boundary.
  double edge = std::numeric_limits<double>::infinity();
};

/// The directions of the columns at all nodes of a wall (#nodes of the surface).
///
/// A column has the axis of the narrowest cone around the normals of the faces at its node. At the
/// rim the normals are mirrored at the boundary without layers, so that the column lies in it:
/// where that boundary is plane in the plane, where two planes meet along both. Along a curved
/// boundary the column follows one of its edges. Away from ridges, corners and rims the directions
/// are then smoothed along the wall, as far as the slant of a column grows by no more than 2 %.
///
/// Throws UsageError naming the node and its place where no direction sees all faces of the wall,
/// where the slant would be more than `most_slant`, and where the wall goes on into a boundary
/// without layers in which no column can lie.
std::vector<ColumnDirection> column_directions(const Mesh& mesh, const WallSurface& surface);

}  // namespace winslow
