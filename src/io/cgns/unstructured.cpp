#include "io/cgns/unstructured.h"

#include <algorithm>

namespace winslow::io::cgns {
namespace {

/// Some programs list elements and do not say so. Vertices they cannot be, if there are none of
/// these numbers.
bool means_elements(const PointSet& set, const ZoneSides& sides, std::int64_t vertices) {
  if (!set.of_vertices()) return true;
  if (!set.location.empty() || set.values.empty()) return false;
  const auto is_side = [&](std::int64_t n) {
    return sides.numbers.find(n).kind == ElementPlace::Kind::side;
  };
  return *std::max_element(set.values.begin(), set.values.end()) > vertices &&
         std::all_of(set.values.begin(), set.values.end(), is_side);
}

}  // namespace

std::vector<Face> UnstructuredBoundary::faces_of(const PointSet& set,
                                                 std::vector<std::string>& warnings) const {
  const std::string owner = "\"" + set.view.path() + "\"";
  if (!means_elements(set, sides_, vertices_)) {
    std::vector<bool> nodes(static_cast<std::size_t>(vertices_), false);
    set.for_each_number([&](std::int64_t vertex) {
      if (vertex < 1 || vertex > vertices_) {
        set.view.fail("vertex " + std::to_string(vertex), "1 to " + std::to_string(vertices_));
      }
      nodes[static_cast<std::size_t>(vertex - 1)] = true;
    });
    return by_nodes_.faces_between(nodes);
  }
  if (set.of_vertices()) {
    warnings.push_back(owner + " has numbers that no vertex has: taken for elements");
  }
  std::vector<Face> faces;
  std::int64_t others = 0;
  set.for_each_number([&](std::int64_t number) {
    const ElementPlace place = sides_.numbers.find(number);
    if (place.kind == ElementPlace::Kind::none) {
      set.view.fail(
          "element " + std::to_string(number),
          "1 to " + std::to_string(sides_.numbers.last()) + ", as the sections have them");
    }
    if (place.kind == ElementPlace::Kind::side) {
      faces.push_back(sides_.faces[at(place.index)]);
    } else {
      ++others;
    }
  });
  if (others > 0) {
    warnings.push_back(owner + " names " + std::to_string(others) + " elements that are no " +
                       (dimension_ == 2 ? "edges (BAR_2)" : "faces (TRI_3, QUAD_4)") +
                       ": they are in no marker");
  }
  return faces;
}

}  // namespace winslow::io::cgns
