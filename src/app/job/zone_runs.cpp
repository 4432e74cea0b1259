#include <set>

#include "app/job/edit_job.h"
#include "app/options/flags.h"
#include "core/error.h"
#include "io/su2/su2.h"
#include "io/tables/file_defaults.h"

namespace winslow::app {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::vector<const Topology*>& topologies,
                         const std::string& file) {
  std::vector<std::string> known;
  std::string list;
  std::size_t begin_so = 0;
  for (const Topology* topology : topologies) {
    for (const Marker& marker : topology->markers()) {
      known.push_back(marker.name);
      if (marker.name.starts_with(name)) ++begin_so;
      list += (list.empty() ? "" : ", ") + marker.name + " (" +
              std::to_string(marker.faces.size()) + ' ' +
              std::string(words_of(topology->kind()).face) + "s)";
    }
  }
  const std::string help = begin_so > 1 ? "; \"" + name + "*\" means the " +
                                              std::to_string(begin_so) + " markers that begin so."
                                        : suggest(name, known);
  throw UsageError("unknown marker \"" + name + '"' + help + " Markers of " + file + ": " +
                   (list.empty() ? "none" : list));
}

}  // namespace

void check_markers(const std::vector<Command>& commands,
                   const std::vector<const Topology*>& topologies, const std::string& file) {
  for (const Command& command : commands) {
    for (const std::string& name : markers_of(command)) {
      const bool known = std::any_of(topologies.begin(), topologies.end(), [&](const Topology* t) {
        return t->markers().find(name).has_value();
      });
      if (!known) refuse(name, topologies, file);
    }
  }
}

void check_markers(const std::vector<Command>& commands, const Topology& topology,
                   const std::string& file) {
  check_markers(commands, std::vector<const Topology*>{&topology}, file);
}

namespace {

void keep_known(std::vector<std::string>& markers, const Topology& topology) {
  std::erase_if(
      markers, [&](const std::string& name) { return !topology.markers().find(name).has_value(); });
}

/// The command for one zone; nothing if all its markers are in other zones.
std::optional<Command> restricted(Command command, const Topology& topology) {
  if (markers_of(command).empty()) return command;
  std::visit(
      [&](auto& c) {
        if constexpr (requires { c.markers; }) {
          keep_known(c.markers, topology);
        } else if constexpr (requires { c.bodies; }) {
          for (MovingBody& body : c.bodies) keep_known(body.markers, topology);
          std::erase_if(c.bodies, [](const MovingBody& body) { return body.markers.empty(); });
        } else if constexpr (requires { c.layers.walls; }) {
          for (LayerWall& wall : c.layers.walls) keep_known(wall.markers, topology);
          std::erase_if(c.layers.walls, [](const LayerWall& wall) { return wall.markers.empty(); });
        }
      },
      command);
  if (markers_of(command).empty()) return std::nullopt;
  return command;
}

// Describes the single nodes that a command names; empty: none.

template <class AnyCommand>
std::string own_nodes(const AnyCommand&) {
  return {};
}
std::string own_nodes(const EditVcvCommand&) { return "edits VCVs of nodes"; }
std::string own_nodes(const DeformCommand& deform) {
  return std::get_if<SineDeformation>(&deform.shape) ? "" : "displaces single nodes";
}
std::string own_nodes(const LayersCommand& command) {
  return command.layers.overrides.empty() ? "" : "says what columns of single nodes are like";
}

std::string about_nodes(const Command& command) {
  std::string own = std::visit([](const auto& of) { return own_nodes(of); }, command);
  const SmoothOptions* smooth = smooth_options(command);
  const bool named =
      smooth && !(smooth->slide.hold_nodes.empty() && smooth->slide.smooth_nodes.empty());
  return own.empty() && named ? "holds single nodes, or makes them smooth" : own;
}

void refuse_ambiguous(const std::vector<ZoneRun>& runs, const std::string& file) {
  std::vector<std::string> seen;
  for (const ZoneRun& run : runs) {
    for (const std::optional<Command>& command : run.commands) {
      const std::string about = command ? about_nodes(*command) : std::string();
      if (about.empty()) continue;
      if (std::find(seen.begin(), seen.end(), about) != seen.end()) {
        throw UsageError(std::string(command_name(*command)) + " " + about + ", and " + file +
                         " has several zones that it could mean; choose one with --zone N");
      }
      seen.push_back(about);
      break;  // several such commands for one zone mean the same nodes
    }
  }
}

}  // namespace

int ZoneRun::number() const {
  return !source.details || source.details->zones.empty() ? 0 : source.details->zone;
}

std::string ZoneRun::name() const {
  return number() == 0 ? "" : "zone " + std::to_string(number());
}

Index inverted_elements(const std::vector<ZoneRun>& zones) {
  Index sum = 0;
  for (const ZoneRun& zone : zones) sum += zone.quality.inverted;
  return sum;
}

std::vector<io::MeshFile> read_zones(const std::string& path, const io::ReadOptions& options) {
  if (options.zone == 0) return io::read_mesh_zones(path, options);
  std::vector<io::MeshFile> files;
  files.push_back(io::read_mesh(path, options));
  return files;
}

std::vector<std::string> warnings_of(const std::vector<io::MeshFile>& files) {
  std::vector<std::string> all;
  std::set<std::string_view> seen;
  for (const io::MeshFile& file : files) {
    for (const std::string& text : file.warnings)
      if (seen.insert(text).second) all.push_back(text);
  }
  return all;
}

std::vector<ZoneRun> share_out(std::vector<io::MeshFile> zones,
                               const std::vector<Command>& commands, const std::string& file) {
  std::vector<const Topology*> topologies;
  for (const io::MeshFile& zone : zones) topologies.push_back(zone.mesh.topology.get());
  check_markers(commands, topologies, file);
  if (zones.size() == 1) {
    return {ZoneRun{std::move(zones[0]), {commands.begin(), commands.end()}, {}, {}, {}, {}}};
  }
  std::vector<ZoneRun> runs;
  for (io::MeshFile& zone : zones) {
    ZoneRun run;
    for (const Command& command : commands) {
      run.commands.push_back(restricted(command, *zone.mesh.topology));
    }
    const bool concerned = std::ranges::any_of(
        run.commands, [](const std::optional<Command>& own) { return own.has_value(); });
    if (!concerned && !commands.empty()) continue;
    run.source = std::move(zone);
    runs.push_back(std::move(run));
  }
  refuse_ambiguous(runs, file);
  return runs;
}

void expand_groups(Command& command, const std::vector<io::MeshFile>& files) {
  std::vector<const Topology*> topologies;
  for (const io::MeshFile& file : files) {
    topologies.push_back(file.mesh.topology.get());
    if (file.details) io::expand_groups(command, file.details->roles, *file.mesh.topology);
  }
  io::expand_patterns(command, topologies);
}

std::vector<std::string> add_file_defaults(std::vector<ZoneRun>& zones, const std::string& config) {
  std::vector<std::string> said;
  const io::MarkerRoles more = config.empty() ? io::MarkerRoles{} : io::su2::read_config(config);
  for (ZoneRun& zone : zones)
    for (std::optional<Command>& command : zone.commands) {
      std::string text =
          command ? io::add_file_defaults(*command, zone.source, more) : std::string();
      if (text.empty()) continue;
      if (const std::string name = zone.name(); !name.empty()) text.insert(0, name + ": ");
      if (std::ranges::find(said, text) == said.end()) said.push_back(std::move(text));
    }
  return said;
}

void resolve_files(std::vector<ZoneRun>& zones, const io::ReferenceReader& read) {
  const auto named = [](const ZoneRun& zone) {
    const auto& details = zone.source.details;
    return details && details->periodic && !details->periodic->pairs.empty();
  };
  const bool any = std::ranges::any_of(zones, named);
  for (ZoneRun& zone : zones) {
    for (std::optional<Command>& command : zone.commands) {
      SlideFiles& files = zone.files.emplace_back();
      SmoothOptions* smooth = command ? smooth_options(*command) : nullptr;
      if (!smooth) continue;
      if (any && !named(zone)) smooth->slide.periodic_from_file = false;
      files = io::resolve_files(smooth->slide, zone.source.details.get(), read);
    }
  }
}

}  // namespace winslow::app
