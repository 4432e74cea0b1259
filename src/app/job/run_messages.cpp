#include "app/job/run_messages.h"

#include <iostream>

#include "app/job/held_motion.h"
#include "app/output/tables.h"
#include "core/error.h"
#include "core/mesh/coordinates.h"
#include "core/quality/mesh_change.h"
#include "core/strategy/run.h"
#include "core/strategy/sliding.h"

namespace winslow::app {
namespace {

constexpr int inverted_elements_shown = 5;
constexpr int cut_columns_shown = 5;

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
    if (const auto& angles = c.result.face_angles; angles && angles->mended > 0)
      std::cout << ", " << angles->mended << " faces brought back to an angle of 70 degrees";
    if (const auto& layers = c.result.layers_held)
      std::cout << ", " << layers->heights << " heights of layers held within "
                << 100 * layers->error << " %";
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
  // In space only a motion with targets keep holds heights, and only of layers.
  const bool holds = plane || (keeps && damage.stretched && zone.result.held_walls.empty());
  if (damage.node && holds) hint = "--hold-layers keeps heights at a wall";
  if (!keeps)
    hint += (hint.empty() ? "" : ", ") + std::string("--targets keep keeps the elements' shapes");
  if (damage.leaning_faces > 0)
    hint +=
        (hint.empty() ? "" : ", ") +
        std::string("--min-quality non_orthogonality=70 ends a motion before faces lean so far");
  else if (!damage.node)
    hint += (hint.empty() ? "" : ", ") + std::string("--raise-worst betters the worst one");
  return hint;
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

}  // namespace

std::string damage_warning(const ZoneRun& zone) {
  if (wants_heights(zone)) return {};
  const Damage damage = find_damage(zone.source.mesh, zone.result.mesh);
  if (damage.text.empty()) return {};
  const std::string name = zone.name();
  std::string hint = hint_to_slide(zone, damage) + hint_to_keep(zone, damage);
  if (hint.ends_with(", ")) hint.resize(hint.size() - 2);
  return (name.empty() ? "" : name + ": ") + damage.text + (hint.empty() ? "" : "; " + hint);
}

std::string fold_warning(const ZoneRun& zone) {
  const SurfaceFolds& folds = zone.quality.folds;
  if (!folds.any() || zone.quality.inverted > 0) return {};
  const std::string name = zone.name();
  const SurfaceFolds::Edge& first = folds.places.front();
  return (name.empty() ? "" : name + ": ") + describe(folds) + ", the first at " +
         place_text(first.centre) + ", edge " + std::to_string(first.nodes[0]) + ' ' +
         std::to_string(first.nodes[1]) +
         "; nodes stay on the shape of the mesh as given, so its folds stay and do not count as "
         "inverted: --reference-surface FILE names a surface without folds";
}

void print_outcome(const JobFiles& files, const std::vector<ZoneRun>& zones, const RunReport& run) {
  print_commands(run);
  for (const ZoneRun& zone : zones) {
    std::cout << '\n';
    print_zone_heading(std::cout, zone.name());
    print_quality_table(std::cout, zone.result.mesh, zone.quality);
    print_regions(std::cout, *zone.result.mesh.topology, zone.source.details->regions_array);
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
    std::cout << "Wrote " << printable(files.output) << " in ";
  else
    std::cout << "Nothing written to " << printable(files.output) << " after ";
  std::cout << run.seconds.total << " s\n";
  if (files.memory) print_memory(std::cout, most_memory(run.commands), peak_memory_bytes());
}

void print_verdict(const JobFiles& files, const std::vector<ZoneRun>& zones, const RunReport& run,
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
    if (files.quiet) return;
    for (const ZoneRun& zone : zones) {
      if (zone.quality.inverted > 0) print_zone_heading(std::cerr, zone.name());
      print_inverted_elements(std::cerr, zone.result.mesh, zone.quality, inverted_elements_shown);
    }
    if (holds_interfaces(run))
      std::cerr << "  nodes in which regions meet were held: --free-interfaces lets them go\n";
  } else if (code == ExitCode::held) {
    for (const ZoneRun& zone : zones)
      if (const auto held = find_held_motion(zone))
        std::cerr << "winslow: " << printable(describe(*held, moving_markers(zone))) << '\n';
  } else if (code == ExitCode::not_converged) {
    const bool at_limit = std::ranges::none_of(
        run.commands, [](const CommandRecord& command) { return gains_no_more(command.result); });
    std::cerr << "winslow: not converged"
              << (at_limit ? " within the limit"
                           : ": neither the energy nor the residual gains any more")
              << "; the mesh is valid and was written\n";
  }
}

}  // namespace winslow::app
