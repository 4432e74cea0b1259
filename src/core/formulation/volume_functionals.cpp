#include "core/formulation/volume_functionals.h"

#include "core/error.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

void compute_functionals(const SphereLink& link, std::span<const Vec3> points,
                         std::span<VolumeFunctional> out) {
  std::fill(out.begin(), out.end(), VolumeFunctional{});
  double total6 = 0;  // six times the volume of the VCV
  for (const SphereLink::Triangle& triangle : link.triangles()) {
    const Vec3 &a = points[at(triangle[0])], &b = points[at(triangle[1])],
               &c = points[at(triangle[2])];
    // Linear interpolation: grad r = sum over the corners of (r_k - r_0) face_k / volume6.
    const std::array<Vec3, 3> faces{b.cross(c), c.cross(a), a.cross(b)};
    const double volume6 = a.dot(faces[0]);
    if (!(volume6 > 0)) throw NumericError("a VCV tetrahedron has no volume");
    total6 += volume6;
    const Vec3 normal = (0.5 / volume6) * (b - a).cross(c - a);
    for (std::size_t k = 0; k < 3; ++k) {
      VolumeFunctional& f = out[at(triangle[k])];
      const Vec3& g = faces[k];
      f.dx += g.x();
      f.dy += g.y();
      f.dz += g.z();
      f.lxx += normal.x() * g.x();
      f.lyy += normal.y() * g.y();
      f.lzz += normal.z() * g.z();
      f.lxy += normal.x() * g.y() + normal.y() * g.x();
      f.lyz += normal.y() * g.z() + normal.z() * g.y();
      f.lzx += normal.z() * g.x() + normal.x() * g.z();
    }
  }
  for (VolumeFunctional& f : out) {
    f.dx /= total6;
    f.dy /= total6;
    f.dz /= total6;
  }
}

VolumeFunctionals::VolumeFunctionals(const VolumeVcvs& vcvs, int threads)
    : topology_(vcvs.shared_topology()),
      values_(topology_->neighbour_rows().values.size(), VolumeFunctional{}) {
  const auto interior = topology_->interior_nodes();
  parallel_for(threads, static_cast<Index>(interior.size()), [&](Index begin, Index end) {
    SphereLink link;
    std::vector<Vec3> points;
    for (Index i = begin; i < end; ++i) {
      const Index node = interior[at(i)];
      link.assign(*topology_, node);
      vcvs.points(node, points);
      const auto first = at(topology_->neighbour_rows().offsets[at(node)]);
      try {
        compute_functionals(link, points, std::span(values_).subspan(first, points.size()));
      } catch (const NumericError& error) {
        throw NumericError("node " + std::to_string(node) + ": " + error.what());
      }
    }
  });
}

Eigen::Matrix3d winslow_tensor(const Eigen::Matrix3d& gradient) {
  // adj(G^T G) = C^T C with the cofactors C of G.
  Eigen::Matrix3d cofactors;
  cofactors.col(0) = gradient.col(1).cross(gradient.col(2));
  cofactors.col(1) = gradient.col(2).cross(gradient.col(0));
  cofactors.col(2) = gradient.col(0).cross(gradient.col(1));
  const Eigen::Matrix3d k = cofactors.transpose() * cofactors;
  const double mean = k.trace() / 3;
  if (!(mean > 0)) return Eigen::Matrix3d::Identity();
  return k / mean;
}

}  // namespace winslow
