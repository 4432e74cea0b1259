#pragma once

#include <pybind11/pybind11.h>

#include "core/options/option.h"

/// Options of the tables as keyword arguments:
///
///     winslow::MoveCommand move;
///     set_options(winslow::option_table(move), keywords);  // {"rotate": -10, "pivot": (0.8, 0)}
namespace winslow::python {

/// The name of an option as a keyword argument: "linear_tolerance". It is that of the flag on the
/// command line, but for options that the command line switches by several flags.
std::string keyword_of(const Option& option);

/// Sets each option that has a value among the keywords, and removes it from them. Throws
/// UsageError for a value of another type or out of range.
void set_options(const OptionTable& table, pybind11::dict& keywords);
/// Throws UsageError for a keyword that is left over; names the nearest of `known`.
void refuse_others(const pybind11::dict& keywords, const std::vector<std::string>& known);

/// The rows of a table for documentation: dicts with name, type, default, range, choices, help.
pybind11::list described(const OptionTable& table);

/// A name or a sequence of names. Throws UsageError for anything else.
std::vector<std::string> names_of(const pybind11::handle& given, const std::string& what);

}  // namespace winslow::python
