#pragma once

#include "core/geometry/periodic_pairs.h"
#include "core/mesh/mesh_data.h"
#include "io/cgns/zone_markers.h"
#include "io/cgns/zones.h"

namespace winslow::io::cgns {

/// Indices of a vertex, from 1; the third one is 1 in a zone of two directions.
using LatticePoint = std::array<std::int64_t, 3>;

/// Vertices of a structured zone of two or three directions, the first index running fastest.
struct Lattice {
  std::size_t directions = 2;
  LatticePoint size{1, 1, 1};         ///< vertices in each direction
  std::vector<Index> node_of_vertex;  ///< the two vertices of a closed cut share a node
  Index nodes = 0;

  bool has(const LatticePoint& p) const {
    for (std::size_t d = 0; d < 3; ++d)
      if (p[d] < 1 || p[d] > size[d]) return false;
    return true;
  }
  std::size_t vertex(const LatticePoint& p) const {
    return static_cast<std::size_t>(p[0] - 1 + size[0] * (p[1] - 1 + size[1] * (p[2] - 1)));
  }
  Index node(const LatticePoint& p) const { return node_of_vertex[vertex(p)]; }
  /// "(3, 4)" or "(3, 4, 1)".
  std::string shown(const LatticePoint& p) const;
};

/// Numbers the nodes of a structured zone. A zone that touches itself one to one (the cut of a
/// C-grid or an O-grid: GridConnectivity1to1_t to the zone itself) is closed: the two vertices of a
/// pair become one node if their places agree up to 1e-7 of the extent. Otherwise, and for a
/// periodic connection, the cut stays open. `joined`: names of the closed connections. places:
/// coordinates of every vertex.
Lattice make_lattice(const NodeView& zone, const ZoneHead& head, const VertexPlaces& places,
                     std::vector<std::string>& joined, std::vector<std::string>& warnings);

/// The pairs of nodes of a one-to-one connection of the zone to itself.
std::vector<PeriodicPair> lattice_pairs(const NodeView& connection, const Lattice& lattice);

/// Adds the cells as quadrilaterals or hexahedra, the first index running fastest. If the indices
/// are left-handed, all are turned over.
void add_cells(const Lattice& lattice, const VertexPlaces& places, MeshData& mesh);

class StructuredBoundary : public ZoneBoundary {
 public:
  StructuredBoundary(const Lattice& lattice, const MeshData& mesh)
      : lattice_(lattice), by_nodes_(mesh) {}
  std::vector<Face> faces_of(const PointSet& set,
                             std::vector<std::string>& warnings) const override;

 private:
  void check(const PointSet& set, const LatticePoint& p) const;
  /// The direction across the faces from p to q; 3: none, because they are no part of one side.
  std::size_t across(const PointSet& set, const LatticePoint& p, const LatticePoint& q) const;
  std::vector<Face> faces_in(const PointSet& set, LatticePoint p, LatticePoint q,
                             std::vector<std::string>& warnings) const;
  std::vector<Face> edges_along(LatticePoint p, const LatticePoint& q) const;
  std::vector<Face> faces_between(const LatticePoint& p, const LatticePoint& q,
                                  std::size_t across) const;

  const Lattice& lattice_;
  BoundaryByNodes by_nodes_;
};

}  // namespace winslow::io::cgns
