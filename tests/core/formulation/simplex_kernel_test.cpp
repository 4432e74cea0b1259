#include "core/formulation/simplex_kernel.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/formulation/distortion.h"
#include "core/formulation/variational_winslow.h"
#include "support/random.h"

using namespace winslow;
using namespace winslow::test;
using distortion::SimplexPlaces;
using distortion::TriangleKernel;
using distortion::TriangleSum;

namespace {

/// Triangles over random points, upright or not, with one to three targets each.
struct Sample {
  std::vector<double> x, terms, size;
  std::vector<Index> nodes, offsets{0}, list;

  Sample(Random& random, Index triangles, bool upright) {
    for (Index n = 0; n < 40; ++n) x.push_back(random.uniform(-1, 1));
    while (static_cast<Index>(offsets.size()) <= triangles) {
      Index abc[3];
      for (Index& n : abc) n = random.index(20);
      if (upright && determinant(abc) < 0.01) continue;
      nodes.insert(nodes.end(), abc, abc + 3);
      const std::size_t count = 1 + static_cast<std::size_t>(random.index(3));
      for (std::size_t k = 0; k < 4 * count; ++k) terms.push_back(random.uniform(0.1, 1));
      offsets.push_back(static_cast<Index>(terms.size() / 4));
      size.push_back(random.uniform(0.01, 1));
      list.push_back(static_cast<Index>(list.size()));
    }
    std::reverse(list.begin(), list.end());
  }
  double determinant(const Index* n) const {
    const distortion::Corner2 q(point(n[0]), point(n[1]), point(n[2]));
    return q.d;
  }
  const double* point(Index n) const { return x.data() + 2 * n; }
  distortion::SimplexData data(const PenaltyOptions& penalty, bool regularised) const {
    distortion::SimplexData data;
    data.x = x.data();
    data.nodes = nodes.data();
    data.offsets = offsets.data();
    data.terms = terms.data();
    data.penalty = distortion::PenaltyFunction(penalty).constants();
    if (regularised) {
      data.size = size.data();
      data.epsilon = 0.3;
      data.curvature_share = 0;
    }
    return data;
  }
};

std::vector<double> sums_of(const TriangleKernel& kernel, const Sample& sample,
                            const distortion::SimplexData& data) {
  const std::size_t room = (sample.list.size() + 3) / 4 * 4;
  std::vector<double> sums(room * TriangleSum::size);
  kernel.sum(data, sample.list.data(), static_cast<Index>(sample.list.size()), 0, sums.data());
  sums.resize(sample.list.size() * TriangleSum::size);
  return sums;
}

const std::vector<PenaltyOptions> penalties{{8, 1.78}, {1, 0}, {2, 0}, {2.5, 1.5}, {1, 0, 1e7}};

}  // namespace

TEST_CASE("the energy of triangles is the sum of what their distortions cost") {
  Random random(1);
  for (const PenaltyOptions& penalty : penalties) {
    for (const Index count : {1, 2, 3, 4, 5, 23}) {
      const Sample sample(random, count, true);
      double expected = 0;
      for (Index t = 0; t < count; ++t) {
        const Index* n = &sample.nodes[3 * static_cast<std::size_t>(t)];
        const distortion::Corner2 q(sample.point(n[0]), sample.point(n[1]), sample.point(n[2]));
        for (Index k = sample.offsets[static_cast<std::size_t>(t)];
             k < sample.offsets[static_cast<std::size_t>(t) + 1]; ++k) {
          const double* c = &sample.terms[4 * static_cast<std::size_t>(k)];
          const double f = q.distortion({c[0], c[1], c[2], c[3]});
          expected += c[3] * (penalty.bound > 0  ? f / (1 - f / penalty.bound)
                              : penalty.knee > 0 ? f + std::pow(f / penalty.knee, penalty.exponent)
                                                 : std::pow(f, penalty.exponent));
        }
      }
      const distortion::SimplexData data = sample.data(penalty, false);
      const TriangleKernel& kernel = distortion::fastest_kernel<2>();
      CHECK(kernel.energy(data, 0, count) == doctest::Approx(expected).epsilon(1e-12));
      // The sums' energy, all together and split at a triangle.
      std::vector<double> sums(24 * TriangleSum::size);
      const auto from = [&](Index first) {
        return kernel.sum(data, sample.list.data(), count, first, sums.data());
      };
      CHECK(from(0) == doctest::Approx(expected).epsilon(1e-12));
      CHECK(from(count / 2) + kernel.energy(data, 0, count / 2) ==
            doctest::Approx(expected).epsilon(1e-12));
    }
  }
}

TEST_CASE("a triangle without area makes the energy infinite, unless it is regularised") {
  Random random(2);
  Sample sample(random, 9, true);
  std::swap(sample.nodes[12], sample.nodes[13]);
  const distortion::SimplexData data = sample.data({8, 1.78}, false);
  CHECK(std::isinf(distortion::fastest_kernel<2>().energy(data, 0, 9)));
  CHECK(std::isfinite(distortion::fastest_kernel<2>().energy(data, 0, 4)));
  const distortion::SimplexData soft = sample.data({8, 1.78}, true);
  CHECK(std::isfinite(distortion::fastest_kernel<2>().energy(soft, 0, 9)));
}

TEST_CASE("a triangle's sum has the lengths of its edges and its corners' forces balance") {
  Random random(3);
  const Sample sample(random, 7, true);
  const auto sums = sums_of(distortion::fastest_kernel<2>(), sample, sample.data({2, 0}, false));
  for (std::size_t i = 0; i < sample.list.size(); ++i) {
    const Index* n = &sample.nodes[3 * static_cast<std::size_t>(sample.list[i])];
    const double* corner = &sums[i * TriangleSum::size + TriangleSum::corners];
    const distortion::Corner2 q(sample.point(n[0]), sample.point(n[1]), sample.point(n[2]));
    const double u = std::hypot(q.ux, q.uy), v = std::hypot(q.vx, q.vy);
    const double w = std::hypot(q.vx - q.ux, q.vy - q.uy);
    CHECK(corner[2] == doctest::Approx(u + v));
    CHECK(corner[6] == doctest::Approx(u + w));
    CHECK(corner[10] == doctest::Approx(v + w));
    const double size = std::abs(corner[0]) + std::abs(corner[1]);
    CHECK(std::abs(corner[0] + corner[4] + corner[8]) <= 1e-12 * size);
    CHECK(std::abs(corner[1] + corner[5] + corner[9]) <= 1e-12 * size);
    CHECK(corner[3] == 1);
  }
}

TEST_CASE("sums are scattered to their rows and blocks") {
  Random random(4);
  std::vector<double> sums(2 * TriangleSum::size);
  for (double& s : sums) s = random.uniform(-1, 1);
  const std::vector<SimplexPlaces<2>> places{{{0, 1, 2}, {1, 2, 3, 4, 5, 6}},
                                             {{1, 3, 0}, {7, 0, 2, 1, 0, 8}}};
  std::vector<double> rows(4 * 8), blocks(9 * 4), rows_alone(4 * 8);
  const TriangleKernel& kernel = distortion::fastest_kernel<2>();
  kernel.scatter(sums.data(), places.data(), 2, rows.data(), blocks.data());
  kernel.scatter(sums.data(), places.data(), 2, rows_alone.data(), nullptr);
  CHECK(rows == rows_alone);

  const auto block = [&](std::size_t t, std::ptrdiff_t place, std::size_t r, std::size_t c) {
    return sums[t * TriangleSum::size + static_cast<std::size_t>(place) + 2 * r + c];
  };
  using S = TriangleSum;
  for (std::size_t r = 0; r < 2; ++r) {
    for (std::size_t c = 0; c < 2; ++c) {
      const std::size_t k = 2 * r + c;
      CHECK(blocks[4 * 1 + k] == doctest::Approx(block(0, S::ab, r, c) + block(1, S::ac, c, r)));
      CHECK(blocks[4 * 2 + k] == doctest::Approx(block(0, S::ab, c, r) + block(1, S::ac, r, c)));
      CHECK(blocks[4 * 5 + k] == block(0, S::bc, r, c));
      CHECK(blocks[4 * 8 + k] == block(1, S::bc, c, r));
      // Row 1: b of the first triangle, a of the second.
      CHECK(rows[8 + k] == doctest::Approx(-block(0, S::ab, c, r) - block(0, S::bc, r, c) -
                                           block(1, S::ab, r, c) - block(1, S::ac, r, c)));
    }
  }
  CHECK(rows[8 + 4] == doctest::Approx(sums[S::corners + 4] + sums[S::size + S::corners]));
}

TEST_CASE("every version of the kernel gives the same bits") {
  const TriangleKernel* fast = distortion::avx2_kernel<2>();
  if (!fast) {
    MESSAGE("no AVX2 here: one version only");
    return;
  }
  const TriangleKernel& portable = distortion::portable_kernel<2>();
  Random random(5);
  for (const PenaltyOptions& penalty : penalties) {
    for (const bool regularised : {false, true}) {
      const Sample sample(random, 30, !regularised);
      const distortion::SimplexData data = sample.data(penalty, regularised);
      CHECK(fast->energy(data, 0, 30) == portable.energy(data, 0, 30));
      const auto sums = sums_of(*fast, sample, data);
      CHECK(sums == sums_of(portable, sample, data));
      const SimplexPlaces<2> places{{0, 1, 2}, {1, 2, 3, 4, 5, 6}};
      std::vector<double> rows(24), blocks(28), other_rows(24), other_blocks(28);
      fast->scatter(sums.data(), &places, 1, rows.data(), blocks.data());
      portable.scatter(sums.data(), &places, 1, other_rows.data(), other_blocks.data());
      CHECK(rows == other_rows);
      CHECK(blocks == other_blocks);
    }
  }
}
