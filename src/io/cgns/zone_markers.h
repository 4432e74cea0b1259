#pragma once

#include "core/geometry/periodic_pairs.h"
#include "core/mesh/mesh_data.h"
#include "io/cgns/cgns.h"
#include "io/cgns/tree.h"
#include "io/cgns/zones.h"

namespace winslow::io::cgns {

/// The points or elements that a boundary condition or an interface covers (PointRange, PointList,
/// ElementRange, ElementList, GridLocation).
struct PointSet {
  NodeView view;
  bool range = false;
  bool elements = false;  ///< numbers of elements, whatever the location
  std::string location;   ///< "Vertex", "EdgeCenter", ...; empty: the file says none
  std::vector<std::int64_t> values;

  /// Calls `visit` for every number of a set with one index; numbers of a range in ascending order.
  template <class Visit>
  void for_each_number(Visit visit) const {
    if (!range) {
      for (const std::int64_t number : values) visit(number);
      return;
    }
    const std::int64_t last = values[0] < values[1] ? values[1] : values[0];
    for (std::int64_t number = values[0] < values[1] ? values[0] : values[1]; number <= last;
         ++number)
      visit(number);
  }

  /// Vertices are the default of the SIDS.
  bool of_vertices() const { return !elements && (location.empty() || location == "Vertex"); }
};

/// indices: index directions of the zone. Returns nothing if the node has no point set.
std::optional<PointSet> read_point_set(const NodeView& owner, std::size_t indices);

/// Finds the boundary edges of a zone that point sets name.
class ZoneBoundary {
 public:
  virtual ~ZoneBoundary() = default;
  /// Throws InputError for numbers that the zone does not have. Adds a sentence to `warnings` for
  /// entries that are no edges.
  virtual std::vector<Face> faces_of(const PointSet& set,
                                     std::vector<std::string>& warnings) const = 0;
};

/// Boundary edges of a mesh with both ends in a set of nodes (#nodes flags), in the order and in
/// the direction of the elements.
class BoundaryByNodes {
 public:
  explicit BoundaryByNodes(const MeshData& mesh) : mesh_(mesh) {}
  std::vector<Face> faces_between(const std::vector<bool>& nodes) const;

 private:
  const MeshData& mesh_;
  mutable std::vector<Face> boundary_;  // computed at the first call
  mutable bool found_ = false;
};

/// Makes the markers of a zone, in this order:
///
/// - from its boundary conditions (BC_t), named by the family (FamilyName) if there is one; else by
///   the condition. Conditions of the same name become one marker;
/// - from its interfaces (GridConnectivity_t, GridConnectivity1to1_t), except those in `joined`:
///   their edges that are in no marker yet;
/// - from the sections of lines: their lines that are in no marker yet, named by the section.
///
/// Conditions that are planes of symmetry (BCSymmetryPlane), or whose family is one, are noted in
/// the roles of the details.
void make_markers(const ZonePlace& place, const ZoneHead& head, const ZoneBoundary& boundary,
                  const ZoneSides& sides, const std::vector<std::string>& joined, ParsedMesh& mesh,
                  Details& details);

/// Makes regions from the parts of an unstructured zone that name cells (ZoneSubRegion_t with
/// GridLocation CellCenter), named by their family if there is one; parts of one name are one
/// region. An element belongs to the first region that names it.
void read_regions(const NodeView& zone, const ElementNumbers& numbers, MeshData& mesh,
                  std::vector<std::string>& warnings);

/// Connections of the zone to other zones or to itself: GridConnectivity_t, GridConnectivity1to1_t.
std::vector<NodeView> connections_of(const NodeView& zone);
/// True for a connection with Periodic_t.
bool is_periodic(const NodeView& connection);
/// True if a connection leads to this zone, given as "Zone" or "Base/Zone".
bool leads_to(const NodeView& connection, const std::string& zone);

/// Pairs of nodes that a connection lists vertex by vertex; empty if it lists none.
using VertexPairs = std::function<std::vector<PeriodicPair>(const NodeView& connection)>;
/// listed_pairs() of an unstructured zone: PointList, PointListDonor and the like at vertices.
std::vector<PeriodicPair> listed_pairs(const NodeView& connection, std::int64_t vertices);

/// Periodic sides of the zone: its connections to itself with Periodic_t, as pairs of the markers
/// on both sides. If a connection names faces instead of pairs of vertices, the rotation and
/// translation of Periodic_t match them. Adds a sentence to `warnings` for a connection that cannot
/// be used.
std::vector<GivenPairs> periodic_pairs(const NodeView& zone, const ZoneHead& head,
                                       const ZoneBoundary& boundary, const VertexPairs& pairs_of,
                                       const MeshData& mesh, std::vector<std::string>& warnings);

}  // namespace winslow::io::cgns
