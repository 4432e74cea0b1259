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

/// A table of options: what a user can set, and how it is called.
///
///     winslow::SmoothOptions options;
///     for (const winslow::Option& option : winslow::option_table(options))
///       std::puts((winslow::path_of(option) + " = " + winslow::value_text(option)).c_str());
///
/// Options as tables. A struct of options has a function option_table(Struct&) that returns one row
/// for each thing that a user can set. The rows are bound to that object: they read and write its
/// members. The command line, recipes, forms, checks and the reference pages are read off them, so
/// that an option is written down in one place.
namespace winslow {

/// The numbers that an option takes: finite ones between two ends.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_included = true, high_included = true;
  std::optional<double> also = std::nullopt;  ///< a number outside that has a meaning of its own

  bool holds(double number) const;
  std::string text() const;  ///< "more than 0, at most 1"; empty: every finite number
};
constexpr Range at_least(double low) { return {.low = low}; }
constexpr Range above(double low) { return {.low = low, .low_included = false}; }
constexpr Range between(double low, double high) { return {.low = low, .high = high}; }
/// Both ends excluded.
constexpr Range inside(double low, double high) { return {low, high, false, false}; }

struct RealOption {
  double* value;
  Range range = {};
};

/// A number that may be left unset.
struct OptionalRealOption {
  std::optional<double>* value;
  Range range = {};
};

struct IntegerOption {
  int* value;
  Range range = {};
};

/// Seeds of random numbers: any whole number from 0 on.
struct SeedOption {
  std::uint64_t* value;
};

/// A vector by two numbers, in space by three. `numbers`: as many as it is written by where the
/// program found it.
struct VectorOption {
  GivenVector* value;
  int numbers = 3;
};

/// The same that may be left unset.
struct OptionalVectorOption {
  std::optional<GivenVector>* value;
  int numbers = 3;
};

/// A vector in space that may be left unset.
struct SpaceVectorOption {
  std::optional<Vec3>* value;
};

/// Names, any number of them, or of pairs of them one after the other.
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
  /// Of a switch that is on unless it is turned off: the flag that does so, and what that means.
  std::string_view off_flag = {}, off_help = {};
};

struct ChoiceItem {
  std::string name;   ///< on the command line and in recipes
  std::string label;  ///< on forms
  std::string_view help = {};
  bool applies = true;  ///< goes with what else is chosen
};

/// One of several named things: an enumerator (items in the order of the enumeration) or a name.
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
  /// Number of the item; that of items if the value is none of them.
  std::size_t chosen() const;
  /// Of the present value, known or not.
  std::string name() const;
  void choose(std::size_t item) const;
  /// False, and nothing changes, if no item has this name.
  bool choose(std::string_view name) const;
  std::string names(const char* separator = ", ") const;

 private:
  struct Enumerator {
    std::function<std::size_t()> get;
    std::function<void(std::size_t)> set;
  };
  std::vector<ChoiceItem> items_;
  std::variant<Enumerator, std::string*> value_;
};

/// Relative shares of several named things: numbers that are not negative, nor all zero.
struct SharesOption {
  struct Part {
    std::string_view name, label, help;
    double* share;
  };
  std::vector<Part> parts;
};

using OptionValue = std::variant<RealOption, OptionalRealOption, IntegerOption, SeedOption,
                                 VectorOption, OptionalVectorOption, SpaceVectorOption, NamesOption,
                                 NodesOption, FileOption, SwitchOption, ChoiceOption, SharesOption>;

/// Whether an option is given by a flag of its own.
enum class OnCommandLine { yes, no };

/// One row of a table: a thing that a user can set. Texts are literals.
struct Option {
  std::string_view key;  ///< in recipes: "max_iterations"
  OptionValue value;
  std::string_view label;        ///< on forms: "Max. iterations"
  std::string_view help;         ///< what it is, in one sentence without its full stop
  std::string_view advice = {};  ///< when to change it, in whole sentences
  std::string_view unit = {};
  std::string_view object =
      {};                      ///< object of the recipe in which the key stands; empty: the struct
  std::string_view flag = {};  ///< without dashes; empty: object and key, "linear-tolerance"
  bool applies = true;         ///< has an effect with what else is chosen
  bool required = false;       ///< must be given
  OnCommandLine on_command_line = OnCommandLine::yes;
};

/// Rows in the order in which they are shown. Valid for as long as the object they are bound to.
using OptionTable = std::vector<Option>;
/// The rows of both, those of the first before those of the second.
OptionTable joined(OptionTable first, OptionTable second);

std::string flag_of(const Option& option);  ///< "--linear-tolerance"
std::string path_of(const Option& option);  ///< "linear.tolerance", as in messages and recipes
/// Its value as it is typed: "0.3", "auto", "0 1".
std::string value_text(const Option& option);
/// What it takes: "more than 0, at most 1", "auto, newton, picard"; empty: everything of its kind.
std::string expected_text(const Option& option);
/// "found 2, expected more than 0, at most 1"; empty if the value is in range.
std::string fault_of(const Option& option);
/// Throws UsageError naming the first option that is out of range.
void check(const OptionTable& table);
/// Puts choices that do not go with the others to the first that does. True if there were any.
bool settle(const OptionTable& table);

/// Whether two tables, of two objects of one struct, hold the same values.
bool same_values(const OptionTable& a, const OptionTable& b);
/// Gives `to` those values of `after` that differ from `before`. Tables of objects of one struct.
void copy_changes(const OptionTable& before, const OptionTable& after, const OptionTable& to);

/// Six significant digits: "0.3", "1e-10".
std::string number_text(double number);

}  // namespace winslow
