#include "core/mesh/topology.h"

#include "core/error.h"
#include "core/mesh/half_edge.h"
#include "core/mesh/topology_builder.h"

namespace winslow {

namespace {

/// Place of the item with these sorted nodes in a list that is ordered by them.
template <typename List, typename Nodes, typename NodesOf>
std::optional<Index> place_of(const List& list, const Nodes& nodes, const NodesOf& nodes_of) {
  const auto it = std::lower_bound(
      list.begin(), list.end(), nodes,
      [&](const auto& item, const Nodes& wanted) { return nodes_of(item) < wanted; });
  if (it == list.end() || nodes_of(*it) != nodes) return std::nullopt;
  return static_cast<Index>(it - list.begin());
}

}  // namespace

Topology::Topology() = default;
Topology::~Topology() = default;

std::shared_ptr<const Topology> Topology::build(const MeshData& data) {
  return TopologyBuilder(data).build();
}

Index Topology::face_count() const {
  return static_cast<Index>(edges_.size() + volume_faces_.size());
}

Topology::SharedFace Topology::face(Index f) const {
  const auto i = static_cast<std::size_t>(f);
  if (cell_dimension() == 3) return volume_faces_[i];
  return {Face(edges_[i].nodes[0], edges_[i].nodes[1]), edges_[i].elements};
}

std::optional<Index> Topology::find_face(const Face& nodes) const {
  if (cell_dimension() == 3) {
    return place_of(volume_faces_, nodes.sorted(),
                    [](const SharedFace& face) { return face.nodes.sorted(); });
  }
  if (nodes.size() != 2) return std::nullopt;
  const std::array<Index, 2> ends{std::min(nodes[0], nodes[1]), std::max(nodes[0], nodes[1])};
  return place_of(edges_, ends, [](const Edge& edge) { return edge.nodes; });
}

std::span<const Topology::Edge> Topology::edges() const {
  if (cell_dimension() == 3) throw UsageError("a volume mesh has no edges with two elements");
  return edges_;
}

const std::vector<std::vector<Index>>& Topology::boundary_loops() const {
  if (cell_dimension() == 3) throw UsageError("a volume mesh has no boundary loops");
  return loops_;
}

const HalfEdgeMesh& Topology::half_edges() const {
  if (cell_dimension() == 3) throw UsageError("a volume mesh has no half-edges");
  std::call_once(half_edges_made_,
                 [this] { half_edges_ = make_half_edges(elements_, edges_, node_count()); });
  return *half_edges_;
}

std::string_view mesh_kind(const Topology& topology) {
  if (topology.cell_dimension() == 3) return "volume mesh";
  return topology.space_dimension() == 2 ? "plane mesh" : "surface mesh";
}

void require_plane(const Topology& topology, std::string_view what) {
  if (topology.space_dimension() == 2) return;
  throw UsageError(std::string(what) + ": only for a plane mesh, and this is a " +
                   std::string(mesh_kind(topology)));
}

void require_volume(const Topology& topology, std::string_view found) {
  if (topology.cell_dimension() == 3) return;
  throw UsageError(std::string(found) + std::string(mesh_kind(topology)));
}

std::vector<Face> node_link(const Topology& topology, Index node) {
  std::vector<Face> link;
  link.reserve(topology.star(node).size());
  for (const Index e : topology.star(node)) {
    const auto corners = topology.element(e);
    const auto corner = std::find(corners.begin(), corners.end(), node) - corners.begin();
    const ElementShape& shape = shape_of(topology.element_type(e));
    link.push_back(by_nodes(shape.links[static_cast<std::size_t>(corner)], corners));
  }
  return link;
}

}  // namespace winslow
