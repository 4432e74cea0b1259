#include "gui/view/overlays/vcv_shape.h"

#include <cmath>

namespace winslow::gui {

std::vector<Vec2> vcv_over_star(const NodalView& node) {
  const double turn = fitted_turn(node.vcv, node.physical);
  const double scale = node.physical.mean_length() / node.vcv.mean_length();
  const double c = scale * std::cos(turn), s = scale * std::sin(turn);
  std::vector<Vec2> ends;
  for (const Vec2& p : node.vcv.points)
    ends.push_back(node.position + Vec2(c * p.x() - s * p.y(), s * p.x() + c * p.y()));
  return ends;
}

bool vcv_in_sight(const NodalView& node, const Bounds& seen) {
  const double reach = 2 * node.physical.mean_length();
  return ((node.position - seen.min).array() > -reach).all() &&
         ((seen.max - node.position).array() > -reach).all();
}

}  // namespace winslow::gui
