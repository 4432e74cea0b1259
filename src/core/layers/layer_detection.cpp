#include "core/layers/layer_detection.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/error.h"
#include "core/layers/wall_chain.h"
#include "core/mesh/half_edge.h"

namespace winslow {

namespace {

using HalfEdge = OpenMesh::HalfedgeHandle;

/// Where the strip of elements between two columns has come to.
struct Strip {
  std::size_t left = 0, right = 0;  // columns
  HalfEdge top;                     // between their topmost nodes; invalid under the tip of a fan
  bool open = true;
};

class Detector {
 public:
  Detector(const Mesh& mesh, const LayerOptions& options)
      : mesh_(mesh),
        topology_(*mesh.topology),
        half_edges_(topology_.half_edges()),
        options_(options) {
    stack_.layer_of_element.assign(at(topology_.element_count()), -1);
  }

  LayerStack detect() {
    for (const WallChain& chain : find_wall_chains(mesh_, options_.walls)) add_chain(chain);
    while (climb()) {
    }
    measure();
    return std::move(stack_);
  }

 private:
  /// Columns and strips on one chain, at the wall.
  void add_chain(const WallChain& chain) {
    const std::size_t first = stack_.columns.size();
    const std::size_t n = chain.nodes.size();
    for (std::size_t i = 0; i < n; ++i) {
      const bool end = !chain.closed && (i == 0 || i + 1 == n);
      const auto wall = static_cast<int>(chain.wall[std::min(i, chain.wall.size() - 1)]);
      const std::size_t count = end ? 1 : 1 + fan_triangles(chain.nodes[i]).size();
      for (std::size_t k = 0; k < count; ++k) {
        LayerColumn column;
        column.wall_node = chain.nodes[i];
        column.wall = wall;
        column.nodes = {chain.nodes[i]};
        stack_.columns.push_back(column);
      }
    }
    const std::size_t last = stack_.columns.size() - 1;
    for (std::size_t c = first; c < last; ++c) add_strip(c, c + 1);
    if (chain.closed) add_strip(last, first);
  }

  void add_strip(std::size_t left, std::size_t right) {
    stack_.pairs.push_back({left, right});
    sides_.resize(stack_.columns.size(), 0);
    ++sides_[left];
    ++sides_[right];
    const OpenMesh::VertexHandle from(stack_.columns[left].wall_node);
    const OpenMesh::VertexHandle to(stack_.columns[right].wall_node);
    strips_.push_back(
        {left, right, from == to ? HalfEdge() : half_edges_.find_halfedge(from, to), true});
  }

  bool quad(Index e) const { return topology_.element_type(e) == ElementType::quadrilateral; }

  /// The triangles at a wall node between two quadrilaterals on its wall edges, in the order along
  /// the wall: all that its star has besides these; none if it has other elements too.
  std::vector<Index> fan_triangles(Index node) const {
    const auto star = topology_.star(node);
    if (star.size() < 3 || !quad(star.front()) || !quad(star.back())) return {};
    std::vector<Index> triangles(star.rbegin() + 1, star.rend() - 1);
    if (std::any_of(triangles.begin(), triangles.end(), [&](Index e) { return quad(e); }))
      return {};
    return triangles;
  }

  /// The element above a strip, and the edge on its far side.
  struct Step {
    Index element = -1;
    HalfEdge far;  // as the element has it: from the right column to the left one
  };
  std::optional<Step> step_of(const Strip& strip) const {
    if (!strip.top.is_valid()) return fan_step(strip);
    const Index element = half_edges_.face_handle(strip.top).idx();
    if (element < 0 || !quad(element)) return std::nullopt;
    return Step{element,
                half_edges_.next_halfedge_handle(half_edges_.next_halfedge_handle(strip.top))};
  }

  /// The triangle at the wall under one sector of a fan.
  Step fan_step(const Strip& strip) const {
    const Index node = stack_.columns[strip.left].wall_node;
    std::size_t first = strip.left;
    while (first > 0 && stack_.columns[first - 1].wall_node == node) --first;
    const Index element = fan_triangles(node)[strip.left - first];
    HalfEdge far = half_edges_.halfedge_handle(OpenMesh::FaceHandle(element));
    while (from(far) == node || to(far) == node) far = half_edges_.next_halfedge_handle(far);
    return {element, far};
  }

  Index from(HalfEdge h) const { return half_edges_.from_vertex_handle(h).idx(); }
  Index to(HalfEdge h) const { return half_edges_.to_vertex_handle(h).idx(); }

  /// One layer more where the strips on both sides of columns agree. False if there is none.
  bool climb() {
    std::vector<std::optional<Step>> steps(strips_.size());
    std::vector<Index> next(stack_.columns.size(), -1);
    constexpr Index disagreed = -2;
    const auto propose = [&](std::size_t column, Index node) {
      Index& known = next[column];
      known = known == -1 || known == node ? node : disagreed;
    };
    for (std::size_t s = 0; s < strips_.size(); ++s) {
      Strip& strip = strips_[s];
      if (!strip.open) continue;
      steps[s] = step_of(strip);
      if (!steps[s] || !may_rise(strip.left) || !may_rise(strip.right)) steps[s].reset();
      if (steps[s]) {
        propose(strip.left, to(steps[s]->far));
        propose(strip.right, from(steps[s]->far));
      }
    }
    // A strip goes on if both of its columns do; a column if all of its strips that are open do.
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t s = 0; s < strips_.size(); ++s) {
        const bool rises = steps[s] && usable(next[strips_[s].left], strips_[s].left) &&
                           usable(next[strips_[s].right], strips_[s].right);
        if (rises || !strips_[s].open) continue;
        for (const std::size_t column : {strips_[s].left, strips_[s].right}) {
          changed = changed || next[column] >= 0;
          next[column] = disagreed;
        }
        strips_[s].open = false;
        steps[s].reset();
        changed = true;
      }
    }
    bool any = false;
    for (std::size_t s = 0; s < strips_.size(); ++s) {
      if (!strips_[s].open || !steps[s]) continue;
      any = true;
      const int layer = static_cast<int>(stack_.columns[strips_[s].left].nodes.size()) - 1;
      stack_.layer_of_element[at(steps[s]->element)] = layer;
      strips_[s].top = half_edges_.opposite_halfedge_handle(steps[s]->far);
    }
    for (std::size_t c = 0; c < next.size(); ++c) {
      if (next[c] >= 0 && any) {
        stack_.columns[c].nodes.push_back(next[c]);
        taken_[next[c]] = c;
      }
    }
    return any;
  }

  bool may_rise(std::size_t column) const {
    const LayerColumn& c = stack_.columns[column];
    const int most = options_.walls[static_cast<std::size_t>(c.wall)].spacing.count;
    return static_cast<int>(c.nodes.size()) - 1 < most;
  }

  /// A node that a column may go on to: not another column's, and not held, unless the column has a
  /// strip on one side only, at the end of a wall.
  bool usable(Index node, std::size_t column) const {
    if (node < 0) return false;
    const auto taken = taken_.find(node);
    if (taken != taken_.end() && taken->second != column) return false;
    return !topology_.on_boundary(node) || sides_[column] == 1;
  }

  /// How the columns stand, and the heights that they have.
  void measure() {
    bool any = false;
    for (LayerColumn& column : stack_.columns) {
      column.heights.assign(column.nodes.size() - 1, 0.0);
      column.along_boundary = column.count() > 0 && topology_.on_boundary(column.nodes[1]);
      any = any || column.count() > 0;
    }
    if (!any) throw UsageError("the mesh has no layers of quadrilaterals at any of these walls");
    const auto stands = column_stands(stack_, mesh_.coordinates);
    for (std::size_t c = 0; c < stack_.columns.size(); ++c) {
      LayerColumn& column = stack_.columns[c];
      column.direction = stands[c].direction;
      column.slant = stands[c].slant;
      for (std::size_t k = 0; k < column.count(); ++k) {
        const Vec2 edge =
            mesh_.coordinates.xy(column.nodes[k + 1]) - mesh_.coordinates.xy(column.nodes[k]);
        column.heights[k] = edge.norm() / column.slant;
      }
      column.first = column.count() > 0 ? column.heights[0] : 0;
      column.asked = column.room = column.thickness();
    }
  }

  const Mesh& mesh_;
  const Topology& topology_;
  const HalfEdgeMesh& half_edges_;
  const LayerOptions& options_;
  LayerStack stack_;
  std::vector<Strip> strips_;
  std::vector<int> sides_;  // strips of each column
  std::map<Index, std::size_t> taken_;
};

}  // namespace

namespace {

/// Place of each known column in the stack of found ones, those of other walls appended to it. On
/// a node where walls meet the found columns count; none: a known one that is not among them.
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

LayerStack detect_layers(const Mesh& mesh, const LayerOptions& options) {
  if (options.walls.empty()) throw UsageError("no wall is given to look for layers at");
  require_plane(*mesh.topology, "layers");
  return Detector(mesh, options).detect();
}

void respace_layers(LayerStack& stack, const Mesh& mesh, const LayerOptions& options) {
  // The columns of a plan, by wall node: it knows the room there is.
  const LayerStack plan = plan_layers(mesh, options);
  std::map<Index, const LayerColumn*> planned;
  for (const LayerColumn& column : plan.columns) planned.emplace(column.wall_node, &column);
  for (LayerColumn& column : stack.columns) {
    const auto found = planned.find(column.wall_node);
    if (found == planned.end() || column.count() == 0) continue;
    LayerSpacing spacing = options.walls[static_cast<std::size_t>(column.wall)].spacing;
    spacing.count = static_cast<int>(column.count());
    spacing.first = found->second->first;
    const double natural = [&] {
      LayerSpacing plain = spacing;
      plain.match_outside = false;
      double sum = 0;
      for (const double h : layer_heights(plain)) sum += h;
      return sum;
    }();
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
