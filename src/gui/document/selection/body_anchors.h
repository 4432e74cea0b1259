#pragma once

#include <string>
#include <vector>

#include "core/mesh/mesh.h"

namespace winslow::gui {

/// Points of a selection about which it is often turned.
enum class PivotPlace { centre, centroid, leading_edge, trailing_edge };

struct BodyAnchors {
  Vec2 centre{0, 0};         ///< of the bounding box
  Vec2 centroid{0, 0};       ///< of the enclosed area; of the nodes where none is enclosed
  Vec2 trailing_edge{0, 0};  ///< the sharper end of the chord
  Vec2 leading_edge{0, 0};   ///< the other end

  const Vec2& at(PivotPlace place) const;
};

/// loops: closed boundary loops of the selection, nodes in order. nodes: of the selection that are
/// on no closed loop. At least one node in all. The chord joins the two nodes farthest apart.
BodyAnchors find_anchors(const std::vector<std::vector<Index>>& loops,
                         const std::vector<Index>& nodes, const Coordinates& x);

/// "leading edge" ...
const char* pivot_place_name(PivotPlace place);

}  // namespace winslow::gui
