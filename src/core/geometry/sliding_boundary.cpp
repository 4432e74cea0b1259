#include "core/geometry/sliding_boundary.h"

#include "core/error.h"
#include "core/geometry/boundary_kinds.h"

namespace winslow {

namespace {

std::vector<Index> indices_of(const Topology& topology, std::span<const std::string> names) {
  topology.markers().nodes_of(names);  // names the markers that there are, if one is not known
  std::vector<Index> indices;
  for (const std::string& name : names) indices.push_back(*topology.markers().find(name));
  return indices;
}

void require_nodes(const Topology& topology, std::span<const Index> nodes) {
  for (const Index node : nodes)
    if (node < 0 || node >= topology.node_count())
      throw UsageError("found node " + std::to_string(node) + " to hold or to make smooth, " +
                       "expected 0 to " + std::to_string(topology.node_count() - 1));
}

/// Nodes that are held are taken out of what slides; the curves and surfaces still run through
/// them.
void take_out(SlidingBoundary& boundary, std::vector<Index> nodes) {
  std::ranges::sort(nodes);
  for (SlidingPart& part : boundary.parts)
    std::erase_if(part.nodes, [&](Index node) { return std::ranges::binary_search(nodes, node); });
  std::erase_if(boundary.parts, [](const SlidingPart& part) { return part.nodes.empty(); });
  for (const Index node : nodes) boundary.places.erase(node);
}

}  // namespace

std::string text_of(Spacing spacing) {
  switch (spacing) {
    case Spacing::turns:
      return ", spacing held: turns as a whole";
    case Spacing::ends:
      return ", spacing held: follows its ends";
    case Spacing::stays:
      return ", spacing held: stays between its ends";
    case Spacing::free:
      break;
  }
  return {};
}

SlidingBoundary SlidingBoundary::find(const Topology& topology, const Coordinates& x,
                                      std::span<const std::string> names, const FeatureRules& rules,
                                      const ReferenceSurface* reference,
                                      std::span<const PeriodicPairs> periodic) {
  require_nodes(topology, rules.hold);
  require_nodes(topology, rules.smooth);
  const bool surface = topology.cell_dimension() != topology.space_dimension();
  if (surface && !names.empty())
    throw UsageError("all nodes of a surface mesh slide: expected no marker, found \"" +
                     names.front() + "\"");
  const std::vector<Index> markers = indices_of(topology, names);
  const bool plane = topology.space_dimension() == 2;
  if (plane && reference)
    throw UsageError(reference->source + ": a reference surface is for meshes in space, and this " +
                     "is a plane mesh");
  SlidingBoundary boundary = plane ? sliding_on_curves(topology, x, markers, rules, periodic)
                             : reference
                                 ? sliding_on_reference(topology, x, markers, rules, *reference)
                                 : sliding_on_surfaces(topology, x, markers, rules, periodic);
  for (const std::string& name : names) {
    bool slides = false;
    for (const SlidingPart& part : boundary.parts) slides |= part.marker == name;
    if (!slides)
      throw UsageError("no node of marker \"" + name +
                       "\" can slide: each lies at a corner or meets another marker");
  }
  take_out(boundary, rules.hold);
  return boundary;
}

Coordinates put_on(const SlidingBoundary& boundary, Coordinates x) {
  for (const SlidingPart& part : boundary.parts)
    for (const Index node : part.nodes) {
      if (x.dimension() == 3) {
        x.set_xyz(node, boundary.geometry->foot(node, x.xyz(node)).point);
      } else {
        const Vec2 p = x.xy(node);
        x.set_xy(node, boundary.geometry->foot(node, Vec3(p.x(), p.y(), 0)).point.head<2>());
      }
    }
  for (const auto& [node, place] : boundary.places) x.set_xyz(node, place);
  return x;
}

}  // namespace winslow
