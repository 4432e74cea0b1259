#pragma once

#include <CLI/CLI.hpp>
#include <ostream>
#include <string>
#include <vector>

namespace winslow::app {

/// What the program takes on its command line, read off the parser that takes it: what tables of
/// options declare is here with no other edit. Manual page and completions are made of it.

/// What follows a flag, as far as a shell can complete it.
enum class ValueKind {
  none,    ///< nothing: a switch
  words,   ///< one of some names
  marker,  ///< a name of a marker of the mesh
  file,    ///< a file or a folder
  other    ///< a number, a title, ...
};

/// A flag or a positional argument.
struct ProgramOption {
  std::vector<std::string> names;  ///< "-o", "--output"; of a positional: "IN"
  bool positional = false;
  bool repeatable = false;           ///< may be given several times
  std::string value;                 ///< "N [500]"; empty: takes none
  std::string help;                  ///< lines
  std::string group;                 ///< heading in the help
  ValueKind kind = ValueKind::none;  ///< of what follows
  int most_values = 0;               ///< that may follow
  std::vector<std::string> words;    ///< with kind words
};

struct ProgramCommand {
  std::string name, summary;
  std::vector<ProgramOption> options;  ///< positionals first
};

struct ProgramOptions {
  std::string name, summary;
  std::vector<ProgramOption> options;  ///< of the program itself
  std::vector<ProgramCommand> commands;
};

/// Of the parser of the whole program; subcommands that its help does not list are left out.
ProgramOptions program_options(CLI::App& program);

/// The manual page winslow.1, in roff with the macros of man(7). Groups of options that several
/// commands have alike are described once.
void print_manual(std::ostream& out, const ProgramOptions& program);

/// The tables of the reference pages (docs), as Markdown: what tables of options, metrics and
/// formats say. docs/make_reference.py puts them into the pages, and a test compares them.
std::vector<std::string> reference_names();
/// Throws UsageError for a name that is not among them.
void print_reference(std::ostream& out, const std::string& name);

/// Shells that completions can be written for: "bash", "fish", "zsh".
std::vector<std::string> completion_shells();
/// A script that completes commands, options, what options take, and the names of markers of text
/// SU2 and MSH files on the command line. Throws UsageError for another shell.
void print_completion(std::ostream& out, const ProgramOptions& program, const std::string& shell);

}  // namespace winslow::app
