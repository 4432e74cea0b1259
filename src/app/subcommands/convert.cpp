#include <iostream>

#include "app/job/edit_job.h"
#include "app/options/flags.h"
#include "app/output/terminal.h"
#include "app/subcommands/subcommand.h"
#include "core/error.h"
#include "core/quality/quality.h"
#include "io/surface/surface.h"

namespace winslow::app {
namespace {

class ConvertSubcommand : public Subcommand {
 public:
  explicit ConvertSubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand(
            "convert", "Write a mesh in another format, its nodes where they are")) {
    add_input(app(), input_);
    reading_.defects = io::Defects::show;
    add_reading_flags(app(), reading_, "all zones, where OUT can hold them");
    app().add_option("OUT", output_, "Mesh to write; its extension says the format")->type_name("");
    FlagGroup(app(), "Output")
        .value("-o,--output", output_flag_, "OUT", "The same as OUT, as other commands take it");
    add_encoding_flags(app(), encoding_);
    add_quiet_flag(app(), quiet_);
  }

  ExitCode run() override {
    choose_output();
    check_mesh_output(output_, input_);
    const InterruptGuard interrupts;
    const std::vector<io::MeshFile> files = read_zones(input_, reading_);
    InterruptGuard::check();
    const SignalsHeld held;
    encoding_.zone_alone = reading_.zone != 0;
    std::vector<io::MeshZone> meshes;
    for (const io::MeshFile& file : files) meshes.push_back({&file.mesh, file.details.get()});
    std::vector<std::string> warnings = warnings_of(files);
    const auto lost = io::write_mesh_zones(output_, meshes, encoding_);
    if (quiet_) return ExitCode::done;
    warnings.insert(warnings.end(), lost.begin(), lost.end());
    print_warnings(warnings);
    tell(files);
    return ExitCode::done;
  }

 private:
  void choose_output() {
    if (output_.empty() == output_flag_.empty()) {
      throw UsageError(output_.empty()
                           ? "no file to write to: give one as OUT or with -o OUT"
                           : "two files to write to, " + output_ + " and " + output_flag_ +
                                 "; expected one, as OUT or with -o OUT");
    }
    if (output_.empty()) output_ = output_flag_;
  }

  void tell(const std::vector<io::MeshFile>& files) const {
    Index nodes = 0, elements = 0, inverted = 0;
    std::size_t markers = 0;
    for (const io::MeshFile& file : files) {
      const io::MeshCounts written = io::written_counts(output_, file.mesh, file.details.get());
      nodes += written.nodes;
      elements += written.elements;
      markers += written.markers;
      inverted += check_validity(*file.mesh.topology, file.mesh.coordinates).inverted;
    }
    if (inverted > 0) {
      print_warnings(
          {input_ + ": " + std::to_string(inverted) + " inverted elements, written as they are"});
    }
    std::cout << "Wrote " << printable(output_) << ": " << nodes << " nodes, " << elements
              << " elements, " << markers << " markers";
    if (files.size() > 1) std::cout << " in " << files.size() << " zones";
    std::cout << '\n';
  }

  std::string input_, output_, output_flag_;
  io::ReadOptions reading_;
  io::WriteOptions encoding_;
  bool quiet_ = false;
};

}  // namespace

std::unique_ptr<Subcommand> make_convert_subcommand(CLI::App& program) {
  return std::make_unique<ConvertSubcommand>(program);
}

}  // namespace winslow::app
