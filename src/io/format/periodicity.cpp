#include "io/format/periodicity.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "core/options/option.h"

namespace winslow::io {

namespace {

std::string names_of(const GivenPairs& given) {
  return "\"" + given.first + "\"" +
         (given.second == given.first ? "" : " and \"" + given.second + "\"");
}

/// By how much nodes may have come apart by rounding.
double rounding(const Coordinates& x) {
  double largest = 0;
  for (const double value : x.values()) largest = std::max(largest, std::abs(value));
  return 1e-14 * largest;
}

}  // namespace

void settle_periodicity(FormatDetails& details, const Mesh& mesh, const std::string& file) {
  if (!details.periodic) details.periodic = std::make_shared<GivenPeriodicity>();
  GivenPeriodicity& periodic = *details.periodic;
  periodic.source = file;
  periodic.nodes = mesh.topology->node_count();
  periodic.elements = mesh.topology->element_count();
  for (GivenPairs& given : periodic.pairs) {
    if (!given.fault.empty()) continue;
    try {
      given.deviation = PeriodicPairs::of(*mesh.topology, mesh.coordinates, given).deviation;
    } catch (const UsageError& error) {
      given.fault = file + ": " + error.what();
    }
  }
}

std::string named_pairs(const GivenPeriodicity& periodicity) {
  std::string text;
  std::set<std::string> seen;
  for (const GivenPairs& given : periodicity.pairs) {
    const std::string names = names_of(given);
    if (given.halo || !seen.insert(names).second) continue;
    text += (text.empty() ? "" : ", ") + names;
  }
  return text;
}

std::vector<std::string> stale_pairs(const FormatDetails& details, const Mesh& mesh) {
  std::vector<std::string> stale;
  if (!details.periodic || !details.periodic->fits(*mesh.topology)) return stale;
  const double noise = rounding(mesh.coordinates);
  for (const GivenPairs& given : details.periodic->pairs) {
    if (!given.fault.empty()) continue;
    std::string how_far;
    try {
      const double now = PeriodicPairs::of(*mesh.topology, mesh.coordinates, given).deviation;
      if (now <= 2 * given.deviation + noise) continue;
      how_far = "they are up to " + number_text(now) + " apart from one another's images";
    } catch (const UsageError& error) {
      how_far = error.what();
    }
    stale.push_back((given.halo ? "the halo nodes beyond " : "the periodic nodes of ") +
                    names_of(given) + " no longer match, and the file still pairs them: " +
                    how_far + "; --periodic-from-file keeps them together");
  }
  return stale;
}

}  // namespace winslow::io
