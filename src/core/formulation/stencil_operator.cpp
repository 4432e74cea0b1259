#include "core/formulation/stencil_operator.h"

#include "core/error.h"
#include "core/linear/pattern_builder.h"
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

auto StencilOperator<2>::slopes(const Matrix& g, const Fluxes& flux, const Vec2& residual)
    -> std::array<Matrix, 2> {
  // alpha' = |r_y|^2, beta' = r_x . r_y, gamma' = |r_x|^2, m = (alpha' + gamma') / 2.
  const auto& [lxx, lxy, lyy] = flux;
  const Vec2 rx = g.col(0), ry = g.col(1);
  const double mean = 0.5 * (rx.squaredNorm() + ry.squaredNorm());
  if (!(mean > 0)) return {Matrix::Zero(), Matrix::Zero()};
  return {((2 * lyy - residual) * rx.transpose() - lxy * ry.transpose()) / mean,
          ((2 * lxx - residual) * ry.transpose() - lxy * rx.transpose()) / mean};
}

auto StencilOperator<3>::slopes(const Matrix& g, const Fluxes& flux, const Vec3& residual)
    -> std::array<Matrix, 3> {
  // K'_pq = c_p . c_q with the cofactors c_p = G_(p+1) x G_(p+2), m a third of the trace of K'.
  std::array<Matrix, 3> slopes{Matrix::Zero(), Matrix::Zero(), Matrix::Zero()};
  std::array<Vec3, 3> cofactors;
  for (int p = 0; p < 3; ++p)
    cofactors[static_cast<std::size_t>(p)] = g.col((p + 1) % 3).cross(g.col((p + 2) % 3));
  const double mean =
      (cofactors[0].squaredNorm() + cofactors[1].squaredNorm() + cofactors[2].squaredNorm()) / 3;
  if (!(mean > 0)) return slopes;
  // c . dc_p, times a flux: c . (dG_(p+1) x G_(p+2) + G_(p+1) x dG_(p+2)).
  const auto add = [&](std::size_t p, const Vec3& c, const Vec3& along) {
    const std::size_t next = (p + 1) % 3, last = (p + 2) % 3;
    const Vec3 first = g.col(static_cast<Index>(next)), second = g.col(static_cast<Index>(last));
    slopes[next] += along * second.cross(c).transpose() / mean;
    slopes[last] += along * c.cross(first).transpose() / mean;
  };
  for (std::size_t p = 0; p < 3; ++p) {
    const std::size_t q = (p + 1) % 3;
    add(p, cofactors[p], 2 * (flux[p] - residual / 3));
    add(p, cofactors[q], flux[3 + p]);  // xy, yz, zx
    add(q, cofactors[p], flux[3 + p]);
  }
  return slopes;
}

NodePattern::NodePattern(const Topology& topology, std::span<const Index> nodes)
    : row_of_node(at(topology.node_count()), -1),
      entry_of_neighbour(topology.neighbour_rows().values.size(), -1) {
  for (std::size_t i = 0; i < nodes.size(); ++i) row_of_node[at(nodes[i])] = static_cast<Index>(i);
  const auto rows = static_cast<Index>(nodes.size());
  pattern = build_pattern(rows, std::max<Index>(rows, 1), 1, [&] {
    return [&](Index row, std::vector<Index>& columns) {
      columns.push_back(row);
      for (const Index node : topology.neighbours(nodes[at(row)]))
        if (const Index other = row_of_node[at(node)]; other >= 0) columns.push_back(other);
    };
  });
  for (Index row = 0; row < rows; ++row) {
    const Index node = nodes[at(row)];
    const auto neighbours = topology.neighbours(node);
    const auto first = at(topology.neighbour_rows().offsets[at(node)]);
    for (std::size_t k = 0; k < neighbours.size(); ++k)
      if (const Index other = row_of_node[at(neighbours[k])]; other >= 0)
        entry_of_neighbour[first + k] = pattern->find(row, other);
  }
}

}  // namespace winslow
