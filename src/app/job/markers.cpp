#include "app/job/markers.h"

#include "app/options/suggestion.h"
#include "core/error.h"

namespace winslow::app {
namespace {

[[noreturn]] void refuse(const std::string& name, const Topology& topology,
                         const std::string& file) {
  std::vector<std::string> known;
  std::string list;
  for (const Marker& marker : topology.markers()) {
    known.push_back(marker.name);
    list += (list.empty() ? "" : ", ") + marker.name + " (" + std::to_string(marker.faces.size()) +
            " edges)";
  }
  throw UsageError("unknown marker \"" + name + '"' + suggest(name, known) + " Markers of " + file +
                   ": " + (list.empty() ? "none" : list));
}

}  // namespace

void check_markers(const std::vector<Command>& commands, const Topology& topology,
                   const std::string& file) {
  for (const Command& command : commands) {
    for (const std::string& name : markers_of(command)) {
      if (!topology.markers().find(name)) refuse(name, topology, file);
    }
  }
}

}  // namespace winslow::app
