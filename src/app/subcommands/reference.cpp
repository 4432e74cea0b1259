#include "app/output/reference.h"

#include <iostream>

#include "app/options/suggestion.h"
#include "app/subcommands/subcommand.h"

namespace winslow::app {
namespace {

/// Not in the help: it serves those who write the pages.
class ReferenceSubcommand : public Subcommand {
 public:
  explicit ReferenceSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand("reference", "Print a table of the reference pages")) {
    app().group("");
    app().add_option("NAME", name_, "Which")->required()->check(one_of(reference_names()));
  }

  ExitCode run() override {
    print_reference(std::cout, name_);
    return ExitCode::done;
  }

 private:
  std::string name_;
};

}  // namespace

std::unique_ptr<Subcommand> make_reference_subcommand(CLI::App& program) {
  return std::make_unique<ReferenceSubcommand>(program);
}

}  // namespace winslow::app
