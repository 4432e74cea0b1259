#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh_data.h"
#include "core/types.h"

namespace winslow {

class HalfEdgeMesh;  // OpenMesh connectivity; see core/mesh/half_edge.h

/// Compressed rows: row i holds values[offsets[i] .. offsets[i+1]).
struct CompressedRows {
  std::vector<Index> offsets{0};
  std::vector<Index> values;

  Index rows() const { return static_cast<Index>(offsets.size()) - 1; }
  std::span<const Index> operator[](Index row) const {
    const auto b = static_cast<std::size_t>(offsets[static_cast<std::size_t>(row)]);
    const auto n = static_cast<std::size_t>(offsets[static_cast<std::size_t>(row) + 1]) - b;
    return {values.data() + b, n};
  }
};

/// Connectivity of a mesh: built and checked once, shared and immutable from then on.
///
/// Elements are counter-clockwise (the sum of the signed areas of each connected part is positive);
/// an element that the file holds clockwise keeps its first node and has the others reversed.
class Topology {
 public:
  /// Builds connectivity from raw arrays. Orients elements consistently by walking over shared
  /// edges, so a tangled mesh is oriented rightly too.
  /// Throws MeshError: node id out of range, repeated node in an element, non-manifold edge or
  /// node, orientation that cannot be made consistent, a closed surface, marker edge that is no
  /// edge of an element.
  static std::shared_ptr<const Topology> build(const MeshData& data);
  ~Topology();

  Topology(const Topology&) = delete;
  Topology& operator=(const Topology&) = delete;

  int dimension() const { return 2; }
  Index node_count() const { return neighbours_.rows(); }
  Index element_count() const { return static_cast<Index>(types_.size()); }

  ElementType element_type(Index e) const { return types_[static_cast<std::size_t>(e)]; }
  /// Corners of an element, counter-clockwise.
  std::span<const Index> element(Index e) const { return elements_[e]; }
  const CompressedRows& elements() const { return elements_; }

  /// Edge neighbours of a node, counter-clockwise. For a boundary node the row starts and ends on
  /// the boundary. Empty for a node that no element uses.
  std::span<const Index> neighbours(Index node) const { return neighbours_[node]; }
  const CompressedRows& neighbour_rows() const { return neighbours_; }
  /// Elements around a node: entry k lies between neighbour k and neighbour k+1 (cyclic for an
  /// interior node; one fewer than the neighbours for a boundary node).
  std::span<const Index> star(Index node) const { return star_[node]; }

  /// True on a boundary loop or on any marker edge: nodes that smoothing never moves by itself.
  bool constrained(Index node) const { return constrained_[static_cast<std::size_t>(node)] != 0; }
  /// True if some element uses the node.
  bool used(Index node) const { return !neighbours(node).empty(); }
  /// Interior nodes that smoothing moves, ascending.
  std::span<const Index> free_nodes() const { return free_nodes_; }

  /// Unique edges; boundary edges have one element, elements[1] == -1.
  struct Edge {
    std::array<Index, 2> nodes;
    std::array<Index, 2> elements;
  };
  std::span<const Edge> edges() const { return edges_; }

  /// Closed boundary loops, each with the elements on its left.
  const std::vector<std::vector<Index>>& boundary_loops() const { return loops_; }

  /// Markers of the file or, if it has none at all, one per boundary loop ("loop_1", ...), in which
  /// case markers_from_file() is false and writers leave them out.
  const std::vector<Marker>& markers() const { return markers_; }
  bool markers_from_file() const { return markers_from_file_; }
  /// Index of the marker of that name, if any.
  std::optional<Index> find_marker(std::string_view name) const;
  /// Sorted unique nodes of a marker.
  std::span<const Index> marker_nodes(Index marker) const { return marker_nodes_[marker]; }
  /// Sorted unique nodes of several markers by name. Throws UsageError naming the known markers.
  std::vector<Index> nodes_of_markers(std::span<const std::string> names) const;
  /// Boundary edges that belong to no marker.
  Index unmarked_boundary_edges() const { return unmarked_edges_; }

  const std::vector<Region>& regions() const { return regions_; }
  /// Region of each element (index into regions() or -1); empty if there are no regions.
  std::span<const Index> element_regions() const { return element_region_; }

  /// Number of elements whose orientation was reversed on load.
  Index reversed_elements() const { return reversed_; }

  const HalfEdgeMesh& half_edges() const { return *half_edges_; }

 private:
  Topology();
  friend class TopologyBuilder;

  std::vector<ElementType> types_;
  CompressedRows elements_;
  CompressedRows neighbours_;
  CompressedRows star_;
  std::vector<unsigned char> constrained_;
  std::vector<Index> free_nodes_;
  std::vector<Edge> edges_;
  std::vector<std::vector<Index>> loops_;
  std::vector<Marker> markers_;
  bool markers_from_file_ = true;
  CompressedRows marker_nodes_;
  Index unmarked_edges_ = 0;
  std::vector<Region> regions_;
  std::vector<Index> element_region_;
  Index reversed_ = 0;
  std::unique_ptr<HalfEdgeMesh> half_edges_;
};

}  // namespace winslow
