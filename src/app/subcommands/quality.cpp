#include <iostream>
#include <nlohmann/json.hpp>

#include "app/job/edit_job.h"
#include "app/options/flags.h"
#include "app/output/report.h"
#include "app/output/tables.h"
#include "app/output/terminal.h"
#include "app/subcommands/subcommand.h"
#include "io/format/mesh_file.h"

namespace winslow::app {
namespace {

constexpr int inverted_elements_shown = 20, folded_edges_shown = 5;

class QualitySubcommand : public Subcommand {
 public:
  explicit QualitySubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand(
            "quality",
            "Print the quality of a mesh and its worst elements; exit status 4 if any element is "
            "inverted")) {
    add_input(app(), input_);
    add_zone_flag(app(), zone_, "every zone is reported");
    FlagGroup group(app());
    group.value_as("--worst", options_.worst, "N [10]", "How many of the worst elements to list")
        ->check(CLI::Range(0, 1000000));
    group.on("--histogram", histogram_, "Print histograms too");
    group.value_as("--bins", options_.histogram_bins, "N [20]", "Bins of a histogram")
        ->check(CLI::Range(1, 1000));
    group.value_as("--threads", options_.threads, "N [0]", "Threads; 0 for all cores")
        ->check(CLI::Range(0, 4096));
    group.value("--report", report_, "FILE.json", "Write the same as JSON");
    add_quiet_flag(app(), quiet_);
  }

  ExitCode run() override {
    check_output(report_);
    if (!report_.empty()) check_distinct({report_, input_});
    Stopwatch total;
    std::vector<io::MeshFile> files = read_zones(input_, zone_);
    RunReport run;
    run.command = "quality";
    run.input = input_;
    const std::vector<std::string> warnings = warnings_of(files);
    run.warnings = warnings;
    std::vector<ZoneRun> zones = share_out(std::move(files), {}, input_);
    run.seconds.load = total.seconds();
    for (ZoneRun& zone : zones) zone.quality = measure_quality(zone.source.mesh, options_);
    run.seconds.solve = total.seconds() - run.seconds.load;
    run.seconds.total = total.seconds();
    for (const ZoneRun& zone : zones) {
      if (!zone.quality.folds.any()) continue;
      const std::string name = zone.name();
      run.warnings.push_back((name.empty() ? "" : name + ": ") +
                             winslow::describe(zone.quality.folds));
    }
    if (!report_.empty()) write_json(report_, describe(zones, run));
    if (!quiet_) print(zones, warnings);
    const bool inverted = std::any_of(zones.begin(), zones.end(),
                                      [](const ZoneRun& z) { return z.quality.inverted > 0; });
    return inverted ? ExitCode::inverted : ExitCode::done;
  }

 private:
  static nlohmann::json describe(const std::vector<ZoneRun>& zones, const RunReport& run) {
    std::vector<ZoneResult> results;
    for (const ZoneRun& z : zones) {
      results.push_back({z.number(), &z.source.mesh, &z.quality, nullptr, nullptr, nullptr,
                         z.source.details->periodic.get()});
    }
    nlohmann::json report = describe_zones(results);
    describe_circumstances(report, run);
    return report;
  }

  void print(const std::vector<ZoneRun>& zones, const std::vector<std::string>& warnings) const {
    print_warnings(warnings);
    for (const ZoneRun& zone : zones) {
      if (&zone != &zones.front()) std::cout << '\n';
      print_zone_heading(std::cout, zone.name());
      const Mesh& mesh = zone.source.mesh;
      print_quality_table(std::cout, mesh, zone.quality);
      if (zone.quality.has_walls()) {
        std::cout << '\n';
        print_walls(std::cout, nullptr, zone.quality.walls);
      }
      print_pairs(std::cout, *zone.source.details->periodic, mesh);
      print_inverted_elements(std::cout, mesh, zone.quality, inverted_elements_shown);
      print_folds(std::cout, zone.quality.folds, folded_edges_shown);
      if (options_.worst > 0) print_worst_elements(std::cout, zone.quality);
      if (histogram_) print_histograms(std::cout, zone.quality);
    }
  }

  std::string input_, report_;
  int zone_ = 0;
  QualityOptions options_;
  bool histogram_ = false, quiet_ = false;
};

}  // namespace

std::unique_ptr<Subcommand> make_quality_subcommand(CLI::App& program) {
  return std::make_unique<QualitySubcommand>(program);
}

}  // namespace winslow::app
