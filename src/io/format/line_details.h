#pragma once

#include <array>
#include <vector>

#include "io/format/mesh_file.h"

namespace winslow::io {

/// Details of a format that mixes the edges of markers with other elements in one list: which line
/// elements there are, in the order of the file, and which of them make up each marker.
struct LineDetails : FormatDetails {
  std::vector<Index> points;                ///< node of each point element
  std::vector<std::array<Index, 2>> lines;  ///< nodes of each line element
  /// Lines of each marker, in its order: l, or ~l (negative) where the marker holds the reversed
  /// line (as Gmsh allows).
  std::vector<std::vector<Index>> marker_lines;
  Index nodes = 0;  ///< sizes of the mesh that this belongs to
  Index elements = 0;

  /// The edge that an entry of marker_lines stands for.
  std::array<Index, 2> edge(Index coded) const;
  /// True if this still describes the mesh: as many nodes and elements, the same marker edges.
  bool fits(const Mesh& mesh) const;
};

}  // namespace winslow::io
