#pragma once

#include "core/mesh/mesh.h"
#include "core/search/box_tree.h"

namespace winslow {

/// How much room a boundary leaves at a point of it: the radius of the largest disc that touches
/// the boundary there, on a given side, and holds no other part of the boundary. Half the width of
/// a gap; the distance to a concave corner; the radius of a concave curve.
class Clearance {
 public:
  /// The whole boundary. reach: no radius is looked for beyond it; in units of the mesh.
  Clearance(const Topology& topology, const Coordinates& x, double reach);

  /// Radius, at most the reach, of the disc at `node`, whose centre lies in the unit direction
  /// `inward` from it. The boundary edges at the node itself do not count.
  double radius(Index node, const Vec2& inward) const;

 private:
  struct Segment {
    Index a, b;
  };

  const Coordinates& x_;
  double reach_;
  std::vector<Segment> segments_;
  BoxTree<2> tree_;  // of segments_
};

}  // namespace winslow
