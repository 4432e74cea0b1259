#include "core/vcv/sphere/sphere_edit.h"

#include <algorithm>
#include <string>

#include "core/error.h"
#include "core/vcv/sphere/solid_angle.h"
#include "core/vcv/vcv_checks.h"

namespace winslow {

namespace {

/// For each neighbour of the node, its place in the edit.
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
