#pragma once

#include <cstddef>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/mesh/mesh.h"

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
  using Cell = std::pair<int, int>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const;
  };

  void choose_cells();
  void list(Index segment);
  Cell cell_of(const Vec2& p) const;

  const Coordinates& x_;
  double reach_;
  double cell_ = 1;  // edge of a cell, at least twice the reach
  Vec2 corner_{0, 0};
  std::vector<Segment> segments_;
  std::vector<Index> long_;                                   // through too many cells to list
  std::unordered_map<Cell, std::vector<Index>, Hash> cells_;  // segments near a cell's points
};

}  // namespace winslow
