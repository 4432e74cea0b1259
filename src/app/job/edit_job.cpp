#include "app/job/edit_job.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/job/interrupt.h"
#include "app/job/markers.h"
#include "app/job/progress.h"
#include "app/output/layer_table.h"
#include "app/output/quality_table.h"
#include "app/output/report.h"
#include "app/output/wall_table.h"
#include "core/error.h"
#include "core/quality/mesh_change.h"
#include "io/recipe/recipe.h"
#include "io/tables/convergence_csv.h"

namespace winslow::app {
namespace {

constexpr int inverted_elements_shown = 5;
constexpr int cut_columns_shown = 5;

void check_files(const JobFiles& files) {
  if (files.output.empty()) throw UsageError("no file to write to: give one with -o OUT");
  check_mesh_output(files.output);
  for (const std::string& path : {files.report, files.history, files.save_recipe}) {
    check_output(path);
    if (!path.empty()) check_distinct({path, files.input});
  }
  check_distinct({files.output, files.report, files.history, files.save_recipe});
}

void check_options(std::vector<Command> commands) {
  for (Command& command : commands) {
    if (const SmoothOptions* options = smooth_options(command)) validate(*options);
  }
}

int thread_count(std::vector<Command> commands) {
  for (Command& command : commands) {
    if (const SmoothOptions* options = smooth_options(command)) return options->threads;
  }
  return 0;
}

CommandRecord make_record(Command command, SmoothResult result) {
  CommandRecord record{
      std::string(command_name(command)), describe(command), {}, std::move(result)};
  if (const SmoothOptions* options = smooth_options(command)) {
    record.formulation = options->formulation;
  }
  return record;
}

/// Applies the commands one after the other.
MeshState apply(const EditJob& job, MeshState state, RunReport& run) {
  ProgressMonitor monitor(!job.files.quiet && terminal_attached());
  RunOptions options;
  options.monitor = &monitor;
  for (const Command& command : job.commands) {
    monitor.set_label(describe(command));
    CommandResult result = execute(command, state, options);
    InterruptGuard::check();
    run.commands.push_back(make_record(command, std::move(result.smooth)));
    state = std::move(result.state);
  }
  return state;
}

double fraction_reached(const RunReport& run) {
  double fraction = 1;
  for (const CommandRecord& c : run.commands) {
    fraction = std::min(fraction, c.result.fraction_reached);
  }
  return fraction;
}

bool out_of_iterations(const RunReport& run) {
  return std::any_of(run.commands.begin(), run.commands.end(),
                     [](const CommandRecord& c) { return c.result.out_of_iterations; });
}

/// The limit of the quality before which a motion ended; empty: none.
std::string limited_by(const RunReport& run) {
  std::string limit;
  for (const CommandRecord& c : run.commands)
    if (!c.result.limited_by.empty()) limit = c.result.limited_by;
  return limit;
}

bool complete(const RunReport& run) {
  return fraction_reached(run) >= 1 && limited_by(run).empty();
}

ExitCode judge(const RunReport& run, const QualityReport& quality) {
  if (quality.inverted > 0 || !complete(run)) return ExitCode::inverted;
  return all_converged(run.commands) ? ExitCode::done : ExitCode::not_converged;
}

void warn(const JobFiles& files, const std::vector<std::string>& warnings) {
  if (files.quiet) return;
  for (const std::string& text : warnings) std::cerr << "winslow: warning: " << text << '\n';
}

void write_history(const std::string& path, const RunReport& run) {
  std::vector<io::ConvergenceTable> tables;
  int number = 0;
  for (const CommandRecord& c : run.commands) tables.push_back({++number, c.result.history});
  io::write_convergence_csv(path, tables);
}

void write_recipe(const EditJob& job) {
  namespace fs = std::filesystem;
  const fs::path recipe = job.files.save_recipe;
  const fs::path folder = fs::absolute(recipe).parent_path();
  const auto relative = [&](const std::string& path) {
    return fs::proximate(fs::absolute(path), folder).generic_string();
  };
  io::write_recipe(recipe, {relative(job.files.input), relative(job.files.output), job.commands});
}

/// Writes mesh, history and recipe; the report comes last, since it tells how long the rest took.
void save(const EditJob& job, const Mesh& mesh, const io::MeshFile& source,
          const QualityReport& quality, RunReport& run) {
  const bool valid = quality.inverted == 0 || job.files.allow_inverted;
  if (valid && (complete(run) || job.files.accept_partial)) {
    const auto warnings =
        io::write_mesh(job.files.output, mesh, source.details.get(), job.files.encoding);
    warn(job.files, warnings);
    run.warnings.insert(run.warnings.end(), warnings.begin(), warnings.end());
    run.written = true;
  }
  if (!job.files.history.empty()) write_history(job.files.history, run);
  if (!job.files.save_recipe.empty()) write_recipe(job);
}

void print_outcome(const EditJob& job, const MeshState& state, const QualityReport& quality,
                   const RunReport& run) {
  for (const CommandRecord& c : run.commands) {
    std::cout << c.description << ": ";
    if (c.result.outer_iterations == 0) {
      std::cout << "done";
    } else {
      std::cout << (c.result.converged ? "converged" : "NOT converged") << " after "
                << c.result.outer_iterations << " iterations, residual " << c.result.residual;
    }
    if (c.result.linear_solves > 0) std::cout << ", " << c.result.linear_solves << " linear solves";
    if (c.result.increments > 1) std::cout << ", in " << c.result.increments << " steps";
    std::cout << '\n';
  }
  std::cout << '\n';
  print_quality_table(std::cout, state.mesh, quality);
  std::cout << '\n';
  print_walls(std::cout, run.before ? &run.before->walls : nullptr, quality.walls);
  std::cout << '\n';
  if (state.layers) {
    print_layers(std::cout, *state.layers, state.mesh.coordinates, cut_columns_shown);
    std::cout << '\n';
  }
  if (run.written)
    std::cout << "Wrote " << job.files.output << " in ";
  else
    std::cout << "Nothing written to " << job.files.output << " after ";
  std::cout << run.seconds.total << " s\n";
}

/// What a flow solver will not like about the result that is no fault of validity. Heights that
/// were asked for are none.
void warn_of_damage(const EditJob& job, const Mesh& before, const Mesh& after, RunReport& run) {
  if (std::ranges::any_of(job.commands, asks_for_heights)) return;
  const std::string damage = describe_damage(before, after);
  if (damage.empty()) return;
  const std::string text =
      damage + "; --targets that keep the elements' own shapes, such as rest, avoid that";
  warn(job.files, {text});
  run.warnings.push_back(text);
}

std::string why_incomplete(const RunReport& run) {
  if (const std::string limit = limited_by(run); !limit.empty()) return limit + " beyond";
  return out_of_iterations(run) ? "the limit of iterations was reached"
                                : "no valid mesh was found beyond";
}

/// Why the exit code is not 0; said even with --quiet.
void print_verdict(const EditJob& job, const Mesh& mesh, const QualityReport& quality,
                   const RunReport& run, ExitCode code) {
  if (code == ExitCode::inverted && quality.inverted == 0) {
    std::cerr << "winslow: the motion could be followed to " << 100 * fraction_reached(run)
              << " % only: " << why_incomplete(run)
              << (run.written ? "; the mesh there was written"
                              : "; nothing was written (--accept-partial writes the mesh there)")
              << '\n';
  } else if (code == ExitCode::inverted) {
    std::cerr << "winslow: the result has " << quality.inverted << " inverted element"
              << (quality.inverted == 1 ? "" : "s")
              << (run.written ? "" : "; nothing was written (--allow-inverted writes it)") << '\n';
    if (!job.files.quiet) {
      print_inverted_elements(std::cerr, mesh, quality, inverted_elements_shown);
    }
  } else if (code == ExitCode::not_converged) {
    std::cerr << "winslow: not converged within the limit; the mesh is valid and was written\n";
  }
}

}  // namespace

ExitCode run_edit_job(const EditJob& job) {
  check_files(job.files);
  check_options(job.commands);
  const InterruptGuard interrupts;
  Stopwatch total, lap;
  RunReport run{job.name, job.files.input, job.files.output, false, {}, {}, {}, {}};

  io::MeshFile source = io::read_mesh(job.files.input);
  warn(job.files, source.warnings);
  run.warnings = source.warnings;
  check_markers(job.commands, *source.mesh.topology, job.files.input);
  run.seconds.load = lap.lap();
  InterruptGuard::check();

  const MeshState result = apply(job, make_state(source.mesh), run);
  QualityOptions quality_options;
  quality_options.threads = thread_count(job.commands);
  const QualityReport quality = measure_quality(result.mesh, quality_options);
  run.before = measure_quality(source.mesh, quality_options);
  run.seconds.solve = lap.lap();

  const SignalsHeld held;
  InterruptGuard::check();
  warn_of_damage(job, source.mesh, result.mesh, run);
  save(job, result.mesh, source, quality, run);
  run.seconds.save = lap.lap();
  run.seconds.total = total.seconds();
  if (!job.files.report.empty()) {
    nlohmann::json report = describe_run(run, result.mesh, quality);
    if (result.layers) {
      report["layers"] = describe_layers(*result.layers, result.mesh.coordinates);
    }
    write_json(job.files.report, report);
  }
  const ExitCode code = judge(run, quality);
  if (!job.files.quiet) print_outcome(job, result, quality, run);
  print_verdict(job, result.mesh, quality, run, code);
  return code;
}

}  // namespace winslow::app
