#include "app/job/edit_job.h"

#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/output/report.h"
#include "app/output/tables.h"
#include "app/output/terminal.h"
#include "core/error.h"
#include "core/mesh/coordinates.h"
#include "core/quality/mesh_change.h"
#include "core/strategy/run.h"
#include "core/strategy/sliding.h"
#include "core/strategy/surface_shape.h"
#include "io/recipe/recipe.h"
#include "io/tables/slide_files.h"
#include "io/tables/table_files.h"

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

CommandRecord make_record(const Command& command, SmoothResult result) {
  CommandRecord record;
  record.name = command_name(command);
  record.description = describe(command);
  record.result = std::move(result);
  record.turned = turned_bodies(command);
  if (const SmoothOptions* options = smooth_options(command)) {
    record.formulation = formulation_name(options->formulation);
  }
  return record;
}

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
  CommandRecord record = make_record(command, std::move(result.smooth));
  record.dimension = result.state.mesh.coordinates.dimension();
  record.on_surface = is_surface(*result.state.mesh.topology);
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

/// Gives a zone its reference mesh: the zone of the same number of that file.
void add_reference(const JobFiles& files, ZoneRun& zone) {
  const io::MeshFile reference = io::read_mesh(files.reference_mesh, {.zone = zone.number()});
  try {
    zone.result = with_reference(std::move(zone.result), reference.mesh);
  } catch (const UsageError& error) {
    throw UsageError(files.reference_mesh + ": " + error.what());
  }
}

/// Applies the commands to all zones in order. A body in several zones turns about one common
/// pivot, found at its current position.
void apply(const EditJob& job, std::vector<ZoneRun>& zones, RunReport& run) {
  for (ZoneRun& zone : zones) {
    zone.result = make_state(zone.source.mesh);
    if (!job.files.reference_mesh.empty()) add_reference(job.files, zone);
  }
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

Index inverted_elements(const std::vector<ZoneRun>& zones) {
  Index sum = 0;
  for (const ZoneRun& zone : zones) sum += zone.quality.inverted;
  return sum;
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
  return all_converged(run.commands) ? ExitCode::done : ExitCode::not_converged;
}

void warn(const JobFiles& files, const std::vector<std::string>& warnings) {
  if (!files.quiet) print_warnings(warnings);
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
  io::Recipe written{relative(job.files.input), relative(job.files.output), job.commands,
                     job.files.zone};
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
    warn(job.files, warnings);
    run.warnings.insert(run.warnings.end(), warnings.begin(), warnings.end());
    run.written = true;
  }
  if (!job.files.history.empty()) write_history(job.files.history, run);
  if (!job.files.save_recipe.empty()) write_recipe(job);
}

/// Adds what slides because a body stands on it: ", sym and the edge between sym and symy give way
/// to wall (--fixed NAME holds one)".
void print_footholds(const MovingBoundary& boundary) {
  std::vector<std::string> names, bodies;
  const auto add = [](std::vector<std::string>& list, const std::string& name) {
    if (!name.empty() && std::ranges::find(list, name) == list.end()) list.push_back(name);
  };
  for (const Foothold& foothold : boundary.footholds) {
    if (!foothold.goes_on) continue;
    add(names, foothold.name());
    add(bodies, foothold.body);
  }
  if (names.empty()) return;
  const auto listed = [](const std::vector<std::string>& list) {
    std::string text;
    for (std::size_t k = 0; k < list.size(); ++k)
      text += (k == 0 ? "" : k + 1 < list.size() ? ", " : " and ") + list[k];
    return printable(text);
  };
  std::cout << ", " << listed(names) << (names.size() == 1 ? " gives" : " give") << " way to "
            << (bodies.empty() ? "what moves" : listed(bodies)) << " (--fixed NAME holds "
            << (names.size() == 1 ? "it)" : "one)");
}

void print_pivots(const CommandRecord& record) {
  for (const MovingBody& body : record.turned) {
    const GivenVector& pivot = *body.motion.pivot;
    std::cout << ", ";
    if (record.turned.size() > 1) std::cout << printable(body.markers.front()) << ' ';
    std::cout << "turned about " << place_text(pivot, pivot.numbers(record.dimension));
  }
}

/// Whether a run with `auto` targets found nothing to do.
bool has_target_shapes(const SmoothResult& result) {
  return result.outer_iterations == 0 && result.converged && result.fraction_reached == 1 &&
         result.stretched;
}

void print_commands(const RunReport& run) {
  for (const CommandRecord& c : run.commands) {
    std::cout << printable(c.description) << ": ";
    if (c.result.nothing_moves) {
      std::cout << "nothing moves, the mesh stays as it is\n";
      continue;
    }
    if (c.result.outer_iterations == 0) {
      std::cout << (c.result.fraction_reached < 1 ? "not begun" : "done");
      if (has_target_shapes(c.result))
        std::cout << ", the elements have the shapes of their targets (--targets element makes all "
                     "of them regular)";
    } else {
      std::cout << (c.result.converged ? "converged" : "NOT converged") << " after "
                << c.result.outer_iterations << " iterations, residual " << c.result.residual;
    }
    if (c.result.linear_solves > 0) std::cout << ", " << c.result.linear_solves << " linear solves";
    if (c.result.stretched)
      std::cout << ", " << std::lround(100 * *c.result.stretched)
                << " % of the elements kept stretched";
    if (c.result.without_shape > 0)
      std::cout << ", " << c.result.without_shape
                << " elements had no shape to keep and were made regular";
    std::size_t sliding = 0, held = 0;
    for (const SlidingPart& part : c.result.boundary.sliding) {
      if (!part.of_regions) sliding += part.sliding_nodes();
      if (part.spacing != Spacing::free) held += part.nodes.size();
    }
    if (sliding > 0)
      std::cout << ", " << sliding << (c.on_surface ? " nodes" : " nodes of the boundary")
                << " slide";
    print_footholds(c.result.boundary);
    if (c.result.boundary.held > 0)
      std::cout << ", " << c.result.boundary.held << " named nodes held";
    if (held > 0) std::cout << ", spacing of " << held << " held";
    if (const std::string text = text_of(c.result.boundary.interfaces); !text.empty())
      std::cout << ", " << printable(text);
    for (const PeriodicPairs& pairs : c.result.boundary.periodic)
      std::cout << ", " << pairs.pairs.size() << (pairs.halo ? " halo nodes" : " periodic pairs")
                << " by " << pairs.description;
    for (const PeriodicPairs& pairs : c.result.boundary.periodic)
      if (!pairs.corners.empty() && !pairs.halo)
        std::cout << ", " << pairs.corners.size() << " corners of theirs slide";
    if (c.result.prescribed_inside > 0)
      std::cout << ", " << c.result.prescribed_inside << " nodes inside prescribed";
    if (c.result.kept_outside > 0)
      std::cout << ", " << c.result.kept_outside << " interior nodes kept outside";
    if (c.result.stuck_nodes > 0)
      std::cout << ", " << c.result.stuck_nodes << " nodes held where the surface folds";
    if (c.result.increments > 1) std::cout << ", in " << c.result.increments << " steps";
    print_pivots(c);
    std::cout << '\n';
  }
}

bool wants_heights(const ZoneRun& zone) {
  return std::ranges::any_of(zone.commands, [](const std::optional<Command>& command) {
    return command && asks_for_heights(*command);
  });
}

void print_outcome(const EditJob& job, const std::vector<ZoneRun>& zones, const RunReport& run) {
  print_commands(run);
  for (const ZoneRun& zone : zones) {
    std::cout << '\n';
    print_zone_heading(std::cout, zone.name());
    print_quality_table(std::cout, zone.result.mesh, zone.quality);
    if (zone.surface) print_surface_change(std::cout, *zone.surface);
    if (zone.quality.has_walls()) {
      std::cout << '\n';
      print_walls(std::cout, &zone.before.walls, zone.quality.walls, wants_heights(zone));
    }
    if (!zone.result.layers) continue;
    std::cout << '\n';
    print_layers(std::cout, *zone.result.layers, zone.result.mesh.coordinates, cut_columns_shown);
  }
  std::cout << '\n';
  if (run.written)
    std::cout << "Wrote " << printable(job.files.output) << " in ";
  else
    std::cout << "Nothing written to " << printable(job.files.output) << " after ";
  std::cout << run.seconds.total << " s\n";
}

constexpr const char* slides_along = " lets its nodes move along it";

/// True if a body turns so far that a fixed marker around it shears the mesh.
bool turns_far(const Command& command) {
  constexpr double far = 45;  // degrees
  const auto* move = std::get_if<MoveCommand>(&command);
  return move && std::ranges::any_of(move->bodies, [](const MovingBody& body) {
           return std::abs(body.motion.rotate) >= far;
         });
}

/// The first fixed marker that is a whole circle or sphere: it can turn with a body.
std::string round_marker(const Mesh& mesh, const std::vector<std::string>& moving,
                         const SlideOptions& slide) {
  const Markers& markers = mesh.topology->markers();
  for (const Marker& marker : markers) {
    const auto in = [&](const std::vector<std::string>& names) {
      return std::ranges::find(names, marker.name) != names.end();
    };
    if (in(moving) || in(slide.markers) || in(slide.periodic) || marker.faces.empty()) continue;
    const std::vector<std::string> names{marker.name};
    try {
      const auto found = SlidingBoundary::find(*mesh.topology, mesh.coordinates, names, {});
      const std::string& what = found.parts.front().description;
      if ((what.starts_with("circle") || what.starts_with("sphere")) &&
          found.parts.front().nodes.size() == markers.nodes_of(names).size())
        return marker.name;
    } catch (const UsageError&) {
      continue;  // none of its nodes can slide
    }
  }
  return {};
}

/// Begins a hint with the fixed marker at the place of damage: "--slide farfield lets its nodes
/// move along it, "; where a body turns far, with a circle or a sphere around it. Empty if there is
/// none, or if nothing moved.
std::string hint_to_slide(const ZoneRun& zone, const Damage& damage) {
  std::vector<std::string> moving;
  SlideOptions slide;
  for (const std::optional<Command>& command : zone.commands) {
    if (!command) continue;
    const SmoothOptions* smooth = smooth_options(*command);
    if (!smooth || smooth->formulation != Formulation::variational) return {};
    const auto add = [](std::vector<std::string>& list, const std::vector<std::string>& more) {
      list.insert(list.end(), more.begin(), more.end());
    };
    add(moving, markers_of(*command));
    add(slide.markers, smooth->slide.markers);
    add(slide.periodic, smooth->slide.periodic);
    if (smooth->slide.periodic_from_file) return {};
  }
  if (moving.empty()) return {};
  std::string marker = fixed_marker_at(*zone.source.mesh.topology, damage, moving, slide);
  const bool far = std::ranges::any_of(zone.commands, [](const std::optional<Command>& command) {
    return command && turns_far(*command);
  });
  if (marker.empty() && far) marker = round_marker(zone.source.mesh, moving, slide);
  return marker.empty() ? "" : "--slide " + printable(marker) + slides_along + ", ";
}

/// How the elements themselves can be kept as they are, besides what the commands do already.
std::string hint_to_keep(const ZoneRun& zone, const Damage& damage) {
  const bool keeps = std::ranges::all_of(zone.commands, [](const std::optional<Command>& command) {
    const SmoothOptions* smooth = command ? smooth_options(*command) : nullptr;
    return !smooth || smooth->targets.keep > 0 ||
           (smooth->targets.by_command() && !std::holds_alternative<SmoothCommand>(*command));
  });
  const bool plane = zone.source.mesh.topology->kind() == MeshKind::plane;
  std::string hint;
  if (damage.node && plane) hint = "--hold-layers keeps heights at a wall";
  if (!keeps)
    hint += (hint.empty() ? "" : ", ") + std::string("--targets keep keeps the elements' shapes");
  if (!damage.node)
    hint += (hint.empty() ? "" : ", ") + std::string("--raise-worst betters the worst one");
  return hint;
}

/// Warns about damage to a valid result that may hurt a flow solver. Commands that request heights
/// of layers suppress the warning.
void warn_of_damage(const EditJob& job, const ZoneRun& zone, RunReport& run) {
  if (wants_heights(zone)) return;
  const Damage damage = find_damage(zone.source.mesh, zone.result.mesh);
  if (damage.text.empty()) return;
  const std::string name = zone.name();
  std::string hint = hint_to_slide(zone, damage) + hint_to_keep(zone, damage);
  if (hint.ends_with(", ")) hint.resize(hint.size() - 2);
  const std::string text =
      (name.empty() ? "" : name + ": ") + damage.text + (hint.empty() ? "" : "; " + hint);
  warn(job.files, {text});
  run.warnings.push_back(text);
}

/// Warns about a surface that is still folded. Inverted elements are reported by themselves.
void warn_of_folds(const EditJob& job, const ZoneRun& zone, RunReport& run) {
  const SurfaceFolds& folds = zone.quality.folds;
  if (!folds.any() || zone.quality.inverted > 0) return;
  const std::string name = zone.name();
  const SurfaceFolds::Edge& first = folds.places.front();
  const std::string text =
      (name.empty() ? "" : name + ": ") + describe(folds) + ", the first at " +
      place_text(first.centre) + ", edge " + std::to_string(first.nodes[0]) + ' ' +
      std::to_string(first.nodes[1]) +
      "; nodes stay on the shape of the mesh as given, so its folds stay and do not count as "
      "inverted: --reference-surface FILE names a surface without folds";
  warn(job.files, {text});
  run.warnings.push_back(text);
}

/// The result of the motion that completed the smallest fraction.
const SmoothResult& least_complete(const RunReport& run) {
  return std::ranges::min_element(run.commands, {},
                                  [](const CommandRecord& c) {
                                    return c.result.limited_by.empty() ? c.result.fraction_reached
                                                                       : -1;
                                  })
      ->result;
}

/// Hints at sliding where a motion ended before a marker that is fixed; empty elsewhere.
std::string hint_beyond_gap(const RunReport& run, const SmoothResult& result) {
  const bool no_mesh = result.gap && !result.contact && result.limited_by.empty() &&
                       !result.out_of_iterations && result.boundary.held_footholds.empty();
  if (!no_mesh || result.gap->edges.other.empty()) return {};
  const std::string& marker = result.gap->edges.other;
  const bool slides = std::ranges::any_of(
      result.boundary.sliding, [&](const SlidingPart& part) { return part.marker == marker; });
  const bool variational = std::ranges::all_of(run.commands, [](const CommandRecord& c) {
    return !c.formulation || *c.formulation == formulation_name(Formulation::variational);
  });
  if (slides || !variational || marker == result.gap->edges.moving) return {};
  return " (--slide " + printable(marker) + slides_along + ")";
}

void print_incomplete(const RunReport& run) {
  const SmoothResult& result = least_complete(run);
  const char* nothing = "; nothing was written (--accept-partial writes ";
  if ((result.contact || result.held_inversion) && result.fraction_reached == 0 && !run.written) {
    std::cerr << "winslow: " << printable(why_incomplete(result)) << nothing
              << "a mesh from before that)\n";
    return;
  }
  std::cerr << "winslow: the motion could be followed to " << 100 * result.fraction_reached
            << " % only: " << printable(why_incomplete(result)) << hint_beyond_gap(run, result)
            << (run.written ? std::string("; the mesh there was written")
                            : nothing + std::string("the mesh there)"))
            << '\n';
}

bool holds_interfaces(const RunReport& run) {
  return std::ranges::any_of(run.commands, [](const CommandRecord& command) {
    return command.result.boundary.interfaces.all.held > 0;
  });
}

/// Prints why the exit code is not 0, even with --quiet.
void print_verdict(const EditJob& job, const std::vector<ZoneRun>& zones, const RunReport& run,
                   ExitCode code) {
  const Index inverted = inverted_elements(zones);
  if (code == ExitCode::inverted && inverted == 0) {
    print_incomplete(run);
  } else if (code == ExitCode::inverted) {
    std::cerr << "winslow: the result has " << inverted << " inverted element"
              << (inverted == 1 ? "" : "s")
              << (run.written ? "" : "; nothing was written (--allow-inverted writes it)") << '\n';
    for (const CommandRecord& command : run.commands)
      if (command.result.held_inversion)
        std::cerr << "winslow: " << describe(*command.result.held_inversion) << '\n';
    if (job.files.quiet) return;
    for (const ZoneRun& zone : zones) {
      if (zone.quality.inverted > 0) print_zone_heading(std::cerr, zone.name());
      print_inverted_elements(std::cerr, zone.result.mesh, zone.quality, inverted_elements_shown);
    }
    if (holds_interfaces(run))
      std::cerr << "  nodes in which regions meet were held: --free-interfaces lets them go\n";
  } else if (code == ExitCode::not_converged) {
    const bool at_limit = std::ranges::none_of(
        run.commands, [](const CommandRecord& command) { return gains_no_more(command.result); });
    std::cerr << "winslow: not converged"
              << (at_limit ? " within the limit"
                           : ": neither the energy nor the residual gains any more")
              << "; the mesh is valid and was written\n";
  }
}

/// Reads the mesh, or the zones that the commands change.
std::vector<ZoneRun> load(const EditJob& job, RunReport& run) {
  std::vector<io::MeshFile> files = read_zones(job.files.input, job.files.zone);
  if (files.size() > 1 && !io::keeps_zones(job.files.output, *files[0].details)) {
    throw UsageError(job.files.output + ": cannot hold the " + std::to_string(files.size()) +
                     " zones of " + job.files.input + "; choose one with --zone N");
  }
  run.warnings = warnings_of(files);
  warn(job.files, run.warnings);
  return share_out(std::move(files), job.commands, job.files.input);
}

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

nlohmann::json describe(const std::vector<ZoneRun>& zones, const RunReport& run) {
  std::vector<ZoneResult> results;
  for (const ZoneRun& zone : zones) {
    results.push_back({zone.number(), &zone.result.mesh, &zone.quality, &zone.before,
                       zone.result.layers ? &*zone.result.layers : nullptr,
                       zone.surface ? &*zone.surface : nullptr});
  }
  return describe_run(run, results);
}

}  // namespace

ExitCode run_edit_job(const EditJob& job) {
  check_files(job.files);
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
    warn_of_damage(job, zone, run);
    warn_of_folds(job, zone, run);
  }
  save(job, zones, run);
  run.seconds.save = lap.lap();
  run.seconds.total = total.seconds();
  if (!job.files.report.empty()) write_json(job.files.report, describe(zones, run));
  const ExitCode code = judge(run, zones);
  if (!job.files.quiet) print_outcome(job, zones, run);
  print_verdict(job, zones, run, code);
  return code;
}

}  // namespace winslow::app
