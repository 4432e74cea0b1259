#include "app/job/edit_job.h"

#include <iterator>
#include <nlohmann/json.hpp>

#include "app/job/held_motion.h"
#include "app/job/run_messages.h"
#include "core/error.h"
#include "core/strategy/run.h"
#include "core/strategy/surface_shape.h"
#include "io/format/mesh_format.h"
#include "io/recipe/recipe.h"
#include "io/tables/slide_files.h"
#include "io/tables/table_files.h"

namespace winslow::app {
namespace {

/// The files that are read besides the mesh.
std::vector<std::string> other_inputs(const EditJob& job) {
  std::vector<std::string> inputs = job.files.also_read;
  inputs.push_back(job.files.reference_mesh);
  inputs.push_back(job.files.config);
  for (const Command& command : job.commands)
    if (const SmoothOptions* smooth = smooth_options(command))
      inputs.push_back(smooth->slide.reference);
  return inputs;
}

void check_files(const EditJob& job) {
  const JobFiles& files = job.files;
  if (files.output.empty()) throw UsageError("no file to write to: give one with -o OUT");
  check_mesh_output(files.output, files.input);
  const std::vector<std::string> tables{files.report, files.history, files.save_recipe};
  for (const std::string& path : tables) check_output(path);
  check_inputs_kept(tables, {files.input});  // the mesh may be written over itself
  check_inputs_kept(tables, other_inputs(job));
  check_inputs_kept({files.output}, other_inputs(job));
  check_is_file(files.history, "--history");
  check_is_file(files.save_recipe, "--save-recipe");
  check_distinct({files.output, files.report, files.history, files.save_recipe});
}

void check_options(const std::vector<Command>& commands) {
  for (const Command& command : commands) {
    if (const SmoothOptions* options = smooth_options(command)) validate(*options);
  }
}

int thread_count(const std::vector<Command>& commands) {
  for (const Command& command : commands) {
    if (const SmoothOptions* options = smooth_options(command)) return options->threads;
  }
  return 0;
}

/// The bodies that a command turns.
std::vector<MovingBody> turned_bodies(const Command& command) {
  std::vector<MovingBody> turned;
  if (const auto* move = std::get_if<MoveCommand>(&command))
    std::ranges::copy_if(move->bodies, std::back_inserter(turned), [](const MovingBody& body) {
      return body.motion.rotate != 0 && body.motion.pivot;
    });
  return turned;
}

}  // namespace

CommandRecord make_record(const Command& command, SmoothResult result, const Mesh& after) {
  CommandRecord record;
  record.name = command_name(command);
  record.description = describe(command);
  record.result = std::move(result);
  record.turned = turned_bodies(command);
  record.dimension = after.coordinates.dimension();
  record.on_surface = is_surface(*after.topology);
  if (const SmoothOptions* options = smooth_options(command)) {
    record.formulation = formulation_name(options->formulation);
  }
  return record;
}

namespace {

/// Applies one command to a zone.
CommandRecord apply(const ResolvedCommand& resolved, ZoneRun& zone, bool all_or_nothing,
                    ProgressMonitor& monitor) {
  const Command& command = resolved.command();
  const std::string name = zone.name();
  RunOptions options;
  options.monitor = &monitor;
  options.all_or_nothing = all_or_nothing;
  monitor.set_label(printable((name.empty() ? "" : name + ": ") + describe(command)));
  CommandResult result = execute(resolved, zone.result, options);
  InterruptGuard::check();
  CommandRecord record = make_record(command, std::move(result.smooth), result.state.mesh);
  if (!name.empty()) {
    record.description.insert(0, name + ": ");
    record.zone = zone.number();
  }
  zone.result = std::move(result.state);
  return record;
}

/// Gives the bodies of one zone the pivots that were found for all zones together. `own`: the
/// bodies of `whole` that are in the zone, in the same order, with only the zone's markers.
void copy_pivots(std::vector<MovingBody>& own, const std::vector<MovingBody>& whole) {
  auto from = whole.begin();
  for (MovingBody& body : own) {
    from = std::find_if(from, whole.end(), [&](const MovingBody& candidate) {
      return body.markers.empty() ||
             std::ranges::find(candidate.markers, body.markers.front()) != candidate.markers.end();
    });
    body.motion.pivot = from->motion.pivot;
  }
}

void add_reference(const std::string& file, const Mesh& reference, ZoneRun& zone) {
  try {
    zone.result = with_reference(std::move(zone.result), reference);
    zone.source.mesh.topology = zone.result.mesh.topology;
  } catch (const UsageError& error) {
    throw UsageError(file + ": " + error.what());
  }
}

/// Gives each zone its reference mesh: the zone of the same number of that file.
void add_references(const std::string& file, std::vector<ZoneRun>& zones) {
  if (zones.size() == 1) {
    ZoneRun& zone = zones.front();
    return add_reference(file, io::read_mesh(file, {.zone = zone.number()}).mesh, zone);
  }
  const std::vector<io::MeshFile> meshes = io::read_mesh_zones(file);
  std::map<int, const io::MeshFile*> by_number;
  for (const io::MeshFile& mesh : meshes) by_number[mesh.details->zone] = &mesh;
  for (ZoneRun& zone : zones) {
    const auto found = by_number.find(zone.number());
    if (found == by_number.end())
      throw UsageError(file + ": no zone " + std::to_string(zone.number()) + " in the file");
    add_reference(file, found->second->mesh, zone);
  }
}

/// Applies the commands to all zones in order. A body in several zones turns about one common
/// pivot, found at its current position.
void apply(const EditJob& job, std::vector<ZoneRun>& zones, RunReport& run) {
  for (ZoneRun& zone : zones) zone.result = make_state(zone.source.mesh);
  if (!job.files.reference_mesh.empty()) add_references(job.files.reference_mesh, zones);
  ProgressMonitor monitor(!job.files.quiet && terminal_attached());
  std::vector<std::vector<CommandRecord>> records(zones.size());
  for (std::size_t k = 0; k < job.commands.size(); ++k) {
    std::vector<const MeshState*> states;
    for (const ZoneRun& zone : zones) {
      if (zone.commands[k]) states.push_back(&zone.result);
    }
    const Command whole = with_pivot(job.commands[k], states);
    for (std::size_t z = 0; z < zones.size(); ++z) {
      std::optional<Command>& own = zones[z].commands[k];
      if (!own) continue;
      if (auto* move = std::get_if<MoveCommand>(&*own))
        copy_pivots(move->bodies, std::get<MoveCommand>(whole).bodies);
      records[z].push_back(
          apply({*own, zones[z].files[k]}, zones[z], !job.files.accept_partial, monitor));
    }
  }
  for (auto& of_zone : records) {
    std::ranges::move(of_zone, std::back_inserter(run.commands));
  }
}

/// A reader that caches reference surfaces, so that each is read once.
io::ReferenceReader reading_once() {
  using Surfaces = std::map<std::filesystem::path, std::shared_ptr<const ReferenceSurface>>;
  return [known = std::make_shared<Surfaces>()](const std::filesystem::path& file) {
    auto& surface = (*known)[file];
    if (!surface) surface = io::read_reference(file);
    return surface;
  };
}

double fraction_reached(const RunReport& run) {
  double fraction = 1;
  for (const CommandRecord& c : run.commands) {
    fraction = std::min(fraction, c.result.fraction_reached);
  }
  return fraction;
}

/// The quality limit that ended a motion early; empty: none.
std::string limited_by(const RunReport& run) {
  std::string limit;
  for (const CommandRecord& c : run.commands)
    if (!c.result.limited_by.empty()) limit = c.result.limited_by;
  return limit;
}

bool complete(const RunReport& run) {
  return fraction_reached(run) >= 1 && limited_by(run).empty();
}

ExitCode judge(const RunReport& run, const std::vector<ZoneRun>& zones) {
  if (inverted_elements(zones) > 0 || !complete(run)) return ExitCode::inverted;
  const auto held = [](const ZoneRun& zone) { return find_held_motion(zone).has_value(); };
  if (std::ranges::any_of(zones, held)) return ExitCode::held;
  return all_converged(run.commands) ? ExitCode::done : ExitCode::not_converged;
}

/// Adds warnings to the report, and prints them unless the run is quiet.
void warn(const JobFiles& files, const std::vector<std::string>& warnings, RunReport& run) {
  if (!files.quiet) print_warnings(warnings);
  run.warnings.insert(run.warnings.end(), warnings.begin(), warnings.end());
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
  const io::ReadOptions& reading = job.files.reading;
  const io::MeshFormat* of_folder =
      reading.time.empty() ? nullptr : io::format_of_folder(job.files.input);
  // The folder of the time that was read, which may have a mesh of its own later.
  const std::string input =
      of_folder ? of_folder->find_folder(job.files.input, reading.time).parent_path().string()
                : job.files.input;
  io::Recipe written{relative(input), relative(job.files.output), job.commands, reading.zone};
  written.regions = reading.regions;
  if (!job.files.config.empty()) written.config = relative(job.files.config);
  if (!job.files.reference_mesh.empty())
    written.reference_mesh = relative(job.files.reference_mesh);
  io::write_recipe(recipe, written);
}

bool moves_nothing(const RunReport& run) {
  return std::ranges::all_of(run.commands,
                             [](const CommandRecord& c) { return c.result.nothing_moves; });
}

/// Writes mesh, history and recipe; the report comes last, since it holds the times of the other
/// steps.
void save(const EditJob& job, const std::vector<ZoneRun>& zones, RunReport& run) {
  const bool valid = inverted_elements(zones) == 0 || job.files.allow_inverted;
  if (valid && (complete(run) || job.files.accept_partial)) {
    std::vector<io::MeshZone> meshes;
    for (const ZoneRun& zone : zones)
      meshes.push_back({&zone.result.mesh, zone.source.details.get()});
    const bool copied =
        moves_nothing(run) && io::copy_mesh(job.files.input, job.files.output,
                                            zones.front().source.details.get(), job.files.encoding);
    const auto warnings = copied
                              ? std::vector<std::string>()
                              : io::write_mesh_zones(job.files.output, meshes, job.files.encoding);
    warn(job.files, warnings, run);
    run.written = true;
  }
  if (!job.files.history.empty()) write_history(job.files.history, run);
  if (!job.files.save_recipe.empty()) write_recipe(job);
}

/// Reads the mesh, or the zones that the commands change.
std::vector<ZoneRun> load(EditJob& job, RunReport& run) {
  std::vector<io::MeshFile> files = read_zones(job.files.input, job.files.reading);
  if (files.size() > 1 && !io::keeps_zones(job.files.output, *files[0].details)) {
    throw UsageError(job.files.output + ": cannot hold the " + std::to_string(files.size()) +
                     " zones of " + job.files.input + "; choose one with --zone N");
  }
  warn(job.files, warnings_of(files), run);
  for (Command& command : job.commands) expand_groups(command, files);
  std::vector<ZoneRun> zones = share_out(std::move(files), job.commands, job.files.input);
  const std::vector<std::string> defaults = add_file_defaults(zones, job.files.config);
  if (!job.files.quiet) print_remarks(defaults);
  return zones;
}

}  // namespace

void measure(ZoneRun& zone, const QualityOptions& options) {
  const Mesh& before = zone.source.mesh;
  QualityOptions of_source = options, compared = options;
  of_source.normals = reference_normals(zone.result, before.coordinates);
  zone.before = measure_quality(before, of_source);
  compared.before = &before.coordinates;
  compared.normals = reference_normals(zone.result, zone.result.mesh.coordinates);
  zone.quality = measure_quality(zone.result.mesh, compared);
  if (is_surface(*before.topology))
    zone.surface = compare_surfaces(before, zone.result.mesh, options.threads);
}

nlohmann::json make_report(const std::vector<ZoneRun>& zones, const RunReport& run) {
  std::vector<ZoneResult> results;
  for (const ZoneRun& zone : zones) {
    results.push_back({zone.number(), &zone.result.mesh, &zone.quality, &zone.before,
                       zone.result.layers ? &*zone.result.layers : nullptr,
                       zone.surface ? &*zone.surface : nullptr});
    if (zone.source.details) results.back().regions_array = zone.source.details->regions_array;
  }
  return describe_run(run, results);
}

ExitCode run_edit_job(const EditJob& given) {
  EditJob job = given;
  const OutputForData for_data(job.files.report == standard_output);
  check_files(job);
  check_options(job.commands);
  const io::ReferenceReader references = reading_once();
  // Report unreadable surfaces before reading the mesh, which may take long.
  for (const Command& command : job.commands)
    if (const SmoothOptions* smooth = smooth_options(command))
      io::resolve_files(smooth->slide, nullptr, references);
  const InterruptGuard interrupts;
  Stopwatch total, lap;
  RunReport run{job.name, job.files.input, job.files.output, false, {}, {}, {}};

  std::vector<ZoneRun> zones = load(job, run);
  resolve_files(zones, references);
  run.seconds.load = lap.lap();
  InterruptGuard::check();

  QualityOptions quality_options;
  quality_options.threads = thread_count(job.commands);
  apply(job, zones, run);
  for (ZoneRun& zone : zones) {
    measure(zone, quality_options);
  }
  run.seconds.solve = lap.lap();

  const SignalsHeld held;
  InterruptGuard::check();
  for (const ZoneRun& zone : zones) {
    for (const std::string& warning : {damage_warning(zone), fold_warning(zone)})
      if (!warning.empty()) warn(job.files, {warning}, run);
  }
  save(job, zones, run);
  run.seconds.save = lap.lap();
  run.seconds.total = total.seconds();
  if (!job.files.report.empty()) write_json(job.files.report, make_report(zones, run));
  const ExitCode code = judge(run, zones);
  if (!job.files.quiet) print_outcome(job.files, zones, run);
  print_verdict(job.files, zones, run, code);
  return code;
}

}  // namespace winslow::app
