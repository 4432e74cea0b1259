#include "app/job/markers.h"

#include "app/options/suggestion.h"
#include "core/error.h"

namespace winslow::app {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::vector<const Topology*>& topologies,
                         const std::string& file) {
  std::vector<std::string> known;
  std::string list;
  for (const Topology* topology : topologies) {
    for (const Marker& marker : topology->markers()) {
      known.push_back(marker.name);
      list += (list.empty() ? "" : ", ") + marker.name + " (" +
              std::to_string(marker.faces.size()) + " edges)";
    }
  }
  throw UsageError("unknown marker \"" + name + '"' + suggest(name, known) + " Markers of " + file +
                   ": " + (list.empty() ? "none" : list));
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

}  // namespace winslow::app
