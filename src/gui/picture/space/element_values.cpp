#include "gui/picture/space/element_values.h"

#include <algorithm>

#include "core/parallel/parallel_for.h"
#include "core/quality/quality.h"
#include "core/quality/surface_distance.h"
#include "core/quality/volume_element.h"
#include "core/strategy/surface_shape.h"

namespace winslow::gui {

std::vector<Vec3> normals_of(const Mesh& mesh, const std::shared_ptr<const Mesh>& given) {
  const auto shape = own_shape(given ? *given : mesh);
  return shape ? shape->normals->at(mesh.coordinates, 0) : std::vector<Vec3>();
}

std::vector<unsigned char> inverted_elements(const Mesh& mesh, std::span<const Vec3> normals) {
  const Topology& topology = *mesh.topology;
  std::vector<unsigned char> inverted(at(topology.element_count()));
  if (is_surface(topology)) {
    const auto sines = element_values(mesh, Metric::normalized_jacobian, normals);
    for (std::size_t e = 0; e < sines.size(); ++e) inverted[e] = sines[e] > 0 ? 0 : 1;
    return inverted;
  }
  parallel_for(0, topology.element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      const VolumeElement element(mesh.coordinates, topology.element_type(e), topology.element(e));
      inverted[at(e)] = element.inverted() ? 1 : 0;
    }
  });
  return inverted;
}

std::vector<double> values_of(const Mesh& mesh, const ElementField& field,
                              const std::shared_ptr<const Mesh>& given,
                              std::span<const Vec3> normals) {
  if (!is_surface(*mesh.topology)) return element_values(mesh, *field.metric());
  return surface_values(mesh, field, normals, SurfaceDistance(given ? *given : mesh));
}

std::vector<unsigned char> worse_than(double threshold, const ElementField& field,
                                      std::span<const double> values) {
  const bool larger = field_info(field).larger_is_better;
  std::vector<unsigned char> chosen;
  chosen.reserve(values.size());
  // What is not a number is no good element either.
  for (const double v : values)
    chosen.push_back((larger ? v >= threshold : v <= threshold) ? 0 : 1);
  return chosen;
}

Index count_of(std::span<const unsigned char> flags) {
  return static_cast<Index>(std::ranges::count(flags, 1));
}

}  // namespace winslow::gui
