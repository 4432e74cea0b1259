#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/mesh/coordinates.h"
#include "core/mesh/topology.h"

namespace winslow {

/// A rotation and a translation: p -> rotation p + offset. In the plane the third coordinate is 0.
struct RigidImage {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vec3 offset{0, 0, 0};

  Vec3 of(const Vec3& point) const { return rotation * point + offset; }
  bool operator==(const RigidImage&) const = default;
};

/// Two sides of a periodic mesh: every node of the second is the image of one of the first.
struct PeriodicPairs {
  struct Pair {
    Index node, image;
    bool operator==(const Pair&) const = default;
  };
  std::string first, second;  ///< the markers
  std::string description;    ///< "translation by (0, 1)", "rotation by 30 degrees"
  RigidImage image;           ///< takes the first side to the second
  /// Ascending by node, of the nodes that move together: those on no other marker.
  std::vector<Pair> pairs;

  /// Finds the translation or, if there is none, the rotation: in the plane about any point, by the
  /// ends of the two sides; in space about a coordinate axis. Throws UsageError for markers that
  /// the mesh does not have, one and the same marker twice, and, naming the first pair, sides that
  /// do not match.
  static PeriodicPairs find(const Topology& topology, const Coordinates& x,
                            const std::string& first, const std::string& second);
};

}  // namespace winslow
