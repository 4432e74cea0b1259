#include "core/strategy/mesh_state.h"

#include "core/error.h"

namespace winslow {

namespace {

std::string list_of(std::span<const Index> nodes) {
  std::string text;
  for (const Index node : nodes) text += (text.empty() ? "" : " ") + std::to_string(node);
  return text;
}

/// The first difference of a reference mesh from a mesh; empty: none.
std::string difference(const Topology& reference, const Topology& mesh) {
  const auto counts = [](const char* what, Index found, Index expected) {
    return "found " + std::to_string(found) + ' ' + what + ", expected " + std::to_string(expected);
  };
  if (reference.cell_dimension() != mesh.cell_dimension() || reference.kind() != mesh.kind())
    return "it is a mesh of another dimension";
  if (reference.node_count() != mesh.node_count())
    return counts("nodes", reference.node_count(), mesh.node_count());
  if (reference.element_count() != mesh.element_count())
    return counts("elements", reference.element_count(), mesh.element_count());
  // Where corners become flat, or no longer are, another type may be read.
  const auto given_by_faces = [](ElementType type) {
    return type == ElementType::polyhedron || type == ElementType::polygon;
  };
  const auto alike = [&](ElementType a, ElementType b) {
    return a == b || given_by_faces(a) || given_by_faces(b);
  };
  for (Index e = 0; e < mesh.element_count(); ++e)
    if (!alike(reference.element_type(e), mesh.element_type(e)) ||
        !std::ranges::equal(reference.element(e), mesh.element(e)))
      return "element " + std::to_string(e) + " has the nodes " + list_of(reference.element(e)) +
             ", expected " + list_of(mesh.element(e));
  const Markers &there = reference.markers(), &here = mesh.markers();
  for (const Marker& marker : here) {
    const auto found = there.find(marker.name);
    if (!found) return "marker \"" + marker.name + "\" is missing";
    if (!std::ranges::equal(there.nodes(*found), here.nodes(*here.find(marker.name))))
      return "marker \"" + marker.name + "\" has other nodes";
  }
  return {};
}

bool has_flat_corners(const Topology& topology) {
  return topology.has_polyhedra() || topology.has_polygons();
}

bool same_parts(const Topology& a, const Topology& b) {
  const auto same_marker = [](const Marker& x, const Marker& y) {
    return x.name == y.name && x.tag == y.tag && x.faces == y.faces;
  };
  const auto same_region = [](const Region& x, const Region& y) {
    return x.name == y.name && x.tag == y.tag;
  };
  return std::ranges::equal(a.markers().list(), b.markers().list(), same_marker) &&
         std::ranges::equal(a.regions(), b.regions(), same_region) &&
         std::ranges::equal(a.element_regions(), b.element_regions());
}

}  // namespace

MeshState with_reference(MeshState state, const Mesh& reference) {
  const std::string fault = difference(*reference.topology, *state.mesh.topology);
  if (!fault.empty())
    throw UsageError("the reference mesh does not have the connectivity of the mesh: " + fault +
                     "; give the file from which this mesh was moved");
  // The reference mesh decides which corners are flat: a motion bends them.
  if ((has_flat_corners(*reference.topology) || has_flat_corners(*state.mesh.topology)) &&
      same_parts(*reference.topology, *state.mesh.topology))
    state = make_state({reference.topology, std::move(state.mesh.coordinates)});
  state.reference = std::make_shared<const Coordinates>(reference.coordinates);
  return state;
}

}  // namespace winslow
