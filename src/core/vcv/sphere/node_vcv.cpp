#include "core/vcv/sphere/node_vcv.h"

#include <string>
#include <utility>

#include "core/error.h"
#include "core/vcv/vcv_checks.h"

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

}  // namespace winslow
