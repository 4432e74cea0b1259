#include "core/mesh/corner_tetrahedra.h"

#include <cmath>
#include <vector>

namespace winslow {

namespace {

std::vector<std::array<Index, 4>> make(ElementType type) {
  std::vector<std::array<Index, 4>> list;
  const auto links = shape_of(type).links;
  const std::size_t corners = type == ElementType::tetrahedron ? 1 : links.size();
  for (std::size_t k = 0; k < corners; ++k) {
    if (links[k].size() == 3)
      list.push_back({static_cast<Index>(k), links[k][0], links[k][1], links[k][2]});
  }
  return list;
}

}  // namespace

std::span<const std::array<Index, 4>> corner_tetrahedra(ElementType type) {
  static const std::array<std::vector<std::array<Index, 4>>, 6> lists{
      {{},
       {},
       make(ElementType::tetrahedron),
       make(ElementType::pyramid),
       make(ElementType::prism),
       make(ElementType::hexahedron)}};
  return lists[static_cast<std::size_t>(type)];
}

std::span<const std::array<double, 3>> regular_corners(ElementType type) {
  using Corners = std::vector<std::array<double, 3>>;
  static const double half = 0.5, third = std::sqrt(3.0) / 6, high = std::sqrt(3.0) / 2;
  static const Corners tetrahedron{
      {0, 0, 0}, {1, 0, 0}, {half, high, 0}, {half, third, std::sqrt(2.0 / 3.0)}};
  static const Corners pyramid{
      {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {half, half, std::sqrt(0.5)}};
  static const Corners prism{{0, 0, 0}, {1, 0, 0}, {half, high, 0},
                             {0, 0, 1}, {1, 0, 1}, {half, high, 1}};
  switch (type) {
    case ElementType::tetrahedron:
      return tetrahedron;
    case ElementType::pyramid:
      return pyramid;
    case ElementType::prism:
      return prism;
    default:
      return shape_of(type).corners;  // the unit cube
  }
}

}  // namespace winslow
