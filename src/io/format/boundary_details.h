#pragma once

#include <vector>

#include "io/format/mesh_file.h"

namespace winslow::io {

/// Details of a format that mixes the faces of markers with other elements in one list: which
/// elements of less than the mesh's dimension there are, in the order of the file, and which of
/// them make up each marker.
struct BoundaryDetails : FormatDetails {
  std::vector<Index> points;  ///< node of each point element
  /// Nodes of each line element and, where the mesh has volumes, of each triangle and each
  /// quadrilateral.
  std::vector<Face> sides;
  /// Sides of each marker, in its order: s, or ~s (negative) where the marker holds the reversed
  /// side (as Gmsh allows).
  std::vector<std::vector<Index>> marker_sides;
  Index nodes = 0;  ///< sizes of the mesh that this belongs to
  Index elements = 0;

  /// The face that an entry of marker_sides stands for.
  Face face(Index coded) const;
  /// True if this still describes the mesh: as many nodes and elements, the same marker faces.
  bool fits(const Mesh& mesh) const;
};

}  // namespace winslow::io
