#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/formulation/simplex_kernel.h"
#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_form.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

TEST_CASE("both versions of the loops over tetrahedra give the same bits") {
  const distortion::TetrahedronKernel* fast = distortion::avx2_kernel<3>();
  if (!fast) return;
  const Mesh mesh = shaken_box(3, 0.15, 7);
  const auto targets =
      volume_targets(*mesh.topology, nullptr, TargetBlend::automatically(), &mesh.coordinates, 1);
  const auto count = static_cast<Index>(targets.cells.size());
  std::vector<double> sizes(targets.cells.size(), 0.01);
  std::vector<Index> list(targets.cells.size());
  for (Index i = 0; i < count; ++i) list[at(i)] = count - 1 - i;
  distortion::SimplexData data;
  data.x = mesh.coordinates.values().data();
  data.nodes = targets.cells.front().data();
  data.offsets = targets.offsets.data();
  data.terms = &targets.terms.front().a11;
  data.penalty = distortion::PenaltyFunction(PenaltyOptions{}).constants();
  for (const bool regularised : {false, true}) {
    if (regularised) {
      data.size = sizes.data();
      data.epsilon = 1;
      data.curvature_share = 0;
    }
    std::vector<double> a(distortion::SimplexLayout<3>::sum * (targets.cells.size() + 3)), b(a);
    const auto& portable = distortion::portable_kernel<3>();
    CHECK(portable.energy(data, 0, count) == fast->energy(data, 0, count));
    CHECK(portable.sum(data, list.data(), count, 0, a.data()) ==
          fast->sum(data, list.data(), count, 0, b.data()));
    const auto check_same = [&] {
      for (std::size_t i = 0; i < distortion::SimplexLayout<3>::sum * targets.cells.size(); ++i) {
        CHECK(a[i] == b[i]);
      }
    };
    check_same();
    if (regularised) continue;
    CHECK(portable.sum_projected(data, list.data(), count, 0, a.data()) ==
          fast->sum_projected(data, list.data(), count, 0, b.data()));
    check_same();
    // Scattered, with and without the Hessian.
    std::vector<distortion::SimplexPlaces<3>> places(targets.cells.size());
    Random random(12);
    for (auto& place : places) {
      for (auto& row : place.rows) row = static_cast<std::uint16_t>(random.index(9));
      for (Index& block : place.blocks) block = random.index(50);
    }
    std::vector<double> rows(16 * 9), other_rows(rows), blocks(9 * 50), other_blocks(blocks);
    portable.scatter(a.data(), places.data(), count, rows.data(), blocks.data());
    fast->scatter(a.data(), places.data(), count, other_rows.data(), other_blocks.data());
    CHECK(rows == other_rows);
    CHECK(blocks == other_blocks);
    a.assign(a.size(), 0);
    b = a;
    portable.sum_gradients(data, list.data(), count, a.data());
    fast->sum_gradients(data, list.data(), count, b.data());
    const std::size_t slim = distortion::SimplexLayout<3>::slim_sum * targets.cells.size();
    CHECK(std::equal(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(slim), b.begin()));
    portable.scatter_gradients(a.data(), places.data(), count, rows.data());
    fast->scatter_gradients(a.data(), places.data(), count, other_rows.data());
    CHECK(rows == other_rows);
  }
}

TEST_CASE("both versions of the loops of first-order steps over tetrahedra give the same bits") {
  const distortion::TetrahedronKernel* fast = distortion::avx2_kernel<3>();
  if (!fast) return;
  const distortion::TetrahedronKernel& portable = distortion::portable_kernel<3>();
  const Mesh mesh = shaken_box(3, 0.15, 7);
  const Mesh regular = make_mesh(cube(3, Volumes::tetrahedra));
  for (const TargetBlend& blend : {TargetBlend::automatically(), TargetBlend::keeping()}) {
    CAPTURE(blend.keep);
    const auto targets = volume_targets(*regular.topology, nullptr, blend, &regular.coordinates, 1);
    const auto count = static_cast<Index>(targets.cells.size());
    distortion::SimplexData data;
    data.x = mesh.coordinates.values().data();
    data.nodes = targets.cells.front().data();
    data.offsets = targets.offsets.data();
    data.terms = &targets.terms.front().a11;
    if (!targets.inverse_limits.empty()) data.inverse_limits = targets.inverse_limits.data();
    data.penalty = distortion::PenaltyFunction({.guard = 5}, true).constants();
    std::vector<double> x(4 * at(mesh.coordinates.size()), 0.0), a(x), b(x);
    for (Index node = 0; node < mesh.coordinates.size(); ++node)
      Eigen::Map<Vec3>(x.data() + 4 * at(node)) = mesh.coordinates.xyz(node);
    const double energy = portable.add_gradients(data, x.data(), data.nodes, 0, count, a.data());
    CHECK(energy == doctest::Approx(portable.energy(data, 0, count)).epsilon(1e-13));
    CHECK(energy == fast->add_gradients(data, x.data(), data.nodes, 0, count, b.data()));
    CHECK(a == b);
    constexpr std::size_t numbers = distortion::SimplexLayout<3>::scale;
    a.assign(numbers * at(mesh.coordinates.size()), 0);
    b = a;
    portable.add_scales(data, x.data(), data.nodes, 0, count, a.data());
    fast->add_scales(data, x.data(), data.nodes, 0, count, b.data());
    CHECK(a == b);
    std::vector<Index> list(targets.cells.size());
    for (Index i = 0; i < count; ++i) list[at(i)] = count - 1 - i;
    constexpr std::size_t size = distortion::SimplexLayout<3>::scalar_sum;
    a.assign(size * (list.size() + 3), 0);
    b = a;
    portable.sum_scalars(data, list.data(), count, a.data());
    fast->sum_scalars(data, list.data(), count, b.data());
    a.resize(size * list.size());
    b.resize(a.size());
    CHECK(a == b);
  }
}

TEST_CASE("the gradients of every number of tetrahedra are those of each alone") {
  // Several packs of cells go side by side, and the last ones are not full.
  const Mesh mesh = shaken_box(3, 0.15, 7);
  const auto targets = volume_targets(*mesh.topology, nullptr, TargetBlend::regular(), nullptr, 1);
  distortion::SimplexData data;
  data.offsets = targets.offsets.data();
  data.terms = &targets.terms.front().a11;
  data.penalty = distortion::PenaltyFunction(PenaltyOptions{}).constants();
  std::vector<double> x(4 * at(mesh.coordinates.size()), 0.0);
  for (Index node = 0; node < mesh.coordinates.size(); ++node)
    Eigen::Map<Vec3>(x.data() + 4 * at(node)) = mesh.coordinates.xyz(node);
  const auto& kernel = distortion::fastest_kernel<3>();
  std::vector<double> one_by_one(x.size(), 0.0);
  double energy = 0;
  for (Index count = 0; count <= 35; ++count) {
    CAPTURE(count);
    std::vector<double> sums(x.size(), 0.0);
    const Index* corners = targets.cells.front().data();
    CHECK(kernel.add_gradients(data, x.data(), corners, 0, count, sums.data()) ==
          doctest::Approx(energy).epsilon(1e-13));
    for (std::size_t i = 0; i < sums.size(); ++i)
      CHECK(sums[i] == doctest::Approx(one_by_one[i]).epsilon(1e-12).scale(1e-3));
    energy += kernel.add_gradients(data, x.data(), targets.cells[at(count)].data(), count,
                                   count + 1, one_by_one.data());
  }
  // An inverted cell among them, wherever it is.
  for (Index inverted = 0; inverted < 35; ++inverted) {
    auto cells = targets.cells;
    std::swap(cells[at(inverted)][0], cells[at(inverted)][1]);
    std::vector<double> sums(x.size(), 0.0);
    CHECK(
        std::isinf(kernel.add_gradients(data, x.data(), cells.front().data(), 0, 35, sums.data())));
  }
}

TEST_CASE("the sums of a tetrahedron go to its rows and blocks, with their transposes") {
  using Layout = distortion::SimplexLayout<3>;
  Random random(13);
  std::vector<double> sums(2 * Layout::sum);
  for (double& s : sums) s = random.uniform(-1, 1);
  // The second tetrahedron has its third node outside the block of rows.
  const std::vector<distortion::SimplexPlaces<3>> places{
      {{0, 1, 2, 3}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}},
      {{3, 1, 4, 0}, {10, 9, 0, 0, 6, 5, 0, 0, 2, 1, 0, 0}}};
  const distortion::TetrahedronKernel& kernel = distortion::fastest_kernel<3>();
  std::vector<double> rows(16 * 5), rows_alone(rows), blocks(9 * 13);
  kernel.scatter(sums.data(), places.data(), 2, rows.data(), blocks.data());
  kernel.scatter(sums.data(), places.data(), 2, rows_alone.data(), nullptr);
  CHECK(rows == rows_alone);
  const auto corner = [&](std::size_t cell, std::size_t k, std::size_t i) {
    return sums[Layout::sum * cell + Layout::corners + Layout::corner * k + i];
  };
  const auto pair = [&](std::size_t cell, std::size_t k, std::size_t i) {
    return sums[Layout::sum * cell + 9 * k + i];
  };
  for (std::size_t i = 0; i < 16; ++i) {
    CHECK(rows[16 * 1 + i] == corner(0, 1, i) + corner(1, 1, i));
    CHECK(rows[16 * 2 + i] == corner(0, 2, i));
    CHECK(rows[16 * 3 + i] == corner(0, 3, i) + corner(1, 0, i));
  }
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = 3 * r + c, transposed = 3 * c + r;
      CHECK(blocks[9 * 1 + i] == pair(0, 0, i) + pair(1, 4, transposed));
      CHECK(blocks[9 * 2 + i] == pair(0, 0, transposed) + pair(1, 4, i));
      CHECK(blocks[9 * 7 + i] == pair(0, 3, i));
      CHECK(blocks[9 * 8 + i] == pair(0, 3, transposed));
      CHECK(blocks[9 * 10 + i] == pair(0, 4, transposed) + pair(1, 0, i));
    }
  }
}
