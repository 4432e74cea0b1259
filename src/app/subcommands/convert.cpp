#include <iostream>

#include "app/job/interrupt.h"
#include "app/options/file_flags.h"
#include "app/subcommands/subcommand.h"
#include "core/quality/quality.h"
#include "io/format/mesh_file.h"

namespace winslow::app {
namespace {

class ConvertSubcommand : public Subcommand {
 public:
  explicit ConvertSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand(
            "convert", "Write a mesh in another format, its nodes where they are")) {
    add_input(app(), input_);
    app()
        .add_option("OUT", output_, "Mesh to write; its extension says the format")
        ->required()
        ->type_name("");
    add_encoding_flags(app(), encoding_);
    add_quiet_flag(app(), quiet_);
  }

  ExitCode run() override {
    check_mesh_output(output_);
    const InterruptGuard interrupts;
    io::MeshFile file = io::read_mesh(input_);
    InterruptGuard::check();
    const SignalsHeld held;
    const auto lost = io::write_mesh(output_, file.mesh, file.details.get(), encoding_);
    if (quiet_) return ExitCode::done;
    file.warnings.insert(file.warnings.end(), lost.begin(), lost.end());
    for (const std::string& text : file.warnings) std::cerr << "winslow: warning: " << text << '\n';
    const Validity validity = check_validity(*file.mesh.topology, file.mesh.coordinates);
    if (validity.inverted > 0) {
      std::cerr << "winslow: warning: " << input_ << ": " << validity.inverted
                << " inverted elements, written as they are\n";
    }
    std::cout << "Wrote " << output_ << ": " << file.mesh.topology->node_count() << " nodes, "
              << file.mesh.topology->element_count() << " elements, "
              << file.mesh.topology->markers().size() << " markers\n";
    return ExitCode::done;
  }

 private:
  std::string input_, output_;
  io::WriteOptions encoding_;
  bool quiet_ = false;
};

}  // namespace

std::unique_ptr<Subcommand> make_convert_subcommand(CLI::App& program) {
  return std::make_unique<ConvertSubcommand>(program);
}

}  // namespace winslow::app
