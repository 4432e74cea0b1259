#pragma once

#include "core/mesh/mesh.h"
#include "io/cgns/tree.h"
#include "io/format/mesh_format.h"
#include "io/format/parsed_mesh.h"

/// CGNS files, https://cgns.github.io: the SIDS and their mapping to ADF and HDF5. Bases of cell
/// dimension 2 and, of unstructured zones, 3; see docs/formats.md for what is read and what is
/// carried.
namespace winslow::io::cgns {

/// What a CGNS file says beyond a mesh: all of it. A mesh that moved goes back into the tree of its
/// file, in which only its coordinates change.
struct Details : MarkerDetails {
  NodePtr root;  ///< of the file
  Container container = Container::hdf5;
  std::string base_name, zone_name;
  /// Names of the boundary conditions (BC_t) of the zone that make up each marker.
  std::vector<std::vector<std::string>> conditions;
  /// Node of each vertex of the zone, of a structured zone whose cut was closed; empty: the vertex.
  std::vector<Index> node_of_vertex;
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

/// The zone of a file, its coordinates replaced by those of the mesh, which the details fit; the
/// zone itself where no node has moved. A vertex whose node has not moved keeps its bits.
/// Coordinates in single precision become double where the new ones need it.
NodePtr moved_zone(const NodePtr& zone, const Mesh& mesh, const Details& details,
                   std::vector<std::string>& warnings);

/// A zone as it is made from a mesh.
struct NewZone {
  NodePtr zone;
  std::vector<NodePtr> families;  ///< one for each marker without a boundary condition in `old`
};
struct NewZoneSource {
  std::string name = "Zone";
  const Node* old = nullptr;             ///< the zone that it takes the place of, if any
  const Details* details = nullptr;      ///< of that one
  const FormatDetails* place = nullptr;  ///< where its plane lies
  int physical_dimension = 2;
  bool start_offsets = false;  ///< MIXED sections as CGNS 3.4 and 4 have them
};
/// Unstructured: a section of elements for each type, or one MIXED section where the order of the
/// elements needs it; for each marker a section of lines and a boundary condition. Of an old zone
/// keeps what does not depend on its elements.
NewZone make_zone(const Mesh& mesh, const NewZoneSource& source,
                  std::vector<std::string>& warnings);

/// "a", "b" and "c", as warnings list names.
std::string listed_names(const std::vector<std::string>& names);

}  // namespace winslow::io::cgns
