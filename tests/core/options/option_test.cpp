#include "core/options/option.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <set>

#include "core/command/option_tables.h"
#include "core/error.h"
#include "core/layers/layer_plan.h"
#include "core/motion/motion.h"

using namespace winslow;

namespace {

enum class Fruit { apple, pear };

struct Basket {
  double weight = 2;
  std::optional<double> price = std::nullopt;
  int count = 3;
  bool ripe = true;
  Fruit fruit = Fruit::pear;
  std::string colour = "green";
  double sweet = 1, sour = 0;
};

OptionTable option_table(Basket& b) {
  return {
      {.key = "weight", .value = RealOption{&b.weight, inside(0, 10)}, .label = "", .help = ""},
      {.key = "price", .value = OptionalRealOption{&b.price, above(0)}, .label = "", .help = ""},
      {.key = "count",
       .value = IntegerOption{&b.count, {.low = 2, .also = 0.0}},
       .label = "",
       .help = "",
       .object = "load"},
      {.key = "ripe", .value = SwitchOption{&b.ripe, "unripe", ""}, .label = "", .help = ""},
      {.key = "fruit",
       .value = ChoiceOption(b.fruit, {{"apple", "Apple"}, {"pear", "Pear", "", b.ripe}}),
       .label = "",
       .help = ""},
      {.key = "colour",
       .value = ChoiceOption(b.colour, {{"green", "Green"}, {"red", "Red"}}),
       .label = "",
       .help = "",
       .flag = "paint"},
      {.key = "taste",
       .value = SharesOption{{{"sweet", "", "", &b.sweet}, {"sour", "", "", &b.sour}}},
       .label = "",
       .help = ""},
  };
}

const Option& row(const OptionTable& table, std::string_view key) {
  for (const Option& option : table)
    if (option.key == key) return option;
  throw UsageError("no such row");
}

std::string complaint(Basket basket) {
  try {
    check(option_table(basket));
  } catch (const UsageError& error) {
    return error.what();
  }
  return {};
}

/// Every table there is, with its name.
template <class Visit>
void for_each_table(const Visit& visit) {
  SmoothOptions smooth;
  MotionOptions how;
  RigidMotionRequest rigid;
  SineDeformation sine;
  LayerSpacing spacing;
  MoveCommand move;
  LayersCommand layers;
  ScrambleCommand scramble;
  visit("smooth", option_table(smooth));
  visit("motion", option_table(how));
  visit("rigid", option_table(rigid));
  visit("sine", option_table(sine));
  visit("spacing", option_table(spacing));
  visit("move", option_table(move));
  visit("layers", option_table(layers));
  visit("scramble", option_table(scramble));
}

}  // namespace

TEST_CASE("ranges: what they hold and how they are said") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(at_least(1).text() == "1 or more");
  CHECK(at_least(1).holds(1));
  CHECK_FALSE(at_least(1).holds(0.99));
  CHECK_FALSE(at_least(1).holds(nan));
  CHECK_FALSE(at_least(1).holds(std::numeric_limits<double>::infinity()));
  CHECK(above(0).text() == "more than 0");
  CHECK_FALSE(above(0).holds(0));
  CHECK(between(1, 64).text() == "1 to 64");
  CHECK(between(1, 64).holds(64));
  CHECK(inside(0, 1).text() == "more than 0, less than 1");
  CHECK_FALSE(inside(0, 1).holds(1));
  const Range knee{.low = 1, .low_included = false, .also = 0.0};
  CHECK(knee.text() == "0 or more than 1");
  CHECK(knee.holds(0));
  CHECK_FALSE(knee.holds(1));
  CHECK(Range{}.text().empty());
  CHECK(Range{}.holds(-1e300));
}

TEST_CASE("rows read and write the object that they are bound to") {
  Basket basket;
  const OptionTable table = option_table(basket);
  CHECK(value_text(row(table, "weight")) == "2");
  CHECK(value_text(row(table, "price")).empty());
  CHECK(value_text(row(table, "fruit")) == "pear");
  CHECK(value_text(row(table, "taste")) == "sweet");
  const auto& fruit = std::get<ChoiceOption>(row(table, "fruit").value);
  CHECK(fruit.choose("apple"));
  CHECK(basket.fruit == Fruit::apple);
  CHECK_FALSE(fruit.choose("plum"));
  CHECK(basket.fruit == Fruit::apple);
  const auto& colour = std::get<ChoiceOption>(row(table, "colour").value);
  colour.choose(1);
  CHECK(basket.colour == "red");
  basket.sour = 0.25;
  CHECK(value_text(row(table, "taste")) == "sweet sour=0.25");
}

TEST_CASE("flags and paths come from object and key unless a flag is given") {
  Basket basket;
  const OptionTable table = option_table(basket);
  CHECK(flag_of(row(table, "weight")) == "--weight");
  CHECK(flag_of(row(table, "count")) == "--load-count");
  CHECK(path_of(row(table, "count")) == "load.count");
  CHECK(flag_of(row(table, "ripe")) == "--unripe");
  CHECK(flag_of(row(table, "colour")) == "--paint");
}

TEST_CASE("a check names the option, what was found and what is expected") {
  CHECK(complaint({}).empty());
  CHECK(complaint({.weight = 10}) == "weight: found 10, expected more than 0, less than 10");
  CHECK(complaint({.price = 0}) == "price: found 0, expected more than 0");
  CHECK(complaint({.count = 1}) == "load.count: found 1, expected 0 or 2 or more");
  CHECK(complaint({.count = 0}).empty());
  CHECK(complaint({.colour = "blue"}) == "colour: found \"blue\", expected one of green, red");
  CHECK(complaint({.sweet = 0}) == "taste: the shares must not be negative, nor all zero");
  CHECK(complaint({.sweet = 2, .sour = -1}).starts_with("taste: "));
}

TEST_CASE("choices that do not go with the others are put to one that does") {
  Basket basket;
  CHECK_FALSE(settle(option_table(basket)));
  basket.ripe = false;
  CHECK(settle(option_table(basket)));
  CHECK(basket.fruit == Fruit::apple);
}

TEST_CASE("choosing other equations leaves no solver or iteration that they do not take") {
  SmoothOptions options;
  options.linear.solver = "cg";
  options.formulation = "pointwise";
  settle(option_table(options));
  CHECK(options.linear.solver == "automatic");
  options.outer = OuterMethod::picard;
  options.formulation = "variational";
  settle(option_table(options));
  CHECK(options.outer == OuterMethod::automatic);
}

TEST_CASE("every row of every table is whole: a key of its own, a label, one line of help") {
  for_each_table([](const char* name, const OptionTable& table) {
    CAPTURE(name);
    std::set<std::string> paths, flags;
    for (const Option& option : table) {
      CAPTURE(option.key);
      CHECK(paths.insert(path_of(option)).second);
      CHECK(flags.insert(flag_of(option)).second);
      CHECK_FALSE(option.label.empty());
      CHECK(option.help.size() > 10);
      CHECK(option.help.back() != '.');
      CHECK(option.help.find('\n') == std::string_view::npos);
      CHECK(fault_of(option).empty());  // the default is in range
    }
  });
}
