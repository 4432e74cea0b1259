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

TEST_CASE("the product of a row of blocks with a vector, in both precisions") {
  Random random(4);
  const std::vector<Index> columns{2, 0, 5, 3};
  const auto values = random_numbers<double>(36, random);
  const auto x = random_numbers<double>(18, random);
  const std::vector<float> values_single(values.begin(), values.end()),
      x_single(x.begin(), x.end());
  for (Index first = 0; first <= 4; ++first) {
    Eigen::Vector3d expected = Eigen::Vector3d::Zero();
    for (auto e = at(first); e < 4; ++e) {
      expected += Eigen::Map<const Block3>(&values[9 * e]) *
                  Eigen::Map<const Eigen::Vector3d>(&x[3 * at(columns[e])]);
    }
    std::array<double, 3> found{};
    row_product<3>(values.data(), columns.data(), first, 4, x.data(), found.data());
    std::array<float, 3> found_single{};
    row_product<3>(values_single.data(), columns.data(), first, 4, x_single.data(),
                   found_single.data());
    for (int k = 0; k < 3; ++k) {
      CHECK(found[at(k)] == doctest::Approx(expected[k]).epsilon(1e-14));
      CHECK(static_cast<double>(found_single[at(k)]) == doctest::Approx(expected[k]).epsilon(1e-5));
    }
  }
}
