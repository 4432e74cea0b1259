#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/mesh/topology.h"
#include "core/search/box_tree.h"

namespace winslow {

/// A straight piece of a boundary.
struct Segment {
  Vec2 a, b;
};

/// What two segments have in common.
struct Meeting {
  enum class Kind {
    none,
    touch,    ///< an end of one lies on the other
    crossing  ///< each goes from one side of the other to its other side
  };
  Kind kind = Kind::none;
  Vec2 place{0, 0};
};
Meeting meeting(const Segment& s, const Segment& t);
/// Between the nearest points of two segments; 0 where they meet.
double distance(const Segment& s, const Segment& t);
Box<2> box_of(const Segment& segment);

using EdgeNodes = std::array<Index, 2>;

bool share_node(const EdgeNodes& a, const EdgeNodes& b);
Segment segment(const EdgeNodes& edge, const Coordinates& x);

/// The edges of a plane mesh that may meet when some nodes move: those of the boundary and those of
/// markers inside.
struct Outline {
  struct Part {
    std::vector<EdgeNodes> edges;
    std::vector<Index> markers;  ///< of each edge; -1: none
    void add(const EdgeNodes& edge, Index marker) {
      edges.push_back(edge);
      markers.push_back(marker);
    }
  };
  Part moving;                      ///< with a node that moves
  Part fixed;                       ///< all others
  std::vector<std::size_t> joints;  ///< of `moving`, with a node that stays

  Outline(const Topology& topology, std::span<const Index> moving_nodes);
};

BoxTree<2> tree_of(const std::vector<EdgeNodes>& edges, const Coordinates& x);

}  // namespace winslow
