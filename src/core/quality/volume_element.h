#pragma once

#include <span>

#include "core/mesh/coordinates.h"
#include "core/mesh/element_type.h"

namespace winslow {

/// One element of a volume mesh, as the metrics in space see it. A corner is compared with that of
/// the regular element of its type (regular_corners()): unit edges, equilateral triangles, square
/// faces. Definitions: see Metric.
class VolumeElement {
 public:
  VolumeElement(const Coordinates& x, ElementType type, std::span<const Index> corners)
      : coordinates_(x), x_(x), type_(type), corners_(corners) {}

  bool inverted() const;  ///< the Jacobian is not positive all over it
  double scaled_jacobian() const;
  double radius_ratio() const;      ///< infinite where inverted
  double condition_number() const;  ///< infinite where inverted
  double smallest_solid_angle() const;
  double largest_solid_angle() const;
  double volume() const;

 private:
  double solid_angle(std::size_t corner) const;

  const Coordinates& coordinates_;
  SpacePoints x_;
  ElementType type_;
  std::span<const Index> corners_;
};

}  // namespace winslow
