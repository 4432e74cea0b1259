#include "core/linear/block_kernel.h"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/linear/blocks.h"
#include "support/random.h"

using namespace winslow;
using namespace winslow::test;

namespace {

using Block3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

template <typename T>
std::vector<T> random_numbers(std::size_t count, Random& random) {
  std::vector<T> numbers(count);
  for (T& v : numbers) v = static_cast<T>(random.uniform(-1, 1));
  return numbers;
}

}  // namespace

TEST_CASE("triple products of blocks: both versions give the same bits, and the right ones") {
  Random random(3);
  const auto left = random_numbers<float>(9, random);
  const auto a = random_numbers<double>(9, random);
  const std::vector<Index> columns{4, 1, 3};
  const std::vector<Index> slot_of{-1, 2, -1, 0, 1};
  const auto right = random_numbers<float>(27, random);
  const auto start = random_numbers<double>(3 * padded_block, random);
  const auto run = [&](const BlockKernel& kernel) {
    auto coarse = start;
    kernel.add_triple_products(left.data(), a.data(), right.data(), columns.data(), 3,
                               slot_of.data(), coarse.data());
    return coarse;
  };
  const auto found = run(portable_block_kernel());
  if (const BlockKernel* fast = avx2_block_kernel()) CHECK(run(*fast) == found);
  const auto block_of = [](const float* p) {
    return Eigen::Map<const Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(p).cast<double>().eval();
  };
  for (std::size_t q = 0; q < 3; ++q) {
    const Block3 expected = block_of(left.data()).transpose() * Eigen::Map<const Block3>(a.data()) *
                            block_of(&right[9 * q]);
    const auto place = static_cast<std::size_t>(padded_block * slot_of[at(columns[q])]);
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t k = place + 4 * r + c;
        CHECK(found[k] - start[k] ==
              doctest::Approx(expected(static_cast<int>(r), static_cast<int>(c))).epsilon(1e-14));
      }
    }
  }
}

namespace {

/// Checks a sum over entries of a matrix of blocks against Eigen, for every range of them.
template <int B, int N>
void check_row_sum(Random& random) {
  const std::vector<Index> columns{2, 0, 5, 3, 1};
  const auto values = random_numbers<float>(5 * B * B + block_tail, random);
  const auto x = random_numbers<float>(6 * N, random);
  for (Index first = 0; first <= 5; ++first) {
    for (Index last = first; last <= 5; ++last) {
      Eigen::Matrix<double, N, 1> expected = Eigen::Matrix<double, N, 1>::Zero();
      for (auto e = at(first); e < at(last); ++e) {
        const Eigen::MatrixXf a = Eigen::Map<const Eigen::Matrix<float, B, B>>(&values[B * B * e]);
        const float* from = &x[N * at(columns[e])];
        for (int r = 0; r < (B == 1 ? N : B); ++r)
          for (int c = 0; c < B; ++c)
            expected[r] += static_cast<double>(B == 1 ? a(0, 0) * from[r] : a(r, c) * from[c]);
      }
      BlockSum<B, N> sum;
      sum.add(values.data(), columns.data(), first, last, x.data());
      for (int k = 0; k < (B == 3 ? 3 : N); ++k) {
        CHECK(static_cast<double>(sum.total()[k]) == doctest::Approx(expected[k]).epsilon(1e-5));
      }
    }
  }
}

}  // namespace

TEST_CASE("sums over a row of blocks of every shape") {
  Random random(5);
  check_row_sum<1, 1>(random);
  check_row_sum<1, 4>(random);
  check_row_sum<2, 2>(random);
  check_row_sum<3, 4>(random);
}

TEST_CASE("the product of a row of blocks with a vector") {
  Random random(4);
  const std::vector<Index> columns{2, 0, 5, 3};
  const auto values = random_numbers<double>(36, random);
  const auto x = random_numbers<double>(18, random);
  for (Index first = 0; first <= 4; ++first) {
    Eigen::Vector3d expected = Eigen::Vector3d::Zero();
    for (auto e = at(first); e < 4; ++e) {
      expected += Eigen::Map<const Block3>(&values[9 * e]) *
                  Eigen::Map<const Eigen::Vector3d>(&x[3 * at(columns[e])]);
    }
    std::array<double, 3> found{};
    row_product<3>(values.data(), columns.data(), first, 4, x.data(), found.data());
    for (int k = 0; k < 3; ++k) CHECK(found[at(k)] == doctest::Approx(expected[k]).epsilon(1e-14));
  }
}
