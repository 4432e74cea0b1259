#include "core/strategy/kept_layers.h"

#include <cstdio>
#include <utility>

#include "core/error.h"

namespace winslow {

namespace {

std::vector<std::string> names_of(std::span<const LayerWall> walls) {
  std::vector<std::string> names;
  for (const LayerWall& wall : walls)
    names.insert(names.end(), wall.markers.begin(), wall.markers.end());
  return names;
}

/// The first of some markers that a node lies on; of all markers if none is named.
std::string marker_at(const Topology& topology, Index node, std::span<const std::string> names) {
  const Markers& markers = topology.markers();
  Index place = 0;
  for (const Marker& marker : markers) {
    const auto nodes = markers.nodes(place++);
    if (!names.empty() && std::ranges::find(names, marker.name) == names.end()) continue;
    if (std::ranges::binary_search(nodes, node)) return marker.name;
  }
  return "(unmarked)";
}

[[noreturn]] void refuse(const std::string& wall, const std::string& what, Index node,
                         const Vec2& at) {
  char place[96];
  std::snprintf(place, sizeof place, "node %lld at (%.6g, %.6g)", static_cast<long long>(node),
                at.x(), at.y());
  throw UsageError("keep-outside: " + what + " '" + wall + "' (" + place +
                   ") outside the region in which nodes may move; expected walls with all of their "
                   "layers inside");
}

/// The end of a column: as it runs in the mesh, or where it is to be.
Vec2 end_of(const LayerColumn& column, const Coordinates& x) {
  if (!column.nodes.empty()) return x.xy(column.rim());
  return x.xy(column.wall_node) + column.thickness() * column.slant * column.direction;
}

void require_column_inside(const FreeRegion& region, const LayerColumn& column, const Mesh& mesh,
                           std::span<const std::string> names) {
  const Coordinates& x = mesh.coordinates;
  const auto wall = [&] { return marker_at(*mesh.topology, column.wall_node, names); };
  const Vec2 foot = x.xy(column.wall_node);
  if (!region.holds(foot)) refuse(wall(), "there is a part of the wall", column.wall_node, foot);
  for (const Index node : column.nodes)
    if (!region.holds(x.xy(node))) refuse(wall(), "there are layers of the wall", node, x.xy(node));
  // A region is convex: a straight column whose ends it holds lies in it.
  if (!region.holds(end_of(column, x)))
    refuse(wall(), "there would be layers of the wall", column.wall_node, foot);
}

bool has_kept_node(const LayerColumn& column, std::span<const Index> kept) {
  return std::ranges::any_of(column.nodes,
                             [&](Index node) { return std::ranges::binary_search(kept, node); });
}

}  // namespace

std::vector<Index> nodes_kept_by_layers(const KeepOutside& keep, const Mesh& mesh,
                                        std::span<const LayerWall> walls) {
  if (!keep.given()) return {};
  const std::vector<Index> nodes = mesh.topology->markers().nodes_of(names_of(walls));
  return nodes_outside(FreeRegion(keep, mesh.coordinates, nodes), *mesh.topology, mesh.coordinates);
}

void require_layers_inside(const KeepOutside& keep, const LayerStack& stack, const Mesh& mesh,
                           std::span<const LayerWall> walls) {
  if (!keep.given()) return;
  const std::vector<std::string> names = names_of(walls);
  const FreeRegion region(keep, mesh.coordinates, mesh.topology->markers().nodes_of(names));
  for (const LayerColumn& column : stack.columns)
    require_column_inside(region, column, mesh, names);
}

void require_moved_layers_inside(const KeepOutside& keep, const LayerStack& stack, const Mesh& mesh,
                                 std::span<const Index> moving) {
  if (!keep.given()) return;
  const FreeRegion region(keep, mesh.coordinates, moving);
  std::vector<Index> moved(moving.begin(), moving.end());
  std::ranges::sort(moved);
  for (const LayerColumn& column : stack.columns)
    if (std::ranges::binary_search(moved, column.wall_node))
      require_column_inside(region, column, mesh, {});
}

void restore_kept_columns(LayerStack& stack, const LayerStack& before,
                          std::span<const Index> kept) {
  if (kept.empty()) return;
  for (std::size_t c = 0; c < stack.columns.size(); ++c)
    if (has_kept_node(stack.columns[c], kept)) stack.columns[c] = before.columns[c];
}

LayerMeasures measure_movable_layers(LayerStack stack, const Coordinates& x,
                                     std::span<const Index> kept) {
  for (LayerColumn& column : stack.columns) {
    if (kept.empty() || !has_kept_node(column, kept)) continue;
    column.heights.clear();
    column.nodes.resize(1);
  }
  return measure_layers(stack, x);
}

}  // namespace winslow
