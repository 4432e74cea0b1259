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
                                      std::span<const std::string> names, double feature_angle,
                                      bool features, const ReferenceSurface* reference,
                                      std::span<const PeriodicPairs> periodic) {
  const bool surface = topology.cell_dimension() != topology.space_dimension();
  if (surface && !names.empty())
    throw UsageError("all nodes of a surface mesh slide: expected no marker, found \"" +
                     names.front() + "\"");
  const std::vector<Index> markers = indices_of(topology, names);
  const bool plane = topology.space_dimension() == 2;
  if (plane && reference)
    throw UsageError(reference->source + ": a reference surface is for meshes in space, and this " +
                     "is a plane mesh");
  SlidingBoundary boundary =
      plane       ? sliding_on_curves(topology, x, markers, feature_angle, periodic)
      : reference ? sliding_on_reference(topology, x, markers, feature_angle, features, *reference)
                  : sliding_on_surfaces(topology, x, markers, feature_angle, features, periodic);
  for (const std::string& name : names) {
    bool slides = false;
    for (const SlidingPart& part : boundary.parts) slides |= part.marker == name;
    if (!slides)
      throw UsageError("no node of marker \"" + name +
                       "\" can slide: each lies at a corner or meets another marker");
  }
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
  return x;
}

}  // namespace winslow
