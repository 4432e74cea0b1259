#pragma once

#include <span>
#include <vector>

#include "core/mesh/coordinates.h"
#include "core/mesh/face.h"

namespace winslow {

/// A part of a surface that is dragged: its nodes, ascending, and the share of the translation that
/// each takes.
struct FadedPatch {
  std::vector<Index> nodes;
  std::vector<double> shares;
};

/// Shares that fade from 1 at the held nodes to 0 at `radius` from them, as faded_share().
/// Distances are measured along the surface, so that the other side of a thin body is as far away
/// as the way around its edge: by fast marching over the triangles (R. Kimmel and J. A. Sethian,
/// PNAS 95, 1998), each unfolded into the plane; those of quadrilaterals are the four of its
/// corners. faces: of the surface. held: those that are not nodes of it are left out. radius >= 0,
/// in units of the mesh. Nodes without a share are left out.
FadedPatch faded_patch(std::span<const Face> faces, const Coordinates& x,
                       std::span<const Index> held, double radius);

}  // namespace winslow
