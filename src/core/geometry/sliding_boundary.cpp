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

}  // namespace

SlidingBoundary SlidingBoundary::find(const Topology& topology, const Coordinates& x,
                                      std::span<const std::string> names, double feature_angle,
                                      bool features) {
  const bool surface = topology.cell_dimension() != topology.space_dimension();
  if (surface && !names.empty())
    throw UsageError("all nodes of a surface mesh slide: expected no marker, found \"" +
                     names.front() + "\"");
  const std::vector<Index> markers = indices_of(topology, names);
  SlidingBoundary boundary =
      topology.space_dimension() == 2
          ? sliding_on_curves(topology, x, markers, feature_angle)
          : sliding_on_surfaces(topology, x, markers, feature_angle, features);
  for (const std::string& name : names) {
    bool slides = false;
    for (const SlidingPart& part : boundary.parts) slides |= part.marker == name;
    if (!slides)
      throw UsageError("no node of marker \"" + name +
                       "\" can slide: each lies at a corner or meets another marker");
  }
  return boundary;
}

}  // namespace winslow
