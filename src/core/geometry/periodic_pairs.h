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

/// A node and its image across a periodic boundary.
struct PeriodicPair {
  Index node, image;
  bool operator==(const PeriodicPair&) const = default;
};

/// Periodic sides in a mesh file: two markers and the pairs of their nodes.
struct GivenPairs {
  std::string first, second;        ///< markers; both sides may be on one marker
  std::vector<PeriodicPair> pairs;  ///< nodes of the first marker and their images, as in the file
  std::vector<Index> held;          ///< nodes that are also in pairs of other sides, ascending
  /// True if the images are halo nodes, which some solvers write into the file: copies of interior
  /// nodes for elements beyond the second marker.
  bool halo = false;
  std::string fault =
      {};  ///< why the pairs cannot be used, with the line of the file; empty: no fault
  double deviation = 0;  ///< PeriodicPairs::deviation of the mesh in the file
};

/// All periodic sides in a file.
struct GivenPeriodicity {
  std::string source;             ///< name of the file, for messages
  Index nodes = 0, elements = 0;  ///< numbers of the mesh in the file
  std::vector<GivenPairs> pairs;

  /// Whether a mesh has as many nodes and elements as the file.
  bool fits(const Topology& topology) const {
    return nodes == topology.node_count() && elements == topology.element_count();
  }
};

/// Two sides of a periodic mesh: each node of the second side is the image of a node of the first.
struct PeriodicPairs {
  using Pair = PeriodicPair;
  std::string first, second;  ///< the markers
  std::string description;    ///< "translation by (0, 1)", "rotation by 30 degrees"
  RigidImage image;           ///< from the first side to the second
  /// Pairs of nodes on no other marker, ascending by node. The nodes of a pair move together.
  std::vector<Pair> pairs;
  /// Pairs of nodes that are also on other markers: ends and edges of the sides. They stay, except
  /// those that slide, see SlidingBoundary::corners.
  std::vector<Pair> corners;
  bool halo = false;     ///< as GivenPairs::halo
  double deviation = 0;  ///< largest distance of a node from the image of its partner

  /// Finds the pairs by a translation or, if none fits, by a rotation: in the plane about any
  /// point, from the ends of the two sides; in space about a coordinate axis. Throws UsageError for
  /// unknown markers, for the same marker twice, and, naming the worst node, for sides that do not
  /// match.
  static PeriodicPairs find(const Topology& topology, const Coordinates& x,
                            const std::string& first, const std::string& second);

  /// Fits a translation or, if none fits, a rotation (in space about any axis) to the pairs of a
  /// file. Throws UsageError for a fault of the pairs, for unknown markers and nodes, and, naming
  /// the worst pair, if neither fits.
  static PeriodicPairs of(const Topology& topology, const Coordinates& x, const GivenPairs& given);
};

}  // namespace winslow
