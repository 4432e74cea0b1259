#include "app/job/sweep_job.h"

#include <unistd.h>

#include <iostream>

#include "app/job/edit_job.h"
#include "app/job/held_motion.h"
#include "app/output/quality_csv.h"
#include "core/error.h"
#include "core/quality/mesh_change.h"
#include "io/file/atomic_file.h"
#include "io/format/mesh_format.h"
#include "io/text/numbers.h"

namespace winslow::app {
namespace {

namespace fs = std::filesystem;

/// The shortest number that is read back exactly.
std::string exact(double value) {
  std::string text;
  io::append_number(text, value);
  return text;
}

/// The value of a word in braces.
std::string value_of(const std::string& word, const std::string& pattern,
                     const io::MotionStep& step) {
  const std::vector<std::string> words{"step", "rotate", "translate_x", "translate_y",
                                       "translate_z"};
  if (word == "step") return step.name;
  if (std::ranges::find(words, word) == words.end())
    throw UsageError(pattern + ": found {" + word + "}, expected one of {" +
                     listed(words, [](const std::string& name) { return name; }) + "}" +
                     suggest(word, words));
  if (step.bodies.size() > 1)
    throw UsageError(pattern + ": {" + word + "} is of a single body, and " +
                     std::to_string(step.bodies.size()) + " move in step " + step.name +
                     ": name the files by {step}");
  const RigidMotion& motion = step.bodies.front().motion;
  if (word == "rotate") return exact(motion.rotate);
  return exact(motion.translate[word.back() - 'x']);
}

/// "flap,tab rotate=-30 pivot=0.85,-0.04": the bodies of a step as --body says them.
/// number: the text of a number, exact in files and short on the terminal.
std::string text_of(const std::vector<MovingBody>& bodies, int dimension,
                    std::string (*number)(double)) {
  const auto numbers = [number](const Vec3& vector, int count) {
    std::string text;
    for (int k = 0; k < count; ++k) text += (k > 0 ? "," : "") + number(vector[k]);
    return text;
  };
  std::string text;
  for (const MovingBody& body : bodies) {
    const RigidMotion& motion = body.motion;
    std::string names;
    for (const std::string& name : body.markers) names += (names.empty() ? "" : ",") + name;
    text += (text.empty() ? "" : " --body ") + names + " rotate=" + number(motion.rotate);
    if (motion.rotate != 0) {
      if (motion.pivot) text += " pivot=" + numbers(*motion.pivot, dimension);
      if (motion.axis && dimension == 3) text += " axis=" + numbers(*motion.axis, 3);
    }
    if (motion.translate != Vec3(0, 0, 0))
      text += " translate=" + numbers(motion.translate, dimension);
  }
  return text;
}

std::string csv_number(double value) { return std::isfinite(value) ? exact(value) : ""; }

/// A mesh's quality as fields of a CSV file. With names[k] the k-th field is called.
struct QualityColumns {
  std::vector<std::string> names;
  std::vector<std::string> fields;

  void add(std::string name, double value) {
    names.push_back(std::move(name));
    fields.push_back(csv_number(value));
  }
};

/// Smallest, mean and largest value of every reported metric.
QualityColumns columns_of_metrics(const QualityReport& quality) {
  QualityColumns columns;
  const std::vector<Metric>& metrics = reported_metrics(quality.cell_dimension);
  for (std::size_t m = 0; m < metrics.size(); ++m) {
    const std::string name(metric_name(metrics[m]));
    const Statistics& statistics = quality.metrics[m].statistics;
    columns.add(name + "_min", statistics.min);
    columns.add(name + "_mean", statistics.avg);
    columns.add(name + "_max", statistics.max);
  }
  return columns;
}

/// What is kept of a step for the table of results.
struct Row {
  std::string status = "not run", message, output, begins;
  std::vector<MovingBody> bodies;
  std::optional<QualityReport> quality;
  std::optional<Quantiles> heights;  // first heights over those of the reference mesh
  bool harmed = false;               // by find_damage()'s measures, against the reference mesh
  int linear_solves = 0, iterations = 0;
  double fraction = 0, seconds = 0;
};

/// The smallest sine or scaled Jacobian of what a run can change; NaN if that is nothing.
double smallest_movable(const QualityReport& quality) {
  return quality.of(Metric::normalized_jacobian).movable.min;
}

/// The status of a step whose bodies moved and no other node.
constexpr const char* held_status = "held";

/// What a run needs besides the job.
struct Inputs {
  ZoneRun zone;
  MeshState state;
  QualityReport reference;  ///< quality of the reference mesh
  double smallest = 0;      ///< smallest_movable() of the reference mesh
};

/// Carries out a sweep: writes each mesh as it is solved, and keeps a row for the table.
class SweepRun final : public SeriesMonitor {
 public:
  SweepRun(const SweepJob& job, const std::vector<std::string>& outputs, const Inputs& inputs)
      : job_(job),
        outputs_(outputs),
        inputs_(inputs),
        rows_(job.steps.size()),
        progress_(!job.files.quiet && terminal_attached() && job.jobs == 1) {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      rows_[i].bodies = job.steps[i].bodies;
      rows_[i].output = outputs[i];
    }
  }

  void on_begin(std::size_t step) override {
    if (job_.jobs == 1) progress_.set_label(printable("step " + job_.steps[step].name));
  }
  bool on_iteration(std::size_t, const IterationRecord& record, const Coordinates& x) override {
    return job_.jobs == 1 ? progress_.on_iteration(record, x) : !cancelled();
  }
  bool cancelled() override { return InterruptGuard::requested(); }

  void on_result(const SeriesResult& result) override {
    Row row;
    row.bodies = result.bodies;
    row.status = status_name(result.status);
    row.message = result.message;
    row.seconds = result.seconds;
    if (result.begins) row.begins = job_.steps[*result.begins].name;
    if (result.run) take_run(*result.run, row);
    const bool written = result.run && may_write(result.status) && write(result, row);
    if (!written) row.output.clear();
    const std::lock_guard lock(mutex_);
    if (!job_.files.quiet) print(result, row);
    rows_[result.step] = std::move(row);
  }

  /// Writes the table of results.
  void write_results() const {
    if (job_.results.empty()) return;
    io::write_atomically(job_.results, [&](std::ostream& out) { write_rows(out); });
  }

  const std::vector<Row>& rows() const { return rows_; }
  int dimension() const { return inputs_.state.mesh.coordinates.dimension(); }

 private:
  QualityOptions quality_options() const {
    QualityOptions options;
    options.threads = job_.jobs == 1 ? job_.smooth.threads : 1;
    options.worst = 0;
    return options;
  }

  void take_run(const CommandResult& run, Row& row) const {
    row.linear_solves = run.smooth.linear_solves;
    row.iterations = run.smooth.outer_iterations;
    row.fraction = run.smooth.fraction_reached;
    row.quality = measure_quality(run.state.mesh, quality_options());
    row.harmed = smallest_movable(*row.quality) < least_sine_kept * inputs_.smallest ||
                 (run.smooth.face_angles && run.smooth.face_angles->beyond > 0);
    if (row.status == status_name(SeriesStatus::done)) find_what_holds(run.state.mesh, row);
    if (const auto change =
            compare_first_heights(inputs_.reference.walls.walls, row.quality->walls.walls);
        change && change->ratio.count > 0) {
      row.heights = change->ratio;
      row.harmed |= spoils_walls(*change);
    }
  }

  void find_what_holds(const Mesh& after, Row& row) const {
    if (!job_.how.smooth_after) return;
    std::vector<std::string> moving;
    for (const MovingBody& body : row.bodies)
      moving.insert(moving.end(), body.markers.begin(), body.markers.end());
    const auto held = find_held_motion(inputs_.state.mesh, after, moving);
    if (!held) return;
    row.status = held_status;
    row.message = describe(*held, moving);
  }

  bool may_write(SeriesStatus status) const {
    if (status == SeriesStatus::inverted) return job_.files.allow_inverted;
    if (status == SeriesStatus::incomplete) return job_.files.accept_partial;
    return status != SeriesStatus::failed;
  }

  bool write(const SeriesResult& result, Row& row) const {
    row.output = outputs_[result.step];
    const auto& details = inputs_.zone.source.details;
    const SignalsHeld held;
    if (const fs::path folder = fs::path(row.output).parent_path(); !folder.empty())
      fs::create_directories(folder);
    if (result.run->smooth.nothing_moves &&
        io::copy_mesh(job_.files.input, row.output, details.get(), job_.files.encoding))
      return true;
    const io::MeshZone zone{&result.run->state.mesh, details.get()};
    io::write_mesh_zones(row.output, std::span(&zone, 1), job_.files.encoding);
    return true;
  }

  void print(const SeriesResult& result, const Row& row) {
    progress_.clear();
    std::cout << printable("step " + job_.steps[result.step].name + ", " +
                           text_of(row.bodies, dimension(), number_text) + ": " + row.status);
    if (result.run && result.run->smooth.nothing_moves) std::cout << ", nothing moves";
    if (row.linear_solves > 0)
      std::cout << ", " << row.linear_solves
                << (row.linear_solves == 1 ? " linear solve" : " linear solves");
    if (!row.begins.empty()) std::cout << printable(" from step " + row.begins);
    if (row.quality)
      std::cout << (dimension() == 3 ? ", smallest scaled Jacobian " : ", smallest sine ")
                << formatted("%.3f", row.quality->of(Metric::normalized_jacobian).statistics.min);
    if (row.heights)
      std::cout << formatted(", first heights x %.3g to %.3g", row.heights->low, row.heights->high);
    if (!row.output.empty()) std::cout << ", wrote " << printable(row.output);
    std::cout << std::endl;
  }

  /// One column of each motion where all steps move the same single body, else one for each body.
  std::vector<std::vector<std::string>> bodies_of_columns() const {
    std::vector<std::vector<std::string>> bodies;
    for (const Row& row : rows_)
      for (const MovingBody& body : row.bodies)
        if (std::ranges::find(bodies, body.markers) == bodies.end()) bodies.push_back(body.markers);
    return bodies;
  }

  void write_rows(std::ostream& out) const {
    const auto bodies = bodies_of_columns();
    const QualityColumns none = columns_of_metrics(inputs_.reference);
    out << "step,status,message,output,motion";
    for (const auto& markers : bodies) {
      std::string before;
      if (bodies.size() > 1)
        before = listed(markers, [](const std::string& name) { return name; }) + ' ';
      out << ',' << csv_field(before + "rotate");
      for (int k = 0; k < dimension(); ++k)
        out << ',' << csv_field(before + "translate_" + "xyz"[k]);
    }
    out << ",fraction,inverted";
    for (const std::string& name : none.names) out << ',' << name;
    out << ",first_height_ratio_p05,first_height_ratio_median,first_height_ratio_p95,linear_solves,"
           "iterations,seconds,begins_at\n";
    for (std::size_t i = 0; i < rows_.size(); ++i) write_row(out, i, bodies, none.names.size());
  }

  void write_row(std::ostream& out, std::size_t step,
                 const std::vector<std::vector<std::string>>& bodies, std::size_t metrics) const {
    const Row& row = rows_[step];
    const bool run = row.status != "not run";
    out << csv_field(job_.steps[step].name) << ',' << row.status << ',' << csv_field(row.message)
        << ',' << csv_field(run ? row.output : "") << ','
        << csv_field(text_of(row.bodies, dimension(), exact));
    for (const auto& markers : bodies) {
      const auto body = std::ranges::find(row.bodies, markers, &MovingBody::markers);
      const RigidMotion motion = body == row.bodies.end() ? RigidMotion() : body->motion;
      out << ',' << csv_number(motion.rotate);
      for (int k = 0; k < dimension(); ++k) out << ',' << csv_number(motion.translate[k]);
    }
    const std::string none(metrics + 1, ',');
    if (row.quality) {
      out << ',' << csv_number(row.fraction) << ',' << row.quality->inverted;
      for (const std::string& field : columns_of_metrics(*row.quality).fields) out << ',' << field;
    } else {
      out << ',' << none;
    }
    if (row.heights)
      out << ',' << csv_number(row.heights->low) << ',' << csv_number(row.heights->median) << ','
          << csv_number(row.heights->high);
    else
      out << ",,,";
    if (run)
      out << ',' << row.linear_solves << ',' << row.iterations << ',' << csv_number(row.seconds);
    else
      out << ",,,";
    out << ',' << csv_field(row.begins) << '\n';
  }

  const SweepJob& job_;
  const std::vector<std::string>& outputs_;
  const Inputs& inputs_;
  std::mutex mutex_;  // guards all below
  std::vector<Row> rows_;
  ProgressMonitor progress_;
};

fs::path whole(const std::string& path) {
  std::error_code pipe;  // set for a pipe, whose path cannot be resolved
  const fs::path resolved = fs::weakly_canonical(fs::absolute(path), pipe);
  return pipe ? fs::absolute(path) : resolved;
}

/// The files of all steps. Throws UsageError for two of one name, and for one that is read.
std::vector<std::string> names_of_outputs(const SweepJob& job) {
  if (job.files.output.empty())
    throw UsageError("no files to write to: give a name with -o, such as -o 'out/s_{step}.su2'");
  std::map<fs::path, std::size_t> seen;
  std::vector<std::string> outputs;
  for (std::size_t i = 0; i < job.steps.size(); ++i) {
    outputs.push_back(output_name(job.files.output, job.steps[i]));
    const auto [other, is_new] = seen.try_emplace(whole(outputs.back()), i);
    if (!is_new)
      throw UsageError("steps " + job.steps[other->second].name + " and " + job.steps[i].name +
                       " would both be written to " + outputs.back() +
                       ": expected a name with {step}, {rotate} or {translate_x} in it that is "
                       "another one for each step");
  }
  for (const std::string& read :
       {job.files.input, job.files.reference_mesh, job.table, job.smooth.slide.reference}) {
    if (read.empty()) continue;
    if (const auto found = seen.find(whole(read)); found != seen.end())
      throw UsageError("step " + job.steps[found->second].name + " would be written over " + read +
                       ", which is read: choose another name with -o");
    if (!job.results.empty() && whole(job.results) == whole(read))
      throw UsageError("--results would be written over " + read +
                       ", which is read: choose another name");
  }
  if (!job.results.empty() && seen.contains(whole(job.results)))
    throw UsageError(job.results + " would be written twice");
  return outputs;
}

/// Throws UsageError for an extension that no format has.
void check_formats(const SweepJob& job, const std::vector<std::string>& outputs) {
  for (const std::string& output : outputs) {
    const io::MeshFormat* format =
        io::format_of_output(output, io::format_of_folder(job.files.input));
    if (!format)
      throw UsageError(output + ": unknown extension, expected one of " +
                       io::writable_extensions());
    if (!format->missing.empty()) throw UsageError(output + ": " + std::string(format->missing));
  }
}

/// Checks that the folders of the outputs can be written to, or made. They are made with the first
/// file.
void check_folders(const SweepJob& job, const std::vector<std::string>& outputs) {
  for (const std::string& output : outputs) {
    fs::path folder = fs::absolute(output).parent_path();
    std::error_code error;
    if (fs::is_directory(folder, error)) {
      check_mesh_output(output, job.files.input);
      continue;
    }
    while (!fs::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
    if (!fs::is_directory(folder, error) || access(folder.c_str(), W_OK | X_OK) != 0)
      throw OutputError(output + ": its folder cannot be made in " + folder.string());
  }
}

/// All bodies of all steps as one command, to find out which zone of the file they are in.
MoveCommand all_bodies(const SweepJob& job) {
  MoveCommand command;
  command.bodies.clear();
  command.how = job.how;
  command.smooth = job.smooth;
  std::vector<std::string> seen;
  for (const io::MotionStep& step : job.steps)
    for (const MovingBody& body : step.bodies)
      for (const std::string& name : body.markers) {
        if (std::ranges::find(seen, name) != seen.end()) continue;
        seen.push_back(name);
        command.bodies.push_back({{name}, body.motion});
      }
  return command;
}

Inputs load(SweepJob& job) {
  std::vector<io::MeshFile> files = read_zones(job.files.input, job.files.reading);
  if (!job.files.quiet) print_warnings(warnings_of(files));
  for (io::MotionStep& step : job.steps) {
    MoveCommand move;
    move.bodies = step.bodies;
    Command command = move;
    expand_groups(command, files);
    step.bodies = std::get<MoveCommand>(command).bodies;
  }
  Command whole = all_bodies(job);
  expand_groups(whole, files);
  std::vector<ZoneRun> zones = share_out(std::move(files), {whole}, job.files.input);
  if (zones.size() > 1)
    throw UsageError("the markers that move are in several zones of " + job.files.input +
                     ", and a sweep is of one: choose it with --zone N");
  const std::vector<std::string> defaults = add_file_defaults(zones, job.files.config);
  if (!job.files.quiet) print_remarks(defaults);
  resolve_files(zones, io::read_reference);
  Inputs inputs{std::move(zones.front()), {}, {}};
  const Mesh& mesh = inputs.zone.source.mesh;
  inputs.state = make_state(mesh);
  if (!job.files.reference_mesh.empty()) {
    const io::MeshFile reference =
        io::read_mesh(job.files.reference_mesh, {.zone = inputs.zone.number()});
    try {
      inputs.state = with_reference(std::move(inputs.state), reference.mesh);
      inputs.zone.source.mesh.topology = inputs.state.mesh.topology;
    } catch (const UsageError& error) {
      throw UsageError(job.files.reference_mesh + ": " + error.what());
    }
  }
  const std::vector<Command> commands = holding_layers(job.held, job.smooth, SmoothCommand{});
  if (commands.size() > 1) {
    check_markers({commands.front()}, *mesh.topology, job.files.input);
    inputs.state = execute(commands.front(), inputs.state).state;
  }
  QualityOptions options;
  options.threads = job.smooth.threads;
  options.worst = 0;
  const Mesh reference{mesh.topology, *reference_of(inputs.state)};
  inputs.reference = measure_quality(reference, options);
  inputs.smallest = smallest_movable(inputs.reference);
  return inputs;
}

Series series_of(const SweepJob& job, const Inputs& inputs) {
  Series series;
  for (const io::MotionStep& step : job.steps) series.steps.push_back(step.bodies);
  series.how = job.how;
  series.smooth = *smooth_options(*inputs.zone.commands.front());
  series.files = inputs.zone.files.front();
  series.accept_partial = job.files.accept_partial;
  series.jobs = job.jobs;
  return series;
}

/// Warns of steps whose meshes are valid, but may hurt a flow solver.
void warn_of_damage(const SweepJob& job, const std::vector<Row>& rows, int dimension) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].harmed && rows[i].quality->inverted == 0) names.push_back(job.steps[i].name);
  if (names.empty()) return;
  constexpr std::size_t most = 10;
  const std::size_t others = names.size() > most ? names.size() - most : 0;
  names.resize(names.size() - others);
  std::string text = names.size() == 1 ? "step " : "steps ";
  text += listed(names, [](const std::string& name) { return name; });
  if (others > 0) text += " and " + std::to_string(others) + " more";
  text += dimension == 3 ? ": the smallest scaled Jacobian fell" : ": the smallest sine fell";
  text +=
      " by more than 10 %, or first heights changed by more than 5 % at more than 5 % of the wall "
      "nodes or by more than 20 % at one";
  std::cerr << "winslow: warning: " << printable(text) << '\n';
}

/// Says which steps were not reached, and returns the exit status.
ExitCode judge(const SweepJob& job, const std::vector<Row>& rows) {
  ExitCode code = ExitCode::done;
  std::size_t done = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Row& row = rows[i];
    if (row.status == status_name(SeriesStatus::done)) {
      ++done;
      continue;
    }
    std::cerr << printable("winslow: step " + job.steps[i].name + " is " + row.status + ": " +
                           row.message +
                           (row.output.empty() ? "; not written" : "; written to " + row.output))
              << '\n';
    if (row.status == held_status)
      code = code == ExitCode::inverted ? code : ExitCode::held;
    else if (row.status != status_name(SeriesStatus::not_converged))
      code = ExitCode::inverted;
    else if (code == ExitCode::done)
      code = ExitCode::not_converged;
  }
  const bool none = std::ranges::all_of(
      rows, [](const Row& row) { return row.status == status_name(SeriesStatus::failed); });
  if (none) code = ExitCode::usage;  // the options suit no step
  if (code != ExitCode::done)
    std::cerr << "winslow: " << done << " of " << rows.size() << " steps are done\n";
  return code;
}

}  // namespace

std::string output_name(const std::string& pattern, const io::MotionStep& step) {
  std::string name;
  for (std::size_t i = 0; i < pattern.size();) {
    const std::size_t open = std::min(pattern.find('{', i), pattern.size());
    name += pattern.substr(i, open - i);
    if (open == pattern.size()) break;
    const std::size_t close = pattern.find('}', open);
    if (close == std::string::npos)
      throw UsageError(pattern + ": found { without }, expected {step}, {rotate}, ...");
    const std::string value = value_of(pattern.substr(open + 1, close - open - 1), pattern, step);
    if (value.find_first_of("/\\") != std::string::npos)
      throw UsageError("the name of step " + value +
                       " has a slash, so it cannot be part of the name of a file");
    name += value;
    i = close + 1;
  }
  return name;
}

ExitCode run_sweep_job(const SweepJob& given) {
  SweepJob job = given;
  validate(job.smooth);
  const std::vector<std::string> outputs = names_of_outputs(job);
  check_formats(job, outputs);
  check_folders(job, outputs);
  check_output(job.results);
  const InterruptGuard interrupts;
  Stopwatch total;
  const Inputs inputs = load(job);
  InterruptGuard::check();
  const Series series = series_of(job, inputs);
  check_series(series, inputs.state);
  SweepRun run(job, outputs, inputs);
  bool interrupted = false;
  try {
    run_series(series, inputs.state, run);
  } catch (const Cancelled&) {
    interrupted = true;
  }
  const SignalsHeld held;
  run.write_results();
  if (interrupted) {
    const auto written = std::ranges::count_if(
        run.rows(), [](const Row& row) { return row.status != "not run" && !row.output.empty(); });
    std::cerr << "winslow: interrupted; " << written << " of " << run.rows().size()
              << " steps were written\n";
    return ExitCode::interrupted;
  }
  if (!job.files.quiet) {
    if (!job.results.empty()) std::cout << "Wrote " << printable(job.results) << '\n';
    std::cout << run.rows().size() << " steps in " << total.seconds() << " s\n";
    warn_of_damage(job, run.rows(), run.dimension());
  }
  return judge(job, run.rows());
}

}  // namespace winslow::app
