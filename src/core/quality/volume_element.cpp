#include "core/quality/volume_element.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/mesh/corner_tetrahedra.h"
#include "core/mesh/element_measure.h"
#include "core/quality/jacobian_sign.h"
#include "core/quality/volume_corner.h"

namespace winslow {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Circumradius over three times the inradius, 1 for the regular tetrahedron.
double radius_ratio_of(const VolumeCorner& corner) {
  const Vec3 a = corner.edges.col(0), b = corner.edges.col(1), c = corner.edges.col(2);
  const Vec3 bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
  const double area2 = bc.norm() + ca.norm() + ab.norm() + (bc + ca + ab).norm();
  const double numerator =
      (a.squaredNorm() * bc + b.squaredNorm() * ca + c.squaredNorm() * ab).norm();
  return numerator * area2 / (6 * corner.determinant * corner.determinant);
}

double scaled_determinant(const VolumeCorner& corner) {
  const double lengths =
      corner.edges.col(0).norm() * corner.edges.col(1).norm() * corner.edges.col(2).norm();
  return lengths > 0 ? corner.determinant / lengths : 0;
}

/// What a corner of the regular element has.
struct RegularCorner {
  Eigen::Matrix3d inverse;  // of its edges
  double scaled_determinant;
  double radius_ratio;
};

std::vector<RegularCorner> make_regular(ElementType type) {
  const auto places = regular_corners(type);
  std::vector<RegularCorner> list;
  for (const auto& corner : corner_tetrahedra(type)) {
    const auto place = [&](std::size_t k) { return Vec3(places[at(corner[k])].data()); };
    const VolumeCorner regular(place(0), place(1), place(2), place(3));
    list.push_back(
        {regular.edges.inverse(), scaled_determinant(regular), radius_ratio_of(regular)});
  }
  return list;
}

const std::vector<RegularCorner>& regular(ElementType type) {
  static const std::array<std::vector<RegularCorner>, 4> lists{
      make_regular(ElementType::tetrahedron), make_regular(ElementType::pyramid),
      make_regular(ElementType::prism), make_regular(ElementType::hexahedron)};
  return lists[static_cast<std::size_t>(type) - static_cast<std::size_t>(ElementType::tetrahedron)];
}

/// Largest value of a function of the corners' tetrahedra; infinite if one is inverted.
template <typename Measure>
double largest_of_corners(const SpacePoints& x, ElementType type, std::span<const Index> corners,
                          Measure&& measure) {
  double largest = 0;
  const auto tetrahedra = corner_tetrahedra(type);
  for (std::size_t k = 0; k < tetrahedra.size(); ++k) {
    const VolumeCorner corner(x, by_nodes(tetrahedra[k], corners));
    if (corner.inverted()) return unbounded;
    largest = std::max(largest, measure(corner, regular(type)[k]));
  }
  return largest;
}

}  // namespace

bool VolumeElement::inverted() const { return !has_positive_jacobian(x_, type_, corners_); }

double VolumeElement::scaled_jacobian() const {
  double smallest = unbounded;
  const auto tetrahedra = corner_tetrahedra(type_);
  for (std::size_t k = 0; k < tetrahedra.size(); ++k) {
    const VolumeCorner corner(x_, by_nodes(tetrahedra[k], corners_));
    double scaled = scaled_determinant(corner);
    if (type_ == ElementType::tetrahedron) {
      // One determinant, four corners: that with the longest edges counts.
      const auto length = [&](int i, int j) {
        return (corner.edges.col(i) - corner.edges.col(j)).norm();
      };
      const double l1 = corner.edges.col(0).norm(), l2 = corner.edges.col(1).norm(),
                   l3 = corner.edges.col(2).norm();
      const double l12 = length(0, 1), l13 = length(0, 2), l23 = length(1, 2);
      const double longest =
          std::max({l1 * l2 * l3, l1 * l12 * l13, l2 * l12 * l23, l3 * l13 * l23});
      scaled = longest > 0 ? corner.determinant / longest : 0;
    }
    smallest = std::min(smallest, scaled / regular(type_)[k].scaled_determinant);
  }
  return smallest;
}

double VolumeElement::radius_ratio() const {
  return largest_of_corners(x_, type_, corners_,
                            [](const VolumeCorner& corner, const RegularCorner& best) {
                              return radius_ratio_of(corner) / best.radius_ratio;
                            });
}

double VolumeElement::condition_number() const {
  return largest_of_corners(x_, type_, corners_,
                            [](const VolumeCorner& corner, const RegularCorner& best) {
                              const Eigen::Matrix3d j = corner.edges * best.inverse;
                              return j.norm() * j.inverse().norm() / 3;
                            });
}

double VolumeElement::solid_angle(std::size_t corner) const {
  const Face link = shape_of(type_).links[corner];
  const Vec3 p = x_[corners_[corner]];
  const auto edge = [&](std::size_t k) { return Vec3(x_[corners_[at(link[k])]] - p); };
  double sum = 0;
  for (std::size_t k = 1; k + 1 < link.size(); ++k)
    sum += solid_angle_of(edge(0), edge(k), edge(k + 1));
  return sum;
}

double VolumeElement::smallest_solid_angle() const {
  double smallest = unbounded;
  for (std::size_t k = 0; k < corners_.size(); ++k) smallest = std::min(smallest, solid_angle(k));
  return smallest;
}

double VolumeElement::largest_solid_angle() const {
  double largest = -unbounded;
  for (std::size_t k = 0; k < corners_.size(); ++k) largest = std::max(largest, solid_angle(k));
  return largest;
}

double VolumeElement::volume() const {
  return signed_volume6(coordinates_, type_, corners_, x_[corners_[0]]) / 6;
}

}  // namespace winslow
