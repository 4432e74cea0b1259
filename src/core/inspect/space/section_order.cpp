#include "core/inspect/space/section_order.h"

#include <algorithm>
#include <string>

#include "core/error.h"
#include "core/mesh/curve_order.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// Elements by the first of their nodes in the order, of which `places` are the inverse.
std::vector<Index> by_first_node(const Topology& topology, const std::vector<Index>& places) {
  std::vector<Index> first(at(topology.element_count()));
  parallel_for(0, topology.element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      Index least = topology.node_count();
      for (const Index node : topology.element(e)) least = std::min(least, places[at(node)]);
      first[at(e)] = least;
    }
  });
  std::vector<Index> begin(places.size() + 1, 0);
  for (const Index place : first) ++begin[at(place) + 1];
  for (std::size_t k = 1; k < begin.size(); ++k) begin[k] += begin[k - 1];
  std::vector<Index> elements(first.size());
  for (std::size_t e = 0; e < first.size(); ++e)
    elements[at(begin[at(first[e])]++)] = static_cast<Index>(e);
  return elements;
}

}  // namespace

SectionOrder::SectionOrder(const Mesh& mesh) {
  const Topology& topology = *mesh.topology;
  if (topology.cell_dimension() != 3)
    throw UsageError("cuts by a plane: only for a volume mesh, and this is a " +
                     std::string(mesh_kind(topology)));
  // Nodes that no element uses may lie outside the box.
  nodes = along_curve(SpacePoints(mesh.coordinates), mesh.coordinates.size(), space_bounds(mesh));
  std::vector<Index> places(nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) places[at(nodes[k])] = static_cast<Index>(k);
  elements = by_first_node(topology, places);
  corners.offsets.reserve(elements.size() + 1);
  corners.values.reserve(topology.elements().values.size());
  for (const Index e : elements) {
    for (const Index node : topology.element(e)) corners.values.push_back(places[at(node)]);
    corners.end_row();
  }
}

}  // namespace winslow
