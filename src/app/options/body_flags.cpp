#include <iterator>

#include "app/options/flags.h"
#include "core/error.h"

namespace winslow::app {
namespace {

constexpr const char* form = "NAME[,NAME...] KEY=VALUE...";

/// "rotate", "axis", ...
std::vector<std::string> motion_keys() {
  RigidMotion motion;
  std::vector<std::string> keys;
  for (const Option& option : option_table(motion)) keys.emplace_back(option.key);
  return keys;
}

std::vector<double> numbers_of(const std::string& value, const std::string& where) {
  std::vector<double> numbers;
  for (const std::string& word : split(value, ',')) {
    double number = 0;
    if (word.empty() || !CLI::detail::lexical_cast(word, number))
      throw UsageError(where + ": found \"" + word + "\", expected " +
                       (value.find(',') == std::string::npos
                            ? "a number"
                            : "numbers with commas between them and no spaces"));
    numbers.push_back(number);
  }
  return numbers;
}

GivenVector vector_of(const std::vector<double>& numbers) {
  const bool third = numbers.size() > 2;
  return GivenVector::of(third ? 3 : 2, {numbers[0], numbers[1], third ? numbers[2] : 0});
}

/// Sets an option of a motion from its numbers.
void set(const Option& option, const std::vector<double>& numbers, const std::string& where) {
  const auto expect = [&](std::size_t least, std::size_t most, const std::string& what) {
    if (numbers.size() >= least && numbers.size() <= most) return;
    throw UsageError(where + ": found " + std::to_string(numbers.size()) +
                     (numbers.size() == 1 ? " number" : " numbers") + ", expected " + what);
  };
  const std::string key(option.key);
  const std::string of_either = "two, in space three: " + key + "=X,Y or " + key + "=X,Y,Z";
  if (const auto* real = std::get_if<RealOption>(&option.value)) {
    expect(1, 1, "one: " + key + "=NUMBER");
    *real->value = numbers.front();
  } else if (const auto* space = std::get_if<SpaceVectorOption>(&option.value)) {
    expect(3, 3, "three: " + key + "=X,Y,Z");
    *space->value = Vec3(numbers[0], numbers[1], numbers[2]);
  } else if (const auto* vector = std::get_if<VectorOption>(&option.value)) {
    expect(2, 3, of_either);
    *vector->value = vector_of(numbers);
  } else if (const auto* optional = std::get_if<OptionalVectorOption>(&option.value)) {
    expect(2, 3, of_either);
    *optional->value = vector_of(numbers);
  } else {
    throw std::logic_error("a motion has an option that --body cannot set: " + key);
  }
  if (const std::string fault = fault_of(option); !fault.empty())
    throw UsageError(where + ": " + fault);
}

/// The names of a body's markers.
std::vector<std::string> names_of_body(const std::string& word, const std::string& where) {
  std::vector<std::string> names = split(word, ',');
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (name->empty())
      throw UsageError(where + ": found an empty name, expected names of markers with commas " +
                       "between them and no spaces: --body " + form);
    if (std::find(names.begin(), name, *name) != name)
      throw UsageError(where + ": names " + *name + " twice");
  }
  return names;
}

/// Reads the words of all --body; an empty word stands between two of them.
std::vector<MovingBody> parse_bodies(const std::vector<std::string>& given) {
  std::vector<std::vector<std::string>> lists(1);
  for (const std::string& word : given) {
    if (!word.empty())
      lists.back().push_back(word);
    else if (!lists.back().empty())
      lists.emplace_back();
  }
  std::vector<MovingBody> bodies;
  std::ranges::transform(lists, std::back_inserter(bodies), parse_body);
  return bodies;
}

/// Sets what a word "KEY=VALUE" gives; returns its key.
std::string read_setting(const std::string& word, const OptionTable& table,
                         const std::string& where) {
  const std::vector<std::string> keys = motion_keys();
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos)
    throw UsageError(where + ": found \"" + word + "\", expected KEY=VALUE with a key of " +
                     join(keys) + "; the mesh IN goes before --body");
  std::string key = word.substr(0, equals);
  const auto option = std::ranges::find(table, key, &Option::key);
  if (option == table.end())
    throw UsageError(where + ": found the key \"" + key + "\", expected one of " + join(keys) +
                     suggest(key, keys));
  const std::string here = where + ' ' + key;
  set(*option, numbers_of(word.substr(equals + 1), here), here);
  return key;
}

}  // namespace

MovingBody parse_body(const std::vector<std::string>& words) {
  if (words.empty()) throw UsageError(std::string("--body: expected ") + form);
  const std::string& first = words.front();
  const std::string where = "--body " + first;
  const std::vector<std::string> keys = motion_keys();
  if (std::ranges::find(keys, first.substr(0, first.find('='))) != keys.end() &&
      first.find('=') != std::string::npos)
    throw UsageError(where + ": expected the name of a marker before it: --body NAME " + first);
  MovingBody body{names_of_body(first, where), {}};
  const OptionTable table = option_table(body.motion);
  std::vector<std::string> given;
  for (auto word = words.begin() + 1; word != words.end(); ++word) {
    std::string key = read_setting(*word, table, where);
    if (std::ranges::find(given, key) != given.end())
      throw UsageError(where + ": gives " + key + " twice");
    given.push_back(std::move(key));
  }
  const auto moves = [](const std::string& key) { return key == "rotate" || key == "translate"; };
  if (std::ranges::none_of(given, moves))
    throw UsageError(where + ": nothing to do: give rotate=DEG, translate=DX,DY, or both");
  return body;
}

void add_body_flag(CLI::App& app, std::vector<MovingBody>& bodies) {
  std::vector<std::string> words = motion_keys();
  const std::string keys = join(words);
  for (std::string& word : words) word += '=';
  CLI::Option* flag =
      app.add_option_function<std::vector<std::string>>(
             "--body",
             [&bodies](const std::vector<std::string>& given) { bodies = parse_bodies(given); },
             "A body with a motion of its own; given several times, all move together, each along "
             "its own arc: --body slat rotate=12 --body flap,tab rotate=-20 pivot=0.8,0 (keys: " +
                 keys +
                 ", as the options of these names, which are of a single body; vectors with "
                 "commas)")
          ->check(words_to_offer(words))
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
          ->option_text(form)
          ->group("Motion");
  flag->inject_separator();
}

void refuse_single_body_flags(const CLI::App& app) {
  const auto given = [&app](const std::string& flag) { return app.get_option(flag)->results(); };
  const auto with_commas = [](const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : ",") + part;
    return text;
  };
  std::vector<std::string> flags;
  const std::vector<std::string> markers = given("--marker");
  if (!markers.empty()) flags.emplace_back("--marker");
  std::string written = "--body " + (markers.empty() ? std::string("NAME") : with_commas(markers));
  for (const std::string& key : motion_keys()) {
    const std::vector<std::string> values = given("--" + key);
    if (values.empty()) continue;
    flags.push_back("--" + key);
    written += ' ' + key + '=' + with_commas(values);
  }
  if (flags.empty()) return;
  throw UsageError("found --body together with " + join(flags) +
                   ", which are of a single body: expected \"" + written + "\" in their place");
}

}  // namespace winslow::app
