#include "core/formulation/pointwise_winslow.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.h"
#include "core/formulation/stencil_operator.h"
#include "core/parallel/parallel_for.h"
#include "support/coordinate.h"
#include "support/formulations.h"
#include "support/meshes.h"
#include "support/samples.h"

using namespace winslow;
using namespace winslow::test;

namespace {

std::vector<Vec2> vcv_points(const VirtualControlVolumes& vcv, Index node) {
  std::vector<Vec2> points;
  for (Index k = 0; k < static_cast<Index>(vcv.angles(node).size()); ++k) {
    points.push_back(vcv.point(node, k));
  }
  return points;
}

std::vector<Vec2> ring_of(const Topology& topology, const Coordinates& x, Index node) {
  std::vector<Vec2> ring;
  for (const Index k : topology.neighbours(node)) ring.push_back(x.xy(k));
  return ring;
}

}  // namespace

TEST_CASE("coefficients, weights and residual agree with an integration triangle by triangle") {
  for (const Cells cells : all_cells) {
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
      CAPTURE(name_of(cells));
      CAPTURE(seed);
      const Sample s = make_sample(seed, cells, seed % 2 == 0);
      const Topology& topology = *s.mesh.topology;
      const PointwiseWinslow winslow = pointwise(s.vcv);
      std::vector<double> residual(2 * topology.interior_nodes().size());
      winslow.residual(s.mesh.coordinates, residual);
      for (std::size_t i = 0; i < topology.interior_nodes().size(); ++i) {
        const Index node = topology.interior_nodes()[i];
        const auto points = vcv_points(s.vcv, node);
        const auto ring = ring_of(topology, s.mesh.coordinates, node);
        const Vec2 r0 = s.mesh.coordinates.xy(node);
        const auto mean_gradient =
            integrate(points, r0, ring, Eigen::Matrix2d::Identity()).gradient;
        Eigen::Matrix2d k = winslow_matrix(mean_gradient);
        k /= 0.5 * k.trace();
        const WinslowCoefficients c = winslow.coefficients(s.mesh.coordinates, node);
        CHECK(c.alpha == doctest::Approx(k(0, 0)).epsilon(1e-9));
        CHECK(c.beta == doctest::Approx(-k(0, 1)).epsilon(1e-9));
        CHECK(c.gamma == doctest::Approx(k(1, 1)).epsilon(1e-9));
        CHECK(c.alpha + c.gamma == doctest::Approx(2));
        const Vec2 expected = integrate(points, r0, ring, k).residual;
        CHECK((Vec2(residual[2 * i], residual[2 * i + 1]) - expected).norm() <
              1e-10 * (1 + expected.norm()));
      }
    }
  }
}

TEST_CASE("an affine map of the VCVs has zero residual, clipped or not where weights allow") {
  for (std::uint64_t seed = 21; seed <= 30; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const Index n = 3 + random.index(7);
    Mesh mesh = make_mesh(regular_star(n));
    VirtualControlVolumes vcv(mesh.topology);
    if (seed % 2 == 0) randomise(vcv, random);
    Eigen::Matrix2d a;
    a << 1 + random.uniform(), random.vector().x(), 0, 1 + random.uniform();
    const Vec2 b = random.vector(-3, 3);
    mesh.coordinates.set_xy(0, b);
    const auto row = mesh.topology->neighbours(0);
    for (std::size_t k = 0; k < row.size(); ++k) {
      mesh.coordinates.set_xy(row[k], a * vcv.point(0, static_cast<Index>(k)) + b);
    }
    const PointwiseWinslow winslow = pointwise(vcv);
    CHECK(winslow.residual(mesh.coordinates, {}).max < 1e-14);
    std::vector<double> w(row.size());
    if (winslow.clipped(true).weights(mesh.coordinates, 0, w) == 0) {
      CHECK(winslow.clipped(true).residual(mesh.coordinates, {}).max < 1e-14);
    }
  }
}

TEST_CASE("clipping sets negative weights to zero, leaves the others and counts them") {
  Index met = 0;
  for (const Cells cells : all_cells) {
    for (const std::uint64_t seed : {41u, 42u}) {
      CAPTURE(name_of(cells));
      CAPTURE(seed);
      const Sample s = make_sample(seed, cells, true);
      const PointwiseWinslow winslow = pointwise(s.vcv);
      Index total = 0;
      for (const Index node : s.mesh.topology->interior_nodes()) {
        const std::size_t n = s.mesh.topology->neighbours(node).size();
        std::vector<double> raw(n), clipped(n);
        const Index negative = winslow.weights(s.mesh.coordinates, node, raw);
        CHECK(winslow.clipped(true).weights(s.mesh.coordinates, node, clipped) == negative);
        CHECK(negative == std::count_if(raw.begin(), raw.end(), [](double w) { return w < 0; }));
        for (std::size_t k = 0; k < n; ++k) CHECK(clipped[k] == std::max(raw[k], 0.0));
        total += negative;
      }
      SparseSystem system;
      CHECK(winslow.clipped(true).freeze(s.mesh.coordinates, system) == total);
      CHECK(winslow.freeze(s.mesh.coordinates, system) == total);
      met += total;
    }
  }
  CHECK(met > 0);
}

TEST_CASE("a frozen system's right-hand side is the residual over the sum of absolute weights") {
  for (const Cells cells : all_cells) {
    for (const bool clip : {false, true}) {
      CAPTURE(name_of(cells));
      CAPTURE(clip);
      constexpr std::uint64_t seed = 51;
      const Sample s = make_sample(seed, cells, true);
      const Topology& topology = *s.mesh.topology;
      const PointwiseWinslow winslow = pointwise(s.vcv);
      SparseSystem system;
      winslow.clipped(clip).freeze(s.mesh.coordinates, system);
      const auto free = topology.interior_nodes();
      REQUIRE(system.columns == 2);
      REQUIRE(system.matrix.pattern->rows() == static_cast<Index>(free.size()));
      std::vector<double> residual(2 * free.size());
      winslow.clipped(clip).residual(s.mesh.coordinates, residual);
      for (std::size_t i = 0; i < free.size(); ++i) {
        std::vector<double> w(topology.neighbours(free[i]).size());
        winslow.clipped(clip).weights(s.mesh.coordinates, free[i], w);
        double absolute = 0, sum = 0, to_boundary = 0;
        for (std::size_t k = 0; k < w.size(); ++k) {
          absolute += std::abs(w[k]);
          sum += w[k];
          if (topology.on_boundary(topology.neighbours(free[i])[k])) to_boundary += w[k];
        }
        CHECK(system.rhs[2 * i] == doctest::Approx(residual[2 * i] / absolute));
        CHECK(system.rhs[2 * i + 1] == doctest::Approx(residual[2 * i + 1] / absolute));
        double row_sum = 0;
        for (Index e = system.matrix.pattern->offsets[i]; e < system.matrix.pattern->offsets[i + 1];
             ++e) {
          row_sum += system.matrix.values[at(e)];
        }
        CHECK(std::abs(row_sum - to_boundary / absolute) < 1e-13);
        CHECK(system.matrix.values[at(system.matrix.pattern->diagonal[i])] ==
              doctest::Approx(sum / absolute));
      }
    }
  }
}

TEST_CASE("the frozen matrix is minus the derivative of the residual, coefficients held") {
  for (const Cells cells : all_cells) {
    CAPTURE(name_of(cells));
    constexpr std::uint64_t seed = 61;
    CAPTURE(seed);
    const Sample s = make_sample(seed, cells, false);
    const Topology& topology = *s.mesh.topology;
    const PointwiseWinslow winslow = pointwise(s.vcv);
    const auto free = topology.interior_nodes();
    SparseSystem system;
    winslow.freeze(s.mesh.coordinates, system);
    Random random(seed);
    std::vector<double> move(2 * free.size());
    Coordinates moved = s.mesh.coordinates;
    for (std::size_t i = 0; i < free.size(); ++i) {
      const Vec2 d = random.vector();
      move[2 * i] = d.x();
      move[2 * i + 1] = d.y();
      moved.set_xy(free[i], moved.xy(free[i]) + d);
    }
    for (std::size_t i = 0; i < free.size(); ++i) {
      // The frozen residual is linear in the positions: one difference is its derivative.
      std::vector<double> w(topology.neighbours(free[i]).size());
      winslow.weights(s.mesh.coordinates, free[i], w);
      Vec2 change(0, 0);
      double absolute = 0;
      for (std::size_t k = 0; k < w.size(); ++k) {
        const Index other = topology.neighbours(free[i])[k];
        const Vec2 after = moved.xy(other) - moved.xy(free[i]);
        const Vec2 before = s.mesh.coordinates.xy(other) - s.mesh.coordinates.xy(free[i]);
        change += w[k] * (after - before);
        absolute += std::abs(w[k]);
      }
      Vec2 product(0, 0);
      for (Index e = system.matrix.pattern->offsets[i]; e < system.matrix.pattern->offsets[i + 1];
           ++e) {
        const auto column = at(system.matrix.pattern->columns[at(e)]);
        product += system.matrix.values[at(e)] * Vec2(move[2 * column], move[2 * column + 1]);
      }
      CHECK((product + change / absolute).norm() < 1e-13);
    }
  }
}

TEST_CASE("norms: the largest and the mean square of the scaled residuals") {
  constexpr std::uint64_t seed = 71;
  CAPTURE(seed);
  const Sample s = make_sample(seed, Cells::mixed, false);
  const Topology& topology = *s.mesh.topology;
  const PointwiseWinslow winslow = pointwise(s.vcv);
  SparseSystem system;
  winslow.clipped(true).freeze(s.mesh.coordinates, system);
  double max = 0, sum = 0;
  for (std::size_t i = 0; i < topology.interior_nodes().size(); ++i) {
    const Index node = topology.interior_nodes()[i];
    double edge = 0;
    for (const Vec2& p : ring_of(topology, s.mesh.coordinates, node)) {
      edge += (p - s.mesh.coordinates.xy(node)).norm();
    }
    edge /= static_cast<double>(topology.neighbours(node).size());
    const double scaled = Vec2(system.rhs[2 * i], system.rhs[2 * i + 1]).norm() / edge;
    max = std::max(max, scaled);
    sum += scaled * scaled;
  }
  const ResidualNorms norms = winslow.clipped(true).residual(s.mesh.coordinates, {});
  CHECK(norms.max == doctest::Approx(max));
  CHECK(norms.rms ==
        doctest::Approx(std::sqrt(sum / static_cast<double>(topology.interior_nodes().size()))));
}

TEST_CASE("norms do not depend on the size, place or orientation of the mesh") {
  constexpr std::uint64_t seed = 72;
  CAPTURE(seed);
  const Sample s = make_sample(seed, Cells::triangles, false);
  const PointwiseWinslow winslow = pointwise(s.vcv);
  const double expected = winslow.residual(s.mesh.coordinates, {}).max;
  Coordinates x = s.mesh.coordinates;
  for (Index i = 0; i < x.size(); ++i) {
    const Vec2 p = x.xy(i);
    x.set_xy(i, 300 * Vec2(0.6 * p.x() - 0.8 * p.y(), 0.8 * p.x() + 0.6 * p.y()) + Vec2(7, -9));
  }
  CHECK(winslow.residual(x, {}).max == doctest::Approx(expected).epsilon(1e-9));
}

TEST_CASE("a neighbourhood collapsed into one point gives finite numbers") {
  Mesh mesh = make_mesh(square(5, Cells::triangles));
  for (Index i = 0; i < mesh.coordinates.size(); ++i) mesh.coordinates.set_xy(i, {0.25, 0.5});
  const PointwiseWinslow winslow = pointwise(VirtualControlVolumes(mesh.topology));
  SparseSystem system;
  for (const bool clip : {false, true}) {
    std::vector<double> residual(2 * mesh.topology->interior_nodes().size(), 1.0);
    CHECK(winslow.clipped(clip).residual(mesh.coordinates, residual).max == 0);
    for (const double r : residual) CHECK(r == 0);
    winslow.clipped(clip).freeze(mesh.coordinates, system);
    for (const double v : system.matrix.values) CHECK(std::isfinite(v));
    for (const double v : system.rhs) CHECK(v == 0);
  }
  const WinslowCoefficients c = winslow.coefficients(mesh.coordinates, 7);
  CHECK(c.alpha == 1);
  CHECK(c.beta == 0);
  CHECK(c.gamma == 1);
}

TEST_CASE("a NaN in one node shows in the norm, wherever the node comes in the order") {
  const Mesh mesh = make_mesh(square(6, Cells::triangles));
  const PointwiseWinslow winslow = pointwise(VirtualControlVolumes(mesh.topology));
  for (Index i = 0; i < mesh.coordinates.size(); ++i) {
    // The corners of the square are no neighbours of free nodes.
    if (!mesh.topology->used(i)) continue;
    const auto row = mesh.topology->neighbours(i);
    const bool felt = !mesh.topology->on_boundary(i) ||
                      std::any_of(row.begin(), row.end(),
                                  [&](Index k) { return !mesh.topology->on_boundary(k); });
    CAPTURE(i);
    Coordinates x = mesh.coordinates;
    coordinate(x, i, 0) = std::numeric_limits<double>::quiet_NaN();
    CHECK(std::isnan(winslow.residual(x, {}).max) == felt);
  }
}

TEST_CASE("the residual and the frozen system are bitwise the same at any number of threads") {
  constexpr std::uint64_t seed = 81;
  CAPTURE(seed);
  Mesh mesh = make_mesh(square(110, Cells::quads));
  Random random(seed);
  tangle(mesh, random);
  const VirtualControlVolumes vcv(mesh.topology);
  const std::size_t size = 2 * mesh.topology->interior_nodes().size();
  REQUIRE(size / 2 > 2 * at(parallel_block));
  std::vector<double> first(size);
  SparseSystem system;
  const PointwiseWinslow single = pointwise(vcv);
  const ResidualNorms norms = single.clipped(true).residual(mesh.coordinates, first);
  const Index negative = single.clipped(true).freeze(mesh.coordinates, system);
  for (const int threads : {2, 5, 0}) {
    CAPTURE(threads);
    const PointwiseWinslow several = pointwise(vcv, threads);
    std::vector<double> residual(size);
    const ResidualNorms other = several.clipped(true).residual(mesh.coordinates, residual);
    CHECK(other.max == norms.max);
    CHECK(other.rms == norms.rms);
    CHECK(residual == first);
    SparseSystem again;
    CHECK(several.clipped(true).freeze(mesh.coordinates, again) == negative);
    CHECK(again.matrix.values == system.matrix.values);
    CHECK(again.rhs == system.rhs);
  }
}

TEST_CASE("the pattern of the free nodes holds each free node and its free neighbours") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    const auto topology = Topology::build(square_with_two_holes(10, cells));
    const NodePattern free(*topology, topology->interior_nodes());
    const SparsityPattern& p = *free.pattern;
    REQUIRE(p.rows() == static_cast<Index>(topology->interior_nodes().size()));
    for (Index node = 0; node < topology->node_count(); ++node) {
      const Index row = free.row_of_node[at(node)];
      CHECK((row >= 0) == !topology->on_boundary(node));
      if (row < 0) continue;
      CHECK(topology->interior_nodes()[at(row)] == node);
      const auto begin = p.columns.begin() + p.offsets[at(row)];
      const auto end = p.columns.begin() + p.offsets[at(row) + 1];
      CHECK(std::adjacent_find(begin, end, std::greater_equal<>()) == end);
      CHECK(p.columns[at(p.diagonal[at(row)])] == row);
      std::ptrdiff_t expected = 1;
      const auto neighbours = topology->neighbours(node);
      const auto first = at(topology->neighbour_rows().offsets[at(node)]);
      for (std::size_t k = 0; k < neighbours.size(); ++k) {
        const Index entry = free.entry_of_neighbour[first + k];
        CHECK((entry >= 0) == !topology->on_boundary(neighbours[k]));
        if (entry < 0) continue;
        ++expected;
        CHECK(entry >= p.offsets[at(row)]);
        CHECK(entry < p.offsets[at(row) + 1]);
        CHECK(p.columns[at(entry)] == free.row_of_node[at(neighbours[k])]);
      }
      CHECK(end - begin == expected);
    }
  }
}
