#pragma once

#include "core/mesh/mesh.h"
#include "io/cgns/tree_file.h"
#include "io/format/mesh_format.h"

/// CGNS files, https://cgns.github.io: the SIDS and their mapping to ADF and HDF5. Bases of cell
/// dimension 2 and, of unstructured zones, 3; see docs/formats.md for what is read and what is
/// carried.
namespace winslow::io::cgns {

/// What a CGNS file says beyond a mesh: all of it. A mesh that moved goes back into the tree of its
/// file, in which only its coordinates change.
struct Details : FormatDetails {
  NodePtr root;  ///< of the file
  Container container = Container::hdf5;
  std::string base_name, zone_name;
  Index nodes = 0;  ///< sizes of the mesh that the details belong to
  Index elements = 0;
  std::vector<Marker> markers;
  /// Names of the boundary conditions (BC_t) of the zone that make up each marker.
  std::vector<std::vector<std::string>> conditions;
  /// Node of each vertex of the zone, of a structured zone whose cut was closed; empty: the vertex.
  std::vector<Index> node_of_vertex;

  /// True if the tree still describes the mesh: as many nodes and elements, the same markers.
  bool fits(const Mesh& mesh) const;
};

extern const MeshFormat format;

/// zone: its place among all zones of the file, from 1 on (find_zones()); 0: the first. Throws
/// UsageError if the file has no such zone.
ParsedMesh read_zone(Source& source, int zone);

/// Writes a file of one zone; of a file of several, without the others. In the container that the
/// options say; else in that of the source, or in HDF5.
std::vector<std::string> write(std::ostream& out, const Mesh& mesh, const FormatDetails* details,
                               const WriteOptions& options = {});
/// Zones of one file; the rest of its tree as it was.
std::vector<std::string> write_zones(std::ostream& out, std::span<const MeshZone> zones,
                                     const WriteOptions& options = {});

}  // namespace winslow::io::cgns
