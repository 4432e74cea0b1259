#include "app/output/reference.h"

#include <iostream>
#include <iterator>

#include "app/options/flags.h"
#include "app/subcommands/subcommand.h"

namespace winslow::app {
namespace {

/// Prints tables of the reference pages, the manual page and shell completions. Hidden from the
/// help: it is for authors of the documentation and for packagers.
class ReferenceSubcommand : public Subcommand {
 public:
  explicit ReferenceSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand("reference",
                                          "Print a table of the reference pages, the manual page "
                                          "or a completion for a shell")),
        program_(program) {
    app().group("");
    app().add_option("NAME", name_, "Which")->required()->check(one_of(names()));
  }

  ExitCode run() override {
    if (name_ == manual) {
      print_manual(std::cout, program_options(program_));
    } else if (std::ranges::count(completion_shells(), name_) > 0) {
      print_completion(std::cout, program_options(program_), name_);
    } else {
      print_reference(std::cout, name_);
    }
    return ExitCode::done;
  }

 private:
  static constexpr std::string_view manual = "man";

  static std::vector<std::string> names() {
    std::vector<std::string> names = reference_names();
    names.emplace_back(manual);
    std::ranges::copy(completion_shells(), std::back_inserter(names));
    return names;
  }

  CLI::App& program_;
  std::string name_;
};

}  // namespace

std::unique_ptr<Subcommand> make_reference_subcommand(CLI::App& program) {
  return std::make_unique<ReferenceSubcommand>(program);
}

}  // namespace winslow::app
