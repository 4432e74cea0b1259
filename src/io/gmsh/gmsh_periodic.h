#pragma once

#include "io/gmsh/gmsh.h"
#include "io/gmsh/section_readers.h"

namespace winslow::io::gmsh {

/// Reads $Periodic. It is text in MSH 2, whatever the rest is.
std::vector<PeriodicLink> read_links(Scanner& scan, bool version_4, bool binary);

/// Pairs of markers: those whose entities the links of `details` join, which are of one dimension
/// less than the elements. A link of entities in no physical group is none; one that joins a group
/// in part is a pair with a fault. Nodes that are not in the file, of entities that Gmsh did not
/// save, are left out.
std::vector<GivenPairs> pairs_of(const Source& source, const Details& details, const NodeTags& tags,
                                 const MeshData& data);

/// Links for the pairs of a mesh that has an entity for each marker, numbered from 1 on: those of a
/// file of another version or format. Affine transforms are left out of a mesh in a plane of space.
std::vector<PeriodicLink> links_of(const FormatDetails& source, const Mesh& mesh);

}  // namespace winslow::io::gmsh
