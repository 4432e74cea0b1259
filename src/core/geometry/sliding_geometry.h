#pragma once

#include <array>
#include <memory>
#include <vector>

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

/// The place on a curve or a surface that is nearest to a point, and how the geometry runs on from
/// there: to second order a node that moves by u_k along the directions of the frame and is put
/// back onto the geometry comes to
///
///   point + sum_k u_k frame_k + 1/2 sum_kl u_k u_l bend_kl,
///
/// bend at right angles to the frame (the curvature vector of a curve, the second fundamental form
/// of a surface). In units of the mesh, bends in 1 / that.
struct Foot {
  Vec3 point{0, 0, 0};
  TangentFrame frame;  ///< one direction of a curve, two of a surface
  std::array<Vec3, 3> bend{Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};  ///< 11, 12, 22
};

/// What the nodes that slide slide on. It does not change while they do, and its answers depend on
/// its arguments alone.
class SlidingGeometry {
 public:
  virtual ~SlidingGeometry() = default;
  /// For a node that slides (others: UsageError), the place on its curve or surface nearest to a
  /// point. Frames of places near one another are near one another.
  virtual Foot foot(Index node, const Vec3& point) const = 0;
};

/// A geometry that remembers the last two feet of each node: a step of a solver asks for those of
/// the mesh that it starts from and of the one that it tries many times over, and a search in a
/// triangulation takes long. The foot of a place that is a foot itself is that foot, bit by bit.
///
/// Different nodes may be asked about at the same time, one node by one thread only: it belongs to
/// one run.
class RememberedFeet final : public SlidingGeometry {
 public:
  RememberedFeet(std::shared_ptr<const SlidingGeometry> geometry, Index node_count)
      : geometry_(std::move(geometry)), memory_(at(node_count)) {}

  Foot foot(Index node, const Vec3& point) const override;

 private:
  struct Place {
    Vec3 asked_for{0, 0, 0};
    Foot foot;
    bool known = false;
  };
  struct Memory {
    std::array<Place, 2> places;
    std::size_t last = 0;  // the one that was asked for last
  };

  std::shared_ptr<const SlidingGeometry> geometry_;
  mutable std::vector<Memory> memory_;
};

}  // namespace winslow
