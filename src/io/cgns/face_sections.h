#pragma once

#include "core/mesh/topology.h"
#include "io/cgns/tree.h"

/// Sections of elements (Elements_t) for writers:
///
///     const FaceSections sections = make_face_sections(topology, markers, false);
///     zone->children.push_back(sections.faces);
///     zone->children.push_back(sections.cells);
namespace winslow::io::cgns {

/// A section of elements with the numbers first + 1 to first + count. starts: #count + 1, the
/// offset of each element in the connectivity; empty: the section holds none.
std::shared_ptr<Node> make_section(std::string name, std::int64_t type, Index first, Index count,
                                   const std::vector<std::int32_t>& connectivity,
                                   const std::vector<std::int32_t>& starts = {});

/// The elements of a mesh with polyhedra. All cells are given by their faces, since readers expect
/// no other cells beside NFACE_n.
struct FaceSections {
  /// NGON_n with ParentElements: the faces of markers, in their order, then the rest of the
  /// boundary, then the faces between cells. Faces of markers are seen from outside their first
  /// cell; their first nodes stay.
  std::shared_ptr<Node> faces;
  std::shared_ptr<Node> cells;  ///< NFACE_n, in the order of the elements; their numbers follow
  std::vector<std::vector<std::int32_t>> markers;  ///< numbers of the faces of each marker
  Index face_count = 0;
};
/// start_offsets: as CGNS 3.4 and 4 have it; else each element begins with the number of its
/// entries. Throws UsageError if 32 bits cannot number the entries.
FaceSections make_face_sections(const Topology& topology, std::span<const Marker> markers,
                                bool start_offsets);

}  // namespace winslow::io::cgns
