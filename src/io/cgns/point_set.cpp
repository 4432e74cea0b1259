#include "io/cgns/point_set.h"

#include <algorithm>
#include <array>
#include <utility>

namespace winslow::io::cgns {
namespace {

/// Faces of one element only, in the order of the elements.
std::vector<Face> boundary_faces(const MeshData& mesh) {
  struct Side {
    std::array<Index, 4> key;
    Index element, local;
  };
  std::vector<Side> sides;
  for (Index e = 0; e < mesh.element_count(); ++e) {
    const auto& faces = shape_of(mesh.types[at(e)]).faces;
    for (std::size_t f = 0; f < faces.size(); ++f)
      sides.push_back({by_nodes(faces[f], mesh.element(e)).sorted(), e, static_cast<Index>(f)});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.key < b.key; });
  std::vector<Side> single;
  for (std::size_t k = 0; k < sides.size();) {
    std::size_t end = k + 1;
    while (end < sides.size() && sides[end].key == sides[k].key) ++end;
    if (end == k + 1) single.push_back(sides[k]);
    k = end;
  }
  std::sort(single.begin(), single.end(), [](const Side& a, const Side& b) {
    return std::pair(a.element, a.local) < std::pair(b.element, b.local);
  });
  std::vector<Face> found;
  for (const Side& side : single) {
    found.push_back(by_nodes(shape_of(mesh.types[at(side.element)]).faces[at(side.local)],
                             mesh.element(side.element)));
  }
  return found;
}

}  // namespace

std::optional<PointSet> read_point_set(const NodeView& owner, std::size_t indices) {
  for (const char* name : {"PointRange", "PointList", "ElementRange", "ElementList"}) {
    const auto view = owner.child(name);
    if (!view) continue;
    PointSet set{*view, false, false, {}, view->integers()};
    set.range = view->name().ends_with("Range");
    set.elements = view->name().starts_with("Element");
    if (const auto location = owner.first("GridLocation_t")) set.location = location->text();
    const std::size_t per_point = set.elements ? 1 : indices;
    const bool whole =
        set.range ? set.values.size() == 2 * per_point : set.values.size() % per_point == 0;
    if (!whole) {
      view->fail(std::to_string(set.values.size()) + " numbers",
                 set.range ? std::to_string(2 * per_point)
                           : std::to_string(per_point) + " for each point");
    }
    return set;
  }
  return std::nullopt;
}

std::vector<Face> BoundaryByNodes::faces_between(const std::vector<bool>& nodes) const {
  if (!std::exchange(found_, true)) boundary_ = boundary_faces(mesh_);
  std::vector<Face> faces;
  std::copy_if(boundary_.begin(), boundary_.end(), std::back_inserter(faces), [&](const Face& f) {
    return std::all_of(f.begin(), f.end(), [&](Index node) { return nodes[at(node)]; });
  });
  return faces;
}

}  // namespace winslow::io::cgns
