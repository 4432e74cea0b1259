#pragma once

#include "core/geometry/periodic_pairs.h"
#include "core/mesh/mesh_data.h"
#include "io/cgns/zone_markers.h"
#include "io/cgns/zones.h"

namespace winslow::io::cgns {

/// Vertices of a structured zone: (i, j) from 1, i running fastest.
struct Lattice {
  std::int64_t ni = 0, nj = 0;
  std::vector<Index> node_of_vertex;  ///< the two vertices of a closed cut share a node
  Index nodes = 0;

  bool has(std::int64_t i, std::int64_t j) const { return i >= 1 && i <= ni && j >= 1 && j <= nj; }
  std::size_t vertex(std::int64_t i, std::int64_t j) const {
    return static_cast<std::size_t>(i - 1 + (j - 1) * ni);
  }
  Index node(std::int64_t i, std::int64_t j) const { return node_of_vertex[vertex(i, j)]; }
};

/// Numbers the nodes of a structured zone. A zone that touches itself one to one (the cut of a
/// C-grid or an O-grid: GridConnectivity1to1_t to the zone itself) is closed: the two vertices of a
/// pair become one node if their places agree up to 1e-7 of the extent. Otherwise, and for a
/// periodic connection, the cut stays open. `joined`: names of the closed connections. x, y:
/// coordinates of every vertex.
Lattice make_lattice(const NodeView& zone, const ZoneHead& head, const std::vector<double>& x,
                     const std::vector<double>& y, std::vector<std::string>& joined,
                     std::vector<std::string>& warnings);

/// The pairs of nodes of a one-to-one connection of the zone to itself.
std::vector<PeriodicPair> lattice_pairs(const NodeView& connection, const Lattice& lattice);

/// Adds the cells as quadrilaterals, i running fastest. If (i, j) is left-handed, all are turned
/// over.
void add_cells(const Lattice& lattice, const std::vector<double>& x, const std::vector<double>& y,
               MeshData& mesh);

class StructuredBoundary : public ZoneBoundary {
 public:
  StructuredBoundary(const Lattice& lattice, const MeshData& mesh)
      : lattice_(lattice), by_nodes_(mesh) {}
  std::vector<Face> faces_of(const PointSet& set,
                             std::vector<std::string>& warnings) const override;

 private:
  using Point = std::array<std::int64_t, 2>;
  void check(const PointSet& set, const Point& p) const;
  std::vector<Face> edges_along(Point p, Point q) const;
  std::vector<Face> faces_at(const PointSet& set, Point p, Point q) const;

  const Lattice& lattice_;
  BoundaryByNodes by_nodes_;
};

}  // namespace winslow::io::cgns
