#include "core/strategy/smooth_options.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "core/command/command.h"
#include "core/error.h"
#include "support/surface_meshes.h"

using namespace winslow;

TEST_CASE("the default options are valid") { CHECK_NOTHROW(validate(SmoothOptions{})); }

TEST_CASE("options at the ends of their ranges are valid") {
  SmoothOptions options;
  options.damping = 1;
  options.acceleration = 0;
  options.max_iterations = 0;
  options.threads = 0;
  options.linear.max_iterations = 1;
  options.linear.restart = 1;
  CHECK_NOTHROW(validate(options));
}

TEST_CASE("options out of range are refused, naming the option") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SmoothOptions options;
  std::string word;
  SUBCASE("formulation") {
    options.formulation = static_cast<Formulation>(2);
    word = "formulation: found \"2\", expected one of variational, pointwise";
  }
  SUBCASE("linear solver") {
    options.linear.solver = "magic";
    word = "linear.solver: found \"magic\", expected one of automatic, ";
  }
  SUBCASE("damping zero") {
    options.damping = 0;
    word = "damping";
  }
  SUBCASE("damping above one") {
    options.damping = 1.0001;
    word = "damping";
  }
  SUBCASE("damping NaN") {
    options.damping = nan;
    word = "damping";
  }
  SUBCASE("acceleration negative") {
    options.acceleration = -1;
    word = "acceleration";
  }
  SUBCASE("acceleration huge") {
    options.acceleration = 101;
    word = "acceleration";
  }
  SUBCASE("iterations") {
    options.max_iterations = -1;
    word = "max_iterations: found -1, expected 0 or more";
  }
  SUBCASE("tolerance zero") {
    options.tolerance = 0;
    word = "tolerance";
  }
  SUBCASE("tolerance one") {
    options.tolerance = 1;
    word = "tolerance";
  }
  SUBCASE("tolerance NaN") {
    options.tolerance = nan;
    word = "tolerance";
  }
  SUBCASE("threads") {
    options.threads = -1;
    word = "threads";
  }
  SUBCASE("linear tolerance") {
    options.linear.tolerance = nan;
    word = "linear.tolerance";
  }
  SUBCASE("linear iterations") {
    options.linear.max_iterations = 0;
    word = "linear.max_iterations: found 0, expected 1 or more";
  }
  SUBCASE("restart") {
    options.linear.restart = 0;
    word = "linear.restart";
  }
  try {
    validate(options);
    FAIL("accepted");
  } catch (const UsageError& error) {
    CHECK(std::string(error.what()).find(word) != std::string::npos);
  }
}

TEST_CASE("the tolerance is the one given, else that of the kind of mesh") {
  SmoothOptions options;
  CHECK(tolerance_of(options, 2) == 1e-10);
  CHECK(tolerance_of(options, 3) == 1e-4);
  CHECK(tolerance_of(independent_of_start(options), 3) == 1e-10);
  for (const double given : {1e-12, 1e-4, 1e-2}) {
    options.tolerance = given;
    CHECK(tolerance_of(options, 2) == given);
    CHECK(tolerance_of(options, 3) == given);
    CHECK(independent_of_start(options).tolerance == given);
  }
}

TEST_CASE("rows for a kind of mesh know its tolerance, as long as none is given") {
  SmoothOptions options;
  for (const auto& [kind, tolerance] :
       {std::pair(MeshKind::plane, 1e-10), std::pair(MeshKind::surface, 1e-10),
        std::pair(MeshKind::volume, 1e-4)}) {
    const OptionTable table = option_table(options, kind);
    const auto row = std::ranges::find_if(table, [](const Option& option) {
      return option.key == "tolerance" && option.object.empty();
    });
    REQUIRE(row != table.end());
    CHECK(std::get<OptionalRealOption>(row->value).instead == tolerance);
    CHECK(value_text(*row) == "1e-10; volume meshes: 1e-4");
    options.tolerance = 1e-6;
    CHECK(value_text(*row) == "1e-06");
    options.tolerance.reset();
  }
}

namespace winslow::test {
namespace {

bool is_refused(const SmoothOptions& options) {
  static const MeshState state = make_state(make_mesh(octasphere(3)));
  try {
    execute(SmoothCommand{options}, state);
    return false;
  } catch (const UsageError&) {
    return true;
  }
}

}  // namespace

TEST_CASE("options of a surface mesh: choices that do not apply are those that it refuses") {
  for (const std::string_view key : {"formulation", "outer", "untangle", "vcv"}) {
    SmoothOptions options;
    const OptionTable table = surface_option_table(options);
    const auto row = std::ranges::find_if(
        table, [&](const Option& option) { return option.key == key && option.object.empty(); });
    REQUIRE(row != table.end());
    const auto& choice = std::get<ChoiceOption>(row->value);
    for (std::size_t k = 0; k < choice.items().size(); ++k) {
      choice.choose(k);
      CAPTURE(key);
      CAPTURE(choice.items()[k].name);
      CHECK(is_refused(options) == !choice.items()[k].applies);
    }
  }
}

TEST_CASE("options of a surface mesh: what is left of those of another mesh is settled") {
  SmoothOptions options;
  options.formulation = Formulation::pointwise;
  options.outer = OuterMethod::picard;
  options.untangle = Untangle::picard;
  options.vcv = VcvKind::existing;
  options.vcv_lengths = 0.5;
  options.linear.solver = "gmres";
  options.keep_outside.radius = 1;
  options.slide.markers = {"far"};
  options.slide.periodic = {"a", "b"};
  options.slide.surface_first = true;
  options.tolerance = 1e-6;
  options.slide.feature_angle = 30;
  REQUIRE(is_refused(options));
  settle_for_surface(options);
  CHECK_FALSE(is_refused(options));
  CHECK_NOTHROW(validate(options));
  CHECK(options.formulation == Formulation::variational);
  // What surface meshes take stays.
  CHECK(options.tolerance == 1e-6);
  CHECK(options.slide.feature_angle == 30);
  CHECK(options.linear.solver == "gmres");
}

TEST_CASE("options of a surface mesh: rows without an effect do not apply, those that it has do") {
  SmoothOptions options;
  for (const Option& option : surface_option_table(options)) {
    CAPTURE(option.key);
    if (option.object == "keep_outside") CHECK_FALSE(option.applies);
    for (const std::string_view key : {"formulation", "damping", "clip", "markers", "periodic"})
      if (option.key == key) CHECK_FALSE(option.applies);
    for (const std::string_view key : {"targets", "exponent", "feature_angle", "features"})
      if (option.key == key) CHECK(option.applies);
  }
}

}  // namespace winslow::test
