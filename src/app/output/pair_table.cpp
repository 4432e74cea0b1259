#include "app/output/pair_table.h"

#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "app/output/terminal.h"

namespace winslow::app {

namespace {

std::string quoted(const GivenPairs& given) {
  return '"' + given.first + '"' +
         (given.second == given.first ? "" : " and \"" + given.second + '"');
}

}  // namespace

void print_pairs(std::ostream& out, const GivenPeriodicity& periodicity, const Mesh& mesh) {
  if (periodicity.pairs.empty()) return;
  out << "\nPeriodic in the file (--periodic-from-file)\n";
  for (const GivenPairs& given : periodicity.pairs) {
    out << "  " << printable(quoted(given)) << ": ";
    if (!given.fault.empty()) {
      out << "cannot be used, " << printable(given.fault) << '\n';
      continue;
    }
    const PeriodicPairs pairs = PeriodicPairs::of(*mesh.topology, mesh.coordinates, given);
    out << given.pairs.size() << (given.halo ? " halo nodes" : " pairs of nodes") << ", "
        << pairs.description << '\n';
  }
}

nlohmann::json describe_pairs(const GivenPeriodicity& periodicity, const Mesh& mesh) {
  nlohmann::json list = nlohmann::json::array();
  for (const GivenPairs& given : periodicity.pairs) {
    nlohmann::json entry{{"markers", {given.first, given.second}},
                         {"pairs", given.pairs.size()},
                         {"halo", given.halo}};
    if (given.fault.empty())
      entry["by"] = PeriodicPairs::of(*mesh.topology, mesh.coordinates, given).description;
    else
      entry["fault"] = given.fault;
    list.push_back(std::move(entry));
  }
  return list;
}

}  // namespace winslow::app
