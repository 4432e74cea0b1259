#pragma once

#include <array>
#include <cstddef>

#include "core/types.h"

namespace winslow {

/// Orthonormal directions in which a node may move, one per unknown. In the plane their third
/// component is zero.
class TangentFrame {
 public:
  TangentFrame() = default;
  /// The axes of a space of that many dimensions.
  static TangentFrame axes(int dimension);
  void add(const Vec3& direction) { directions_[static_cast<std::size_t>(count_++)] = direction; }

  int count() const { return count_; }
  const Vec3& operator[](int k) const { return directions_[static_cast<std::size_t>(k)]; }
  const Vec3* begin() const { return directions_.data(); }
  const Vec3* end() const { return directions_.data() + count_; }

  bool operator==(const TangentFrame&) const = default;

 private:
  std::array<Vec3, 3> directions_{Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};
  int count_ = 0;
};

}  // namespace winslow
