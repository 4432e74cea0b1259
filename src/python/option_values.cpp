#include "python/option_values.h"

#include "core/error.h"
#include "python/arrays.h"

namespace py = pybind11;

namespace winslow::python {
namespace {

std::string type_name(const py::handle& given) {
  return py::str(py::type::handle_of(given).attr("__name__")).cast<std::string>();
}

/// "rotate: found str, expected a number".
[[noreturn]] void refuse(const std::string& what, const py::handle& given, const char* expected) {
  throw UsageError(what + ": found " + py::repr(given).cast<std::string>() + " (" +
                   type_name(given) + "), expected " + expected);
}

double number_of(const py::handle& given, const std::string& what) {
  const double number = PyBool_Check(given.ptr()) ? -1 : PyFloat_AsDouble(given.ptr());
  if (PyErr_Occurred() != nullptr || PyBool_Check(given.ptr())) {
    PyErr_Clear();
    refuse(what, given, "a number");
  }
  return number;
}

/// A whole number: int, or what stands for one (numpy's integers).
std::int64_t whole_of(const py::handle& given, const std::string& what) {
  const auto whole = PyBool_Check(given.ptr())
                         ? py::object()
                         : py::reinterpret_steal<py::object>(PyNumber_Index(given.ptr()));
  const long long value = whole ? PyLong_AsLongLong(whole.ptr()) : -1;
  if (!whole || PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    refuse(what, given, "a whole number");
  }
  return value;
}

template <class Number>
Number fitting(std::int64_t value, const py::handle& given, const std::string& what) {
  if (!std::in_range<Number>(value)) refuse(what, given, "a number that fits");
  return static_cast<Number>(value);
}

Vec3 vector_of(const py::handle& given, std::size_t least, const std::string& what, bool& third) {
  const auto array = InputArray<double>::ensure(py::reinterpret_borrow<py::object>(given));
  const bool sound =
      array && array.ndim() == 1 && (array.size() == 3 || (array.size() == 2 && least == 2));
  if (!sound) {
    PyErr_Clear();
    refuse(what, given, least == 2 ? "two numbers, in space three" : "three numbers");
  }
  third = array.size() == 3;
  return {array.data()[0], array.data()[1], third ? array.data()[2] : 0};
}

GivenVector given_vector(const py::handle& given, const std::string& what) {
  bool third = false;
  const Vec3 vector = vector_of(given, 2, what, third);
  return GivenVector::of(third ? 3 : 2, vector);
}

// Set an option of each kind from a value.

void set(const RealOption& real, const py::handle& given, const std::string& what) {
  *real.value = number_of(given, what);
}
void set(const OptionalRealOption& real, const py::handle& given, const std::string& what) {
  if (given.is_none())
    real.value->reset();
  else
    *real.value = number_of(given, what);
}
void set(const IntegerOption& integer, const py::handle& given, const std::string& what) {
  *integer.value = fitting<int>(whole_of(given, what), given, what);
}
void set(const SeedOption& seed, const py::handle& given, const std::string& what) {
  *seed.value = fitting<std::uint64_t>(whole_of(given, what), given, what);
}
void set(const VectorOption& vector, const py::handle& given, const std::string& what) {
  *vector.value = given_vector(given, what);
}
void set(const OptionalVectorOption& vector, const py::handle& given, const std::string& what) {
  if (given.is_none())
    vector.value->reset();
  else
    *vector.value = given_vector(given, what);
}
void set(const SpaceVectorOption& vector, const py::handle& given, const std::string& what) {
  bool third = false;
  if (given.is_none())
    vector.value->reset();
  else
    *vector.value = vector_of(given, 3, what, third);
}
void set(const NamesOption& names, const py::handle& given, const std::string& what) {
  names.value->clear();
  if (!names.pairs || py::isinstance<py::str>(given)) {
    *names.value = names_of(given, what);
    return;
  }
  if (!py::isinstance<py::sequence>(given)) refuse(what, given, "pairs of names");
  for (const py::handle part : given) {
    for (std::string& name : names_of(part, what)) names.value->push_back(std::move(name));
  }
}
void set(const NodesOption& nodes, const py::handle& given, const std::string& what) {
  nodes.value->clear();
  const auto array = py::array::ensure(py::reinterpret_borrow<py::object>(given));
  if (!array) refuse(what, given, "numbers of nodes");
  for (const py::handle node : array.attr("ravel")().attr("tolist")())
    nodes.value->push_back(fitting<Index>(whole_of(node, what), node, what));
}
void set(const FileOption& file, const py::handle& given, const std::string& what) {
  if (given.is_none()) {
    file.value->clear();
    return;
  }
  try {
    *file.value = py::str(py::module_::import("os").attr("fspath")(given)).cast<std::string>();
  } catch (const py::error_already_set&) {
    refuse(what, given, "the name of a file");
  }
}
void set(const SwitchOption& on, const py::handle& given, const std::string& what) {
  if (!PyBool_Check(given.ptr()) && type_name(given) != "bool_")
    refuse(what, given, "True or False");
  *on.value = given.cast<bool>();
}
void set(const ChoiceOption& choice, const py::handle& given, const std::string& what) {
  const std::string names = "one of " + choice.names();
  if (!py::isinstance<py::str>(given)) refuse(what, given, names.c_str());
  if (!choice.choose(std::string_view(given.cast<std::string>())))
    throw UsageError(what + ": found \"" + given.cast<std::string>() + "\", expected " + names);
}

/// One name, or a dict of shares by name.
void set(const SharesOption& shares, const py::handle& given, const std::string& what) {
  py::dict by_name;
  if (py::isinstance<py::str>(given))
    by_name[given] = py::float_(1.0);
  else if (py::isinstance<py::dict>(given))
    by_name = py::reinterpret_borrow<py::dict>(given);
  else
    refuse(what, given, "a name, or a dict of shares by name");
  shares.clear();
  for (const auto& [key, share] : by_name) {
    const auto name = py::str(key).cast<std::string>();
    if (shares.may_be_none() && by_name.size() == 1 && name == shares.none.name) return;
    const auto part = std::ranges::find(shares.parts, name, &SharesOption::Part::name);
    if (part == shares.parts.end())
      throw UsageError(what + ": found \"" + name + "\", expected one of " +
                       listed(shares.choices(), [](const auto& of) { return of.name; }));
    *part->share = number_of(share, what);
  }
  if (shares.is_none()) throw UsageError(what + ": the shares must not all be zero");
}

// The type of a value, for documentation.

std::string type_of(const RealOption&) { return "float"; }
std::string type_of(const OptionalRealOption&) { return "Optional[float]"; }
std::string type_of(const IntegerOption&) { return "int"; }
std::string type_of(const SeedOption&) { return "int"; }
std::string type_of(const VectorOption&) { return "Sequence[float]"; }
std::string type_of(const OptionalVectorOption&) { return "Optional[Sequence[float]]"; }
std::string type_of(const SpaceVectorOption&) { return "Optional[Sequence[float]]"; }
std::string type_of(const NamesOption& names) {
  return names.pairs ? "Sequence[Tuple[str, str]]" : "Union[str, Sequence[str]]";
}
std::string type_of(const NodesOption&) { return "Sequence[int]"; }
std::string type_of(const FileOption&) { return "Optional[PathLike]"; }
std::string type_of(const SwitchOption&) { return "bool"; }
std::string type_of(const ChoiceOption& choice) {
  return "Literal[" +
         listed(choice.items(), [](const ChoiceItem& item) { return '"' + item.name + '"'; }) + "]";
}
std::string type_of(const SharesOption&) { return "Union[str, Dict[str, float]]"; }

/// The default as an expression of Python; "None" where nothing is given.
std::string default_of(const Option& option) {
  return std::visit(
      [&](const auto& of) -> std::string {
        using Kind = std::decay_t<decltype(of)>;
        if constexpr (std::is_same_v<Kind, SwitchOption>) return *of.value ? "True" : "False";
        if constexpr (std::is_same_v<Kind, ChoiceOption>) return '"' + of.name() + '"';
        if constexpr (std::is_same_v<Kind, NamesOption> || std::is_same_v<Kind, NodesOption>)
          return "()";
        if constexpr (std::is_same_v<Kind, RealOption> || std::is_same_v<Kind, IntegerOption> ||
                      std::is_same_v<Kind, SeedOption>)
          return value_text(option);
        if constexpr (std::is_same_v<Kind, VectorOption>) return "(0, 0)";
        if constexpr (std::is_same_v<Kind, SharesOption>) return '"' + value_text(option) + '"';
        return "None";
      },
      option.value);
}

py::list choices_of(const Option& option) {
  py::list choices;
  const auto add = [&](std::string_view name, std::string_view help) {
    choices.append(py::make_tuple(std::string(name), std::string(help)));
  };
  if (const auto* choice = std::get_if<ChoiceOption>(&option.value)) {
    for (const ChoiceItem& item : choice->items()) add(item.name, item.help);
  } else if (const auto* shares = std::get_if<SharesOption>(&option.value)) {
    for (const auto& part : shares->choices()) add(part.name, part.help);
  }
  return choices;
}

}  // namespace

std::string keyword_of(const Option& option) {
  const auto* choice = std::get_if<ChoiceOption>(&option.value);
  const auto* on = std::get_if<SwitchOption>(&option.value);
  const bool several = (choice && choice->has_flags()) || (on && !on->off_flag.empty());
  std::string name = several ? std::string(option.key) : flag_of(option).substr(2);
  std::ranges::replace(name, '-', '_');
  return name;
}

void set_options(const OptionTable& table, py::dict& keywords) {
  for (const Option& option : table) {
    const std::string name = keyword_of(option);
    if (!keywords.contains(name)) continue;
    const auto given = keywords.attr("pop")(name).cast<py::object>();
    std::visit([&](const auto& of) { set(of, given, name); }, option.value);
    if (const std::string fault = fault_of(option); !fault.empty())
      throw UsageError(name + ": " + fault);
  }
}

void refuse_others(const py::dict& keywords, const std::vector<std::string>& known) {
  if (keywords.empty()) return;
  const auto name = py::str((*keywords.begin()).first).cast<std::string>();
  py::list names;
  for (const std::string& one : known) names.append(one);
  const auto near =
      py::module_::import("difflib").attr("get_close_matches")(name, names, 1).cast<py::list>();
  std::string hint = "; help() of the function lists what there is";
  if (!near.empty()) hint = "; did you mean " + near[0].cast<std::string>() + "?";
  throw UsageError("unknown option \"" + name + '"' + hint);
}

py::list described(const OptionTable& table) {
  py::list rows;
  for (const Option& option : table) {
    py::dict row;
    row["name"] = keyword_of(option);
    row["type"] = std::visit([](const auto& of) { return type_of(of); }, option.value);
    row["default"] = default_of(option);
    row["shown"] = value_text(option);
    row["range"] = choices_of(option).empty() ? expected_text(option) : "";
    row["choices"] = choices_of(option);
    row["help"] = std::string(option.help);
    row["advice"] = std::string(option.advice);
    row["unit"] = std::string(option.unit);
    rows.append(row);
  }
  return rows;
}

std::vector<std::string> names_of(const py::handle& given, const std::string& what) {
  if (given.is_none()) return {};
  if (py::isinstance<py::str>(given)) return {given.cast<std::string>()};
  if (!py::isinstance<py::sequence>(given) && !py::isinstance<py::set>(given))
    refuse(what, given, "a name or a list of names");
  std::vector<std::string> names;
  for (const py::handle name : given) {
    if (!py::isinstance<py::str>(name)) refuse(what, name, "a name");
    names.push_back(name.cast<std::string>());
  }
  return names;
}

}  // namespace winslow::python
