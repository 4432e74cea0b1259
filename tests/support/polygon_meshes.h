#pragma once

#include "support/meshes.h"

/// Plane meshes with polygons for tests.
namespace winslow::test {

/// The same elements, all as polygons.
inline MeshData as_polygons(MeshData data) {
  std::ranges::fill(data.types, ElementType::polygon);
  return data;
}

/// A grid of n by n quadrilaterals on the unit square with a square hole (n a multiple of 5), in
/// which the cells around the hole are split into four. Those beside them are polygons with hanging
/// nodes. Markers outer, hole.
inline MeshData quadtree_with_hole(Index n) {
  MeshData data;
  std::map<std::pair<Index, Index>, Index> ids;  // by twice the numbers of a node of the grid
  const auto id = [&](Index i, Index j) {
    const auto [it, fresh] = ids.try_emplace({i, j}, data.node_count());
    if (fresh) data.coordinates.push_xy(Vec2(i, j) / (2 * n));
    return it->second;
  };
  const auto in_hole = [&](Index i, Index j) { return 5 * i / n == 2 && 5 * j / n == 2; };
  const auto split = [&](Index i, Index j) {
    const Index low = 2 * n / 5 - 1, high = 3 * n / 5;
    return i >= low && i <= high && j >= low && j <= high;
  };
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i) {
      if (in_hole(i, j)) continue;
      const Index x = 2 * i, y = 2 * j;
      if (split(i, j)) {
        for (const auto& [a, b] :
             {std::pair<Index, Index>{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}})
          add_quad(data, id(a, b), id(a + 1, b), id(a + 1, b + 1), id(a, b + 1));
        continue;
      }
      std::vector<Index> corners;
      const auto side = [&](Index a, Index b, Index da, Index db, bool is_split) {
        corners.push_back(id(a, b));
        if (is_split) corners.push_back(id(a + da, b + db));
      };
      side(x, y, 1, 0, split(i, j - 1));
      side(x + 2, y, 0, 1, split(i + 1, j));
      side(x + 2, y + 2, -1, 0, split(i, j + 1));
      side(x, y + 2, 0, -1, split(i - 1, j));
      data.add_element(corners.size() == 4 ? ElementType::quadrilateral : ElementType::polygon,
                       corners);
    }
  }
  mark_boundary(data, [](const Vec2& p) {
    const Vec2 q = (p - Vec2(0.5, 0.5)).cwiseAbs();
    return q.maxCoeff() > 0.5 - 1e-9 ? "outer" : "hole";
  });
  return data;
}

/// The dual of a mesh: a polygon for each node, through the middles of the elements around it; that
/// of a boundary node also through the middles of its boundary edges and the node itself. Markers
/// as in the mesh.
inline MeshData dual_of(const Mesh& mesh) {
  const Topology& topology = *mesh.topology;
  const Coordinates& x = mesh.coordinates;
  MeshData data;
  for (Index e = 0; e < topology.element_count(); ++e) {
    Vec2 middle(0, 0);
    for (const Index node : topology.element(e)) middle += x.xy(node);
    data.coordinates.push_xy(middle / static_cast<double>(topology.element(e).size()));
  }
  std::map<std::pair<Index, Index>, Index> of_edge;
  const auto new_node = [&](const Vec2& p) {
    data.coordinates.push_xy(p);
    return data.node_count() - 1;
  };
  const auto middle = [&](Index a, Index b) {
    const auto [it, fresh] = of_edge.try_emplace(std::minmax(a, b), -1);
    if (fresh) it->second = new_node(0.5 * (x.xy(a) + x.xy(b)));
    return it->second;
  };
  std::map<Index, Index> of_node;
  for (Index node = 0; node < topology.node_count(); ++node) {
    if (!topology.used(node)) continue;
    std::vector<Index> corners(topology.star(node).begin(), topology.star(node).end());
    const auto row = topology.neighbours(node);
    if (row.size() > corners.size()) {  // of the boundary
      const Index first = middle(node, row.front()), last = middle(node, row.back());
      of_node[node] = new_node(x.xy(node));
      corners.insert(corners.begin(), first);
      corners.insert(corners.end(), {last, of_node[node]});
    }
    data.add_element(ElementType::polygon, corners);
  }
  for (const Marker& marker : topology.markers()) {
    data.markers.push_back({marker.name, marker.tag, {}});
    Marker& own = data.markers.back();
    for (const Face& face : marker.faces) {
      const auto [a, b] = face.edge();
      own.faces.emplace_back(of_node.at(a), middle(a, b));
      own.faces.emplace_back(middle(a, b), of_node.at(b));
    }
  }
  return data;
}

}  // namespace winslow::test
