#pragma once

#include "core/mesh/mesh.h"
#include "io/cgns/tree.h"
#include "io/format/mesh_format.h"
#include "io/format/parsed_mesh.h"

/// Reads and writes CGNS files, https://cgns.github.io: the SIDS and their mapping to ADF and HDF5.
/// Bases may have cell dimension 2 or 3; docs/formats.md lists what is read and what is only
/// carried along.
namespace winslow::io::cgns {

/// Everything that a CGNS file holds: its whole tree. A moved mesh is written back into the tree of
/// its file; only the coordinates change.
struct Details : MarkerDetails {
  NodePtr root;  ///< of the file
  Container container = Container::hdf5;
  std::string base_name, zone_name;
  /// Names of the boundary conditions (BC_t) of the zone that make up each marker.
  std::vector<std::vector<std::string>> conditions;
  /// Mesh node of each vertex, for a structured zone whose cut was closed; empty: node = vertex.
  std::vector<Index> node_of_vertex;
};

extern const MeshFormat format;

/// Reads one zone. zone: its number among all zones of the file, from 1 (find_zones()); 0: the
/// first. Throws UsageError if the file has no such zone.
ParsedMesh read_zone(Source& source, int zone);
/// Reads all zones of a file, in the order of find_zones(). They share its tree.
void read_zones(Source& source, const TakeZone& take);

/// Writes a file with one zone; other zones of the source file are left out. The options choose the
/// container; the default is that of the source, else HDF5.
std::vector<std::string> write(std::ostream& out, const Mesh& mesh, const FormatDetails* details,
                               const WriteOptions& options = {});
/// Writes several zones of one file; the rest of the file's tree is written unchanged.
std::vector<std::string> write_zones(std::ostream& out, std::span<const MeshZone> zones,
                                     const WriteOptions& options = {});

/// Returns the zone with the coordinates of the mesh, which must fit the details; the same zone if
/// no node has moved. A vertex whose node has not moved keeps its value bit by bit. Coordinates in
/// single precision become double where the new ones need it.
NodePtr moved_zone(const NodePtr& zone, const Mesh& mesh, const Details& details,
                   std::vector<std::string>& warnings);

/// A new zone that was made from a mesh.
struct NewZone {
  NodePtr zone;
  std::vector<NodePtr> families;  ///< one for each marker without a boundary condition in `old`
};
struct NewZoneSource {
  std::string name = "Zone";
  const Node* old = nullptr;             ///< the zone that the new one replaces, if any
  const Details* details = nullptr;      ///< of the old zone
  const FormatDetails* place = nullptr;  ///< tells where the plane of the mesh lies
  int physical_dimension = 2;
  bool start_offsets = false;  ///< MIXED and NGON_n sections as CGNS 3.4 and 4 have them
};
/// Makes an unstructured zone: a section of elements for each type, or one MIXED section if the
/// order of the elements needs it, and a section of lines and a boundary condition for each marker.
/// A mesh with polyhedra has one section of all faces and one of all cells (FaceSections) instead.
/// Nodes of the old zone that do not depend on its elements are kept.
NewZone make_zone(const Mesh& mesh, const NewZoneSource& source,
                  std::vector<std::string>& warnings);

/// "a", "b" and "c", as warnings list names.
std::string listed_names(const std::vector<std::string>& names);

}  // namespace winslow::io::cgns
