#include "core/inspect/node_roles.h"

#include <exception>
#include <iterator>

#include "core/error.h"
#include "core/mesh/surface_faces.h"
#include "core/problem/node_classes.h"
#include "core/strategy/sliding.h"
#include "core/strategy/surface_shape.h"

namespace winslow {

namespace {

/// Edges of sliding markers of a volume mesh: all but those with two faces of one marker that
/// include less than the feature angle. Faces of one marker may have opposite directions in the
/// file.
std::vector<std::array<Index, 2>> features_of(const Mesh& mesh, const SlideOptions& slide) {
  const Markers& markers = mesh.topology->markers();
  std::vector<SurfaceFace> faces;
  for (const std::string& name : slide.markers)
    if (const auto m = markers.find(name))
      for (const Face& face : markers[at(*m)].faces) faces.push_back({face, -1, -1, *m});
  const SpacePoints x(mesh.coordinates);
  const auto normal_of = [&](Index f) -> Vec3 {
    return area_vector(x, faces[at(f)].nodes).normalized();
  };
  const double most = std::cos(slide.feature_angle * pi / 180);
  const SurfaceEdges edges = surface_edges(faces);
  std::vector<std::array<Index, 2>> features;
  for (Index k = 0; k < edges.faces.rows(); ++k) {
    const auto around = edges.faces[k];
    if (around.size() != 2 || faces[at(around[0])].marker != faces[at(around[1])].marker ||
        !(std::abs(normal_of(around[0]).dot(normal_of(around[1]))) >= most))
      features.push_back(edges.nodes[at(k)]);
  }
  return features;
}

/// Adds what was found of interfaces. held: receives the nodes that stay because regions meet
/// there.
void add_interfaces(const InterfaceReport& report, NodeRoles& out, std::vector<Index>& held) {
  for (const InterfaceNodes& nodes : report.each)
    if (nodes.held > 0)
      out.found.push_back(nodes.regions + ": " + std::to_string(nodes.held) +
                          (nodes.held == 1 ? " node stays" : " nodes stay") +
                          " where these regions meet");
  held = report.held;
}

/// The nodes of those markers that the mesh has, ascending.
std::vector<Index> nodes_of(const Mesh& mesh, const std::vector<std::string>& names) {
  std::vector<Index> nodes;
  const Markers& markers = mesh.topology->markers();
  for (const std::string& name : names)
    if (const auto m = markers.find(name))
      nodes.insert(nodes.end(), markers.nodes(*m).begin(), markers.nodes(*m).end());
  sort_unique(nodes);
  return nodes;
}

/// The classes of nodes with these options; none if the boundary cannot move like this.
std::optional<NodeClasses> classes_of(const Mesh& mesh, ResolvedSlide slide,
                                      const std::vector<std::string>& moving, NodeRoles& out,
                                      std::vector<Index>& where_regions_meet) {
  NodeClasses classes(mesh.topology);
  try {
    slide.interfaces = interfaces_in(slide.interfaces, !moving.empty());
    MovingBoundary boundary = make_boundary_move(slide, mesh, {}, classes);
    add_interfaces(boundary.interfaces, out, where_regions_meet);
    const std::vector<Index> bodies = nodes_of(mesh, moving);
    let_footholds_slide(slide, {}, mesh, {bodies, bodies}, boundary, classes);
    classes.set_prescribed(bodies);
    hold_spacing(slide, mesh, boundary, classes);
    for (const SlidingPart& part : boundary.sliding)
      out.found.push_back(part.marker + ": " + part.description + text_of(part.spacing) +
                          (part.gives_way ? ", gives way to what stands on it" : ""));
    for (const Foothold& foothold : boundary.footholds) {
      auto& names = foothold.goes_on ? out.give_way : out.in_the_way;
      names.insert(names.end(), foothold.markers.begin(), foothold.markers.end());
      if (!foothold.goes_on)
        out.found.push_back(foothold.name() + ": " + foothold.description + ", holds " +
                            std::to_string(foothold.nodes.size()) + " nodes of " + foothold.body);
    }
    for (auto* names : {&out.give_way, &out.in_the_way}) sort_unique(*names);
    for (const HeldFoothold& held : boundary.held_footholds)
      out.found.push_back(held.description());
    out.bends = boundary.bends;
    for (const PeriodicPairs& pairs : boundary.periodic)
      out.found.push_back(pairs.first + " and " + pairs.second + ": " + pairs.description);
    return classes;
  } catch (const Error& error) {
    out.fault = error.what();
    out.found.clear();
    where_regions_meet.clear();
    return std::nullopt;
  }
}

NodeRole role_of(NodeClass which, bool paired, bool on_sliding_marker) {
  if (paired) return NodeRole::periodic;
  switch (which) {
    case NodeClass::free:
      return NodeRole::free;
    case NodeClass::follows:
    case NodeClass::on_curve:
      return NodeRole::on_curve;
    case NodeClass::on_surface:
      return NodeRole::on_surface;
    case NodeClass::prescribed:
      return NodeRole::moves;
    case NodeClass::image:
      return NodeRole::periodic;
    case NodeClass::fixed:
      break;
  }
  return on_sliding_marker ? NodeRole::corner : NodeRole::fixed;
}

std::vector<std::string> joined(std::vector<std::string> names,
                                const std::vector<std::string>& more) {
  names.insert(names.end(), more.begin(), more.end());
  return names;
}

std::vector<unsigned char> marked(const Mesh& mesh, const std::vector<std::string>& names) {
  std::vector<unsigned char> flags(at(mesh.coordinates.size()), 0);
  for (const std::string& name : names)
    if (const auto m = mesh.topology->markers().find(name))
      for (const Index node : mesh.topology->markers().nodes(*m)) flags[at(node)] = 1;
  return flags;
}

/// Sets the roles of nodes that stay because regions meet there, then those of nodes that the
/// options name, and counts all roles.
void set_held(const SlideOptions& slide, std::span<const Index> where_regions_meet,
              NodeRoles& out) {
  for (const Index node : where_regions_meet)
    if (out.roles[at(node)] != NodeRole::moves) out.roles[at(node)] = NodeRole::regions;
  const auto known = [&](Index node) { return node >= 0 && at(node) < out.roles.size(); };
  for (const std::vector<Index>* nodes : {&slide.hold_nodes, &slide.smooth_nodes})
    std::ranges::copy_if(*nodes, std::back_inserter(out.overridden), known);
  sort_unique(out.overridden);
  for (const Index node : slide.hold_nodes)
    if (known(node) && out.roles[at(node)] != NodeRole::moves) out.roles[at(node)] = NodeRole::held;
  for (const NodeRole role : out.roles) ++out.counts[static_cast<std::size_t>(role)];
}

/// Roles in a surface mesh: all nodes slide, except those on feature lines and at their corners.
NodeRoles surface_roles(const MeshState& state, const ResolvedSlide& slide) {
  const Topology& topology = *state.mesh.topology;
  NodeRoles out;
  NodeClasses classes(state.mesh.topology);
  // A node that could slide and is held, to fix the rotation of a sphere, is no corner.
  std::vector<unsigned char> could_slide(at(topology.node_count()), 0);
  std::vector<Index> where_regions_meet;
  try {
    const auto shape = surface_shape(state, slide);
    slide_on_surface(*shape, state.mesh.coordinates, classes);
    add_interfaces(interfaces_of_surface(*shape, classes), out, where_regions_meet);
    out.bends = shape->boundary.bends;
    for (const SlidingPart& part : shape->boundary.parts) {
      out.found.push_back(part.description);
      for (const Index node : part.nodes) could_slide[at(node)] = 1;
    }
  } catch (const Error& error) {
    out.fault = error.what();
    classes.set_fixed(topology.interior_nodes());
  }
  for (Index node = 0; node < topology.node_count(); ++node) {
    out.roles.push_back(topology.used(node)
                            ? role_of(classes[node], false, could_slide[at(node)] == 0)
                            : NodeRole::fixed);
  }
  set_held(slide, where_regions_meet, out);
  const std::vector<SurfaceFace> faces = boundary_faces(topology);
  const SurfaceEdges edges = surface_edges(faces);
  const SpacePoints x(state.mesh.coordinates);
  const std::vector<unsigned char> sharp = feature_edges(x, faces, edges, slide.feature_angle);
  for (std::size_t k = 0; k < sharp.size(); ++k)
    if (sharp[k] != 0) out.features.push_back(edges.nodes[k]);
  return out;
}

}  // namespace

NodeRoles node_roles(const MeshState& state, const ResolvedSlide& slide,
                     const std::vector<std::string>& moving) {
  if (is_surface(*state.mesh.topology)) return surface_roles(state, slide);
  return node_roles(state.mesh, slide, moving);
}

NodeRoles node_roles(const Mesh& mesh, const ResolvedSlide& slide,
                     const std::vector<std::string>& moving) {
  NodeRoles out;
  std::vector<Index> where_regions_meet;
  const auto found = classes_of(mesh, slide, moving, out, where_regions_meet);
  const NodeClasses classes = found ? *found : NodeClasses(mesh.topology);
  const std::vector<unsigned char> sliding =
      marked(mesh, found ? joined(slide.markers, out.give_way) : std::vector<std::string>());
  const std::vector<unsigned char> moved = marked(mesh, moving);
  out.roles.resize(sliding.size());
  for (std::size_t i = 0; i < sliding.size(); ++i) {
    const auto node = static_cast<Index>(i);
    out.roles[i] = moved[i] != 0
                       ? NodeRole::moves
                       : role_of(classes[node], classes.tied().has_image(node), sliding[i] != 0);
  }
  set_held(slide, where_regions_meet, out);
  if (mesh.topology->kind() == MeshKind::volume) out.features = features_of(mesh, slide);
  return out;
}

}  // namespace winslow
