#include "gui/document/selection/space_pivot.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace winslow::gui {

namespace {

/// A line has two directions: the one that is positive along the axis that it follows most.
Vec3 upright(const Vec3& direction) {
  Index most = 0;
  direction.cwiseAbs().maxCoeff(&most);
  Vec3 axis = direction[most] < 0 ? Vec3(-direction) : direction;
  // What rounding leaves of a zero would be shown, and kept in recipes.
  for (Index k = 0; k < 3; ++k)
    if (std::abs(axis[k]) < 1e-12) axis[k] = 0;
  return axis;
}

/// Twice the area vector of a polygon (Newell).
Vec3 area_of(const std::vector<Index>& nodes, const Coordinates& x) {
  Vec3 area(0, 0, 0);
  const Vec3 origin = x.xyz(nodes.front());
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k)
    area += (x.xyz(nodes[k]) - origin).cross(x.xyz(nodes[k + 1]) - origin);
  return area;
}

}  // namespace

std::optional<SpacePivot> pivot_at(const PivotSource& source, const Coordinates& x,
                                   const Vec3& axis) {
  const auto exists = [&](Index node) { return node >= 0 && node < x.size(); };
  if (source.nodes.empty() || !std::ranges::all_of(source.nodes, exists)) return std::nullopt;
  SpacePivot pivot{source.from, source.nodes, Vec3(0, 0, 0), axis};
  for (const Index node : source.nodes) pivot.point += x.xyz(node);
  pivot.point /= static_cast<double>(source.nodes.size());
  if (source.nodes.size() == 1) return pivot;
  const Vec3 direction = source.nodes.size() == 2
                             ? Vec3(x.xyz(source.nodes[1]) - x.xyz(source.nodes[0]))
                             : area_of(source.nodes, x);
  if (!(direction.norm() > 0)) return std::nullopt;
  const Vec3 unit = direction.normalized();
  pivot.axis = source.nodes.size() == 2 ? upright(unit) : unit;
  return pivot;
}

const char* pivot_from_name(PivotFrom from) {
  switch (from) {
    case PivotFrom::centre:
      return "centre";
    case PivotFrom::typed:
      return "numbers";
    case PivotFrom::node:
      return "node";
    case PivotFrom::edge:
      return "edge";
    case PivotFrom::nodes:
      return "two nodes";
    case PivotFrom::face:
      return "face";
  }
  return "";
}

}  // namespace winslow::gui
