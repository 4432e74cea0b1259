#include "app/output/program_options.h"

#include <algorithm>
#include <array>

#include "app/options/suggestion.h"

namespace winslow::app {
namespace {

/// "N [500]" is N.
std::string_view without_default(std::string_view value) {
  return value.substr(0, value.find(' '));
}

bool names_a_file(std::string_view value) {
  constexpr std::array<std::string_view, 7> kinds{"IN",   "OUT", "MESH",  "PIC",
                                                  "FILE", "DIR", "RECIPE"};
  const std::string_view name = value.substr(0, value.find('.'));
  return std::ranges::find(kinds, name) != kinds.end();
}

ValueKind kind_of(const ProgramOption& option) {
  if (option.most_values == 0) return ValueKind::none;
  if (!option.words.empty()) return ValueKind::words;
  const std::string_view value =
      without_default(option.positional ? option.names.front() : option.value);
  if (names_a_file(value)) return ValueKind::file;
  return value == "NAME" ? ValueKind::marker : ValueKind::other;
}

/// As many as a shell needs to count.
int most_values(const CLI::Option& option) {
  constexpr int many = 99;
  if (option.get_items_expected_max() == 0) return 0;
  const bool several = option.get_allow_extra_args() && option.get_expected_max() > 1;
  return several ? many : std::min(option.get_type_size_max(), many);
}

ProgramOption option_of(CLI::Option& option) {
  ProgramOption out;
  out.positional = !option.nonpositional();
  if (out.positional) {
    out.names.push_back(option.get_name(true));
  } else {
    for (const std::string& name : option.get_snames()) out.names.push_back('-' + name);
    for (const std::string& name : option.get_lnames()) out.names.push_back("--" + name);
  }
  out.most_values = most_values(option);
  out.repeatable = option.get_expected_max() > 1;
  if (out.most_values > 0 && !out.positional) {
    out.value =
        option.get_option_text().empty() ? option.get_type_name() : option.get_option_text();
    out.value = out.value.substr(0, out.value.find(':'));  // what checks say of themselves
  }
  out.help = option.get_description();
  out.group = option.get_group();
  out.words = words_of(option);
  out.kind = kind_of(out);
  return out;
}

std::vector<ProgramOption> options_of(CLI::App& app) {
  std::vector<ProgramOption> options;
  for (CLI::Option* option : app.get_options()) options.push_back(option_of(*option));
  std::stable_partition(options.begin(), options.end(),
                        [](const ProgramOption& o) { return o.positional; });
  return options;
}

}  // namespace

ProgramOptions program_options(CLI::App& program) {
  ProgramOptions out{program.get_name(), program.get_description(), options_of(program), {}};
  for (CLI::App* command : program.get_subcommands(std::function<bool(CLI::App*)>())) {
    if (command->get_group().empty()) continue;
    out.commands.push_back({command->get_name(), command->get_description(), options_of(*command)});
  }
  return out;
}

}  // namespace winslow::app
