#include "core/options/option.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"

namespace winslow {

namespace {

// Texts of values.
std::string text_of(double number) { return number_text(number); }
std::string text_of(int number) { return std::to_string(number); }
std::string text_of(std::uint64_t number) { return std::to_string(number); }
std::string text_of(bool on) { return on ? "true" : "false"; }
std::string text_of(const std::string& name) { return name; }
template <class Value>
std::string text_of(const std::optional<Value>& value) {
  return value ? text_of(*value) : "";
}
template <class Value>
std::string text_of(const std::vector<Value>& list) {
  std::string text;
  for (const Value& value : list) text += (text.empty() ? "" : ", ") + text_of(value);
  return text;
}
std::string text_of(const Vec3& vector, int numbers) {
  std::string text = number_text(vector.x()) + ' ' + number_text(vector.y());
  return numbers == 3 ? text + ' ' + number_text(vector.z()) : text;
}

// Texts of the values of options.
template <class Simple>
std::string text_of(const Simple& option) requires requires {
  option.value;
}
{ return text_of(*option.value); }
std::string text_of(const VectorOption& vector) {
  return text_of(*vector.value, vector.value->numbers(vector.numbers));
}
std::string text_of(const OptionalVectorOption& vector) {
  return *vector.value ? text_of(**vector.value, (*vector.value)->numbers(vector.numbers)) : "";
}
std::string text_of(const SpaceVectorOption& vector) {
  return *vector.value ? text_of(**vector.value, 3) : "";
}
std::string text_of(const OptionalRealOption& real) {
  return *real.value ? number_text(**real.value) : std::string(real.unset);
}
std::string text_of(const ChoiceOption& choice) { return choice.name(); }
std::string text_of(const SharesOption& shares) {
  if (shares.may_be_none() && shares.is_none()) return std::string(shares.none.name);
  std::string text;
  for (const auto& [name, label, help, share] : shares.parts) {
    if (*share == 0) continue;
    text += (text.empty() ? "" : " ") + std::string(name);
    if (*share != 1) text += "=" + number_text(*share);
  }
  return text;
}

/// Accepted values of each kind; empty: all of its type.
template <class Kind>
std::string expected_of(const Kind& option) {
  if constexpr (requires { option.range; }) return option.range.text();
  if constexpr (std::is_same_v<Kind, ChoiceOption>) return option.names();
  constexpr bool counts = std::is_same_v<Kind, SeedOption> || std::is_same_v<Kind, NodesOption> ||
                          std::is_same_v<Kind, SharesOption>;
  return counts ? at_least(0).text() : "";
}

std::string out_of(const Range& range, double found) {
  if (range.holds(found)) return "";
  const std::string expected = range.text();
  return "found " + number_text(found) + ", expected " +
         (expected.empty() ? "a finite number" : expected);
}

std::string out_of(const Range& range, const std::optional<double>& found) {
  return found ? out_of(range, *found) : "";
}

// The fault in a value of each kind; empty: none.
std::string wrong_with(const Vec3& vector) {
  for (const double component : vector)
    if (std::string fault = out_of({}, component); !fault.empty()) return fault;
  return "";
}
template <class Vector>
std::string wrong_with(const std::optional<Vector>& vector) {
  return vector ? wrong_with(*vector) : "";
}
template <class Kind>
std::string wrong_with(const Kind& option) requires requires {
  option.value;
}
{
  if constexpr (requires { option.range; })
    return out_of(option.range, *option.value);
  else if constexpr (requires { wrong_with(*option.value); })
    return wrong_with(*option.value);
  else
    return "";
}
std::string wrong_with(const NamesOption& names) {
  if (!names.pairs || names.value->size() % 2 == 0) return "";
  return "found " + std::to_string(names.value->size()) + " names, expected pairs of them";
}
std::string wrong_with(const NodesOption& nodes) {
  for (const Index node : *nodes.value)
    if (std::string fault = out_of(at_least(0), node); !fault.empty()) return fault;
  return "";
}
std::string wrong_with(const ChoiceOption& choice) {
  if (choice.chosen() < choice.items().size()) return "";
  return "found \"" + choice.name() + "\", expected one of " + choice.names();
}
std::string wrong_with(const SharesOption& shares) {
  if (shares.may_be_none() && shares.is_none()) return "";
  double sum = 0;
  bool negative = false;
  for (const auto& part : shares.parts) {
    negative = negative || !(*part.share >= 0);
    sum += *part.share;
  }
  if (!negative && sum > 0 && std::isfinite(sum)) return "";
  return "the shares must not be negative, nor all zero";
}

}  // namespace

bool Range::holds(double number) const {
  if (also && number == *also) return true;
  if (!std::isfinite(number)) return false;
  const bool above_low = low_included ? number >= low : number > low;
  return above_low && (high_included ? number <= high : number < high);
}

std::string Range::text() const {
  const bool floor = std::isfinite(low), ceiling = std::isfinite(high);
  std::string text;
  if (floor && ceiling && low_included && high_included) {
    text = number_text(low) + " to " + number_text(high);
  } else {
    if (floor) text = number_text(low) + " or more";
    if (floor && !low_included) text = "more than " + number_text(low);
    if (ceiling) {
      text += (text.empty() ? "" : ", ") + std::string(high_included ? "at most " : "less than ") +
              number_text(high);
    }
  }
  return also ? number_text(*also) + " or " + text : text;
}

std::size_t ChoiceOption::chosen() const {
  if (const auto* enumerator = std::get_if<Enumerator>(&value_)) return enumerator->get();
  const std::string& name = *std::get<std::string*>(value_);
  const auto found = std::find_if(items_.begin(), items_.end(),
                                  [&](const ChoiceItem& item) { return item.name == name; });
  return static_cast<std::size_t>(found - items_.begin());
}

std::string ChoiceOption::name() const {
  if (const auto* name = std::get_if<std::string*>(&value_)) return **name;
  const std::size_t item = chosen();
  return item < items_.size() ? items_[item].name : std::to_string(item);
}

void ChoiceOption::choose(std::size_t item) const {
  if (const auto* enumerator = std::get_if<Enumerator>(&value_)) return enumerator->set(item);
  *std::get<std::string*>(value_) = items_[item].name;
}

bool ChoiceOption::has_flags() const {
  return std::ranges::any_of(items_, [](const ChoiceItem& item) { return !item.flag.empty(); });
}

bool ChoiceOption::choose(std::string_view name) const {
  for (std::size_t i = 0; i < items_.size(); ++i) {
    if (items_[i].name != name) continue;
    choose(i);
    return true;
  }
  return false;
}

std::string ChoiceOption::names(const char* separator) const {
  std::string text;
  for (const ChoiceItem& item : items_) text += (text.empty() ? "" : separator) + item.name;
  return text;
}

std::string flag_of(const Option& option) {
  if (const auto* on = std::get_if<SwitchOption>(&option.value); on && !on->off_flag.empty())
    return "--" + std::string(on->off_flag);
  if (!option.flag.empty()) return "--" + std::string(option.flag);
  std::string flag = "--" + std::string(option.object);
  if (!option.object.empty()) flag += '-';
  flag += option.key;
  std::replace(flag.begin(), flag.end(), '_', '-');
  return flag;
}

std::string path_of(const Option& option) {
  const std::string key(option.key);
  return option.object.empty() ? key : std::string(option.object) + '.' + key;
}

std::string value_text(const Option& option) {
  return std::visit([](const auto& of) { return text_of(of); }, option.value);
}

std::string expected_text(const Option& option) {
  return std::visit([](const auto& of) { return expected_of(of); }, option.value);
}

std::string fault_of(const Option& option) {
  return std::visit([](const auto& of) { return wrong_with(of); }, option.value);
}

OptionTable joined(OptionTable first, OptionTable second) {
  std::ranges::move(second, std::back_inserter(first));
  return first;
}

void check(const OptionTable& table) {
  for (const Option& option : table) {
    if (const std::string fault = fault_of(option); !fault.empty())
      throw UsageError(path_of(option) + ": " + fault);
  }
}

bool settle(const OptionTable& table) {
  bool changed = false;
  for (const Option& option : table) {
    const auto* choice = std::get_if<ChoiceOption>(&option.value);
    if (!choice || choice->chosen() >= choice->items().size()) continue;
    const auto& items = choice->items();
    if (items[choice->chosen()].applies) continue;
    const auto first =
        std::find_if(items.begin(), items.end(), [](const auto& i) { return i.applies; });
    if (first == items.end()) continue;
    choice->choose(static_cast<std::size_t>(first - items.begin()));
    changed = true;
  }
  return changed;
}

std::string number_text(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", number);
  return text;
}

namespace {

bool same(const ChoiceOption& a, const ChoiceOption& b) { return a.name() == b.name(); }
bool same(const SharesOption& a, const SharesOption& b) {
  return std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(),
                    [](const auto& p, const auto& q) { return *p.share == *q.share; });
}
template <class Simple>
bool same(const Simple& a, const Simple& b) {
  return *a.value == *b.value;
}

void copy(const ChoiceOption& from, const ChoiceOption& to) { to.choose(from.name()); }
void copy(const SharesOption& from, const SharesOption& to) {
  for (std::size_t k = 0; k < from.parts.size(); ++k) *to.parts[k].share = *from.parts[k].share;
}
template <class Simple>
void copy(const Simple& from, const Simple& to) {
  *to.value = *from.value;
}

bool same_value(const Option& a, const Option& b) {
  return std::visit(
      [&]<class Value>(const Value& value) { return same(value, std::get<Value>(b.value)); },
      a.value);
}

}  // namespace

bool same_values(const OptionTable& a, const OptionTable& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_value);
}

void copy_changes(const OptionTable& before, const OptionTable& after, const OptionTable& to) {
  for (std::size_t row = 0; row < after.size(); ++row) {
    if (same_value(before[row], after[row])) continue;
    std::visit(
        [&]<class Value>(const Value& value) { copy(value, std::get<Value>(to[row].value)); },
        after[row].value);
  }
}

}  // namespace winslow
