#include <CLI/CLI.hpp>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "app/options/flags.h"
#include "app/output/terminal.h"
#include "app/subcommands/subcommand.h"
#include "core/error.h"
#include "core/formulation/tangled_rest.h"
#include "core/version.h"

namespace winslow::app {

namespace {

ExitCode fail(ExitCode code, const std::string& message) {
  std::cerr << "winslow: " << printable(message) << '\n';
  return code;
}

/// Full name of the chosen subcommand, as the user types it.
std::string asked_for(const CLI::App& program) {
  for (const CLI::App* sub : program.get_subcommands()) return "winslow " + sub->get_name();
  return "winslow";
}

/// A message for unexpected arguments that suggests the nearest valid one.
std::string describe_extras(const CLI::App& program) {
  const auto chosen = program.get_subcommands();
  const CLI::App& app = chosen.empty() ? program : *chosen.front();
  const std::vector<std::string> extras = program.remaining(true);
  const std::string& unknown = extras.front();
  std::vector<std::string> known;
  if (unknown.starts_with("-")) {
    for (const CLI::Option* option : app.get_options()) {
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
    return "unknown option " + unknown + suggest(unknown, known);
  }
  if (!chosen.empty()) return "unexpected argument \"" + unknown + '"';
  for (const CLI::App* sub : program.get_subcommands({})) known.push_back(sub->get_name());
  return "unknown command \"" + unknown + '"' + suggest(unknown, known);
}

ExitCode run_subcommand(const SubcommandList& subcommands, const CLI::App& program) {
  for (const auto& subcommand : subcommands) {
    if (subcommand->chosen()) return subcommand->run();
  }
  std::cerr << program.help();
  return ExitCode::usage;
}

/// Turns "-.2" into "-0.2". CLI11 recognises a negative number by the digit after the minus sign,
/// so "-.2" would end a list such as --pivot .3 -.2.
std::string with_leading_zero(std::string word) {
  if (!word.starts_with("-.")) return word;
  const std::string_view digits = std::string_view(word).substr(1);
  double value = 0;
  const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool number = fault == std::errc() && end == digits.data() + digits.size();
  return number ? word.insert(1, "0") : word;
}

/// The words of the command line in the order that CLI11 requires: the last one first.
std::vector<std::string> reversed_words(int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  std::ranges::transform(words, words.begin(), with_leading_zero);
  std::ranges::reverse(words);
  return words;
}

ExitCode parse_and_run(CLI::App& program, const SubcommandList& subcommands, int argc,
                       char** argv) {
  try {
    program.parse(reversed_words(argc, argv));
  } catch (const CLI::Success& success) {  // --help, --version
    program.exit(success);
    return ExitCode::done;
  } catch (const CLI::ExtrasError&) {
    return fail(ExitCode::usage, describe_extras(program) + " (" + asked_for(program) +
                                     " --help lists what there is)");
  } catch (const CLI::ParseError& error) {
    return fail(ExitCode::usage,
                std::string(error.what()) + " (see " + asked_for(program) + " --help)");
  }
  return run_subcommand(subcommands, program);
}

/// Throws OutputError if something that was said could not be written: a full disk, for instance.
void flush_output() {
  errno = 0;
  if (std::cout.flush()) return;
  throw OutputError(std::string("the standard output cannot be written") +
                    (errno != 0 ? ": " : "") + (errno != 0 ? std::strerror(errno) : ""));
}

/// The whole program: parses the command line, runs the subcommand, and turns every error into one
/// line on the standard error and an exit code. Throws nothing.
ExitCode run_program(int argc, char** argv) {
  try {
    CLI::App program(
        "Repairs unstructured meshes after boundary motion: Winslow smoothing on "
        "virtual control volumes.",
        "winslow");
    program.set_version_flag("--version", "winslow " WINSLOW_VERSION, "Print the version");
    program.footer(std::string("'winslow COMMAND --help' explains a command.\n\n") +
                   std::string(exit_code_help));
    const SubcommandList subcommands = make_subcommands(program);
    const ExitCode code = parse_and_run(program, subcommands, argc, argv);
    flush_output();
    return code;
  } catch (const UsageError& error) {
    return fail(ExitCode::usage, error.what());
  } catch (const InputError& error) {
    return fail(ExitCode::input, error.what());
  } catch (const OutputError& error) {
    return fail(ExitCode::input, error.what());
  } catch (const Cancelled&) {
    return fail(ExitCode::interrupted, "interrupted; nothing was written");
  } catch (const TangledRest& error) {
    return fail(ExitCode::tangled_rest, std::string(error.what()) + "; nothing was written");
  } catch (const NumericError& error) {
    return fail(ExitCode::not_converged, std::string(error.what()) + "; nothing was written");
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::internal, "out of memory");
  } catch (const std::exception& error) {
    return fail(ExitCode::internal, error.what());
  }
}

}  // namespace

}  // namespace winslow::app

namespace {

/// Lets the allocator keep freed memory, up to a limit, for later allocations. Every iteration
/// allocates and frees arrays of megabytes. By default they come from the system each time, which
/// costs a tenth to a quarter of a run on a surface of 100,000 triangles, mostly in serial code.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int most_of_one = 32 << 20, most_kept = 256 << 20;  // bytes
  mallopt(M_MMAP_THRESHOLD, most_of_one);
  mallopt(M_TRIM_THRESHOLD, most_kept);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  // Writing beyond the limit of file sizes is then an ordinary error.
  std::signal(SIGXFSZ, SIG_IGN);
  return static_cast<int>(winslow::app::run_program(argc, argv));
}
