#include "gui/document/autosave/step_checks.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace winslow::gui {

namespace {

bool within(Index value, Index count) { return value >= 0 && value < count; }

bool positive(double value) { return value > 0 && std::isfinite(value); }

bool all_positive(const std::vector<double>& values) {
  return std::ranges::all_of(values, positive);
}

bool element_rows_fit(const MeshData& data) {
  const auto& offsets = data.element_offsets;
  if (offsets.size() != data.types.size() + 1 || offsets.front() != 0) return false;
  for (std::size_t e = 0; e < data.types.size(); ++e) {
    if (data.types[e] > ElementType::hexahedron) return false;
    // In this order: no sum of damaged numbers overflows.
    if (offsets[e] < 0 || offsets[e + 1] < offsets[e]) return false;
    if (offsets[e + 1] - offsets[e] != corner_count(data.types[e])) return false;
  }
  return static_cast<std::size_t>(offsets.back()) == data.element_nodes.size();
}

std::string fault_of_column(const LayerColumn& column, Index nodes) {
  if (!within(column.wall_node, nodes) || column.wall < 0) return "a column on no wall";
  if (!column.direction.allFinite() || !positive(column.slant)) return "a column without direction";
  for (const double value : {column.first, column.asked, column.room})
    if (!std::isfinite(value)) return "a height that is no number";
  for (const LayerLimit limit : {column.limit, column.granted_limit})
    if (limit < LayerLimit::none || limit > LayerLimit::room) return "a reason that does not exist";
  for (const auto* heights : {&column.heights, &column.granted, &column.corrections})
    if (!all_positive(*heights)) return "a height that is not positive";
  if (!column.granted.empty() && column.granted.size() != column.count())
    return std::to_string(column.granted.size()) + " granted heights of " +
           std::to_string(column.count());
  if (!column.corrections.empty() && column.corrections.size() != column.count())
    return std::to_string(column.corrections.size()) + " corrections of " +
           std::to_string(column.count()) + " heights";
  if (column.end < LayerEnd::none || column.end > LayerEnd::count)
    return "a reason that does not exist";
  if (!column.bends.empty() && column.bends.size() != column.count())
    return std::to_string(column.bends.size()) + " bends of " + std::to_string(column.count()) +
           " heights";
  if (!std::ranges::all_of(column.bends, [](double bend) { return std::isfinite(bend); }))
    return "a bend that is no number";
  if (column.nodes.size() != column.count() + 1 || column.nodes.front() != column.wall_node)
    return std::to_string(column.nodes.size()) + " nodes in a column of " +
           std::to_string(column.count()) + " layers";
  if (!std::ranges::all_of(column.nodes, [&](Index node) { return within(node, nodes); }))
    return "a column through no node of the mesh";
  return {};
}

}  // namespace

std::string fault_of(const MeshData& data) {
  if (!element_rows_fit(data)) return "elements that do not fit their nodes";
  for (const Marker& marker : data.markers)
    for (const Face& face : marker.faces)
      if (face.size() < 2 || face.size() > 4 ||
          !std::ranges::all_of(face, [&](Index node) { return within(node, data.node_count()); }))
        return "a face of a marker between no nodes of the mesh";
  if (!data.element_region.empty() && data.element_region.size() != data.types.size())
    return "regions of " + std::to_string(data.element_region.size()) + " elements";
  const auto regions = static_cast<Index>(data.regions.size());
  if (!std::ranges::all_of(data.element_region,
                           [&](Index region) { return region == -1 || within(region, regions); }))
    return "an element in a region that does not exist";
  return {};
}

std::string fault_of_surface(const std::vector<Vec3>& points, const std::vector<Face>& faces) {
  if (!std::ranges::all_of(points, [](const Vec3& point) { return point.allFinite(); }))
    return "a point of a surface that is no place";
  const auto count = static_cast<Index>(points.size());
  for (const Face& face : faces)
    if (face.size() < 3 || face.size() > 4 ||
        !std::ranges::all_of(face, [&](Index point) { return within(point, count); }))
      return "a face of a surface between no points of it";
  return {};
}

std::string fault_of(const LayerStack& stack, const Topology& topology) {
  if (stack.columns.empty()) return "layers without columns";
  std::size_t most = 0;
  for (const LayerColumn& column : stack.columns) {
    if (std::string fault = fault_of_column(column, topology.node_count()); !fault.empty())
      return fault;
    most = std::max(most, column.count());
  }
  for (const ColumnPair& pair : stack.pairs)
    if (pair.left >= stack.columns.size() || pair.right >= stack.columns.size())
      return "neighbours of a column that does not exist";
  if (stack.layer_of_element.size() != static_cast<std::size_t>(topology.element_count()))
    return "layers of " + std::to_string(stack.layer_of_element.size()) + " elements";
  for (const int layer : stack.layer_of_element)
    if (layer < -1 || layer >= static_cast<int>(most))
      return "an element in a layer that does not exist";
  return {};
}

std::string fault_of(const std::vector<VirtualControlVolumes::Role>& roles) {
  for (const auto& role : roles) {
    unsigned char byte = 0;
    std::memcpy(&byte, &role.own_shape, 1);
    if (byte > 1) return "a role that does not exist";
  }
  return {};
}

}  // namespace winslow::gui
