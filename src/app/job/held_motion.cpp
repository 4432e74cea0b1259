#include "app/job/held_motion.h"

#include "app/job/edit_job.h"
#include "core/mesh/coordinates.h"
#include "io/text/source.h"

namespace winslow::app {
namespace {

constexpr std::size_t holders_shown = 5;

bool moved(const Mesh& before, const Mesh& after, Index node) {
  const std::size_t dimension = at(before.coordinates.dimension());
  const auto of = [&](const Mesh& mesh) {
    return mesh.coordinates.values().subspan(dimension * at(node), dimension);
  };
  return !std::ranges::equal(of(before), of(after));
}

/// Counts by marker, and boundary and interior nodes without one, the nodes that `held` marks.
std::vector<HeldMotion::Holder> holders_of(const Topology& topology,
                                           const std::vector<char>& held) {
  std::vector<HeldMotion::Holder> holders;
  std::vector<char> named(held.size(), 0);
  const Markers& markers = topology.markers();
  for (std::size_t m = 0; m < markers.size(); ++m) {
    HeldMotion::Holder holder{markers[m].name, 0};
    for (const Index node : markers.nodes(static_cast<Index>(m))) {
      if (held[at(node)] == 0) continue;
      ++holder.nodes;
      named[at(node)] = 1;
    }
    if (holder.nodes > 0) holders.push_back(std::move(holder));
  }
  std::ranges::stable_sort(holders, std::greater<>(), &HeldMotion::Holder::nodes);
  HeldMotion::Holder boundary{"the boundary outside of all markers", 0},
      meeting{"where regions meet", 0}, inside{"inside the mesh", 0};
  std::vector<char> in_interface(held.size(), 0);
  for (const RegionInterface& interface : topology.interfaces())
    for (const Index node : interface.nodes) in_interface[at(node)] = 1;
  for (Index node = 0; node < topology.node_count(); ++node) {
    if (held[at(node)] == 0 || named[at(node)] != 0) continue;
    auto& of = topology.on_boundary(node) ? boundary : in_interface[at(node)] ? meeting : inside;
    ++of.nodes;
  }
  for (HeldMotion::Holder& other : {std::ref(boundary), std::ref(meeting), std::ref(inside)})
    if (other.nodes > 0) holders.push_back(std::move(other));
  return holders;
}

}  // namespace

std::optional<HeldMotion> find_held_motion(const Mesh& before, const Mesh& after,
                                           const std::vector<std::string>& moving) {
  const Topology& topology = *before.topology;
  if (moving.empty() || after.coordinates.size() != before.coordinates.size()) return std::nullopt;
  std::vector<char> held(at(topology.node_count()), 0);
  for (Index node = 0; node < topology.node_count(); ++node) held[at(node)] = topology.used(node);
  bool body_moved = false;
  for (const Index node : topology.markers().nodes_of(moving)) {
    body_moved = body_moved || moved(before, after, node);
    held[at(node)] = 0;
  }
  HeldMotion found;
  for (Index node = 0; node < topology.node_count(); ++node) {
    if (held[at(node)] == 0) continue;
    if (moved(before, after, node)) return std::nullopt;
    ++found.nodes;
  }
  if (!body_moved || found.nodes == 0) return std::nullopt;
  found.holders = holders_of(topology, held);
  const std::string& first = found.holders.front().name;
  if (topology.markers().from_file() && topology.markers().find(first)) found.slides = first;
  return found;
}

namespace {

/// True for a motion of bodies that is not of the boundary alone.
bool wants_nodes_to_follow(const Command& command) {
  if (const auto* move = std::get_if<MoveCommand>(&command)) return move->how.smooth_after;
  const auto* deform = std::get_if<DeformCommand>(&command);
  return deform != nullptr && deform->how.smooth_after;
}

}  // namespace

std::vector<std::string> moving_markers(const ZoneRun& zone) {
  std::vector<std::string> moving;
  for (const std::optional<Command>& command : zone.commands) {
    if (!command || !wants_nodes_to_follow(*command)) continue;
    for (const std::string& marker : markers_of(*command))
      if (zone.source.mesh.topology->markers().find(marker)) moving.push_back(marker);
  }
  return moving;
}

std::optional<HeldMotion> find_held_motion(const ZoneRun& zone) {
  return find_held_motion(zone.source.mesh, zone.result.mesh, moving_markers(zone));
}

std::string describe(const HeldMotion& held, const std::vector<std::string>& moving) {
  std::string text = "no node but those of " +
                     io::list_of(moving, [](const std::string& name) { return name; }) +
                     " moved: the other " + std::to_string(held.nodes) + " are held by ";
  for (std::size_t k = 0; k < std::min(held.holders.size(), holders_shown); ++k)
    text += (k == 0 ? "" : ", ") + held.holders[k].name + " (" +
            std::to_string(held.holders[k].nodes) + ')';
  if (held.holders.size() > holders_shown)
    text += " and " + std::to_string(held.holders.size() - holders_shown) + " more";
  if (!held.slides.empty()) text += "; --slide " + held.slides + " lets its nodes move along it";
  return text;
}

}  // namespace winslow::app
