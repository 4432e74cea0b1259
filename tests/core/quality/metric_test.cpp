#include "core/quality/metric.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "core/error.h"
#include "core/inspect/element_field.h"
#include "core/quality/quality.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

TEST_CASE("every field has a name of its own, a label and help, and is found by its name") {
  std::set<std::string_view> names;
  for (const ElementField& field : all_element_fields()) {
    const FieldInfo& info = field_info(field);
    CAPTURE(info.name);
    CHECK(names.insert(info.name).second);
    CHECK_FALSE(info.label.empty());
    CHECK(info.help.ends_with('.'));
    CHECK(parse_field(info.name) == field);
  }
  for (const Metric metric : all_metrics()) CHECK(names.contains(metric_name(metric)));
}

TEST_CASE("metrics of the best elements are at their best, inverted ones beyond the threshold") {
  const std::array<Vec2, 3> equilateral{Vec2(0, 0), Vec2(1, 0), Vec2(0.5, std::sqrt(0.75))};
  const auto corners_of = [](const std::array<Vec2, 3>& p) {
    return std::array<Corner, 3>{Corner(p[0], p[1], p[2]), Corner(p[1], p[2], p[0]),
                                 Corner(p[2], p[0], p[1])};
  };
  const auto good = corners_of(equilateral);
  const auto inverted = corners_of({equilateral[0], equilateral[2], equilateral[1]});
  for (const Metric metric : all_metrics()) {
    CAPTURE(metric_name(metric));
    const MetricInfo& info = metric_info(metric);
    const double best = info.of_element({good}), worst = info.of_element({inverted});
    CHECK((info.field.larger_is_better ? best > worst : best < worst));
    CHECK((info.field.larger_is_better ? worst < info.field.threshold
                                       : worst > info.field.threshold));
    if (!info.of_corner) continue;
    for (const Corner& corner : good) CHECK((corner.*info.of_corner)() == doctest::Approx(best));
  }
  CHECK(metric_info(Metric::aspect_ratio).of_element({good}) == doctest::Approx(1));
  CHECK(metric_info(Metric::area).of_element({good}) == doctest::Approx(std::sqrt(0.75) / 2));
}

TEST_CASE("a report has what the table says is reported, and nothing of the others") {
  const Mesh mesh = make_mesh(square(4, Cells::triangles));
  const QualityReport report = measure_quality(mesh);
  CHECK(report.metrics.size() == reported_metrics().size());
  for (const Metric metric : all_metrics()) {
    CAPTURE(metric_name(metric));
    if (metric_info(metric).reported) {
      CHECK(&report.of(metric) >= report.metrics.data());
    } else {
      CHECK_THROWS_AS(report.of(metric), UsageError);
    }
  }
}

TEST_CASE("angles and skewness of triangles and quadrilaterals that are known by hand") {
  const auto of = [](Metric metric, const std::vector<Vec2>& p) {
    std::vector<Corner> corners;
    for (std::size_t k = 0; k < p.size(); ++k)
      corners.emplace_back(p[k], p[(k + 1) % p.size()], p[(k + p.size() - 1) % p.size()]);
    return metric_info(metric).of_element({corners});
  };
  const double steep = std::sqrt(3.0);
  const std::vector<Vec2> half_square{{0, 0}, {1, 0}, {0, 1}};
  CHECK(of(Metric::smallest_angle, half_square) == doctest::Approx(45));
  CHECK(of(Metric::largest_angle, half_square) == doctest::Approx(90));
  CHECK(of(Metric::skewness, half_square) == doctest::Approx(0.25));
  const std::vector<Vec2> obtuse{{-steep, 0}, {steep, 0}, {0, 1}};  // 30, 30, 120 degrees
  CHECK(of(Metric::smallest_angle, obtuse) == doctest::Approx(30));
  CHECK(of(Metric::largest_angle, obtuse) == doctest::Approx(120));
  CHECK(of(Metric::skewness, obtuse) == doctest::Approx(0.5));
  const std::vector<Vec2> rhombus{{0, 0}, {2, 0}, {3, steep}, {1, steep}};  // 60, 120
  CHECK(of(Metric::smallest_angle, rhombus) == doctest::Approx(60));
  CHECK(of(Metric::largest_angle, rhombus) == doctest::Approx(120));
  CHECK(of(Metric::skewness, rhombus) == doctest::Approx(1.0 / 3));
  const std::vector<Vec2> cell_at_a_wall{{0, 0}, {1, 0}, {1, 1e-6}, {0, 1e-6}};
  CHECK(of(Metric::skewness, cell_at_a_wall) == doctest::Approx(0));
  const std::vector<Vec2> arrowhead{{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}};  // inverted at its third
  CHECK(of(Metric::smallest_angle, arrowhead) < 0);
  CHECK(of(Metric::largest_angle, arrowhead) ==
        doctest::Approx(360 + of(Metric::smallest_angle, arrowhead)));
  CHECK(of(Metric::skewness, arrowhead) > 1);
}

TEST_CASE("measures of stretching are not judged, all others are") {
  for (const Metric metric : reported_metrics()) {
    CAPTURE(metric_name(metric));
    const bool stretching = metric == Metric::aspect_ratio || metric == Metric::condition_number;
    CHECK(metric_info(metric).field.judged != stretching);
  }
}
