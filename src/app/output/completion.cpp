#include "app/output/reference.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "core/error.h"

namespace winslow::app {
namespace {

std::string joined(const std::vector<std::string>& words, std::string_view separator = " ") {
  std::string text;
  for (const std::string& word : words) text.append(text.empty() ? "" : separator).append(word);
  return text;
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t start = 0; (start = text.find(what, start)) != std::string::npos;
       start += by.size())
    text.replace(start, what.size(), by);
  return text;
}

/// Puts text in single quotes for bash and zsh.
std::string quoted(const std::string& text) { return '\'' + replaced(text, "'", "'\\''") + '\''; }

/// Short description of an option: the first line of its help, truncated.
std::string brief(const std::string& help) {
  constexpr std::size_t longest = 70;
  std::string text = help.substr(0, help.find('\n'));
  if (text.ends_with(':')) text.pop_back();
  if (text.size() <= longest) return text;
  return text.substr(0, text.rfind(' ', longest - 3)) + "...";
}

std::vector<std::string> flags_of(const std::vector<ProgramOption>& options) {
  std::vector<std::string> flags;
  for (const ProgramOption& option : options) {
    if (!option.positional) flags.insert(flags.end(), option.names.begin(), option.names.end());
  }
  return flags;
}

std::vector<std::string> names_of(const std::vector<ProgramCommand>& commands) {
  std::vector<std::string> names;
  for (const ProgramCommand& command : commands) names.push_back(command.name);
  return names;
}

/// Shell code that prints the marker names of the file $word (text SU2 and MSH). All shells accept
/// it; only their loops differ.
constexpr std::string_view print_markers =
    R"sh(case "$word" in
      *.su2) sed -n 's/^[[:space:]]*MARKER_*TAG[[:space:]]*=[[:space:]]*//p' "$word" ;;
      *.msh) sed -n '/^\$PhysicalNames/,/^\$EndPhysicalNames/s/^1 [0-9-]* "\(.*\)"/\1/p' "$word" ;;
    esac)sh";

// bash

constexpr std::string_view bash_engine = R"sh(_winslow() {
  local cur=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]} flag='' given=0 i
  local kind='' most=0 words=''
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    _winslow_offer "$_winslow_commands"
    return
  fi
  for ((i = COMP_CWORD - 1; i > 1; --i)); do
    if [[ ${COMP_WORDS[i]} == -[a-zA-Z-]* ]]; then
      flag=${COMP_WORDS[i]} given=$((COMP_CWORD - i))
      break
    fi
  done
  _winslow_option "$command $flag"
  if [[ $cur != -[a-zA-Z-]* && $cur != - ]] && ((given > 0 && given <= most)); then
    case $kind in
      words) _winslow_offer "$words" ;;
      marker) _winslow_offer "$(_winslow_markers | sort -u)" ;;
      body)
        if ((given == 1)); then
          _winslow_offer "$(_winslow_markers | sort -u)"
        else
          compopt -o nospace 2>/dev/null
          _winslow_offer "$words"
        fi ;;
      file) ;; # the shell's own names of files
      *) compopt +o default 2>/dev/null ;;
    esac
  elif [[ $cur == -* ]]; then
    _winslow_offer "$(_winslow_flags "$command")"
  fi
}
complete -o default -F _winslow winslow
)sh";

void print_bash_options(std::ostream& out, const ProgramOptions& program) {
  constexpr std::array<const char*, 6> kinds{"none", "words", "marker", "body", "file", "other"};
  // Flags grouped by their description.
  std::map<std::string, std::vector<std::string>> flags;
  for (const ProgramCommand& command : program.commands) {
    for (const ProgramOption& option : command.options) {
      if (option.positional || option.kind == ValueKind::none) continue;
      std::string says = std::string("kind=") + kinds[static_cast<std::size_t>(option.kind)] +
                         " most=" + std::to_string(option.most_values);
      if (!option.words.empty()) says += " words=" + quoted(joined(option.words, "\n"));
      for (const std::string& name : option.names)
        flags[says].push_back('"' + command.name + ' ' + name + '"');
    }
  }
  out << "_winslow_option() {\n  case $1 in\n";
  for (const auto& [says, patterns] : flags)
    out << "    " << joined(patterns, " | ") << ")\n      " << says << " ;;\n";
  out << "  esac\n}\n\n";
}

void print_bash(std::ostream& out, const ProgramOptions& program) {
  std::vector<std::string> first = names_of(program.commands);
  const std::vector<std::string> own = flags_of(program.options);
  first.insert(first.end(), own.begin(), own.end());
  out << "# Completion of winslow for bash. Written by: winslow reference bash\n\n"
      << "_winslow_commands=" << quoted(joined(first, "\n")) << "\n\n"
      << "_winslow_markers() {\n  local word\n  for word in \"${COMP_WORDS[@]}\"; do\n"
      << "    word=${word/#\\~/$HOME}\n    [[ -f $word ]] || continue\n    " << print_markers
      << "\n  done | tr -d '\\r'\n}\n\n"
      << "# Offers those of the lines of $1 that begin with what is typed.\n"
      << "_winslow_offer() {\n  local line\n  while IFS= read -r line; do\n"
      << "    [[ -n $line && $line == \"$cur\"* ]] && COMPREPLY+=(\"$(printf %q \"$line\")\")\n"
      << "  done <<<\"$1\"\n}\n\n"
      << "_winslow_flags() {\n  case $1 in\n";
  for (const ProgramCommand& command : program.commands)
    out << "    " << command.name << ") echo " << quoted(joined(flags_of(command.options), "\n"))
        << " ;;\n";
  out << "  esac\n}\n\n";
  print_bash_options(out, program);
  out << bash_engine;
}

// zsh

/// Escapes text for _arguments, within brackets or between colons.
std::string zsh_text(std::string text) {
  for (const std::string_view special : {"\\", "[", "]", ":"})
    text = replaced(std::move(text), special, '\\' + std::string(special));
  return text;
}

/// ":message:action" for each value.
std::string zsh_values(const ProgramOption& option) {
  std::string action = " ";
  if (option.kind == ValueKind::words) action = '(' + joined(option.words) + ')';
  if (option.kind == ValueKind::marker) action = "_winslow_markers";
  if (option.kind == ValueKind::file) action = "_files";
  const std::string value = option.positional ? option.names.front() : option.value;
  if (option.kind == ValueKind::body)  // up to the next option
    return ":NAME:_winslow_markers:*-*:KEY=VALUE:(" + joined(option.words) + ')';
  const std::string one = ':' + zsh_text(value.substr(0, value.find(" ["))) + ':' + action;
  constexpr int few = 4;
  std::string all;
  for (int k = 0; k < (option.most_values <= few ? option.most_values : 1); ++k) all += one;
  return all;
}

void print_zsh_option(std::ostream& out, const ProgramOption& option) {
  if (option.positional) {
    out << " \\\n        " << quoted((option.repeatable ? "*" : "") + zsh_values(option));
    return;
  }
  const std::string says = '[' + zsh_text(brief(option.help)) + ']' + zsh_values(option);
  for (const std::string& name : option.names) {
    const std::string once = option.repeatable ? "*" : '(' + joined(option.names) + ')';
    out << " \\\n        " << quoted(once + name + says);
  }
}

void print_zsh(std::ostream& out, const ProgramOptions& program) {
  out << "#compdef winslow\n# Completion of winslow for zsh. Written by: winslow reference zsh\n\n"
      << "_winslow_markers() {\n  local word\n  local -a names\n"
      << "  names=(${(fu)\"$(for word in \"${(@Q)words}\"; do\n    [[ -f $word ]] || continue\n    "
      << print_markers << "\n  done | tr -d '\\r')\"})\n  compadd -a names\n}\n\n"
      << "_winslow() {\n  local -a commands\n  commands=(";
  for (const ProgramCommand& command : program.commands)
    out << "\n    " << quoted(command.name + ':' + brief(command.summary));
  out << "\n  )\n  if ((CURRENT == 2)); then\n    _describe command commands\n    return\n  fi\n"
      << "  local command=$words[2]\n  shift words\n  ((CURRENT--))\n  case $command in\n";
  for (const ProgramCommand& command : program.commands) {
    out << "    " << command.name << ")\n      _arguments";
    for (const ProgramOption& option : command.options) print_zsh_option(out, option);
    out << " ;;\n";
  }
  out << "  esac\n}\n\n"
      << "if [[ $funcstack[1] == _winslow ]]; then\n  _winslow \"$@\"\nelse\n"
      << "  compdef _winslow winslow\nfi\n";
}

// fish

/// Puts text in single quotes for fish.
std::string fish_quoted(const std::string& text) {
  return '\'' + replaced(replaced(text, "\\", "\\\\"), "'", "\\'") + '\'';
}

/// The flags and their values, without the commands that they belong to.
std::string fish_option(const ProgramOption& option) {
  std::string text;
  for (const std::string& name : option.names)
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (option.kind == ValueKind::file) text += " -r -F";
  if (option.kind == ValueKind::other) text += " -x";
  if (option.kind == ValueKind::words) text += " -x -a " + fish_quoted(joined(option.words));
  if (option.kind == ValueKind::marker) text += " -x -a '(__winslow_markers)'";
  if (option.kind == ValueKind::body)
    text += " -x -a '(__winslow_markers) " + joined(option.words) + '\'';
  return text + " -d " + fish_quoted(brief(option.help));
}

void print_fish(std::ostream& out, const ProgramOptions& program) {
  out << "# Completion of winslow for fish. Written by: winslow reference fish\n\n"
      << "function __winslow_markers\n"
      << "  for word in (commandline -opc)\n    test -f $word; or continue\n    switch $word\n"
      << "      case '*.su2'\n        sed -n "
      << R"sh('s/^[[:space:]]*MARKER_*TAG[[:space:]]*=[[:space:]]*//p' $word)sh" << '\n'
      << "      case '*.msh'\n        sed -n "
      << R"sh('/^\$PhysicalNames/,/^\$EndPhysicalNames/s/^1 [0-9-]* "\(.*\)"/\1/p' $word)sh" << '\n'
      << "    end\n  end | tr -d '\\r' | sort -u\nend\n\n";
  for (const ProgramOption& option : program.options)
    out << "complete -c winslow -n __fish_use_subcommand" << fish_option(option) << '\n';
  for (const ProgramCommand& command : program.commands)
    out << "complete -c winslow -n __fish_use_subcommand -f -a " << command.name << " -d "
        << fish_quoted(brief(command.summary)) << '\n';
  std::vector<std::pair<std::string, std::vector<std::string>>> lines;
  for (const ProgramCommand& command : program.commands) {
    for (const ProgramOption& option : command.options) {
      if (option.positional) continue;
      const std::string text = fish_option(option);
      auto entry =
          std::ranges::find_if(lines, [&](const auto& line) { return line.first == text; });
      if (entry == lines.end()) entry = lines.insert(entry, {text, {}});
      entry->second.push_back(command.name);
    }
  }
  for (const auto& [text, commands] : lines)
    out << "complete -c winslow -n '__fish_seen_subcommand_from " << joined(commands) << "'" << text
        << '\n';
}

struct Shell {
  const char* name;
  void (*print)(std::ostream& out, const ProgramOptions& program);
};
constexpr std::array shells{Shell{"bash", print_bash}, Shell{"fish", print_fish},
                            Shell{"zsh", print_zsh}};

}  // namespace

std::vector<std::string> completion_shells() {
  std::vector<std::string> names;
  for (const Shell& shell : shells) names.emplace_back(shell.name);
  return names;
}

void print_completion(std::ostream& out, const ProgramOptions& program, const std::string& shell) {
  for (const Shell& known : shells) {
    if (shell == known.name) return known.print(out, program);
  }
  throw UsageError("no completion for the shell \"" + shell + '"');
}

}  // namespace winslow::app
