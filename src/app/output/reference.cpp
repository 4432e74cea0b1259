#include "app/output/reference.h"

#include <cctype>
#include <sstream>

#include "app/options/flags.h"
#include "app/output/terminal.h"
#include "core/command/option_tables.h"
#include "core/error.h"
#include "core/inspect/element_field.h"
#include "core/layers/layer_plan.h"
#include "core/motion/motion.h"
#include "core/version.h"
#include "io/format/foreign_formats.h"
#include "io/format/mesh_format.h"

namespace winslow::app {
namespace {

/// Removes the default: "N [500]" becomes "N".
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
  if (!option.words.empty())
    return option.value.starts_with("NAME[,") ? ValueKind::body : ValueKind::words;
  const std::string_view value =
      without_default(option.positional ? option.names.front() : option.value);
  if (names_a_file(value)) return ValueKind::file;
  return value == "NAME" ? ValueKind::marker : ValueKind::other;
}

/// Largest number of values, limited to what shell completion needs.
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
    out.value = out.value.substr(0, out.value.find(':'));  // without the descriptions of validators
  }
  out.help = option.get_description();
  out.group = option.get_group();
  out.words = words_of(option);
  out.kind = kind_of(out);
  return out;
}

std::vector<ProgramOption> options_of(CLI::App& app) {
  std::vector<ProgramOption> options;
  for (CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) options.push_back(option_of(*option));  // others are hidden
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

namespace {

/// Escapes text for roff: no escapes, no requests at the beginning of a line, and minus signs that
/// can be copied.
std::string escaped(std::string_view text) {
  static const std::map<char, std::string_view> glyphs{
      {'\\', "\\e"}, {'-', "\\-"}, {'^', "\\(ha"}, {'~', "\\(ti"}, {'`', "\\(ga"}, {'\'', "\\(aq"}};
  std::string out;
  for (const char c : text) {
    if (out.empty() && c == '.') out += "\\&";
    const auto glyph = glyphs.find(c);
    if (glyph == glyphs.end())
      out += c;
    else
      out += glyph->second;
  }
  return out;
}

/// Formats text in bold or italics.
std::string in_font(char font, const std::string& text) {
  return std::string("\\f") + font + escaped(text) + "\\fR";
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// Prints a help text; each line after the first (choices) starts a new line.
void print_text(std::ostream& out, const std::string& text) {
  std::istringstream lines(text);
  bool first = true;
  for (std::string line; std::getline(lines, line); first = false) {
    if (!first) out << ".br\n";
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin != std::string::npos) out << escaped(line.substr(begin)) << '\n';
  }
}

void print_option(std::ostream& out, const ProgramOption& option) {
  out << ".TP\n";
  for (std::size_t k = 0; k < option.names.size(); ++k) {
    out << (k == 0 ? "" : ", ") << in_font(option.positional ? 'I' : 'B', option.names[k]);
  }
  if (!option.value.empty()) out << ' ' << in_font('I', option.value);
  out << '\n';
  print_text(out, option.help);
}

constexpr std::string_view unnamed = "Options";  // heading of options without a group

/// Options grouped by heading, in order.
using Groups = std::vector<std::pair<std::string, std::vector<const ProgramOption*>>>;

Groups groups_of(const ProgramCommand& command) {
  Groups groups;
  for (const ProgramOption& option : command.options) {
    auto entry =
        std::ranges::find_if(groups, [&](const auto& g) { return g.first == option.group; });
    if (entry == groups.end()) entry = groups.insert(entry, {option.group, {}});
    entry->second.push_back(&option);
  }
  return groups;
}

std::string text_of(const Groups::value_type& group) {
  std::ostringstream out;
  for (const ProgramOption* option : group.second) print_option(out, *option);
  return out.str();
}

/// Groups of options that several commands share.
class SharedGroups {
 public:
  explicit SharedGroups(const ProgramOptions& program) {
    std::map<Key, int> uses;
    std::vector<Key> order;
    for (const ProgramCommand& command : program.commands) {
      for (const auto& group : groups_of(command)) {
        const Key key{group.first, text_of(group)};
        if (group.first != unnamed && ++uses[key] == 2) order.push_back(key);
      }
    }
    for (const Key& key : order) {
      const bool taken =
          std::ranges::any_of(shared_, [&](const Key& k) { return k.first == key.first; });
      if (!taken) shared_.push_back(key);
    }
  }

  bool holds(const Groups::value_type& group) const {
    return std::ranges::find(shared_, Key{group.first, text_of(group)}) != shared_.end();
  }
  void print(std::ostream& out) const {
    if (shared_.empty()) return;
    out << ".SH OPTIONS OF SEVERAL COMMANDS\n";
    for (const auto& [heading, text] : shared_) out << ".SS " << escaped(heading) << '\n' << text;
  }

 private:
  using Key = std::pair<std::string, std::string>;
  std::vector<Key> shared_;
};

void print_command(std::ostream& out, const std::string& program, const ProgramCommand& command,
                   const SharedGroups& shared) {
  out << ".SS " << escaped(program + ' ' + command.name) << '\n';
  print_text(out, command.summary + '.');
  std::string elsewhere;
  for (const auto& group : groups_of(command)) {
    if (shared.holds(group)) {
      elsewhere += (elsewhere.empty() ? "" : ", ") + group.first;
      continue;
    }
    out << text_of(group);
  }
  if (!elsewhere.empty()) out << ".PP\nFurther options, below: " << escaped(elsewhere) << ".\n";
}

void print_synopsis(std::ostream& out, const ProgramOptions& program) {
  out << ".SH SYNOPSIS\n";
  for (const ProgramCommand& command : program.commands) {
    out << in_font('B', program.name + ' ' + command.name);
    for (const ProgramOption& option : command.options) {
      if (!option.positional) continue;
      out << ' ' << in_font('I', option.names.front() + (option.repeatable ? " ..." : ""));
    }
    out << " [" << in_font('I', "OPTIONS") << "]\n.br\n";
  }
}

}  // namespace

void print_manual(std::ostream& out, const ProgramOptions& program) {
  out << ".\\\" Written by: " << program.name << " reference man\n"
      << ".TH " << upper(program.name) << " 1 \"\" \"" << program.name << " " << WINSLOW_VERSION
      << "\" \"User Commands\"\n"
      << ".SH NAME\n"
      << program.name << " \\- smooth unstructured meshes after their boundary has moved\n";
  print_synopsis(out, program);
  out << ".SH DESCRIPTION\n";
  print_text(out, program.summary);
  out << ".SH OPTIONS\n";
  for (const ProgramOption& option : program.options) print_option(out, option);
  const SharedGroups shared(program);
  out << ".SH COMMANDS\n";
  for (const ProgramCommand& command : program.commands)
    print_command(out, program.name, command, shared);
  shared.print(out);
  out << ".SH EXIT STATUS\n";
  std::string status(exit_code_help);
  std::ranges::replace(status, '\n', ' ');
  print_text(out, status.substr(status.find(": ") + 2));
}

namespace {

std::string code(const std::string& text) { return text.empty() ? "" : '`' + text + '`'; }

template <class Item>
std::string item_text(const Item& item) {
  return "; " + code(std::string(item.name)) +
         (item.help.empty() ? "" : ": " + std::string(item.help));
}

/// Description of an option with its choices.
std::string meaning(const Option& option) {
  std::string text(option.help);
  std::string items;
  if (const auto* choice = std::get_if<ChoiceOption>(&option.value)) {
    for (const ChoiceItem& item : choice->items()) items += item_text(item);
  } else if (const auto* shares = std::get_if<SharesOption>(&option.value)) {
    for (const auto& part : shares->choices()) items += item_text(part);
  }
  if (!items.empty()) text += ": " + items.substr(2);
  if (!option.unit.empty()) text += " (" + std::string(option.unit) + ")";
  return text + '.' + (option.advice.empty() ? "" : ' ' + std::string(option.advice));
}

/// The range of an option; for a choice empty, because its meaning lists the names.
std::string range_text(const Option& option) {
  return std::holds_alternative<ChoiceOption>(option.value) ? "" : expected_text(option);
}

/// The flag of an option, or those of its choices.
std::string flags_text(const Option& option) {
  if (option.on_command_line == OnCommandLine::no) return {};
  const auto* choice = std::get_if<ChoiceOption>(&option.value);
  if (!choice || !choice->has_flags()) return code(flag_of(option));
  std::string text;
  for (const ChoiceItem& item : choice->items())
    if (!item.flag.empty())
      text += (text.empty() ? "" : ", ") + code("--" + std::string(item.flag));
  return text;
}

void print_flags(std::ostream& out, const OptionTable& table) {
  out << "| option | in a recipe | default | range | meaning |\n|---|---|---|---|---|\n";
  for (const Option& option : table) {
    out << "| " << flags_text(option) << " | " << code(path_of(option)) << " | "
        << (option.required ? "required" : code(value_text(option))) << " | " << range_text(option)
        << " | " << meaning(option) << " |\n";
  }
}

/// Prints the table of an options struct with its defaults.
template <class Options>
void print_table(std::ostream& out) {
  Options defaults;
  print_flags(out, option_table(defaults));
}

void print_fields(std::ostream& out) {
  out << "| field | in the report | meaning |\n|---|---|---|\n";
  std::vector<ElementField> fields = all_element_fields();
  for (const ElementField& field : all_element_fields(MeshKind::surface))
    if (field.surface()) fields.push_back(field);
  for (const ElementField& field : fields) {
    if (field.layer()) continue;  // a mesh file holds no layers
    const bool reported = field.metric() && metric_info(*field.metric()).reported;
    const FieldInfo& info = field_info(field);
    out << "| " << code(std::string(info.name)) << " | " << (reported ? "yes" : "") << " | "
        << info.help << " |\n";
  }
}

void print_formats(std::ostream& out) {
  out << "| format | extension | encodings | markers | regions | quadrilaterals | volumes |\n"
         "|---|---|---|---|---|---|---|\n";
  for (const io::MeshFormat* format : io::mesh_formats()) {
    out << "| " << format->title << (format->versions.empty() ? "" : ", ") << format->versions
        << " | " << code('.' + std::string(format->name)) << " | " << format->encodings << " | "
        << format->markers << " | " << format->regions << " | " << format->quadrilaterals << " | "
        << format->volumes << (format->polyhedra ? ", with polyhedra" : "") << " |\n";
  }
}

void print_foreign_formats(std::ostream& out) {
  out << "| what the file is | extensions | converted by | command |\n|---|---|---|---|\n";
  for (const io::ForeignFormat& foreign : io::foreign_formats()) {
    out << "| " << foreign.title << " | " << code(std::string(foreign.extensions)) << " | "
        << foreign.with << " | " << code(std::string(foreign.command)) << " |\n";
  }
}

struct Reference {
  const char* name;
  void (*print)(std::ostream& out);
};

constexpr std::array references{Reference{"smoothing", print_table<SmoothOptions>},
                                Reference{"motion", print_table<MotionOptions>},
                                Reference{"rigid", print_table<RigidMotion>},
                                Reference{"sine", print_table<SineDeformation>},
                                Reference{"spacing", print_table<LayerSpacing>},
                                Reference{"layers", print_table<LayersCommand>},
                                Reference{"scramble", print_table<ScrambleCommand>},
                                Reference{"fields", print_fields},
                                Reference{"formats", print_formats},
                                Reference{"foreign", print_foreign_formats}};

}  // namespace

std::vector<std::string> reference_names() {
  std::vector<std::string> names;
  for (const Reference& reference : references) names.emplace_back(reference.name);
  return names;
}

void print_reference(std::ostream& out, const std::string& name) {
  for (const Reference& reference : references) {
    if (name == reference.name) return reference.print(out);
  }
  throw UsageError("no reference table is called \"" + name + '"');
}

}  // namespace winslow::app
