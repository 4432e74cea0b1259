#include "core/formulation/surface_cells.h"

#include "core/formulation/row_blocks.h"
#include "core/mesh/index_sets.h"
#include "core/parallel/parallel_for.h"
#include "core/quality/metric.h"

namespace winslow {

namespace {

/// The element that contains all nodes of a triangle.
Index element_of(const Topology& topology, const std::array<Index, 3>& nodes) {
  for (const Index e : topology.star(nodes[0])) {
    const auto element = topology.element(e);
    const auto has = [&](Index node) { return std::ranges::find(element, node) != element.end(); };
    if (has(nodes[1]) && has(nodes[2])) return e;
  }
  return -1;
}

std::vector<bool> loose_rows(const NodeUnknowns& nodes,
                             const std::vector<std::array<Index, 3>>& cells) {
  const auto count = at(nodes.topology().node_count());
  JoinedSets parts(count);
  for (const auto& cell : cells) {
    parts.join(cell[0], cell[1]);
    parts.join(cell[0], cell[2]);
  }
  std::vector<bool> held(count, false);
  for (const auto& cell : cells)
    for (const Index node : cell)
      if (!nodes.classes().moves(node)) held[at(parts.find(node))] = true;
  std::vector<bool> loose;
  for (const Index node : nodes.nodes()) loose.push_back(!held[at(parts.find(node))]);
  return loose;
}

}  // namespace

std::unique_ptr<double[]> KeptMemory::borrow() {
  {
    const std::lock_guard lock(mutex_);
    if (kept_) return std::move(kept_);
  }
  return std::make_unique_for_overwrite<double[]>(numbers_);
}

void KeptMemory::give_back(std::unique_ptr<double[]> memory) {
  const std::lock_guard lock(mutex_);
  kept_ = std::move(memory);
}

SurfaceStructure::SurfaceStructure(const NodeUnknowns& nodes,
                                   const std::vector<std::array<Index, 3>>& triangles)
    : cells(triangles), row_of_node(at(nodes.topology().node_count()), -1) {
  const auto rows = static_cast<Index>(nodes.nodes().size());
  for (Index row = 0; row < rows; ++row) row_of_node[at(nodes.nodes()[at(row)])] = row;
  for (const auto& cell : cells) element.push_back(element_of(nodes.topology(), cell));
  corners = corners_of_rows(cells, row_of_node, rows);
  pattern = pattern_of_cells(cells, corners, row_of_node, nodes.threads());
  entries.assign(3 * cells.size(), {-1, -1, -1});
  for (Index row = 0; row < rows; ++row)
    for (const Index corner : corners[row])
      for (std::size_t j = 0; j < 3; ++j)
        if (const Index column = row_of_node[at(cells[at(corner / 3)][j])]; column >= 0)
          entries[at(corner)][j] = pattern->find(row, column);
  loose = loose_rows(nodes, cells);
  numbers.resize(3 * cells.size());
  std::iota(numbers.begin(), numbers.end(), 0);
}

CellPlane own_plane(const Vec3& u, const Vec3& v, const Vec3& reference) {
  CellPlane plane;
  const Vec3 area = u.cross(v);
  const double size = area.norm(), length = u.norm();
  if (!(size > 0)) {
    plane.normal = reference;
    plane.e1 = reference.unitOrthogonal();
  } else {
    plane.normal = is_turned_over(area, reference) ? Vec3(-area / size) : Vec3(area / size);
    plane.e1 = u / length;
  }
  plane.e2 = plane.normal.cross(plane.e1);
  return plane;
}

double determinant_in(const CellPlane& plane, const Vec3& u, const Vec3& v) {
  const Vec2 b = plane.of(u), c = plane.of(v);
  return b.x() * c.y() - b.y() * c.x();
}

namespace {

/// plane(edges at the first corner, reference normal) for each cell.
template <typename Plane>
FlatCells lay_flat(const SurfaceStructure& structure, const Coordinates& coordinates,
                   std::span<const Vec3> normals, int threads, const Plane& plane) {
  const SpacePoints x(coordinates);
  FlatCells flat;
  flat.x.resize(6 * structure.cells.size());
  flat.planes.resize(structure.cells.size());
  parallel_for(threads, static_cast<Index>(structure.cells.size()), [&](Index begin, Index end) {
    for (auto t = at(begin); t < at(end); ++t) {
      const auto& nodes = structure.cells[t];
      const Vec3 u = x[nodes[1]] - x[nodes[0]], v = x[nodes[2]] - x[nodes[0]];
      CellPlane& of_cell = flat.planes[t] = plane(u, v, normals[at(structure.element[t])]);
      double* points = flat.x.data() + 6 * t;
      points[0] = points[1] = 0;
      const Vec2 b = of_cell.of(u), c = of_cell.of(v);
      std::copy_n(b.data(), 2, points + 2);
      std::copy_n(c.data(), 2, points + 4);
    }
  });
  return flat;
}

}  // namespace

FlatCells FlatCells::in_own_planes(const SurfaceStructure& structure, const Coordinates& x,
                                   std::span<const Vec3> normals, int threads) {
  return lay_flat(structure, x, normals, threads, own_plane);
}

FlatCells FlatCells::against(const SurfaceStructure& structure, const Coordinates& x,
                             std::span<const Vec3> normals, int threads) {
  return lay_flat(structure, x, normals, threads,
                  [](const Vec3&, const Vec3&, const Vec3& reference) {
                    const Vec3 e1 = reference.unitOrthogonal();
                    return CellPlane{e1, reference.cross(e1), reference};
                  });
}

double FlatCells::determinant(std::size_t cell) const {
  const double* p = x.data() + 6 * cell;
  return p[2] * p[5] - p[3] * p[4];
}

}  // namespace winslow
