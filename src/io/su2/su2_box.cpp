#include "io/su2/su2_box.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "io/format/mesh_in_space.h"
#include "io/su2/su2_lines.h"
#include "io/text/numbers.h"

namespace winslow::io::su2 {

std::vector<BoxPoint> box_points(const Source& source, const ParsedMesh& mesh) {
  constexpr std::string_view key = "FFD_SURFACE_POINTS";
  std::vector<BoxPoint> points;
  std::set<std::string_view> markers;
  for (const Marker& marker : mesh.data.markers) markers.insert(marker.name);
  const auto text = source.text();
  for (auto at = text.find(key); at != std::string_view::npos; at = text.find(key, at + 1)) {
    LineReader lines(source, at, text.size());
    lines.next();
    while (!lines.at_end()) {
      const Line line = lines.next();
      if (!line.key.empty()) break;
      LineWords words(line.text);
      const auto marker = words.next();
      const auto node = parse_integer(words.next());
      if (!node || *node < 0 || *node >= mesh.data.node_count() || !markers.contains(marker))
        continue;
      const auto i = static_cast<Index>(*node);
      points.push_back({i, place_in_space(nullptr, mesh.data.coordinates, i)});
    }
  }
  return points;
}

bool box_is_stale(const std::vector<BoxPoint>& points, const Coordinates& x) {
  return std::any_of(points.begin(), points.end(), [&](const BoxPoint& point) {
    return point.node < x.size() && place_in_space(nullptr, x, point.node) != point.place;
  });
}

}  // namespace winslow::io::su2
