#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/formulation/pointwise_winslow.h"
#include "support/formulations.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

constexpr double h = 1e-6;

struct System {
  SparseMatrix jacobian;
  std::vector<double> residual, scales;

  System(const VolumePointwise& problem, const Coordinates& x)
      : residual(problem.unknowns()), scales(problem.unknowns() / 3) {
    problem.linearise(x, jacobian, residual);
    problem.row_scales(x, scales);
  }
  /// J times a displacement of all nodes that have rows.
  std::vector<double> times(const Coordinates& d, std::span<const Index> free) const {
    std::vector<double> out(residual.size(), 0.0);
    const SparsityPattern& pattern = *jacobian.pattern;
    for (std::size_t i = 0; i < free.size(); ++i) {
      for (Index e = pattern.offsets[i]; e < pattern.offsets[i + 1]; ++e) {
        const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> block(
            jacobian.values.data() + 9 * at(e));
        const Vec3 product = block * d.xyz(free[at(pattern.columns[at(e)])]);
        for (int c = 0; c < 3; ++c) out[3 * i + at(c)] += product[c];
      }
    }
    return out;
  }
};

/// Scaled central difference of the residual along a displacement.
std::vector<double> difference(const VolumePointwise& problem, const Coordinates& x,
                               const Coordinates& d, const std::vector<double>& scales) {
  const auto residual = [&](double step) {
    Coordinates moved = x;
    for (Index i = 0; i < x.size(); ++i) moved.set_xyz(i, x.xyz(i) + step * d.xyz(i));
    std::vector<double> out(problem.unknowns());
    problem.residual(moved, out);
    return out;
  };
  std::vector<double> plus = residual(h);
  const std::vector<double> minus = residual(-h);
  for (std::size_t r = 0; r < plus.size(); ++r)
    plus[r] = scales[r / 3] * (plus[r] - minus[r]) / (2 * h);
  return plus;
}

/// Whether a weight is so near zero that moves by h could clip or unclip it.
bool near_kink(const VolumePointwise& problem, const Coordinates& x, Index node,
               std::size_t neighbours) {
  std::vector<double> w(neighbours);
  problem.clipped(false).weights(x, node, w);
  return std::any_of(w.begin(), w.end(), [](double v) { return std::abs(v) < 1e-3; });
}

Coordinates random_displacement(const Topology& topology, Random& random, bool boundary) {
  Coordinates d(3, topology.node_count());
  for (Index i = 0; i < d.size(); ++i) {
    if (topology.on_boundary(i) == boundary) d.set_xyz(i, random_vector(random));
  }
  return d;
}

}  // namespace

TEST_CASE("in space the Jacobian of the pointwise form agrees with central differences") {
  for (const Volumes volumes : all_volumes) {
    for (const bool clip : {false, true}) {
      CAPTURE(name_of(volumes));
      CAPTURE(clip);
      const Mesh mesh = shaken_box(4, 0.25, 21, volumes);
      const Topology& topology = *mesh.topology;
      const auto free = topology.interior_nodes();
      const VolumeVcvs vcvs(mesh.topology, mesh.coordinates, {.angles = VcvAngles::adjusted});
      const VolumePointwise problem(vcvs, free_interior(mesh.topology), 1, clip);
      const System system(problem, mesh.coordinates);
      CHECK(system.jacobian.block == 3);
      CHECK(!system.jacobian.symmetric);
      Random random(22);
      for (const bool boundary : {false, true}) {
        CAPTURE(boundary);
        const Coordinates d = random_displacement(topology, random, boundary);
        const auto expected = difference(problem, mesh.coordinates, d, system.scales);
        std::vector<double> found(expected.size());
        if (boundary) {
          problem.boundary_response(mesh.coordinates, d, found);
        } else {
          found = system.times(d, free);
          for (double& value : found) value = -value;  // J = -S dR/dx
        }
        double size = 0, worst = 0;
        Index compared = 0;
        for (std::size_t r = 0; r < found.size(); ++r) {
          const Index node = free[r / 3];
          if (clip && near_kink(problem, mesh.coordinates, node, topology.neighbours(node).size()))
            continue;
          ++compared;
          size = std::max(size, std::abs(expected[r]));
          worst = std::max(worst, std::abs(found[r] - expected[r]));
        }
        CHECK(compared > 20);
        CHECK(size > 0.01);
        CHECK(worst < 1e-6 * size);
      }
    }
  }
}

TEST_CASE("in space moves that only shift, turn or stretch the mesh are answered exactly") {
  const Mesh mesh = shaken_box(4, 0.25, 23);
  const auto free = mesh.topology->interior_nodes();
  const VolumePointwise problem(VolumeVcvs(mesh.topology), free_interior(mesh.topology), 1);
  const System system(problem, mesh.coordinates);
  Eigen::Matrix3d similarity;  // a stretch and an infinitesimal turn
  similarity << 0.4, -0.8, 0.3, 0.8, 0.4, -0.5, -0.3, 0.5, 0.4;
  Coordinates move(3, mesh.coordinates.size());
  for (Index i = 0; i < move.size(); ++i)
    move.set_xyz(i, similarity * mesh.coordinates.xyz(i) + Vec3(0.7, -0.2, 0.1));
  std::vector<double> change(problem.unknowns());
  problem.boundary_response(mesh.coordinates, move, change);
  const auto own = system.times(move, free);
  for (std::size_t i = 0; i < free.size(); ++i) {
    const Vec3 expected = similarity * Vec3(system.residual.data() + 3 * i);
    CHECK((Vec3(change.data() + 3 * i) - Vec3(own.data() + 3 * i) - expected).norm() < 1e-12);
  }
}

TEST_CASE("in space a neighbourhood collapsed into one point has the Laplacian's Jacobian") {
  Mesh mesh = make_mesh(cube(4, Volumes::tetrahedra));
  for (Index i = 0; i < mesh.coordinates.size(); ++i) mesh.coordinates.set_xyz(i, {0.2, 0.5, 0.1});
  const VolumePointwise problem(VolumeVcvs(mesh.topology), free_interior(mesh.topology), 1, true);
  const System system(problem, mesh.coordinates);
  SparseSystem frozen;
  problem.freeze(mesh.coordinates, frozen);
  for (std::size_t e = 0; e < frozen.matrix.values.size(); ++e) {
    for (std::size_t k = 0; k < 9; ++k)
      CHECK(system.jacobian.values[9 * e + k] ==
            doctest::Approx(k % 4 == 0 ? frozen.matrix.values[e] : 0));
  }
}

TEST_CASE("in space the Jacobian has the same bits at any number of threads") {
  const Mesh mesh = shaken_box(19, 0.3, 24);
  const VolumeVcvs vcvs(mesh.topology);
  const VolumePointwise one(vcvs, free_interior(mesh.topology), 1, true),
      three(vcvs, free_interior(mesh.topology), 3, true);
  const System a(one, mesh.coordinates), b(three, mesh.coordinates);
  CHECK(a.jacobian.values == b.jacobian.values);
  CHECK(a.residual == b.residual);
  CHECK(a.scales == b.scales);
}
