#include "core/vcv/virtual_control_volumes.h"

#include <cmath>
#include <numeric>
#include <string>

#include "core/error.h"

namespace winslow {

VirtualControlVolumes::VirtualControlVolumes(std::shared_ptr<const Topology> topology)
    : topology_(std::move(topology)),
      angles_(topology_->neighbour_rows().values.size(), 0.0),
      lengths_(topology_->neighbour_rows().values.size(), 0.0) {
  for (const Index node : topology_->free_nodes()) reset(node);
}

std::span<double> VirtualControlVolumes::row(std::vector<double>& values, Index node) {
  const auto begin =
      static_cast<std::size_t>(topology_->neighbour_rows().offsets[static_cast<std::size_t>(node)]);
  return {values.data() + begin, topology_->neighbours(node).size()};
}

std::span<const double> VirtualControlVolumes::row(const std::vector<double>& values,
                                                   Index node) const {
  const auto begin =
      static_cast<std::size_t>(topology_->neighbour_rows().offsets[static_cast<std::size_t>(node)]);
  return {values.data() + begin, topology_->neighbours(node).size()};
}

std::span<const double> VirtualControlVolumes::angles(Index node) const {
  return topology_->constrained(node) ? std::span<const double>{} : row(angles_, node);
}

std::span<const double> VirtualControlVolumes::lengths(Index node) const {
  return topology_->constrained(node) ? std::span<const double>{} : row(lengths_, node);
}

void VirtualControlVolumes::require_free(Index node) const {
  if (node < 0 || node >= topology_->node_count() || topology_->constrained(node) ||
      !topology_->used(node)) {
    throw UsageError("VCV of node " + std::to_string(node) +
                     ": the node is not a free node of the mesh");
  }
}

Vec2 VirtualControlVolumes::point(Index node, Index k) const {
  const auto angle = angles(node).first(static_cast<std::size_t>(k));
  const double phi = std::accumulate(angle.begin(), angle.end(), 0.0);
  return lengths(node)[static_cast<std::size_t>(k)] * Vec2(std::cos(phi), std::sin(phi));
}

void VirtualControlVolumes::set(Index node, std::span<const double> angles,
                                std::span<const double> lengths) {
  require_free(node);
  const std::string who = "VCV of node " + std::to_string(node);
  const std::size_t n = topology_->neighbours(node).size();
  if (angles.size() != n || lengths.size() != n) {
    throw UsageError(who + ": expected " + std::to_string(n) + " angles and lengths");
  }
  double sum = 0;
  for (const double angle : angles) {
    if (!(angle > 0) || !(n == 2 ? angle <= pi : angle < pi)) {
      throw UsageError(who + ": an angle lies outside (0, pi)");
    }
    sum += angle;
  }
  if (std::abs(sum - 2 * pi) > 1e-9) throw UsageError(who + ": the angles do not sum to 2 pi");
  for (const double length : lengths) {
    if (!(length > 0) || !std::isfinite(length)) {
      throw UsageError(who + ": an edge length is not positive");
    }
  }
  std::copy(angles.begin(), angles.end(), row(angles_, node).begin());
  std::copy(lengths.begin(), lengths.end(), row(lengths_, node).begin());
}

void VirtualControlVolumes::reset(Index node) {
  require_free(node);
  const auto angles = row(angles_, node);
  std::fill(angles.begin(), angles.end(), 2 * pi / static_cast<double>(angles.size()));
  const auto lengths = row(lengths_, node);
  std::fill(lengths.begin(), lengths.end(), 1.0);
}

}  // namespace winslow
