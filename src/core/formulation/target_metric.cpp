#include "core/formulation/target_metric.h"

#include "core/mesh/element_type.h"

namespace winslow {

namespace {

using Tetrahedra = std::span<const std::array<Index, 4>>;

std::vector<Eigen::Matrix3d> make(ElementType type, Tetrahedra tetrahedra) {
  std::vector<Eigen::Matrix3d> list;
  const auto places = regular_corners(type);
  for (const auto& corner : tetrahedra) {
    const auto place = [&](std::size_t k) { return Vec3(places[at(corner[k])].data()); };
    Edges3 edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = place(at(k + 1)) - place(0);
    list.push_back(volume_metric(edges));
  }
  return list;
}

std::array<std::vector<Eigen::Matrix3d>, 6> make_all(Tetrahedra (*tetrahedra)(ElementType)) {
  std::array<std::vector<Eigen::Matrix3d>, 6> lists;
  for (const ElementType type : all_element_types)
    if (shape_of(type).dimension == 3)
      lists[static_cast<std::size_t>(type)] = make(type, tetrahedra(type));
  return lists;
}

}  // namespace

const std::vector<Eigen::Matrix3d>& regular_metrics(ElementType type) {
  static const auto lists = make_all(corner_tetrahedra);
  return lists[static_cast<std::size_t>(type)];
}

const std::vector<Eigen::Matrix3d>& regular_edge_metrics(ElementType type) {
  static const auto lists = make_all(edge_tetrahedra);
  return lists[static_cast<std::size_t>(type)];
}

}  // namespace winslow
