#include <cctype>
#include <iostream>

#include "app/options/flags.h"
#include "core/command/option_tables.h"
#include "core/error.h"

namespace winslow::app {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

constexpr const char* words_name = "words";  // name of the validators that hold words
constexpr std::string_view separator = ", ";

/// Levenshtein distance, ignoring case.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string join(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += std::string(list.empty() ? "" : separator) + name;
  return list;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = text.find(separator, begin);
    parts.push_back(text.substr(begin, end == std::string::npos ? end : end - begin));
    if (end == std::string::npos) return parts;
    begin = end + 1;
  }
}

std::string suggest(std::string_view unknown, const std::vector<std::string>& known) {
  const std::string* nearest = nullptr;
  // Suggest only if at most half of the word is wrong.
  std::size_t best = unknown.size() / 2 + 1;
  for (const std::string& name : known) {
    const std::size_t d = distance(unknown, name);
    if (d < best) {
      best = d;
      nearest = &name;
    }
  }
  return nearest ? "; did you mean " + *nearest + "?" : "";
}

CLI::Validator one_of(std::vector<std::string> names) {
  const std::string list = join(names);
  return CLI::Validator(
      [names = std::move(names), list](std::string& value) {
        if (std::find(names.begin(), names.end(), value) != names.end()) return std::string();
        return "found \"" + value + "\", expected one of " + list + suggest(value, names);
      },
      "{" + list + "}", words_name);
}

CLI::Validator words_to_offer(const std::vector<std::string>& words) {
  return CLI::Validator([](std::string&) { return std::string(); }, "{" + join(words) + "}",
                        words_name);
}

std::vector<std::string> words_of(CLI::Option& option) {
  std::string list;
  try {
    list = option.get_validator(words_name)->get_description();
  } catch (const CLI::OptionNotFound&) {
    return {};
  }
  std::vector<std::string> words;
  list = list.substr(1, list.size() - 2).append(separator);  // without the braces
  for (std::size_t start = 0, end = 0; (end = list.find(separator, start)) != std::string::npos;
       start = end + separator.size())
    words.push_back(list.substr(start, end - start));
  return words;
}

namespace {

/// The names of the choices, or of the items that have shares.
template <class Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.emplace_back(item.name);
  return names;
}

/// Parses "element vcv=0.3": sets the named shares; the others become 0.
void set_shares(const SharesOption& shares, const std::string& flag,
                const std::vector<std::string>& words) {
  shares.clear();
  if (shares.may_be_none() && words.size() == 1 && words.front() == shares.none.name) return;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    double share = 1;
    if (equals != std::string::npos && !CLI::detail::lexical_cast(word.substr(equals + 1), share)) {
      throw UsageError(flag + ' ' + word + ": expected NAME=SHARE with a number");
    }
    const auto part = std::ranges::find(shares.parts, name, &SharesOption::Part::name);
    if (part == shares.parts.end()) {
      throw UsageError(flag + ' ' + word + ": found \"" + name + "\", expected one of " +
                       join(names_of(shares.choices())));
    }
    *part->share = share;
  }
  if (shares.is_none()) throw UsageError(flag + ": the shares must not all be zero");
}

/// Throws the option's fault after its value was set; CLI11 prepends the flag.
void refuse_fault(const Option& option) {
  if (const std::string fault = fault_of(option); !fault.empty())
    throw CLI::ValidationError(flag_of(option), fault);
}

/// Declares a flag that sets the value from one or several words.
template <class Given>
CLI::Option* add_value(CLI::App& app, const Option& option,
                       const std::function<void(const Given&)>& set) {
  return app
      .add_option_function<Given>(
          flag_of(option),
          [option, set](const Given& given) {
            set(given);
            refuse_fault(option);
          },
          flag_help(option))
      ->option_text(flag_text(option));
}

// One overload per kind of option: declares its flag and the help's name of its value.

/// A number or a text without conversion.
template <class Given, class Value>
CLI::Option* add_plain(CLI::App& app, const Option& option, Value* value) {
  return add_value<Given>(app, option, [value](const Given& given) { *value = given; });
}

CLI::Option* declare(CLI::App& app, const Option& option, const RealOption& real) {
  return add_plain<double>(app, option, real.value);
}
std::string metavariable(const RealOption&) { return "NUMBER"; }

CLI::Option* declare(CLI::App& app, const Option& option, const OptionalRealOption& real) {
  return add_plain<double>(app, option, real.value);
}
std::string metavariable(const OptionalRealOption&) { return "NUMBER"; }

CLI::Option* declare(CLI::App& app, const Option& option, const IntegerOption& integer) {
  return add_plain<int>(app, option, integer.value);
}
std::string metavariable(const IntegerOption&) { return "N"; }

CLI::Option* declare(CLI::App& app, const Option& option, const SeedOption& seed) {
  return add_plain<std::uint64_t>(app, option, seed.value)
      ->check([](const std::string& text) {  // the conversion would wrap a negative number
        return text.starts_with("-") ? "found " + text + ", expected 0 or more" : std::string();
      });
}
std::string metavariable(const SeedOption&) { return "N"; }

/// Two numbers or three.
template <class Vector>
requires std::is_same_v<Vector, VectorOption> || std::is_same_v<Vector, OptionalVectorOption>
    CLI::Option* declare(CLI::App& app, const Option& option, const Vector& vector) {
  using Numbers = std::vector<double>;
  return add_value<Numbers>(
             app, option,
             [vector](const Numbers& v) {
               const bool third = v.size() > 2;
               *vector.value = GivenVector::of(third ? 3 : 2, {v[0], v[1], third ? v[2] : 0});
             })
      ->expected(2, 3);
}
std::string metavariable(const VectorOption&) { return "X Y [Z]"; }
std::string metavariable(const OptionalVectorOption&) { return "X Y [Z]"; }

CLI::Option* declare(CLI::App& app, const Option& option, const SpaceVectorOption& vector) {
  using Triple = std::array<double, 3>;
  return add_value<Triple>(app, option,
                           [vector](const Triple& v) { *vector.value = Vec3(v[0], v[1], v[2]); });
}
std::string metavariable(const SpaceVectorOption&) { return "X Y Z"; }

/// The flag is repeated for each name or pair.
CLI::Option* declare(CLI::App& app, const Option& option, const NamesOption& names) {
  using Names = std::vector<std::string>;
  using Pairs = std::vector<std::pair<std::string, std::string>>;
  if (!names.pairs) return add_plain<Names>(app, option, names.value)->allow_extra_args(false);
  return add_value<Pairs>(app, option,
                          [names](const Pairs& given) {
                            names.value->clear();
                            for (const auto& [first, second] : given)
                              names.value->insert(names.value->end(), {first, second});
                          })
      ->allow_extra_args(false);
}
std::string metavariable(const NamesOption& names) { return names.pairs ? "NAME NAME" : "NAME"; }

/// The flag is repeated for each node.
CLI::Option* declare(CLI::App& app, const Option& option, const NodesOption& nodes) {
  return add_plain<std::vector<Index>>(app, option, nodes.value)->allow_extra_args(false);
}
std::string metavariable(const NodesOption&) { return "ID"; }

CLI::Option* declare(CLI::App& app, const Option& option, const FileOption& file) {
  return add_plain<std::string>(app, option, file.value);
}
std::string metavariable(const FileOption&) { return "FILE"; }

CLI::Option* declare(CLI::App& app, const Option& option, const SwitchOption& on) {
  const bool value = on.off_flag.empty();
  return app.add_flag_callback(
      flag_of(option), [on, value] { *on.value = value; }, flag_help(option));
}
std::string metavariable(const SwitchOption&) { return {}; }

/// Declares a flag for each choice that has one; two of them together are an error.
void declare_choices(CLI::App& app, const ChoiceOption& choice, const std::string& group) {
  std::vector<CLI::Option*> flags;
  for (const ChoiceItem& item : choice.items()) {
    if (item.flag.empty()) continue;
    CLI::Option* flag = app.add_flag_callback(
        "--" + std::string(item.flag), [choice, name = item.name] { choice.choose(name); },
        std::string(item.help));
    flag->group(group);
    for (CLI::Option* other : flags) flag->excludes(other);
    flags.push_back(flag);
  }
}

CLI::Option* declare(CLI::App& app, const Option& option, const ChoiceOption& choice) {
  return add_value<std::string>(app, option,
                                [choice](const std::string& name) { choice.choose(name); })
      ->check(one_of(names_of(choice.items())));
}
std::string metavariable(const ChoiceOption& choice) {
  constexpr std::size_t few = 4;
  return choice.items().size() <= few ? choice.names("|") : "NAME";
}

CLI::Option* declare(CLI::App& app, const Option& option, const SharesOption& shares) {
  using Words = std::vector<std::string>;
  const std::string flag = flag_of(option);
  return add_value<Words>(app, option,
                          [shares, flag](const Words& words) { set_shares(shares, flag, words); })
      ->check(words_to_offer(names_of(shares.choices())));
}
std::string metavariable(const SharesOption&) { return "NAME[=SHARE]..."; }

template <class Item>
std::string item_help(const Item& item) {
  return item.help.empty() ? "" : "\n  " + std::string(item.name) + ": " + std::string(item.help);
}

}  // namespace

std::string flag_text(const Option& option) {
  const std::string word =
      std::visit([](const auto& of) { return metavariable(of); }, option.value);
  const std::string value = word.empty() ? "" : value_text(option);
  return word + (value.empty() ? "" : " [" + value + "]");
}

std::string flag_help(const Option& option) {
  if (const auto* on = std::get_if<SwitchOption>(&option.value); on && !on->off_help.empty())
    return std::string(on->off_help);
  std::string help(option.help);
  if (!option.unit.empty()) help += ", " + std::string(option.unit);
  std::string items;
  if (const auto* choice = std::get_if<ChoiceOption>(&option.value)) {
    for (const ChoiceItem& item : choice->items()) items += item_help(item);
  } else if (const auto* shares = std::get_if<SharesOption>(&option.value)) {
    for (const auto& part : shares->choices()) items += item_help(part);
  } else if (const std::string expected = expected_text(option); !expected.empty()) {
    help += " (" + expected + ")";
  }
  return help + (items.empty() ? "" : ":" + items);
}

void add_option_flags(CLI::App& app, const OptionTable& table, const std::string& group) {
  for (const Option& option : table) {
    if (option.on_command_line == OnCommandLine::no) continue;
    if (const auto* choice = std::get_if<ChoiceOption>(&option.value);
        choice && choice->has_flags()) {
      declare_choices(app, *choice, group);
      continue;
    }
    CLI::Option* flag =
        std::visit([&](const auto& of) { return declare(app, option, of); }, option.value);
    flag->group(group);
  }
}

namespace {

std::string limited_names() {
  std::vector<std::string> names;
  for (const Metric metric : limited_metrics()) names.emplace_back(metric_name(metric));
  return join(names);
}

/// Finds a metric of elements of either dimension, because the mesh's dimension is not known yet.
Metric metric_named(const std::string& name) {
  for (const int dimension : {2, 3}) {
    for (const Metric metric : all_metrics(dimension))
      if (metric_name(metric) == name) return metric;
  }
  throw UsageError("--min-quality: unknown metric '" + name +
                   "', expected one of: " + limited_names());
}

/// Parses "normalized_jacobian=0.2".
void set_limit(QualityFloor& floor, const std::string& word) {
  const std::size_t equals = word.find('=');
  double limit = 0;
  if (equals == std::string::npos || !CLI::detail::lexical_cast(word.substr(equals + 1), limit))
    throw UsageError("--min-quality " + word + ": expected METRIC=VALUE with a number");
  floor.set(metric_named(word.substr(0, equals)), limit);
}

}  // namespace

void add_smooth_flags(CLI::App& app, SmoothOptions& options) {
  add_option_flags(app, option_table(options), "Smoothing");
  app.add_option_function<std::string>(
         "--reference",
         [&options](const std::string& file) {
           options.slide.reference = file;
           std::cerr << "winslow: warning: --reference is now called --reference-surface\n";
         })
      ->group("");  // an earlier name, not shown in the help
}

void add_min_quality_flag(CLI::App& app, QualityFloor& floor) {
  app.add_option_function<std::vector<std::string>>(
         "--min-quality",
         [&floor](const std::vector<std::string>& words) {
           for (const std::string& word : words) set_limit(floor, word);
         },
         "End the motion before any element is worse than this; several limits hold together: " +
             limited_names())
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->option_text("METRIC=VALUE")
      ->group("Motion");
}

void add_direct_flag(CLI::App& app, MotionOptions& options) {
  app.add_flag_callback(
         "--direct", [&options] { options.increments = 1; },
         "Move the boundary at once, the interior left where it was, as in the paper; then "
         "untangle")
      ->group("Motion");
}

CLI::Option* add_sine_flags(CLI::App& app, SineDeformation& sine) {
  const std::string group = "Shape";
  CLI::Option* flag = app.add_option_function<std::array<double, 2>>(
                             "--sine",
                             [&sine](const std::array<double, 2>& v) {
                               sine.amplitude = v[0];
                               sine.waves = v[1];
                             },
                             "Add a sine wave along the body: amplitude, number of periods")
                          ->type_name("AMPLITUDE WAVES")
                          ->group(group);
  const OptionTable options = option_table(sine);
  add_option_flags(app, options, group);
  for (const Option& option : options)
    if (option.on_command_line == OnCommandLine::yes) app.get_option(flag_of(option))->needs(flag);
  return flag;
}

CLI::Option* add_marker_flag(CLI::App& app, std::vector<std::string>& markers) {
  return app
      .add_option(
          "--marker", markers,
          "Marker that moves; several move together, and so do all that NAME matches with a *")
      ->required()
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->option_text("NAME");
}

}  // namespace winslow::app
