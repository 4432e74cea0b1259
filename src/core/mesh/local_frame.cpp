#include "core/mesh/local_frame.h"

#include <algorithm>
#include <cmath>

namespace winslow {

LocalFrame::LocalFrame(const Mesh& mesh) {
  if (mesh.topology->cell_dimension() == 3) return;
  const Bounds box = bounds(mesh);
  constexpr double far = 16;
  const double extent = box.size().maxCoeff();
  for (const int axis : {0, 1}) {
    const double centre = box.centre()[axis];
    if (std::abs(centre) > far * extent) origin_[axis] = centre;
  }
}

Coordinates LocalFrame::to_local(Coordinates x) const {
  for (Index node = 0; node < x.size(); ++node) x.set_xy(node, to_local(x.xy(node)));
  return x;
}

Coordinates LocalFrame::to_mesh(Coordinates x, const Coordinates& rest) const {
  for (Index node = 0; node < x.size(); ++node) {
    const bool rests = node < rest.size() && x.xy(node) == to_local(rest.xy(node));
    x.set_xy(node, rests ? rest.xy(node) : to_mesh(x.xy(node)));
  }
  return x;
}

}  // namespace winslow
