#include "core/formulation/volume_metric.h"

#include "core/mesh/corner_tetrahedra.h"

namespace winslow {

namespace {

std::vector<Eigen::Matrix3d> make(ElementType type) {
  std::vector<Eigen::Matrix3d> list;
  const auto places = regular_corners(type);
  for (const auto& corner : corner_tetrahedra(type)) {
    const auto place = [&](std::size_t k) { return Vec3(places[at(corner[k])].data()); };
    Edges3 edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = place(at(k + 1)) - place(0);
    list.push_back(volume_metric(edges));
  }
  return list;
}

}  // namespace

const std::vector<Eigen::Matrix3d>& regular_metrics(ElementType type) {
  static const std::array<std::vector<Eigen::Matrix3d>, 6> lists{{{},
                                                                  {},
                                                                  make(ElementType::tetrahedron),
                                                                  make(ElementType::pyramid),
                                                                  make(ElementType::prism),
                                                                  make(ElementType::hexahedron)}};
  return lists[static_cast<std::size_t>(type)];
}

}  // namespace winslow
