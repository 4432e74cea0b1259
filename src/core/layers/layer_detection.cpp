#include "core/layers/layer_detection.h"

#include <map>

#include "core/error.h"
#include "core/mesh/topology.h"

namespace winslow {

namespace {

std::string names_of(const LayerOptions& options) {
  std::vector<std::string> names;
  for (const LayerWall& wall : options.walls)
    names.insert(names.end(), wall.markers.begin(), wall.markers.end());
  return listed(names, [](const std::string& name) { return "'" + name + "'"; });
}

std::string reason_for_none(LayerEnd end) {
  switch (end) {
    case LayerEnd::isotropic:
      return "its elements are less than twice as long as high";
    case LayerEnd::growth:
      return "the heights of its elements do not grow from there";
    case LayerEnd::clearance:
      return "another boundary is too near";
    default:
      return "no rows of quadrilaterals, or of triangles in pairs, stand on it";
  }
}

/// Throws if no column has a layer.
void require_layers(const LayerStack& stack, const LayerOptions& options, LayerExtent extent) {
  std::map<LayerEnd, std::size_t> ends;
  for (const LayerColumn& column : stack.columns) {
    if (column.nodes.size() > 1) return;
    ++ends[column.end];
  }
  // The shapes of elements are a better reason than columns that were not found at all.
  const auto most = ends.contains(LayerEnd::isotropic) ? LayerEnd::isotropic
                    : ends.contains(LayerEnd::growth)  ? LayerEnd::growth
                                                       : ends.begin()->first;
  throw UsageError("the mesh has no layers at " + names_of(options) + ": " +
                   (extent == LayerExtent::connected
                        ? "no rows of quadrilaterals all along it stand on it"
                        : reason_for_none(most)));
}

/// Sets directions, slants and heights of the columns and, if `course`, their bends.
void measure(LayerStack& stack, const Mesh& mesh, bool course) {
  const Coordinates& x = mesh.coordinates;
  for (LayerColumn& column : stack.columns) {
    column.heights.assign(column.nodes.size() - 1, 0.0);
    if (course) column.bends = column.heights;
    column.along_boundary = column.count() > 0 && mesh.topology->on_boundary(column.nodes[1]);
  }
  const auto stands = column_stands(stack, x);
  for (std::size_t c = 0; c < stack.columns.size(); ++c) {
    LayerColumn& column = stack.columns[c];
    set_stand(column, stands[c]);
    for (std::size_t k = 0; k < column.count(); ++k) {
      const Vec2 edge = x.xy(column.nodes[k + 1]) - x.xy(column.nodes[k]);
      column.heights[k] = edge.norm() / column.slant;
      if (course) column.bends[k] = turn_between(column.plane_direction(), edge);
    }
    column.first = column.count() > 0 ? column.heights[0] : 0;
    column.asked = column.room = column.thickness();
  }
}

/// Appends the known columns of other walls to the stack of found ones. Returns the index of each
/// known column in it; none for a column on a node of the found walls that was not found again.
std::vector<std::optional<std::size_t>> join_columns(LayerStack& found, const LayerStack& known) {
  std::multimap<Index, std::size_t> by_node;
  for (std::size_t c = 0; c < found.columns.size(); ++c)
    by_node.emplace(found.columns[c].wall_node, c);
  std::vector<std::optional<std::size_t>> place(known.columns.size());
  for (std::size_t c = 0; c < known.columns.size(); ++c) {
    const LayerColumn& column = known.columns[c];
    auto [first, last] = by_node.equal_range(column.wall_node);
    if (first == last) {
      place[c] = found.columns.size();
      found.columns.push_back(column);
    }
    const auto second = [](const LayerColumn& l) { return l.nodes.size() < 2 ? -1 : l.nodes[1]; };
    for (; first != last; ++first)
      if (second(found.columns[first->second]) == second(column)) place[c] = first->second;
  }
  return place;
}

}  // namespace

LayerStack with_other_layers(LayerStack found, const LayerStack& known, const Topology& topology) {
  require_plane(topology, "layers");
  const std::size_t own = found.columns.size();
  const auto place = join_columns(found, known);
  for (const ColumnPair& pair : known.pairs) {
    const auto left = place[pair.left], right = place[pair.right];
    if (left && right && (*left >= own || *right >= own)) found.pairs.push_back({*left, *right});
  }
  std::vector<bool> in_column(at(topology.node_count()), false);
  for (const LayerColumn& column : found.columns)
    for (const Index node : column.nodes) in_column[at(node)] = true;
  for (std::size_t e = 0; e < known.layer_of_element.size(); ++e) {
    const auto corners = topology.element(static_cast<Index>(e));
    if (found.layer_of_element[e] < 0 &&
        std::ranges::all_of(corners, [&](Index node) { return in_column[at(node)]; }))
      found.layer_of_element[e] = known.layer_of_element[e];
  }
  return found;
}

LayerStack detect_layers(const Mesh& mesh, const LayerOptions& options, LayerExtent extent) {
  if (options.walls.empty()) throw UsageError("no wall is given to look for layers at");
  require_plane(*mesh.topology, "layers");
  LayerStack stack = climb_layers(mesh, options, extent);
  require_layers(stack, options, extent);
  measure(stack, mesh, extent == LayerExtent::stretched);
  return stack;
}

void respace_layers(LayerStack& stack, const Mesh& mesh, const LayerOptions& options) {
  // A plan finds the room of each column; its columns by wall node.
  const LayerStack plan = plan_layers(mesh, options);
  std::map<Index, const LayerColumn*> planned;
  for (const LayerColumn& column : plan.columns) planned.emplace(column.wall_node, &column);
  for (LayerColumn& column : stack.columns) {
    const auto found = planned.find(column.wall_node);
    if (found == planned.end() || column.count() == 0) continue;
    LayerSpacing spacing = options.walls[at(column.wall)].spacing;
    spacing.count = static_cast<int>(column.count());
    spacing.first = found->second->first;
    LayerSpacing plain = spacing;
    plain.match_outside = false;
    const double natural = sum_of(layer_heights(plain));
    const auto heights = layer_heights_within(spacing, std::min(natural, found->second->room));
    if (heights.size() != column.count()) {
      throw UsageError("there is no room for " + std::to_string(column.count()) +
                       " layers at node " + std::to_string(column.wall_node) +
                       "; choose a smaller first height");
    }
    column.heights = heights;
    column.first = spacing.first;
    column.asked = natural;
    column.room = found->second->room;
    column.limit = found->second->limit;
  }
}

}  // namespace winslow
