#pragma once

#include "io/format/mesh_format.h"
#include "io/format/parsed_mesh.h"

/// Medit's ASCII format (.mesh): P. Frey, "Medit: an interactive mesh visualization software",
/// INRIA RT-0253 (2001), with the pyramids and prisms of libMeshb. Every entry ends in a reference:
/// the tag of the region for an element, the tag of the marker for a face, 0 for none. The format
/// has no names; winslow writes them as comments "# marker TAG NAME" and "# region TAG NAME".
namespace winslow::io::medit {

/// A section of elements.
struct Kind {
  std::string_view keyword;
  std::optional<ElementType> type;  ///< none: edges
  std::size_t corners;
  int dimension;
};
/// Edges, triangles, ..., hexahedra, in the order in which they are written.
std::span<const Kind> kinds();

/// Content of a file beyond a Mesh.
struct Details : BoundaryDetails {
  struct Section {
    enum class Part { raw, dimension, vertices, cells } part;
    std::string raw;             ///< unchanged bytes: names and unknown sections
    const Kind* kind = nullptr;  ///< of cells
    bool elements = false;       ///< true: elements of the mesh; false: sides
    Index first = 0, count = 0;  ///< range among these elements or sides
  };
  int version = 2;    ///< other programs read version 1 as single precision
  int dimension = 3;  ///< of the coordinates
  int cell_dimension = 3;
  std::vector<Section> sections;
  std::vector<int> vertex_references, side_references, element_references;
};

extern const MeshFormat format;

}  // namespace winslow::io::medit
