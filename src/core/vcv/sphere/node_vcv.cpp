#include "core/vcv/sphere/node_vcv.h"

#include <utility>

#include "core/error.h"
#include "core/vcv/sphere/sphere_link.h"
#include "core/vcv/virtual_control_volumes.h"

namespace winslow {

SphereStencil checked_stencil(const Topology& topology, Index node,
                              std::span<const Vec3> directions, std::span<const double> lengths) {
  require_vcv_node(topology, node);
  const std::string who = "VCV of node " + std::to_string(node);
  const std::size_t n = topology.neighbours(node).size();
  if (directions.size() != n || lengths.size() != n) {
    throw UsageError(who + ": expected " + std::to_string(n) + " directions and lengths");
  }
  SphereStencil stencil{{}, {lengths.begin(), lengths.end()}};
  for (const Vec3& direction : directions) stencil.directions.push_back(direction.normalized());
  if (!covers_sphere(SphereLink(topology, node), stencil.directions)) {
    throw UsageError(who + ": the directions do not cover the sphere once, a triangle is inverted");
  }
  require_edge_lengths(node, lengths);
  return stencil;
}

std::vector<Vec3> NodeVcv::points() const {
  std::vector<Vec3> points = stencil.directions;
  for (std::size_t k = 0; k < points.size(); ++k) points[k] *= stencil.lengths[k];
  return points;
}

NodeVcv make_node_vcv(const Topology& topology, const Coordinates& physical, Index node,
                      const VolumeVcvOptions& options, const SphereStencil* edited) {
  require_vcv_node(topology, node);
  NodeVcv vcv;
  vcv.node = node;
  vcv.link.assign(topology, node);
  const auto neighbours = topology.neighbours(node);
  const SpacePoints x(physical);
  std::vector<Vec3> directions(neighbours.size(), Vec3(0, 0, 0));
  if (options.angles != VcvAngles::equal) physical_directions(x, node, neighbours, directions);
  StarTargets targets;
  const auto wanted = targets.of_kind(options.angles, vcv.link, directions);
  vcv.targets.assign(wanted.begin(), wanted.end());
  vcv.edited = edited != nullptr;
  if (edited) {
    vcv.stencil = *edited;
    return vcv;
  }
  try {
    const auto seed = static_cast<std::uint64_t>(node);
    vcv.end = StarBuilder(options.construction)
                  .build(vcv.link, wanted, options.fit(), seed, directions)
                  .end;
  } catch (const NumericError& error) {
    throw MeshError(MeshEntity::node, node, "node " + std::to_string(node) + ": " + error.what());
  }
  vcv.stencil.directions = std::move(directions);
  vcv.stencil.lengths.assign(neighbours.size(), 1);
  if (options.length_power != 0)
    graded_lengths(x, node, neighbours, options.length_power, vcv.stencil.lengths);
  return vcv;
}

namespace {

/// For each neighbour of the node, its position in the edit.
std::vector<std::size_t> places(const Topology& topology, const VcvEdit& edit) {
  const auto neighbours = topology.neighbours(edit.node);
  std::vector<std::size_t> places(neighbours.size());
  for (std::size_t k = 0; k < places.size(); ++k) places[k] = k;
  if (edit.neighbours.empty()) return places;
  std::vector<Index> sorted = edit.neighbours;
  std::sort(sorted.begin(), sorted.end());
  if (!std::ranges::equal(sorted, neighbours)) {
    std::string list;
    for (const Index node : neighbours) list += (list.empty() ? "" : ", ") + std::to_string(node);
    throw UsageError("VCV of node " + std::to_string(edit.node) +
                     ": the neighbours are not those of the mesh, which are " + list +
                     " (in any order)");
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    const auto found = std::find(edit.neighbours.begin(), edit.neighbours.end(), neighbours[k]);
    places[k] = static_cast<std::size_t>(found - edit.neighbours.begin());
  }
  return places;
}

void apply(const Topology& topology, const VcvEdit& edit, SphereStencils& stencils) {
  require_vcv_node(topology, edit.node);
  if (edit.resets()) {
    stencils.erase(edit.node);
    return;
  }
  const std::string who = "VCV of node " + std::to_string(edit.node);
  if (!edit.angles.empty())
    throw UsageError(who + ": angles are for plane meshes; that of a volume mesh has directions");
  const std::size_t n = topology.neighbours(edit.node).size();
  if (edit.directions.size() != n || (!edit.lengths.empty() && edit.lengths.size() != n))
    throw UsageError(who + ": expected " + std::to_string(n) + " directions and lengths");
  std::vector<Vec3> directions;
  std::vector<double> lengths;
  for (const std::size_t place : places(topology, edit)) {
    directions.push_back(edit.directions[place]);
    lengths.push_back(edit.lengths.empty() ? 1 : edit.lengths[place]);
  }
  stencils[edit.node] = checked_stencil(topology, edit.node, directions, lengths);
}

}  // namespace

std::shared_ptr<const SphereStencils> edit_vcvs(const Topology& topology,
                                                const SphereStencils* before,
                                                std::span<const VcvEdit> edits) {
  SphereStencils stencils;
  if (before) stencils = *before;
  for (const VcvEdit& edit : edits) apply(topology, edit, stencils);
  if (stencils.empty()) return nullptr;
  return std::make_shared<const SphereStencils>(std::move(stencils));
}

VcvEdit edit_of(const Topology& topology, Index node, const SphereStencil& stencil) {
  const auto neighbours = topology.neighbours(node);
  return {node, {neighbours.begin(), neighbours.end()}, {}, stencil.lengths, stencil.directions};
}

LeastAngle least_angle_at(const SphereLink& link, std::span<const Vec3> directions, Index vertex) {
  const double equal = 4 * pi / link.triangle_count();
  LeastAngle least{2 * link.triangle_count() + 1.0, -1};
  for (const Index half_edge : link.outgoing(vertex)) {
    const Index t = half_edge / 3;
    const auto& [a, b, c] = link.triangles()[at(t)];
    const double share =
        solid_angle(directions[at(a)], directions[at(b)], directions[at(c)]) / equal;
    if (share < least.share) least = {share, t};
  }
  return least;
}

}  // namespace winslow
