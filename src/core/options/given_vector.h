#pragma once

#include "core/types.h"

namespace winslow {

/// A vector that remembers whether the user gave it by two numbers (plane) or three (space).
///
///   GivenVector shift = Vec2(1, 2);                // by two numbers
///   shift = GivenVector::of_three(Vec3(1, 2, 0));  // by three
///   shift = Vec3(1, 2, 0);                         // by none: the program found it
///
/// In arithmetic it is an ordinary Vec3, whose third component is 0 if two numbers were given. The
/// number of components matters only to readers and writers of commands, and to the check of a
/// command against its mesh.
class GivenVector : public Vec3 {
 public:
  GivenVector() : Vec3(Vec3::Zero()) {}
  GivenVector(double x, double y) : GivenVector(Vec2(x, y)) {}
  GivenVector(double x, double y, double z) : Vec3(x, y, z) {}
  template <class Derived>
  GivenVector(const Eigen::MatrixBase<Derived>& vector) : Vec3(Vec3::Zero()) {
    constexpr int rows = Derived::RowsAtCompileTime;
    static_assert(rows == 2 || rows == 3);
    head<rows>() = vector;
    if (rows == 2) numbers_ = 2;
  }
  static GivenVector of_three(const Vec3& vector) {
    GivenVector given(vector);
    given.numbers_ = 3;
    return given;
  }
  /// The vector with as many numbers as the mesh has dimensions.
  static GivenVector of(int dimension, const Vec3& vector) {
    GivenVector given(vector);
    given.tail(3 - dimension).setZero();
    given.numbers_ = dimension;
    return given;
  }

  template <class Derived>
  GivenVector& operator=(const Eigen::MatrixBase<Derived>& vector) {
    return *this = GivenVector(vector);
  }

  /// 2 or 3; `otherwise` if the program computed the vector.
  int numbers(int otherwise) const { return numbers_ == 0 ? otherwise : numbers_; }
  /// True if it was given by three numbers of any value, or computed with a nonzero z.
  bool leaves_plane() const { return numbers_ == 3 || z() != 0; }

  /// Compares the components only, not the number of components given.
  friend bool operator==(const GivenVector& a, const GivenVector& b) {
    return a.vector() == b.vector();
  }
  template <class Derived>
  friend bool operator==(const GivenVector& a, const Eigen::MatrixBase<Derived>& b) {
    return a.vector() == GivenVector(b).vector();
  }

 private:
  const Vec3& vector() const { return *this; }

  int numbers_ = 0;
};

}  // namespace winslow
