#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/options/given_vector.h"
#include "core/types.h"

/// Tables of options: what a user can set, with names, ranges and help texts.
///
///     winslow::SmoothOptions options;
///     for (const winslow::Option& option : winslow::option_table(options))
///       std::puts((winslow::path_of(option) + " = " + winslow::value_text(option)).c_str());
///
/// Each struct of options has a function option_table(Struct&) that returns one row per option. The
/// rows are bound to that object: they read and write its members. The command line, recipes,
/// forms, checks and the reference pages are generated from the rows, so that an option is defined
/// in one place.
namespace winslow {

/// The numbers that an option accepts: finite numbers between two limits.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_included = true, high_included = true;
  std::optional<double> also = std::nullopt;  ///< outside the limits, with a special meaning

  bool holds(double number) const;
  std::string text() const;  ///< "more than 0, at most 1"; empty: every finite number
};
constexpr Range at_least(double low) { return {.low = low}; }
constexpr Range above(double low) { return {.low = low, .low_included = false}; }
constexpr Range between(double low, double high) { return {.low = low, .high = high}; }
/// Both limits excluded.
constexpr Range inside(double low, double high) { return {low, high, false, false}; }

struct RealOption {
  double* value;
  Range range = {};
};

/// A number that may be left unset.
struct OptionalRealOption {
  std::optional<double>* value;
  Range range = {};
  /// What holds where it is unset, in words; empty: nothing does.
  std::string_view unset = {};
  /// The number that holds where it is unset, if that is known: forms show it.
  std::optional<double> instead = std::nullopt;
};

struct IntegerOption {
  int* value;
  Range range = {};
};

/// Seeds of random numbers: any whole number from 0 on.
struct SeedOption {
  std::uint64_t* value;
};

/// A vector of two numbers, in space of three. `numbers`: how many are written if the program
/// computed the vector.
struct VectorOption {
  GivenVector* value;
  int numbers = 3;
};

/// The same, which may be left unset.
struct OptionalVectorOption {
  std::optional<GivenVector>* value;
  int numbers = 3;
};

/// A vector in space that may be left unset.
struct SpaceVectorOption {
  std::optional<Vec3>* value;
};

/// Any number of names, or of pairs of names in sequence.
struct NamesOption {
  std::vector<std::string>* value;
  bool pairs = false;
};

/// Numbers of nodes, from 0 on, any number of them.
struct NodesOption {
  std::vector<Index>* value;
};

/// The name of a file; empty: none.
struct FileOption {
  std::string* value;
};

struct SwitchOption {
  bool* value;
  /// For a switch that is on by default: the flag that turns it off, and its help text.
  std::string_view off_flag = {}, off_help = {};
};

struct ChoiceItem {
  std::string name;   ///< on the command line and in recipes
  std::string label;  ///< on forms
  std::string_view help = {};
  bool applies = true;  ///< compatible with the other options
  /// Without dashes: the flag that chooses it. The option then has no flag of its own, and choices
  /// without a flag are what holds without one.
  std::string_view flag = {};
};

/// One of several named choices: an enumerator (items in the order of the enumeration) or a name.
class ChoiceOption {
 public:
  template <class Enum>
  requires std::is_enum_v<Enum> ChoiceOption(Enum& value, std::vector<ChoiceItem> items)
      : items_(std::move(items)),
        value_(Enumerator{[&value] { return static_cast<std::size_t>(value); },
                          [&value](std::size_t item) { value = static_cast<Enum>(item); }}) {}
  ChoiceOption(std::string& value, std::vector<ChoiceItem> items)
      : items_(std::move(items)), value_(&value) {}

  const std::vector<ChoiceItem>& items() const { return items_; }
  /// Index of the chosen item; the number of items if the value is none of them.
  std::size_t chosen() const;
  /// Name of the present value, known or not.
  std::string name() const;
  void choose(std::size_t item) const;
  /// Returns false and changes nothing if no item has this name.
  bool choose(std::string_view name) const;
  std::string names(const char* separator = ", ") const;
  /// Whether each choice has a flag of its own on the command line, instead of the option.
  bool has_flags() const;

 private:
  struct Enumerator {
    std::function<std::size_t()> get;
    std::function<void(std::size_t)> set;
  };
  std::vector<ChoiceItem> items_;
  std::variant<Enumerator, std::string*> value_;
};

/// Relative shares of several named parts: non-negative numbers, not all zero.
struct SharesOption {
  struct Part {
    std::string_view name, label, help;
    double* share = nullptr;
  };
  std::vector<Part> parts;
  /// What all shares zero mean, with the name of that choice. Without a name: they are a fault.
  Part none = {};

  bool may_be_none() const { return !none.name.empty(); }
  bool is_none() const {
    return std::ranges::all_of(parts, [](const Part& part) { return *part.share == 0; });
  }
  void clear() const {
    for (const Part& part : parts) *part.share = 0;
  }
  /// What can be chosen, in display order: `none`, then the parts.
  std::vector<Part> choices() const {
    std::vector<Part> all = parts;
    if (may_be_none()) all.insert(all.begin(), none);
    return all;
  }
};

using OptionValue = std::variant<RealOption, OptionalRealOption, IntegerOption, SeedOption,
                                 VectorOption, OptionalVectorOption, SpaceVectorOption, NamesOption,
                                 NodesOption, FileOption, SwitchOption, ChoiceOption, SharesOption>;

/// Whether an option has its own flag on the command line.
enum class OnCommandLine { yes, no };

/// One row of a table: an option that a user can set. Texts are literals.
struct Option {
  std::string_view key;  ///< in recipes: "max_iterations"
  OptionValue value;
  std::string_view label;        ///< on forms: "Max. iterations"
  std::string_view help;         ///< what it is, in one sentence without a full stop
  std::string_view advice = {};  ///< when to change it, in whole sentences
  std::string_view unit = {};
  std::string_view object =
      {};                      ///< object of the recipe in which the key stands; empty: the struct
  std::string_view flag = {};  ///< without dashes; empty: object and key, "linear-tolerance"
  bool applies = true;         ///< has an effect with the other options as chosen
  bool required = false;       ///< must be given
  OnCommandLine on_command_line = OnCommandLine::yes;
};

/// Rows in display order. Valid as long as the object that they are bound to.
using OptionTable = std::vector<Option>;
/// The rows of both, those of the first before those of the second.
OptionTable joined(OptionTable first, OptionTable second);

std::string flag_of(const Option& option);  ///< "--linear-tolerance"
std::string path_of(const Option& option);  ///< "linear.tolerance", as in messages and recipes
/// Its value as it is typed: "0.3", "auto", "0 1".
std::string value_text(const Option& option);
/// Accepted values: "more than 0, at most 1", "auto, newton, picard"; empty: all of its type.
std::string expected_text(const Option& option);
/// "found 2, expected more than 0, at most 1"; empty if the value is in range.
std::string fault_of(const Option& option);
/// Throws UsageError naming the first option that is out of range.
void check(const OptionTable& table);
/// Replaces choices that are incompatible with the others by the first compatible one. Returns true
/// if any changed.
bool settle(const OptionTable& table);

/// Whether two tables, of two objects of one struct, hold the same values.
bool same_values(const OptionTable& a, const OptionTable& b);
/// Gives `to` those values of `after` that differ from `before`. Tables of objects of one struct.
void copy_changes(const OptionTable& before, const OptionTable& after, const OptionTable& to);

/// Six significant digits: "0.3", "1e-10".
std::string number_text(double number);

}  // namespace winslow
