#include "app/options/flags.h"

#include <charconv>
#include <cstdlib>
#include <system_error>

#include "core/error.h"
#include "core/layers/layer_plan.h"

namespace winslow::app {

namespace {

/// Parses "KEY=NUMBER,KEY=NUMBER" and calls set(key, number) for each; set returns whether the key
/// is known.
template <class Set>
void read_settings(const std::string& text, const std::string& where, const std::string& keys,
                   const Set& set) {
  for (const std::string& setting : split(text, ',')) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      throw UsageError(where + ": found \"" + setting + "\", expected KEY=NUMBER");
    }
    const std::string key = setting.substr(0, equals), number = setting.substr(equals + 1);
    char* end = nullptr;
    const double value = std::strtod(number.c_str(), &end);
    if (number.empty() || *end != '\0') {
      throw UsageError(where + ": found \"" + number + "\", expected a number");
    }
    if (!set(key, value)) {
      throw UsageError(where + ": found \"" + key + "\", expected one of " + keys);
    }
  }
}

double* bound_named(const std::string& key, WallPart& part) {
  if (key == "xmin") return &part.xmin;
  if (key == "xmax") return &part.xmax;
  if (key == "ymin") return &part.ymin;
  return key == "ymax" ? &part.ymax : nullptr;
}

int whole(double value, const std::string& where, const std::string& key) {
  if (!(std::abs(value) < 1e9) || value != std::floor(value)) {
    throw UsageError(where + ": " + key + " must be whole");
  }
  return static_cast<int>(value);
}

/// Sets a numeric option named `key`; false if the option is not numeric.
bool set_number(const OptionValue& option, double value, const std::string& where,
                const std::string& key) {
  if (const auto* real = std::get_if<RealOption>(&option)) {
    *real->value = value;
  } else if (const auto* optional = std::get_if<OptionalRealOption>(&option)) {
    *optional->value = value;
  } else if (const auto* integer = std::get_if<IntegerOption>(&option)) {
    *integer->value = whole(value, where, key);
  } else {
    return false;
  }
  return true;
}

/// The keys of a table's numbers: "count, first, ratio".
std::string number_keys(LayerSpacing spacing) {
  std::vector<std::string> keys;
  for (const Option& option : option_table(spacing))
    if (set_number(option.value, 0, {}, {})) keys.emplace_back(option.key);
  return join(keys);
}

}  // namespace

void add_hold_layers_flag(CLI::App& app, std::vector<std::string>& markers) {
  FlagGroup(app).value("--hold-layers", markers, "NAME",
                       "Wall whose layers, as the mesh has them, keep their heights; may be given "
                       "several times");
}

std::vector<Command> holding_layers(const std::vector<std::string>& markers,
                                    const SmoothOptions& smooth, Command command) {
  if (markers.empty()) return {std::move(command)};
  constexpr int all = 1000;
  LayersCommand hold;
  hold.task = LayerTask::hold;
  LayerSpacing spacing;
  spacing.count = all;
  hold.layers.walls.push_back({markers, spacing});
  hold.smooth = smooth;
  return {hold, std::move(command)};
}

LayerWall parse_wall(const std::string& text, const LayerSpacing& common) {
  // A marker's name may contain a colon; settings cannot.
  const std::size_t colon = text.rfind(':');
  LayerWall wall{split(text.substr(0, colon), ','), common};
  if (colon == std::string::npos) return wall;
  const std::string where = "--wall " + text;
  read_settings(text.substr(colon + 1), where,
                number_keys(wall.spacing) + ", xmin, xmax, ymin, ymax",
                [&](const std::string& key, double value) {
                  if (double* bound = bound_named(key, wall.part)) {
                    *bound = value;
                    return true;
                  }
                  const OptionTable table = option_table(wall.spacing);
                  const auto named = std::ranges::find(table, key, &Option::key);
                  return named != table.end() && set_number(named->value, value, where, key);
                });
  return wall;
}

ColumnOverride parse_column(const std::string& text) {
  const std::string where = "--column " + text;
  const std::size_t colon = text.find(':');
  const std::string node = text.substr(0, colon);
  ColumnOverride own;
  const char* const end = node.data() + node.size();
  const auto read = std::from_chars(node.data(), end, own.node);
  if (colon == std::string::npos || read.ec != std::errc{} || read.ptr != end || own.node < 0) {
    throw UsageError(where + ": expected NODE:columns=N,thickness=T");
  }
  read_settings(text.substr(colon + 1), where, "columns, thickness",
                [&](const std::string& key, double value) {
                  if (key == "columns") {
                    own.columns = whole(value, where, key);
                  } else if (key == "thickness") {
                    own.thickness = value;
                  } else {
                    return false;
                  }
                  return true;
                });
  return own;
}

void LayerFlags::declare(CLI::App& app) {
  FlagGroup group(app, "Layers");
  group.value("--marker", markers_, "NAME", "Wall to insert layers at; may be given several times");
  group.value(
      "--wall", walls_, "NAME[,NAME]:KEY=NUMBER,...",
      "Wall with settings of its own, e.g. flap:count=20,first=2e-5 (keys: " +
          number_keys(spacing_) +
          "; xmin, xmax, ymin, ymax: the part of the markers that is to have layers); may be "
          "given several times");
  group.value("--column", columns_, "NODE:KEY=NUMBER,...",
              "What one wall node is to have instead of what the rules choose, e.g. "
              "17:columns=1,thickness=0.01 (columns: 1 is no fan; thickness: 0 is no layers); "
              "may be given several times");
  add_option_flags(app, option_table(spacing_), "Layers");
  app.get_option("--match-outside")->excludes(app.get_option("--total"));
  CLI::Option* reynolds = group.value_as("--reynolds", reynolds_, "RE",
                                         "Reynolds number of the reference length, for --y-plus");
  group
      .value_as("--y-plus", y_plus_, "Y+",
                "Wanted y+ of the first node: gives --first by the turbulent friction of a flat "
                "plate (White, Fluid Mechanics: 0.026 / Re^(1/7))")
      ->needs(reynolds)
      ->excludes(app.get_option("--first"));
  group
      .value_as("--reference-length", length_, "LENGTH [1]",
                "Reference length (chord), units of the mesh")
      ->needs(reynolds);
}

void LayerFlags::finish(LayerOptions& options) const {
  LayerSpacing common = spacing_;
  if (y_plus_) common.first = first_height_for_y_plus(*y_plus_, reynolds_.value_or(0), length_);
  if (!markers_.empty()) options.walls.push_back({markers_, common});
  for (const std::string& text : walls_) options.walls.push_back(parse_wall(text, common));
  for (const std::string& text : columns_) options.overrides.push_back(parse_column(text));
  if (options.walls.empty()) throw UsageError("no wall is given: use --marker NAME or --wall");
  validate(options);
}

}  // namespace winslow::app
