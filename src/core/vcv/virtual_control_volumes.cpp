#include "core/vcv/virtual_control_volumes.h"

#include <cmath>

#include "core/error.h"
#include "core/mesh/polygon.h"

namespace winslow {

void require_vcv_node(const Topology& topology, Index node) {
  if (node < 0 || node >= topology.node_count() || topology.on_boundary(node) ||
      !topology.used(node)) {
    throw UsageError("VCV of node " + std::to_string(node) +
                     ": the node is not a free node of the mesh");
  }
}

void require_edge_lengths(Index node, std::span<const double> lengths) {
  const std::string who = "VCV of node " + std::to_string(node);
  for (const double length : lengths) {
    if (!(length > 0) || !std::isfinite(length)) {
      throw UsageError(who + ": an edge length is not positive");
    }
  }
  // Above this ratio the short edges are below the round-off of the long ones.
  constexpr double most_stretched = 1e12;
  const auto [shortest, longest] = std::ranges::minmax(lengths);
  if (longest > most_stretched * shortest) {
    throw UsageError(who + ": the longest edge is more than 1e12 times the shortest");
  }
}

VirtualControlVolumes::VirtualControlVolumes(std::shared_ptr<const Topology> topology)
    : topology_(std::move(topology)) {
  if (topology_->cell_dimension() != 2) require_plane(*topology_, "virtual control volumes");
  for (const Index node : topology_->interior_nodes()) {
    const std::size_t n = topology_->neighbours(node).size();
    if (n >= equal_.size()) equal_.resize(n + 1);
    if (!equal_[n].angles.empty()) continue;
    equal_[n].angles.assign(n, 2 * pi / static_cast<double>(n));
    equal_[n].lengths.assign(n, 1.0);
  }
  if (topology_->has_polygons()) find_hanging_nodes();
}

void VirtualControlVolumes::find_hanging_nodes() {
  for (const Index node : topology_->interior_nodes()) {
    const auto star = topology_->star(node);
    std::vector<std::size_t> flat;
    for (std::size_t k = 0; k < star.size(); ++k)
      if (is_flat_corner(topology_->shape(star[k]), index_of(topology_->element(star[k]), node)))
        flat.push_back(k);
    if (star.size() < 3 || flat.size() != 1) continue;
    Stencil& stencil = hanging_[node];
    stencil.angles.assign(star.size(), pi / static_cast<double>(star.size() - 1));
    stencil.angles[flat[0]] = pi;
    stencil.lengths.assign(star.size(), 1.0);
  }
}

const VirtualControlVolumes::Stencil* VirtualControlVolumes::stencil(Index node) const {
  if (topology_->on_boundary(node)) return nullptr;
  if (!edited_.empty()) {
    const auto found = edited_.find(node);
    if (found != edited_.end()) return &found->second;
  }
  return equal_stencil(node);
}

const VirtualControlVolumes::Stencil* VirtualControlVolumes::equal_stencil(Index node) const {
  if (topology_->on_boundary(node)) return nullptr;
  if (!hanging_.empty()) {
    const auto found = hanging_.find(node);
    if (found != hanging_.end()) return &found->second;
  }
  const std::size_t n = topology_->neighbours(node).size();
  return n < equal_.size() ? &equal_[n] : nullptr;
}

std::span<const double> VirtualControlVolumes::angles(Index node) const {
  const Stencil* s = stencil(node);
  return s ? std::span<const double>(s->angles) : std::span<const double>{};
}

std::span<const double> VirtualControlVolumes::equal_angles(Index node) const {
  const Stencil* s = equal_stencil(node);
  return s ? std::span<const double>(s->angles) : std::span<const double>{};
}

std::span<const double> VirtualControlVolumes::lengths(Index node) const {
  const Stencil* s = stencil(node);
  return s ? std::span<const double>(s->lengths) : std::span<const double>{};
}

Vec2 VirtualControlVolumes::point(Index node, Index k) const {
  const auto angle = angles(node).first(static_cast<std::size_t>(k));
  const double phi = std::accumulate(angle.begin(), angle.end(), 0.0);
  return lengths(node)[static_cast<std::size_t>(k)] * Vec2(std::cos(phi), std::sin(phi));
}

void VirtualControlVolumes::set(Index node, std::span<const double> angles,
                                std::span<const double> lengths) {
  require_vcv_node(*topology_, node);
  const std::string who = "VCV of node " + std::to_string(node);
  const std::size_t n = topology_->neighbours(node).size();
  if (angles.size() != n || lengths.size() != n) {
    throw UsageError(who + ": expected " + std::to_string(n) + " angles and lengths");
  }
  double sum = 0;
  const auto equal = equal_angles(node);
  for (std::size_t k = 0; k < n; ++k) {
    const bool straight = equal[k] == pi;  // one of two edges, or the polygon at a hanging node
    if (!(angles[k] > 0) || !(straight ? angles[k] <= pi : angles[k] < pi)) {
      throw UsageError(who + ": an angle lies outside (0, pi)");
    }
    sum += angles[k];
  }
  if (std::abs(sum - 2 * pi) > 1e-9) throw UsageError(who + ": the angles do not sum to 2 pi");
  require_edge_lengths(node, lengths);
  edited_[node] = {{angles.begin(), angles.end()}, {lengths.begin(), lengths.end()}};
}

void VirtualControlVolumes::reset(Index node) {
  require_vcv_node(*topology_, node);
  edited_.erase(node);
}

}  // namespace winslow
