#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/formulation/pointwise_winslow.h"
#include "core/parallel/parallel_for.h"
#include "support/coordinate.h"
#include "support/formulations.h"
#include "support/samples.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

constexpr double h = 1e-6;

struct Linearisation {
  SparseMatrix jacobian;
  std::vector<double> residual, scales;

  Linearisation(const PointwiseWinslow& winslow, const Coordinates& x, bool clip, std::size_t rows)
      : residual(2 * rows), scales(rows) {
    winslow.clipped(clip).linearise(x, jacobian, residual);
    winslow.clipped(clip).row_scales(x, scales);
  }

  /// Entry for scalar row r, column c; zero outside the pattern.
  double operator()(std::size_t r, std::size_t c) const {
    const SparsityPattern& p = *jacobian.pattern;
    for (Index e = p.offsets[r / 2]; e < p.offsets[r / 2 + 1]; ++e) {
      if (at(p.columns[at(e)]) == c / 2) return jacobian.values[(at(e) * 2 + r % 2) * 2 + c % 2];
    }
    return 0;
  }
};

/// Scaled central difference of the residual along `direction` (#nodes by 2).
std::vector<double> difference(const PointwiseWinslow& winslow, const Coordinates& x,
                               const Coordinates& direction, bool clip,
                               const std::vector<double>& scales) {
  std::vector<double> plus(2 * scales.size()), minus(2 * scales.size());
  Coordinates moved = x;
  for (Index i = 0; i < x.size(); ++i) moved.set_xy(i, x.xy(i) + h * direction.xy(i));
  winslow.clipped(clip).residual(moved, plus);
  for (Index i = 0; i < x.size(); ++i) moved.set_xy(i, x.xy(i) - h * direction.xy(i));
  winslow.clipped(clip).residual(moved, minus);
  for (std::size_t r = 0; r < plus.size(); ++r) {
    plus[r] = scales[r / 2] * (plus[r] - minus[r]) / (2 * h);
  }
  return plus;
}

/// True if a weight of the node is so near zero that moves by h could clip or unclip it: there the
/// residual has a kink and no derivative to compare with.
bool near_kink(const PointwiseWinslow& winslow, const Coordinates& x, Index node,
               std::size_t neighbours) {
  std::vector<double> w(neighbours);
  winslow.weights(x, node, w);
  return std::any_of(w.begin(), w.end(), [](double v) { return std::abs(v) < 1e-3; });
}

double largest_entry(const SparseMatrix& matrix) {
  double largest = 0;
  for (const double v : matrix.values) largest = std::max(largest, std::abs(v));
  return largest;
}

}  // namespace

TEST_CASE("the Jacobian of the pointwise form agrees with central differences") {
  Index clipped = 0;
  for (const Cells cells : all_cells) {
    for (const bool clip : {false, true}) {
      for (const std::uint64_t seed : {101u, 102u, 103u}) {
        CAPTURE(name_of(cells));
        CAPTURE(clip);
        CAPTURE(seed);
        const Sample s = make_sample(seed, cells, false);
        const Topology& topology = *s.mesh.topology;
        const auto free = topology.interior_nodes();
        const Coordinates& x = s.mesh.coordinates;
        REQUIRE(check_validity(topology, x).inverted == 0);
        const PointwiseWinslow winslow = pointwise(s.vcv);
        const Linearisation exact(winslow, x, clip, free.size());
        CHECK(exact.jacobian.block == 2);
        CHECK(!exact.jacobian.symmetric);
        const double size = largest_entry(exact.jacobian);
        double worst = 0;
        for (std::size_t c = 0; c < 2 * free.size(); ++c) {
          Coordinates direction(2, x.size());
          coordinate(direction, free[c / 2], c % 2) = 1;
          const auto column = difference(winslow, x, direction, clip, exact.scales);
          for (std::size_t r = 0; r < column.size(); ++r) {
            const Index node = free[r / 2];
            if (clip && near_kink(winslow, x, node, topology.neighbours(node).size())) continue;
            worst = std::max(worst, std::abs(exact(r, c) + column[r]) / size);
          }
        }
        CHECK(worst < 1e-6);
        for (const Index node : free) {
          std::vector<double> w(topology.neighbours(node).size());
          if (clip) clipped += winslow.clipped(true).weights(x, node, w);
        }
      }
    }
  }
  CHECK(clipped > 0);
}

TEST_CASE("the response to a moved boundary agrees with central differences") {
  for (const Cells cells : all_cells) {
    for (const bool clip : {false, true}) {
      for (const std::uint64_t seed : {111u, 112u}) {
        CAPTURE(name_of(cells));
        CAPTURE(clip);
        CAPTURE(seed);
        const Sample s = make_sample(seed, cells, false);
        const Topology& topology = *s.mesh.topology;
        const auto free = topology.interior_nodes();
        const Coordinates& x = s.mesh.coordinates;
        const PointwiseWinslow winslow = pointwise(s.vcv);
        const Linearisation exact(winslow, x, clip, free.size());
        Random random(seed);
        Coordinates direction(2, x.size());
        for (Index i = 0; i < x.size(); ++i) {
          if (topology.on_boundary(i)) direction.set_xy(i, random.vector());
        }
        const auto expected = difference(winslow, x, direction, clip, exact.scales);
        for (const Index node : free) direction.set_xy(node, {1e3, -1e3});  // to be ignored
        std::vector<double> response(2 * free.size());
        winslow.clipped(clip).boundary_response(x, direction, response);
        double size = 0, worst = 0;
        for (std::size_t r = 0; r < response.size(); ++r) {
          const Index node = free[r / 2];
          if (clip && near_kink(winslow, x, node, topology.neighbours(node).size())) continue;
          size = std::max(size, std::abs(expected[r]));
          worst = std::max(worst, std::abs(response[r] - expected[r]));
        }
        CHECK(size > 0.01);
        CHECK(worst < 1e-6 * size);
      }
    }
  }
}

TEST_CASE("moves of all nodes that only shift, turn or stretch the mesh are answered exactly") {
  // The residual turns and grows with the mesh: with boundary and interior moving alike, Jacobian
  // and response together know that without any difference quotient.
  for (const Cells cells : all_cells) {
    CAPTURE(name_of(cells));
    constexpr std::uint64_t seed = 121;
    CAPTURE(seed);
    const Sample s = make_sample(seed, cells, false);
    const Topology& topology = *s.mesh.topology;
    const auto free = topology.interior_nodes();
    const Coordinates& x = s.mesh.coordinates;
    const PointwiseWinslow winslow = pointwise(s.vcv);
    const Linearisation exact(winslow, x, false, free.size());
    Eigen::Matrix2d similarity;
    similarity << 0.3, -0.8, 0.8, 0.3;
    Coordinates move(2, x.size());
    for (Index i = 0; i < x.size(); ++i) move.set_xy(i, similarity * x.xy(i) + Vec2(0.7, -0.2));
    std::vector<double> change(2 * free.size());
    winslow.boundary_response(x, move, change);
    for (std::size_t r = 0; r < change.size(); ++r) {
      for (std::size_t c = 0; c < change.size(); ++c) {
        change[r] -= exact(r, c) * coordinate(move, free[c / 2], c % 2);
      }
    }
    for (std::size_t i = 0; i < free.size(); ++i) {
      const Vec2 expected = similarity * Vec2(exact.residual[2 * i], exact.residual[2 * i + 1]);
      CHECK((Vec2(change[2 * i], change[2 * i + 1]) - expected).norm() < 1e-12);
    }
  }
}

TEST_CASE("a linearised system carries the residual, its norms and the scales of its rows") {
  constexpr std::uint64_t seed = 131;
  CAPTURE(seed);
  for (const bool clip : {false, true}) {
    CAPTURE(clip);
    const Sample s = make_sample(seed, Cells::mixed, true);
    const Topology& topology = *s.mesh.topology;
    const auto free = topology.interior_nodes();
    const Coordinates& x = s.mesh.coordinates;
    const PointwiseWinslow winslow = pointwise(s.vcv);
    const Linearisation system(winslow, x, clip, free.size());
    std::vector<double> raw(2 * free.size());
    const ResidualNorms expected = winslow.clipped(clip).residual(x, raw);
    SparseMatrix matrix;
    std::vector<double> residual(2 * free.size());
    const ResidualNorms norms = winslow.clipped(clip).linearise(x, matrix, residual);
    CHECK(norms.max == doctest::Approx(expected.max));
    CHECK(norms.rms == doctest::Approx(expected.rms));
    for (std::size_t i = 0; i < free.size(); ++i) {
      std::vector<double> w(topology.neighbours(free[i]).size());
      winslow.clipped(clip).weights(x, free[i], w);
      double absolute = 0;
      for (const double v : w) absolute += std::abs(v);
      CHECK(system.scales[i] == doctest::Approx(1 / absolute));
      CHECK(residual[2 * i] == doctest::Approx(raw[2 * i] / absolute));
      CHECK(residual[2 * i + 1] == doctest::Approx(raw[2 * i + 1] / absolute));
    }
  }
}

TEST_CASE("a neighbourhood collapsed into one point has the Laplacian's Jacobian") {
  Mesh mesh = make_mesh(square(5, Cells::triangles));
  for (Index i = 0; i < mesh.coordinates.size(); ++i) mesh.coordinates.set_xy(i, {0.25, 0.5});
  const PointwiseWinslow winslow = pointwise(VirtualControlVolumes(mesh.topology));
  const std::size_t rows = mesh.topology->interior_nodes().size();
  const Linearisation system(winslow, mesh.coordinates, true, rows);
  SparseSystem frozen;
  winslow.clipped(true).freeze(mesh.coordinates, frozen);
  for (std::size_t e = 0; e < frozen.matrix.values.size(); ++e) {
    const double* block = system.jacobian.values.data() + 4 * e;
    CHECK(block[0] == doctest::Approx(frozen.matrix.values[e]));
    CHECK(block[3] == doctest::Approx(frozen.matrix.values[e]));
    CHECK(block[1] == 0);
    CHECK(block[2] == 0);
  }
  for (const double r : system.residual) CHECK(r == 0);
}

TEST_CASE("the Jacobian and the response are bitwise the same at any number of threads") {
  constexpr std::uint64_t seed = 141;
  CAPTURE(seed);
  Mesh mesh = make_mesh(square(110, Cells::quads));
  Random random(seed);
  tangle(mesh, random);
  const VirtualControlVolumes vcv(mesh.topology);
  const std::size_t rows = mesh.topology->interior_nodes().size();
  REQUIRE(rows > 2 * at(parallel_block));
  Coordinates move(2, mesh.coordinates.size());
  for (double& v : move.values()) v = random.uniform(-1, 1);
  const PointwiseWinslow single = pointwise(vcv);
  const Linearisation first(single, mesh.coordinates, true, rows);
  std::vector<double> response(2 * rows), again(2 * rows);
  single.clipped(true).boundary_response(mesh.coordinates, move, response);
  for (const int threads : {2, 5, 0}) {
    CAPTURE(threads);
    const PointwiseWinslow several = pointwise(vcv, threads);
    const Linearisation other(several, mesh.coordinates, true, rows);
    CHECK(other.jacobian.values == first.jacobian.values);
    CHECK(other.residual == first.residual);
    CHECK(other.scales == first.scales);
    several.clipped(true).boundary_response(mesh.coordinates, move, again);
    CHECK(again == response);
  }
}

namespace {

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
