#include <iostream>
#include <nlohmann/json.hpp>

#include "app/job/edit_job.h"
#include "app/options/flags.h"
#include "app/output/openfoam_section.h"
#include "app/output/quality_csv.h"
#include "app/output/report.h"
#include "app/output/tables.h"
#include "app/output/terminal.h"
#include "app/subcommands/subcommand.h"
#include "core/error.h"
#include "io/format/mesh_file.h"

namespace winslow::app {
namespace {

constexpr int inverted_elements_shown = 20, folded_edges_shown = 5;

/// A mesh file that was read and measured.
struct MeasuredFile {
  std::string input;
  std::vector<ZoneRun> zones;
  std::vector<std::string> warnings;  ///< of the reader

  /// True if a zone is no sound mesh and is only shown.
  bool defective() const {
    return std::ranges::any_of(zones, [](const ZoneRun& zone) { return zone.source.defective; });
  }
  Index inverted() const {
    Index sum = 0;
    for (const ZoneRun& zone : zones) sum += zone.quality.inverted;
    return sum;
  }
};

nlohmann::json describe(const MeasuredFile& file) {
  std::vector<ZoneResult> results;
  for (const ZoneRun& z : file.zones) {
    results.push_back({z.number(), &z.source.mesh, &z.quality, nullptr, nullptr, nullptr,
                       z.source.details->periodic.get(), z.source.details->regions_array,
                       z.openfoam ? &*z.openfoam : nullptr});
  }
  return describe_zones(results);
}

/// The warnings of a report: those of the reader, and folds.
std::vector<std::string> reported_warnings(const MeasuredFile& file) {
  std::vector<std::string> warnings = file.warnings;
  for (const ZoneRun& zone : file.zones) {
    if (!zone.quality.folds.any()) continue;
    const std::string name = zone.name();
    warnings.push_back((name.empty() ? "" : name + ": ") + winslow::describe(zone.quality.folds));
  }
  return warnings;
}

/// The warnings with the name of their file, unless they begin with it.
std::vector<std::string> with_name(const MeasuredFile& file, std::vector<std::string> warnings) {
  for (std::string& warning : warnings)
    if (!warning.starts_with(file.input)) warning.insert(0, file.input + ": ");
  return warnings;
}

/// A table with a line for each mesh, for many of them.
class MeshList {
 public:
  explicit MeshList(const std::vector<std::string>& inputs) {
    constexpr std::size_t widest = 60;
    for (const std::string& input : inputs) width_ = std::max(width_, input.size());
    width_ = std::min(width_, widest);
  }

  void print(const MeasuredFile& file) {
    if (!std::exchange(begun_, true)) print_heading();
    for (const ZoneRun& zone : file.zones) {
      const std::string zone_name = zone.name();
      const Topology& topology = *zone.source.mesh.topology;
      std::cout << padded(printable(file.input) + (zone_name.empty() ? "" : ", " + zone_name))
                << formatted("%10d%10d%10d", static_cast<int>(topology.node_count()),
                             static_cast<int>(topology.element_count()),
                             static_cast<int>(zone.quality.inverted));
      for (const Metric metric : shown) {
        const Statistics& of = zone.quality.of(metric).statistics;
        std::cout << formatted("%*.4g", column(metric),
                               metric_info(metric).field.larger_is_better ? of.min : of.max);
      }
      std::cout << '\n';
    }
  }

 private:
  // Plane and volume meshes have these metrics.
  static constexpr std::array shown{Metric::normalized_jacobian, Metric::aspect_ratio,
                                    Metric::condition_number};

  static int column(Metric metric) { return static_cast<int>(metric_label(metric).size()) + 2; }
  std::string padded(std::string text) const {
    if (text.size() < width_) text.resize(width_, ' ');
    return text;
  }
  void print_heading() const {
    std::cout << padded({}) << formatted("%10s%10s%10s", "nodes", "elements", "inverted");
    for (const Metric metric : shown)
      std::cout << formatted("%*s", column(metric), std::string(metric_label(metric)).c_str());
    std::cout << '\n' << padded({}) << std::string(30, ' ');
    for (const Metric metric : shown)
      std::cout << formatted("%*s", column(metric),
                             metric_info(metric).field.larger_is_better ? "minimum" : "maximum");
    std::cout << '\n';
  }

  std::size_t width_ = 0;
  bool begun_ = false;
};

class QualitySubcommand : public Subcommand {
 public:
  explicit QualitySubcommand(CLI::App& program)
      : Subcommand(program.add_subcommand(
            "quality",
            "Print the quality of meshes and their worst elements; exit status 4 if any element is "
            "inverted, 3 if a file is no sound mesh")) {
    add_inputs(app(), inputs_);
    reading_.defects = io::Defects::show;
    add_reading_flags(app(), reading_, "every zone is reported");
    FlagGroup group(app());
    worst_flag_ = group
                      .value_as("--worst", options_.worst, "N [10]",
                                "How many of the worst elements to list; of several meshes: for "
                                "each of them, in place of one line for each")
                      ->check(CLI::Range(0, 1000000));
    group.on("--histogram", histogram_, "Print histograms too");
    group.value_as("--bins", options_.histogram_bins, "N [20]", "Bins of a histogram")
        ->check(CLI::Range(1, 1000));
    group
        .value_as("--threads", options_.threads, "N [0]", "Threads; 0: all cores, or one under MPI")
        ->check(CLI::Range(0, 4096));
    group.value("--report", report_, "FILE.json",
                "Write the same as JSON; -: to the standard output, and what else is said to the "
                "standard error");
    group.value("--csv", csv_, "FILE.csv",
                "Write a table with a row for each mesh, and each zone: every metric with its "
                "worst element; -: to the standard output");
    add_quiet_flag(app(), quiet_);
  }

  ExitCode run() override {
    check_outputs();
    const OutputForData for_data(report_ == standard_output || csv_ == standard_output);
    const bool several = inputs_.size() > 1;
    const Stopwatch total;
    RunReport run;
    run.command = "quality";
    MeshList list(inputs_);
    std::size_t read = 0, inverted = 0, defective = 0;
    for (const std::string& input : inputs_) {
      std::optional<MeasuredFile> file;
      try {
        file = measure(input, run.seconds);
      } catch (const Error& error) {
        if (!several) throw;
        note_unread(input, error.what());
        continue;
      }
      ++read;
      if (file->inverted() > 0) ++inverted;
      if (file->defective()) ++defective;
      add(*file, run);
      if (quiet_) continue;
      print_warnings(several ? with_name(*file, file->warnings) : file->warnings);
      if (several && !blocks())
        list.print(*file);
      else
        print(*file);
    }
    run.seconds.total = total.seconds();
    if (read > 0) save(run);
    if (several && !quiet_) print_end(read, inverted);
    if (read < inputs_.size() || defective > 0) return ExitCode::input;
    return inverted > 0 ? ExitCode::inverted : ExitCode::done;
  }

 private:
  void check_outputs() const {
    check_output(report_);
    check_output(csv_);
    check_inputs_kept({report_, csv_}, inputs_);
    check_distinct({report_, csv_});
  }

  /// Several meshes are printed as one is.
  bool blocks() const { return histogram_ || worst_flag_->count() > 0; }
  /// Whether more is shown than the table of several meshes or the rows of a CSV file.
  bool shows_all() const {
    return !report_.empty() || (!quiet_ && (inputs_.size() == 1 || blocks()));
  }

  MeasuredFile measure(const std::string& input, Timings& seconds) const {
    Stopwatch lap;
    MeasuredFile file{input, {}, {}};
    std::vector<io::MeshFile> meshes = read_zones(input, reading_);
    file.warnings = warnings_of(meshes);
    file.zones = share_out(std::move(meshes), {}, input);
    seconds.load += lap.lap();
    QualityOptions options = options_;
    if (!csv_.empty()) options.worst = std::max(options.worst, 1);
    for (ZoneRun& zone : file.zones) {
      const Mesh& mesh = zone.source.mesh;
      zone.quality = measure_quality(mesh, options);
      if (mesh.topology->kind() == MeshKind::volume && shows_all())
        zone.openfoam = openfoam_measures(mesh, options.threads);
    }
    seconds.solve += lap.lap();
    return file;
  }

  void note_unread(const std::string& input, const std::string& error) {
    const std::string text = error.starts_with(input) ? error : input + ": " + error;
    std::cout.flush();
    std::cerr << "winslow: " << printable(text) << '\n';
    unread_.push_back({{"input", input}, {"error", text}});
  }

  /// Adds a mesh to the table and to the report.
  void add(MeasuredFile& file, RunReport& run) {
    for (ZoneRun& zone : file.zones) {
      std::vector<std::string> row{file.input,
                                   zone.number() > 0 ? std::to_string(zone.number()) : ""};
      std::ranges::move(quality_values(zone.source.mesh, zone.quality), std::back_inserter(row));
      rows_ += csv_line(row);
      if (options_.worst > 0) continue;
      for (QualityReport::PerMetric& metric : zone.quality.metrics) metric.worst.clear();
      for (auto& worst : zone.quality.worst_at_walls) worst.clear();
    }
    if (report_.empty()) return;
    const std::vector<std::string> warnings = reported_warnings(file);
    meshes_.push_back(describe(file));
    if (inputs_.size() == 1) {
      run.warnings = warnings;
      return;
    }
    meshes_.back()["input"] = file.input;
    meshes_.back()["warnings"] = warnings;
    std::ranges::move(with_name(file, warnings), std::back_inserter(run.warnings));
  }

  void save(RunReport& run) const {
    if (!report_.empty()) write_json(report_, whole_report(run));
    if (csv_.empty()) return;
    std::vector<std::string> columns{"file", "zone"};
    std::ranges::move(quality_columns(), std::back_inserter(columns));
    write_text(csv_, csv_line(columns) + rows_);
  }

  /// One mesh: its description. Several: the sums, "meshes" with the description of each, and
  /// "unread".
  nlohmann::json whole_report(RunReport& run) const {
    if (inputs_.size() == 1) {
      nlohmann::json report = meshes_.front();
      run.input = inputs_.front();
      describe_circumstances(report, run);
      return report;
    }
    nlohmann::json report{{"meshes", meshes_}, {"unread", unread_}};
    for (const char* key : {"nodes", "elements", "inverted"}) {
      std::int64_t sum = 0;
      for (const nlohmann::json& mesh : meshes_) sum += mesh[key].get<std::int64_t>();
      report[key] = sum;
    }
    describe_circumstances(report, run);
    report["input"] = inputs_;
    return report;
  }

  /// Prints all of a mesh; of several, first the name of its file.
  void print(const MeasuredFile& file) {
    if (inputs_.size() > 1)
      std::cout << (std::exchange(printed_, true) ? "\n" : "") << printable(file.input) << '\n';
    for (const ZoneRun& zone : file.zones) {
      if (&zone != &file.zones.front()) std::cout << '\n';
      print_zone_heading(std::cout, zone.name());
      const Mesh& mesh = zone.source.mesh;
      print_quality_table(std::cout, mesh, zone.quality);
      print_regions(std::cout, *mesh.topology, zone.source.details->regions_array);
      if (zone.quality.has_walls()) {
        std::cout << '\n';
        print_walls(std::cout, nullptr, zone.quality.walls);
      }
      if (zone.openfoam) {
        std::cout << '\n';
        print_openfoam_measures(std::cout, *zone.openfoam);
      }
      print_pairs(std::cout, *zone.source.details->periodic, zone.source.details->roles.pairs_move,
                  mesh);
      print_inverted_elements(std::cout, mesh, zone.quality, inverted_elements_shown);
      print_folds(std::cout, zone.quality.folds, folded_edges_shown);
      if (options_.worst > 0) print_worst_elements(std::cout, zone.quality);
      if (histogram_) print_histograms(std::cout, zone.quality);
    }
  }

  /// How many meshes there were.
  void print_end(std::size_t read, std::size_t inverted) const {
    std::cout << '\n' << inputs_.size() << " meshes";
    if (read < inputs_.size()) std::cout << ", " << inputs_.size() - read << " could not be read";
    if (inverted > 0) std::cout << ", " << inverted << " with inverted elements";
    std::cout << '\n';
  }

  std::vector<std::string> inputs_;
  std::string report_, csv_;
  io::ReadOptions reading_;
  QualityOptions options_;
  CLI::Option* worst_flag_ = nullptr;
  bool histogram_ = false, quiet_ = false;

  std::string rows_;  // of the table
  nlohmann::json meshes_ = nlohmann::json::array(), unread_ = nlohmann::json::array();
  bool printed_ = false;
};

}  // namespace

std::unique_ptr<Subcommand> make_quality_subcommand(CLI::App& program) {
  return std::make_unique<QualitySubcommand>(program);
}

}  // namespace winslow::app
