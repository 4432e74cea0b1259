#include "core/quality/quality.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.h"
#include "core/parallel/parallel_for.h"
#include "core/quality/corner_kernel.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// A mesh of one element. The topology is built from a regular polygon, so that the element may be
/// inverted or flat.
Mesh single(std::initializer_list<Vec2> corners) {
  MeshData data;
  std::vector<Index> ids;
  const auto n = static_cast<Index>(corners.size());
  for (Index k = 0; k < n; ++k) {
    data.coordinates.push_xy({std::cos(2 * pi * k / n), std::sin(2 * pi * k / n)});
    ids.push_back(k);
  }
  data.add_element(n == 3 ? ElementType::triangle : ElementType::quadrilateral, ids);
  Mesh mesh{Topology::build(data), {}};
  for (const Vec2& p : corners) mesh.coordinates.push_xy(p);
  return mesh;
}

struct Values {
  double sine, aspect, condition, area;
};

Values values_of(const Mesh& mesh) {
  return {element_values(mesh, Metric::normalized_jacobian)[0],
          element_values(mesh, Metric::aspect_ratio)[0],
          element_values(mesh, Metric::condition_number)[0], element_values(mesh, Metric::area)[0]};
}

void check_values(const Mesh& mesh, const Values& expected) {
  const Values v = values_of(mesh);
  CHECK(v.sine == doctest::Approx(expected.sine));
  // Two infinities are equal, but Approx does not know it.
  CHECK((v.aspect == expected.aspect || v.aspect == doctest::Approx(expected.aspect)));
  CHECK((v.condition == expected.condition || v.condition == doctest::Approx(expected.condition)));
  CHECK(v.area == doctest::Approx(expected.area));
}

const double root2 = std::sqrt(2.0);
const double root3 = std::sqrt(3.0);
constexpr double infinity = std::numeric_limits<double>::infinity();

Mesh moved_at_random(std::uint64_t seed, Cells cells, bool tangled) {
  Random random(seed);
  Mesh mesh = make_mesh(square_with_two_holes(10, cells));
  if (tangled) {
    tangle(mesh, random);
  } else {
    perturb(mesh, random);
  }
  return mesh;
}

/// Sine of the angle at b, measured as an angle.
double sine_at(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = c - b, v = a - b;
  return std::sin(std::atan2(v.y(), v.x()) - std::atan2(u.y(), u.x()));
}

}  // namespace

TEST_CASE("triangles whose values are known") {
  SUBCASE("equilateral") {
    check_values(single({{0, 0}, {1, 0}, {0.5, root3 / 2}}), {root3 / 2, 1, 1, root3 / 4});
  }
  SUBCASE("right isosceles") {
    check_values(single({{0, 0}, {1, 0}, {0, 1}}), {root2 / 2, (1 + root2) / 2, 2 / root3, 0.5});
  }
  SUBCASE("3-4-5: circumradius 2.5, inradius 1") {
    check_values(single({{0, 0}, {4, 0}, {0, 3}}), {0.6, 1.25, 50 / (4 * root3 * 6), 6});
  }
  SUBCASE("inverted") {
    check_values(single({{0, 0}, {0.5, root3 / 2}, {1, 0}}),
                 {-root3 / 2, infinity, infinity, -root3 / 4});
  }
  SUBCASE("flat") { check_values(single({{0, 0}, {1, 0}, {3, 0}}), {0, infinity, infinity, 0}); }
  SUBCASE("all in one point") {
    check_values(single({{1, 1}, {1, 1}, {1, 1}}), {0, infinity, infinity, 0});
  }
}

TEST_CASE("quadrilaterals whose values are known") {
  SUBCASE("square") { check_values(single({{0, 0}, {2, 0}, {2, 2}, {0, 2}}), {1, 1, 1, 4}); }
  SUBCASE("rectangle of aspect 3") {
    const double d = std::sqrt(10.0);
    check_values(single({{0, 0}, {3, 0}, {3, 1}, {0, 1}}),
                 {1, 3 * d * (4 + d) / (4 * 9) / ((1 + root2) / 2), 10.0 / 6, 3});
  }
  SUBCASE("rhombus of 30 degrees") {
    const Vec2 a(1, 0), b(root3 / 2, 0.5);
    const Mesh mesh = single({{0, 0}, a, a + b, b});
    CHECK(values_of(mesh).sine == doctest::Approx(0.5));
    CHECK(values_of(mesh).condition == doctest::Approx(2));
    CHECK(values_of(mesh).area == doctest::Approx(0.5));
  }
  SUBCASE("arrow: one corner inverted though its area is positive") {
    const Mesh mesh = single({{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}});
    CHECK(values_of(mesh).sine < 0);
    CHECK(values_of(mesh).aspect == infinity);
    CHECK(values_of(mesh).condition == infinity);
    CHECK(values_of(mesh).area > 0);
    CHECK(measure_quality(mesh).inverted == 1);
  }
  SUBCASE("bow tie") {
    const Mesh mesh = single({{0, 0}, {1, 1}, {1, 0}, {0, 1}});
    CHECK(measure_quality(mesh).inverted == 1);
    CHECK(values_of(mesh).sine == doctest::Approx(-1 / root2));
  }
}

TEST_CASE("metrics do not depend on place, orientation or size") {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    CAPTURE(seed);
    const Mesh mesh = moved_at_random(seed, Cells::mixed, false);
    Random random(seed);
    const double phi = random.uniform(0, 2 * pi), size = random.uniform(0.01, 100);
    const Vec2 shift = random.vector(-5, 5);
    Mesh other = mesh;
    for (Index i = 0; i < mesh.coordinates.size(); ++i) {
      const Vec2 p = mesh.coordinates.xy(i);
      other.coordinates.set_xy(i,
                               shift + size * Vec2(std::cos(phi) * p.x() - std::sin(phi) * p.y(),
                                                   std::sin(phi) * p.x() + std::cos(phi) * p.y()));
    }
    for (const Metric metric :
         {Metric::normalized_jacobian, Metric::aspect_ratio, Metric::condition_number}) {
      const auto a = element_values(mesh, metric), b = element_values(other, metric);
      for (std::size_t e = 0; e < a.size(); ++e) {
        CHECK(b[e] == doctest::Approx(a[e]).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("statistics: of the sine over all corners, of the others over the elements") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    constexpr std::uint64_t seed = 4;
    CAPTURE(seed);
    CAPTURE(name_of(cells));
    const Mesh mesh = moved_at_random(seed, cells, false);
    std::vector<double> sines;
    for (Index e = 0; e < mesh.topology->element_count(); ++e) {
      const auto c = mesh.topology->element(e);
      for (std::size_t k = 0; k < c.size(); ++k) {
        sines.push_back(sine_at(mesh.coordinates.xy(c[(k + c.size() - 1) % c.size()]),
                                mesh.coordinates.xy(c[k]),
                                mesh.coordinates.xy(c[(k + 1) % c.size()])));
      }
    }
    const QualityReport report = measure_quality(mesh);
    const auto check = [](const Statistics& s, const std::vector<double>& v) {
      CHECK(s.min == doctest::Approx(*std::min_element(v.begin(), v.end())));
      CHECK(s.max == doctest::Approx(*std::max_element(v.begin(), v.end())));
      CHECK(s.avg == doctest::Approx(std::accumulate(v.begin(), v.end(), 0.0) /
                                     static_cast<double>(v.size())));
    };
    CHECK(report.elements == mesh.topology->element_count());
    CHECK(report.inverted == 0);
    check(report.of(Metric::normalized_jacobian).statistics, sines);
    check(report.of(Metric::aspect_ratio).statistics, element_values(mesh, Metric::aspect_ratio));
    check(report.of(Metric::condition_number).statistics,
          element_values(mesh, Metric::condition_number));
  }
}

TEST_CASE("inverted elements are counted and listed, and left out of aspect and condition") {
  for (const std::uint64_t seed : {5u, 6u, 7u}) {
    CAPTURE(seed);
    const Mesh mesh = moved_at_random(seed, Cells::mixed, true);
    const QualityReport report = measure_quality(mesh);
    const auto condition = element_values(mesh, Metric::condition_number);
    std::vector<Index> inverted;
    std::vector<double> rest;
    for (std::size_t e = 0; e < condition.size(); ++e) {
      if (std::isfinite(condition[e])) {
        rest.push_back(condition[e]);
      } else {
        inverted.push_back(static_cast<Index>(e));
      }
    }
    REQUIRE(!inverted.empty());
    CHECK(report.inverted == static_cast<Index>(inverted.size()));
    if (inverted.size() > 100) inverted.resize(100);
    CHECK(report.inverted_elements == inverted);
    CHECK(report.of(Metric::condition_number).statistics.max ==
          doctest::Approx(*std::max_element(rest.begin(), rest.end())));
    CHECK(std::isfinite(report.of(Metric::aspect_ratio).statistics.avg));
    CHECK(report.of(Metric::condition_number).worst.front().value == infinity);
  }
}

TEST_CASE("histograms hold every value once, in its bin") {
  constexpr std::uint64_t seed = 8;
  CAPTURE(seed);
  const Mesh mesh = moved_at_random(seed, Cells::triangles, false);
  QualityOptions options;
  options.histogram_bins = 7;
  const QualityReport report = measure_quality(mesh, options);
  const Histogram& h = report.of(Metric::condition_number).histogram;
  REQUIRE(h.counts.size() == 7);
  CHECK(h.low == 1);
  CHECK(h.high == report.of(Metric::condition_number).statistics.max);
  std::vector<Index> counts(7, 0);
  for (const double v : element_values(mesh, Metric::condition_number)) {
    std::size_t bin = 0;
    while (bin < 6 && v >= h.low + (h.high - h.low) * static_cast<double>(bin + 1) / 7) ++bin;
    ++counts[bin];
  }
  CHECK(h.counts == counts);
  const auto& sines = report.of(Metric::normalized_jacobian).histogram;
  CHECK(sines.low == 0);
  CHECK(sines.high == 1);
  CHECK(std::accumulate(sines.counts.begin(), sines.counts.end(), 0) ==
        3 * mesh.topology->element_count());
  const Mesh tangled = moved_at_random(seed, Cells::triangles, true);
  const auto& below = measure_quality(tangled).of(Metric::normalized_jacobian);
  CHECK(below.histogram.low == below.statistics.min);
  CHECK(below.histogram.low < 0);
}

TEST_CASE("the worst elements, worst first") {
  constexpr std::uint64_t seed = 9;
  CAPTURE(seed);
  const Mesh mesh = moved_at_random(seed, Cells::mixed, false);
  QualityOptions options;
  options.worst = 5;
  const QualityReport report = measure_quality(mesh, options);
  for (const Metric metric :
       {Metric::normalized_jacobian, Metric::aspect_ratio, Metric::condition_number}) {
    CAPTURE(metric_name(metric));
    const auto values = element_values(mesh, metric);
    auto sorted = values;
    std::sort(sorted.begin(), sorted.end());
    if (metric != Metric::normalized_jacobian) std::reverse(sorted.begin(), sorted.end());
    const auto& worst = report.of(metric).worst;
    REQUIRE(worst.size() == 5);
    for (std::size_t k = 0; k < 5; ++k) {
      CHECK(worst[k].value == sorted[k]);
      CHECK(values[at(worst[k].element)] == worst[k].value);
      Vec2 centre(0, 0);
      const auto c = mesh.topology->element(worst[k].element);
      for (const Index node : c) centre += mesh.coordinates.xy(node);
      CHECK((worst[k].centre.head<2>() - centre / static_cast<double>(c.size())).norm() < 1e-15);
    }
  }
  options.worst = 0;
  CHECK(measure_quality(mesh, options).of(Metric::aspect_ratio).worst.empty());
  options.worst = 1000000;
  CHECK(measure_quality(mesh, options).of(Metric::aspect_ratio).worst.size() ==
        at(mesh.topology->element_count()));
}

TEST_CASE("the result does not depend on the number of threads") {
  Mesh mesh = make_mesh(square(100, Cells::mixed));
  constexpr std::uint64_t seed = 10;
  CAPTURE(seed);
  Random random(seed);
  tangle(mesh, random);
  REQUIRE(mesh.topology->element_count() > 2 * parallel_block);
  QualityOptions options;
  options.threads = 1;
  const QualityReport one = measure_quality(mesh, options);
  const Validity validity = check_validity(*mesh.topology, mesh.coordinates, 1);
  for (const int threads : {2, 5, 0}) {
    CAPTURE(threads);
    options.threads = threads;
    const QualityReport several = measure_quality(mesh, options);
    CHECK(several.inverted == one.inverted);
    CHECK(several.inverted_elements == one.inverted_elements);
    for (const Metric metric :
         {Metric::normalized_jacobian, Metric::aspect_ratio, Metric::condition_number}) {
      CHECK(several.of(metric).statistics.avg == one.of(metric).statistics.avg);
      CHECK(several.of(metric).statistics.max == one.of(metric).statistics.max);
      CHECK(several.of(metric).histogram.counts == one.of(metric).histogram.counts);
    }
    const Validity other = check_validity(*mesh.topology, mesh.coordinates, threads);
    CHECK(other.inverted == validity.inverted);
    CHECK(other.min_sine == validity.min_sine);
  }
}

TEST_CASE("the quick check agrees with the full measurement on tangled meshes") {
  for (std::uint64_t seed = 11; seed < 17; ++seed) {
    for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
      CAPTURE(seed);
      CAPTURE(name_of(cells));
      const Mesh mesh = moved_at_random(seed, cells, seed % 2 == 0);
      const Validity validity = check_validity(*mesh.topology, mesh.coordinates, 1);
      const QualityReport report = measure_quality(mesh);
      CHECK(validity.inverted == report.inverted);
      CHECK(validity.min_sine == report.of(Metric::normalized_jacobian).statistics.min);
    }
  }
}

TEST_CASE("the two agree also where round-off decides whether a triangle is flat") {
  constexpr std::uint64_t seed = 18;
  CAPTURE(seed);
  Random random(seed);
  Index inverted = 0;
  for (int k = 0; k < 3000; ++k) {
    const Vec2 a = random.vector(), d = random.vector();
    const Mesh mesh = single({a, a + random.uniform(1, 2) * d, a + random.uniform() * d});
    const Index quick = check_validity(*mesh.topology, mesh.coordinates, 1).inverted;
    const QualityReport report = measure_quality(mesh);
    REQUIRE(report.inverted == quick);
    REQUIRE(std::isinf(values_of(mesh).aspect) == (quick == 1));
    inverted += quick;
  }
  CHECK(inverted > 0);
  CHECK(inverted < 3000);
}

TEST_CASE("every version of the quick check gives the same bits") {
  const CornerKernel fast = avx2_corner_kernel();
  if (!fast) {
    MESSAGE("no AVX2 here: one version only");
    return;
  }
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    const Mesh mesh = moved_at_random(19, cells, true);
    const CompressedRows& elements = mesh.topology->elements();
    const CornerData data{mesh.coordinates.values().data(), elements.offsets.data(),
                          elements.values.data()};
    for (Index begin = 0; begin + 7 < elements.rows(); begin += 5) {
      const CornerSummary a = fast(data, begin, begin + 7);
      const CornerSummary b = portable_corner_kernel()(data, begin, begin + 7);
      CHECK(a.inverted == b.inverted);
      CHECK(a.min_sine == b.min_sine);
    }
  }
}

TEST_CASE("metrics are known by name") {
  for (const Metric metric : {Metric::normalized_jacobian, Metric::aspect_ratio,
                              Metric::condition_number, Metric::area}) {
    CHECK(parse_metric(metric_name(metric)) == metric);
    CHECK(!metric_label(metric).empty());
  }
  CHECK(metric_name(Metric::normalized_jacobian) == "normalized_jacobian");
  CHECK_THROWS_WITH_AS(parse_metric("beauty"),
                       "unknown metric 'beauty', expected one of: normalized_jacobian, "
                       "aspect_ratio, condition_number, smallest_angle, largest_angle, "
                       "skewness, area",
                       UsageError);
  const Mesh mesh = make_mesh(square(2, Cells::quads));
  CHECK_THROWS_AS(measure_quality(mesh).of(Metric::area), UsageError);
}
