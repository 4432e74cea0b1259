#pragma once

#include <CLI/CLI.hpp>

#include "app/output/terminal.h"

namespace winslow::app {

/// A subcommand: the constructor declares its options; run() is called after they are parsed.
class Subcommand {
 public:
  explicit Subcommand(CLI::App* app) : app_(app) {}
  virtual ~Subcommand() = default;
  Subcommand(const Subcommand&) = delete;
  Subcommand& operator=(const Subcommand&) = delete;

  /// True if the user chose this subcommand.
  bool chosen() const { return app_->parsed(); }
  /// Throws the library's errors.
  virtual ExitCode run() = 0;

 protected:
  CLI::App& app() const { return *app_; }

 private:
  CLI::App* app_;
};

using SubcommandList = std::vector<std::unique_ptr<Subcommand>>;

/// Makes all subcommands, in the order of the help.
SubcommandList make_subcommands(CLI::App& program);

std::unique_ptr<Subcommand> make_sweep_subcommand(CLI::App& program);
std::unique_ptr<Subcommand> make_sensitivity_subcommand(CLI::App& program);
std::unique_ptr<Subcommand> make_quality_subcommand(CLI::App& program);
std::unique_ptr<Subcommand> make_render_subcommand(CLI::App& program);
std::unique_ptr<Subcommand> make_convert_subcommand(CLI::App& program);
std::unique_ptr<Subcommand> make_studio_subcommand(CLI::App& program);
std::unique_ptr<Subcommand> make_reference_subcommand(CLI::App& program);

}  // namespace winslow::app
