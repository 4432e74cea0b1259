#include "core/problem/run_validity.h"

#include <algorithm>

#include "core/quality/quality.h"

namespace winslow {

std::vector<Vec3> element_normals(const NodeClasses& classes, const Coordinates& x, int threads) {
  if (!classes.element_normals()) return {};
  return classes.element_normals()->at(x, threads);
}

Validity check_validity(const NodeClasses& classes, const Coordinates& x, int threads) {
  return check_validity(classes.topology(), x, threads, element_normals(classes, x, threads));
}

Validity validity_of_moving(const NodeClasses& classes, const Coordinates& x, int threads) {
  const Topology& topology = classes.topology();
  const std::vector<Vec3> normals = element_normals(classes, x, threads);
  Validity found = check_validity(topology, x, threads, normals);
  if (!is_surface(topology)) return found;
  std::vector<Index> still;
  for (Index e = 0; e < topology.element_count(); ++e)
    if (std::ranges::none_of(topology.element(e), [&](Index node) { return classes.moves(node); }))
      still.push_back(e);
  const Mesh mesh{classes.shared_topology(), x};
  const bool counts = std::ranges::any_of(still, [&](Index e) {
    return element_value(mesh, e, Metric::normalized_jacobian, normals) <= found.min_sine;
  });
  if (!counts) return found;
  std::vector<double> sines = element_values(mesh, Metric::normalized_jacobian, normals);
  for (const Index e : still) sines[at(e)] = 1;
  found.min_sine = *std::ranges::min_element(sines);
  return found;
}

}  // namespace winslow
