#include "core/quality/surface_change.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "core/geometry/surface/triangulation.h"

namespace winslow {

namespace {

bool is_closed(const Topology& topology) {
  return std::ranges::none_of(topology.edges(),
                              [](const Topology::Edge& edge) { return edge.elements[1] < 0; });
}

std::optional<double> volume_of(const Mesh& mesh) {
  return is_closed(*mesh.topology) ? std::optional(enclosed_volume(mesh)) : std::nullopt;
}

double largest_of(std::span<const double> values) {
  return values.empty() ? 0 : *std::ranges::max_element(values);
}

}  // namespace

double enclosed_volume(const Mesh& mesh) {
  const SpacePoints x(mesh.coordinates);
  const Vec3 origin = !mesh.coordinates.empty() ? Vec3(x[0]) : Vec3(0, 0, 0);
  double volume = 0;
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    volume += (a - origin).dot((b - origin).cross(c - origin)) / 6;
  };
  for (Index e = 0; e < mesh.topology->element_count(); ++e) {
    const auto nodes = mesh.topology->element(e);
    if (nodes.size() == 3) {
      add(x[nodes[0]], x[nodes[1]], x[nodes[2]]);
      continue;
    }
    for (const auto& [a, b, c] : halves_of(x, nodes)) add(x[nodes[a]], x[nodes[b]], x[nodes[c]]);
  }
  return volume;
}

SurfaceChange compare_surfaces(const Mesh& before, const SurfaceDistance& to_before,
                               const Mesh& after, std::span<const double> after_to_before,
                               int threads) {
  SurfaceChange change;
  change.extent = to_before.extent();
  change.from_before = largest_of(element_distances(before, SurfaceDistance(after), threads));
  change.from_after = largest_of(after_to_before);
  change.volume_before = volume_of(before);
  change.volume_after = volume_of(after);
  return change;
}

SurfaceChange compare_surfaces(const Mesh& before, const Mesh& after, int threads) {
  const SurfaceDistance to_before(before);
  return compare_surfaces(before, to_before, after, element_distances(after, to_before, threads),
                          threads);
}

}  // namespace winslow
