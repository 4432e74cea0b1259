#pragma once

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

/// A node, and the one that is its image across a periodic boundary.
struct PeriodicPair {
  Index node, image;
  bool operator==(const PeriodicPair&) const = default;
};

/// What a mesh file says of periodic sides: two markers, and which node is the image of which.
struct GivenPairs {
  std::string first, second;        ///< markers; one may hold both sides
  std::vector<PeriodicPair> pairs;  ///< nodes of the first marker and their images, as listed
  std::vector<Index> held;          ///< ascending: of them, those in pairs of other sides, too
  /// The images are no side but copies of nodes of the interior, for elements beyond the second
  /// marker: halo nodes of solvers that keep these in the file.
  bool halo = false;
  std::string fault = {};  ///< why they cannot be used, with the place in the file; empty: they can
  double deviation = 0;    ///< PeriodicPairs::deviation of the mesh in the file
};

/// All that a file says of periodic sides.
struct GivenPeriodicity {
  std::string source;             ///< name of the file, for messages
  Index nodes = 0, elements = 0;  ///< of the mesh in it
  std::vector<GivenPairs> pairs;

  /// Whether the numbers of nodes are still those of the file.
  bool fits(const Topology& topology) const {
    return nodes == topology.node_count() && elements == topology.element_count();
  }
};

/// Two sides of a periodic mesh: every node of the second is the image of one of the first.
struct PeriodicPairs {
  using Pair = PeriodicPair;
  std::string first, second;  ///< the markers
  std::string description;    ///< "translation by (0, 1)", "rotation by 30 degrees"
  RigidImage image;           ///< takes the first side to the second
  /// Ascending by node, of the nodes that move together: those on no other marker.
  std::vector<Pair> pairs;
  /// The same of nodes on other markers, too: ends and edges of the sides. They stay, but for those
  /// that SlidingBoundary::find() has slide.
  std::vector<Pair> corners;
  bool halo = false;     ///< as GivenPairs::halo
  double deviation = 0;  ///< largest distance of a node from the image of its partner

  /// Finds the translation or, if there is none, the rotation: in the plane about any point, by the
  /// ends of the two sides; in space about a coordinate axis. Throws UsageError for markers that
  /// the mesh does not have, one and the same marker twice, and, naming the first pair, sides that
  /// do not match.
  static PeriodicPairs find(const Topology& topology, const Coordinates& x,
                            const std::string& first, const std::string& second);

  /// The translation or, if there is none, the rotation (in space about any axis) that fits the
  /// pairs of a file. Throws UsageError for a fault of theirs, markers and nodes that the mesh does
  /// not have, and, naming the first one, a pair that it does not fit.
  static PeriodicPairs of(const Topology& topology, const Coordinates& x, const GivenPairs& given);
};

}  // namespace winslow
