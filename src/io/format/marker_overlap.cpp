#include "io/format/marker_overlap.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

namespace winslow::io {
namespace {

struct Named {
  std::array<Index, 4> nodes;
  std::size_t marker;
};

std::string counted(std::size_t n, const char* what) {
  return std::to_string(n) + ' ' + what + (n == 1 ? "" : "s");
}

}  // namespace

std::vector<std::string> marker_overlaps(const Topology& topology) {
  if (!topology.markers().from_file()) return {};
  std::vector<Named> all;
  const auto& markers = topology.markers();
  for (std::size_t m = 0; m < markers.size(); ++m) {
    for (const Face& face : markers[m].faces) all.push_back({face.sorted(), m});
  }
  std::sort(all.begin(), all.end(), [](const Named& a, const Named& b) {
    return std::tie(a.nodes, a.marker) < std::tie(b.nodes, b.marker);
  });
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> pairs;
  for (std::size_t k = 1; k < all.size(); ++k) {
    if (all[k].nodes == all[k - 1].nodes) ++pairs[{all[k - 1].marker, all[k].marker}];
  }
  const char* what = topology.cell_dimension() == 2 ? "edge" : "face";
  std::vector<std::string> warnings;
  for (const auto& [pair, n] : pairs) {
    const std::string& first = markers[pair.first].name;
    if (pair.first == pair.second) {
      warnings.push_back("marker \"" + first + "\" names " + counted(n, what) + " again");
    } else {
      warnings.push_back("markers \"" + first + "\" and \"" + markers[pair.second].name +
                         "\" share " + counted(n, what));
    }
  }
  return warnings;
}

}  // namespace winslow::io
