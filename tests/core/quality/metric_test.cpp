#include "core/quality/metric.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <set>

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
    const double best = info.of_element(good), worst = info.of_element(inverted);
    CHECK((info.field.larger_is_better ? best > worst : best < worst));
    CHECK((info.field.larger_is_better ? worst < info.field.threshold
                                       : worst > info.field.threshold));
    if (!info.of_corner) continue;
    for (const Corner& corner : good) CHECK(info.of_corner(corner) == doctest::Approx(best));
  }
  CHECK(metric_info(Metric::aspect_ratio).of_element(good) == doctest::Approx(1));
  CHECK(metric_info(Metric::area).of_element(good) == doctest::Approx(std::sqrt(0.75) / 2));
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
