#pragma once

#include <CLI/CLI.hpp>
#include <ostream>
#include <string>
#include <vector>

namespace winslow::app {

/// Description of the command line, read from its parser, so that options declared in tables appear
/// without further edits. The manual page and the completions are made from it.

/// The kind of value after a flag, for shell completion.
enum class ValueKind {
  none,    ///< no value: a switch
  words,   ///< one of some names
  marker,  ///< a name of a marker of the mesh
  body,    ///< a name of a marker, then words such as "rotate="
  file,    ///< a file or a folder
  other    ///< a number, a title, ...
};

/// A flag or a positional argument.
struct ProgramOption {
  std::vector<std::string> names;  ///< "-o", "--output"; for a positional argument: "IN"
  bool positional = false;
  bool repeatable = false;           ///< may be given several times
  std::string value;                 ///< "N [500]"; empty: no value
  std::string help;                  ///< lines
  std::string group;                 ///< heading in the help
  ValueKind kind = ValueKind::none;  ///< kind of the values
  int most_values = 0;               ///< largest number of values
  std::vector<std::string> words;    ///< for ValueKind::words and ValueKind::body
};

struct ProgramCommand {
  std::string name, summary;
  std::vector<ProgramOption> options;  ///< positionals first
};

struct ProgramOptions {
  std::string name, summary;
  std::vector<ProgramOption> options;  ///< options of the program itself
  std::vector<ProgramCommand> commands;
};

/// Reads the description from the program's parser; subcommands hidden from its help are left out.
ProgramOptions program_options(CLI::App& program);

/// The manual page winslow.1, in roff with the macros of man(7). Groups of options that several
/// commands share are described once.
void print_manual(std::ostream& out, const ProgramOptions& program);

/// Names of the tables of options, metrics and formats for the reference pages (docs).
/// docs/make_reference.py puts them into the pages, and a test compares them.
std::vector<std::string> reference_names();
/// Prints a table as Markdown. Throws UsageError for a name not in reference_names().
void print_reference(std::ostream& out, const std::string& name);

/// Shells that completions can be written for: "bash", "fish", "zsh".
std::vector<std::string> completion_shells();
/// Prints a script that completes commands, options, their values, and marker names of text SU2 and
/// MSH files on the command line. Throws UsageError for another shell.
void print_completion(std::ostream& out, const ProgramOptions& program, const std::string& shell);

}  // namespace winslow::app
