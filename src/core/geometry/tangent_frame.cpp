#include "core/geometry/tangent_frame.h"

namespace winslow {

TangentFrame TangentFrame::axes(int dimension) {
  TangentFrame frame;
  for (int k = 0; k < dimension; ++k) frame.add(Vec3::Unit(k));
  return frame;
}

}  // namespace winslow
