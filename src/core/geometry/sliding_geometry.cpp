#include "core/geometry/sliding_geometry.h"

namespace winslow {

TangentFrame TangentFrame::axes(int dimension) {
  TangentFrame frame;
  for (int k = 0; k < dimension; ++k) frame.add(Vec3::Unit(k));
  return frame;
}

Foot RememberedFeet::foot(Index node, const Vec3& point) const {
  Memory& memory = memory_[at(node)];
  for (std::size_t k = 0; k < memory.places.size(); ++k) {
    const Place& place = memory.places[k];
    if (!place.known || (place.asked_for != point && place.foot.point != point)) continue;
    memory.last = k;
    return place.foot;
  }
  memory.last = 1 - memory.last;
  Place& place = memory.places[memory.last];
  place = {point, geometry_->foot(node, point), true};
  return place.foot;
}

}  // namespace winslow
