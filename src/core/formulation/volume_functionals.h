#pragma once

#include "core/types.h"
#include "core/vcv/sphere/sphere_link.h"
#include "core/vcv/sphere/volume_vcvs.h"

namespace winslow {

/// The nine numbers per neighbour to which a VCV of a volume mesh reduces. With r_0 the node and
/// r_k its neighbours,
///   r_x = sum_k dx_k (r_k - r_0)  and so on
/// is the volume-weighted mean of the VCV tetrahedra's gradients (Green-Gauss over the VCV), and
///   w_k = K_xx lxx_k + K_yy lyy_k + K_zz lzz_k + K_xy lxy_k + K_yz lyz_k + K_zx lzx_k
/// makes sum_k w_k (r_k - r_0) the integral of K grad r over the VCV's boundary, K symmetric.
struct VolumeFunctional {
  double dx, dy, dz;
  double lxx, lyy, lzz, lxy, lyz, lzx;
};

/// Functionals of one VCV with the node at the origin. points: of the vertices of its link. out:
/// #vertices. Throws NumericError if one of its tetrahedra has no positive volume.
void compute_functionals(const SphereLink& link, std::span<const Vec3> points,
                         std::span<VolumeFunctional> out);

/// Functionals of all VCVs: rows as long as those of Topology::neighbour_rows(), and zero for nodes
/// of the boundary. 72 bytes for each neighbour: what every evaluation of the operator reads.
class VolumeFunctionals {
 public:
  /// threads: 0 for all cores; no result depends on it.
  VolumeFunctionals(const VolumeVcvs& vcvs, int threads);
  std::span<const VolumeFunctional> operator[](Index node) const {
    const auto& offsets = topology_->neighbour_rows().offsets;
    return std::span(values_).subspan(at(offsets[at(node)]),
                                      at(offsets[at(node) + 1] - offsets[at(node)]));
  }

 private:
  std::shared_ptr<const Topology> topology_;
  std::vector<VolumeFunctional> values_;
};

/// Coefficients of the Winslow equations in space,
///
///   alpha_1 r_xx + alpha_2 r_yy + alpha_3 r_zz + 2 (beta_1 r_xy + beta_2 r_yz + beta_3 r_xz) = 0,
///
/// K = [alpha_1 beta_1 beta_3; beta_1 alpha_2 beta_2; beta_3 beta_2 alpha_3] = adj(G^T G), G =
/// [r_x r_y r_z], divided by a third of its trace. Where that vanishes: those of the Laplacian.
Eigen::Matrix3d winslow_tensor(const Eigen::Matrix3d& gradient);

/// Weight of one neighbour.
inline double winslow_weight(const Eigen::Matrix3d& k, const VolumeFunctional& f) {
  return k(0, 0) * f.lxx + k(1, 1) * f.lyy + k(2, 2) * f.lzz + k(0, 1) * f.lxy + k(1, 2) * f.lyz +
         k(2, 0) * f.lzx;
}

}  // namespace winslow
