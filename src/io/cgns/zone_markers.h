#pragma once

#include "core/geometry/periodic_pairs.h"
#include "core/mesh/mesh_data.h"
#include "io/cgns/cgns.h"
#include "io/cgns/tree.h"
#include "io/cgns/zones.h"

namespace winslow::io::cgns {

/// What a boundary condition or an interface covers (PointRange, PointList, ElementRange,
/// ElementList, GridLocation).
struct PointSet {
  NodeView view;
  bool range = false;
  bool elements = false;  ///< numbers of elements, whatever the location
  std::string location;   ///< "Vertex", "EdgeCenter", ...; empty: the file says none
  std::vector<std::int64_t> values;

  /// Calls `visit` for every number of a set with one index: of a range in ascending order.
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

/// indices: index directions of the zone. Nothing, if the node has no point set.
std::optional<PointSet> read_point_set(const NodeView& owner, std::size_t indices);

/// The boundary edges of a zone, as point sets name them.
class ZoneBoundary {
 public:
  virtual ~ZoneBoundary() = default;
  /// Throws InputError for numbers that the zone does not have. Adds a sentence to `warnings` for
  /// what is no edge.
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
  mutable std::vector<Face> boundary_;  // found when first asked for
  mutable bool found_ = false;
};

/// Makes the markers of a zone, in this order:
///
/// - from its boundary conditions (BC_t), named by their family (FamilyName) if they have one; else
///   by the section of lines that they cover whole, if they do, as SU2 names them; else by
///   themselves. Those of one name are one marker;
/// - from its interfaces (GridConnectivity_t, GridConnectivity1to1_t) but those of `joined`: their
///   edges that are in no marker yet;
/// - from the sections of lines: their lines that are in no marker yet, named by the section.
void make_markers(const NodeView& zone, const ZoneHead& head, const ZoneBoundary& boundary,
                  const ZoneSides& sides, const std::vector<std::string>& joined, ParsedMesh& mesh,
                  Details& details);

/// Makes regions of the parts of an unstructured zone that name cells (ZoneSubRegion_t with
/// GridLocation CellCenter). An element has one region, the first that names it.
void read_regions(const NodeView& zone, const ElementNumbers& numbers, MeshData& mesh,
                  std::vector<std::string>& warnings);

/// What the zone has in common with others or itself: GridConnectivity_t, GridConnectivity1to1_t.
std::vector<NodeView> connections_of(const NodeView& zone);
/// True for a connection with Periodic_t.
bool is_periodic(const NodeView& connection);
/// The zone that a connection leads to is this one: "Zone" or "Base/Zone".
bool leads_to(const NodeView& connection, const std::string& zone);

/// Pairs of nodes that a connection names vertex by vertex; empty: it does not.
using VertexPairs = std::function<std::vector<PeriodicPair>(const NodeView& connection)>;
/// Of an unstructured zone: PointList, PointListDonor and the like at vertices.
std::vector<PeriodicPair> listed_pairs(const NodeView& connection, std::int64_t vertices);

/// Periodic sides of the zone: its connections to itself with Periodic_t, as pairs of the markers
/// that lie on their sides. Where a connection names no pairs of vertices but faces, these are
/// matched by what Periodic_t says of rotation and translation. One that cannot be used is a
/// sentence in `warnings`.
std::vector<GivenPairs> periodic_pairs(const NodeView& zone, const ZoneHead& head,
                                       const ZoneBoundary& boundary, const VertexPairs& pairs_of,
                                       const MeshData& mesh, std::vector<std::string>& warnings);

}  // namespace winslow::io::cgns
