#include "core/mesh/local_frame.h"

#include <cmath>

namespace winslow {

namespace {

template <int D>
Vec3 origin_of(const Box<D>& box) {
  constexpr double far = 16;
  const double extent = box.size().maxCoeff();
  const Vec<D> centre = box.centre();
  Vec3 origin(0, 0, 0);
  for (int axis = 0; axis < D; ++axis) {
    if (std::abs(centre[axis]) > far * extent) origin[axis] = centre[axis];
  }
  return origin;
}

template <int D>
void take_to_local(const LocalFrame& frame, Coordinates& x) {
  for (Index node = 0; node < x.size(); ++node) x.set<D>(node, frame.to_local(x.get<D>(node)));
}

template <int D>
void take_to_mesh(const LocalFrame& frame, Coordinates& x, const Coordinates& rest) {
  for (Index node = 0; node < x.size(); ++node) {
    const bool rests = node < rest.size() && x.get<D>(node) == frame.to_local(rest.get<D>(node));
    x.set<D>(node, rests ? rest.get<D>(node) : frame.to_mesh(x.get<D>(node)));
  }
}

}  // namespace

LocalFrame::LocalFrame(const Mesh& mesh)
    : origin_(mesh.topology->cell_dimension() == 3 ? origin_of(space_bounds(mesh))
                                                   : origin_of(bounds(mesh))) {}

Coordinates LocalFrame::to_local(Coordinates x) const {
  x.dimension() == 3 ? take_to_local<3>(*this, x) : take_to_local<2>(*this, x);
  return x;
}

Coordinates LocalFrame::to_mesh(Coordinates x, const Coordinates& rest) const {
  x.dimension() == 3 ? take_to_mesh<3>(*this, x, rest) : take_to_mesh<2>(*this, x, rest);
  return x;
}

}  // namespace winslow
