#pragma once

#include "io/cgns/cgns.h"

namespace winslow::io::cgns {

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
