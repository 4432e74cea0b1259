#include "app/output/manual.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "app/output/exit_code.h"

namespace winslow::app {
namespace {

/// Text that roff prints as it is: no escapes, no requests at the beginning of a line, and minus
/// signs that can be copied.
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

/// A piece of a line in bold or italics.
std::string in_font(char font, const std::string& text) {
  return std::string("\\f") + font + escaped(text) + "\\fR";
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// The lines of a help text, those after the first (choices) each on a line of its own.
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

constexpr std::string_view unnamed = "Options";  // heading of what belongs to no group

/// Options by their headings, in order.
using Groups = std::vector<std::pair<std::string, std::vector<const ProgramOption*>>>;

Groups groups_of(const ProgramCommand& command) {
  Groups groups;
  for (const ProgramOption& option : command.options) {
    auto at = std::ranges::find_if(groups, [&](const auto& g) { return g.first == option.group; });
    if (at == groups.end()) at = groups.insert(at, {option.group, {}});
    at->second.push_back(&option);
  }
  return groups;
}

std::string text_of(const Groups::value_type& group) {
  std::ostringstream out;
  for (const ProgramOption* option : group.second) print_option(out, *option);
  return out.str();
}

/// Groups of a name that several commands have alike.
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
      if (option.positional) out << ' ' << in_font('I', option.names.front());
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

}  // namespace winslow::app
