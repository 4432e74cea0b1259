#include <iostream>
#include <nlohmann/json.hpp>

#include "app/options/file_flags.h"
#include "app/output/quality_table.h"
#include "app/output/report.h"
#include "app/output/stopwatch.h"
#include "app/output/wall_table.h"
#include "app/subcommands/subcommand.h"
#include "io/format/mesh_file.h"

namespace winslow::app {
namespace {

constexpr int inverted_elements_shown = 20;

class QualitySubcommand : public Subcommand {
 public:
  explicit QualitySubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand(
            "quality",
            "Print the quality of a mesh and its worst elements; exit status 4 if any element is "
            "inverted")) {
    add_input(app(), input_);
    app()
        .add_option("--worst", options_.worst, "How many of the worst elements to list")
        ->check(CLI::Range(0, 1000000))
        ->option_text("N [10]");
    app().add_flag("--histogram", histogram_, "Print histograms too");
    app()
        .add_option("--bins", options_.histogram_bins, "Bins of a histogram")
        ->check(CLI::Range(1, 1000))
        ->option_text("N [20]");
    app()
        .add_option("--threads", options_.threads, "Threads; 0 for all cores")
        ->check(CLI::Range(0, 4096))
        ->option_text("N [0]");
    app().add_option("--report", report_, "Write the same as JSON")->type_name("FILE.json");
    add_quiet_flag(app(), quiet_);
  }

  ExitCode run() override {
    check_output(report_);
    if (!report_.empty()) check_distinct({report_, input_});
    Stopwatch total;
    const io::MeshFile file = io::read_mesh(input_);
    Timings seconds;
    seconds.load = total.seconds();
    const QualityReport quality = measure_quality(file.mesh, options_);
    seconds.solve = total.seconds() - seconds.load;
    seconds.total = total.seconds();
    if (!report_.empty()) write_json(report_, describe(file, quality, seconds));
    if (!quiet_) print(file, quality);
    return quality.inverted > 0 ? ExitCode::inverted : ExitCode::done;
  }

 private:
  nlohmann::json describe(const io::MeshFile& file, const QualityReport& quality,
                          const Timings& seconds) const {
    nlohmann::json report = describe_mesh(file.mesh, quality);
    report["command"] = "quality";
    report["input"] = input_;
    report["seconds"] = {{"load", seconds.load},
                         {"solve", seconds.solve},
                         {"save", seconds.save},
                         {"total", seconds.total}};
    report["peak_memory_bytes"] = peak_memory_bytes();
    report["warnings"] = file.warnings;
    return report;
  }

  void print(const io::MeshFile& file, const QualityReport& quality) const {
    for (const std::string& text : file.warnings) std::cerr << "winslow: warning: " << text << '\n';
    print_quality_table(std::cout, file.mesh, quality);
    std::cout << '\n';
    print_walls(std::cout, nullptr, quality.walls);
    print_inverted_elements(std::cout, file.mesh, quality, inverted_elements_shown);
    if (options_.worst > 0) print_worst_elements(std::cout, quality);
    if (histogram_) print_histograms(std::cout, quality);
  }

  std::string input_, report_;
  QualityOptions options_;
  bool histogram_ = false, quiet_ = false;
};

}  // namespace

std::unique_ptr<Subcommand> make_quality_subcommand(CLI::App& program) {
  return std::make_unique<QualitySubcommand>(program);
}

}  // namespace winslow::app
