#include "core/layers/layer_climb.h"

#include <map>
#include <set>
#include <utility>

#include "core/layers/clearance.h"
#include "core/layers/row_rules.h"
#include "core/layers/wall_chain.h"

namespace winslow {

namespace {

using HalfEdge = OpenMesh::HalfedgeHandle;

class Climb {
 public:
  Climb(const Mesh& mesh, const LayerOptions& options, LayerExtent extent)
      : mesh_(mesh),
        topology_(*mesh.topology),
        half_edges_(topology_.half_edges()),
        options_(options),
        extent_(extent),
        used_(at(topology_.element_count()), false) {}

  LayerStack run() {
    const auto chains = find_wall_chains(mesh_, options_.walls);
    for (std::size_t k = 0; k < chains.size(); ++k) add_chain(chains[k], k);
    while (row()) {
    }
    if (extent_ == LayerExtent::stretched) {
      for (std::size_t k = 0; k < chains.size(); ++k) end_where_growth_ends(strips_, k);
      keep_clear();
      level_neighbours(strips_, columns_.size());
    }
    return stack();
  }

 private:
  struct Column {
    Index wall_node = -1;
    int wall = 0;
    bool end_of_wall = false;  ///< it may lie on the next boundary
    std::vector<Index> nodes;
  };

  bool quad(Index e) const { return topology_.element_type(e) == ElementType::quadrilateral; }
  Index from(HalfEdge h) const { return half_edges_.from_vertex_handle(h).idx(); }
  Index to(HalfEdge h) const { return half_edges_.to_vertex_handle(h).idx(); }
  Vec2 xy(Index node) const { return mesh_.coordinates.xy(node); }

  HalfEdge wall_edge(const WallChain& chain, std::size_t i) const {
    return half_edges_.find_halfedge(OpenMesh::VertexHandle(chain.node(i)),
                                     OpenMesh::VertexHandle(chain.node(i + 1)));
  }

  /// Columns and strips on one chain, at the wall.
  void add_chain(const WallChain& chain, std::size_t number) {
    const std::size_t n = chain.nodes.size();
    std::vector<std::size_t> first(n), last(n);
    std::vector<bool> fan(n);
    for (std::size_t i = 0; i < n; ++i) {
      const bool end = !chain.closed && (i == 0 || i + 1 == n);
      const std::size_t sectors = end ? 0 : fan_triangles(chain.nodes[i]).size();
      fan[i] = sectors > 0;
      const bool parted = !end && !fan[i] && parts(chain, i);
      first[i] = columns_.size();
      last[i] = first[i] + (parted ? 1 : sectors);
      const auto wall = static_cast<int>(chain.wall[std::min(i, chain.wall.size() - 1)]);
      columns_.resize(last[i] + 1, {chain.nodes[i], wall, end, {chain.nodes[i]}});
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (fan[i]) {
        for (std::size_t c = first[i]; c < last[i]; ++c) add_strip(c, c + 1, HalfEdge(), number);
      }
      if (i >= chain.edge_count()) continue;
      add_strip(last[i], first[(i + 1) % n], wall_edge(chain, i), number);
    }
  }

  void add_strip(std::size_t left, std::size_t right, HalfEdge edge, std::size_t chain) {
    Strip strip;
    strip.left = left;
    strip.right = right;
    strip.chain = chain;
    strip.fan = !edge.is_valid();
    strips_.push_back(std::move(strip));
    tops_.push_back(edge);
  }

  /// Whether the strips on the two sides of a wall node have no next node in common, as at a
  /// trailing edge with a wake behind it: each has a column of its own there.
  bool parts(const WallChain& chain, std::size_t i) const {
    if (extent_ == LayerExtent::connected) return false;
    const std::size_t before = (i + chain.edge_count() - 1) % chain.edge_count();
    const auto left = steps_above(topology_, wall_edge(chain, before));
    const auto right = steps_above(topology_, wall_edge(chain, i));
    if (left.empty() || right.empty()) return false;
    return std::ranges::none_of(left, [&](const StripStep& l) {
      return std::ranges::any_of(right, [&](const StripStep& r) { return r.left == l.right; });
    });
  }

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

  /// The triangle at the wall under one sector of a fan.
  StripStep fan_step(const Strip& strip) const {
    const Index node = columns_[strip.left].wall_node;
    std::size_t first = strip.left;
    while (first > 0 && columns_[first - 1].wall_node == node) --first;
    const Index element = fan_triangles(node)[strip.left - first];
    HalfEdge far = half_edges_.halfedge_handle(OpenMesh::FaceHandle(element));
    while (from(far) == node || to(far) == node) far = half_edges_.next_halfedge_handle(far);
    return {to(far), from(far), {element, -1}, half_edges_.opposite_halfedge_handle(far)};
  }

  /// The steps that a strip may take, as far as elements and nodes are free; else why not.
  std::vector<StripStep> free_steps(std::size_t s, LayerEnd& why) const {
    const Strip& strip = strips_[s];
    std::vector<StripStep> steps;
    if (!tops_[s].is_valid()) {
      steps.push_back(fan_step(strip));
    } else {
      steps = steps_above(topology_, tops_[s]);
    }
    why = LayerEnd::elements;
    std::erase_if(steps, [&](const StripStep& step) {
      const bool pair = step.elements[1] >= 0;
      if (used_[at(step.elements[0])] || (pair && used_[at(step.elements[1])])) {
        why = LayerEnd::meeting;
        return true;
      }
      if (pair && extent_ == LayerExtent::connected) return true;
      return !usable(step.left, strip.left, why) || !usable(step.right, strip.right, why);
    });
    const int most = options_.walls[at(columns_[strip.left].wall)].spacing.count;
    if (static_cast<int>(strip.rows.size()) >= most) {
      why = LayerEnd::count;
      steps.clear();
    }
    return steps;
  }

  bool usable(Index node, std::size_t column, LayerEnd& why) const {
    const auto taken = taken_.find(node);
    if (taken != taken_.end() && taken->second != column) {
      why = LayerEnd::meeting;
      return false;
    }
    if (topology_.on_boundary(node) && !columns_[column].end_of_wall) {
      why = LayerEnd::boundary;
      return false;
    }
    return true;
  }

  /// One row more wherever there is one. False if there is none.
  bool row() {
    steps_.assign(strips_.size(), {});
    for (std::size_t s = 0; s < strips_.size(); ++s) {
      if (!strips_[s].open) continue;
      LayerEnd why = LayerEnd::none;
      steps_[s] = free_steps(s, why);
      if (steps_[s].empty()) close(s, why);
    }
    choose_next_nodes();
    part_claims();
    settle();
    if (extent_ == LayerExtent::stretched) {
      judge_shapes();
      settle();
    }
    return add_next_rows();
  }

  void close(std::size_t s, LayerEnd why) {
    strips_[s].open = false;
    strips_[s].end = why;
    steps_[s].clear();
  }

  /// Where a column goes on to: a node that the open strips on both of its sides can go on to;
  /// if there are several, the one that lies most nearly in the direction of the column.
  void choose_next_nodes() {
    std::vector<std::optional<std::set<Index>>> candidates(columns_.size());
    const auto narrow = [&](std::size_t column, const std::set<Index>& nodes) {
      auto& known = candidates[column];
      if (!known) {
        known = nodes;
      } else {
        std::erase_if(*known, [&](Index node) { return !nodes.contains(node); });
      }
    };
    std::vector<Vec2> normals(columns_.size(), Vec2(0, 0));
    for (std::size_t s = 0; s < strips_.size(); ++s) {
      if (!strips_[s].open) continue;
      std::set<Index> lefts, rights;
      for (const StripStep& step : steps_[s]) {
        lefts.insert(step.left);
        rights.insert(step.right);
      }
      narrow(strips_[s].left, lefts);
      narrow(strips_[s].right, rights);
      const Vec2 along =
          xy(columns_[strips_[s].right].nodes.back()) - xy(columns_[strips_[s].left].nodes.back());
      const Vec2 normal = Vec2(-along.y(), along.x()) / std::max(along.norm(), 1e-300);
      normals[strips_[s].left] += normal;
      normals[strips_[s].right] += normal;
    }
    next_.assign(columns_.size(), -1);
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (candidates[c]) next_[c] = straightest(columns_[c], *candidates[c], normals[c]);
    }
  }

  Index straightest(const Column& column, const std::set<Index>& nodes, const Vec2& normal) const {
    const Vec2 tip = xy(column.nodes.back());
    Vec2 direction = normal.normalized();
    if (column.nodes.size() > 1) {
      direction += (tip - xy(column.nodes[column.nodes.size() - 2])).normalized();
    }
    const auto deviation = [&](Index node) {
      return -direction.dot((xy(node) - tip).normalized());
    };
    const auto best = std::ranges::min_element(nodes, {}, deviation);
    return best == nodes.end() ? -1 : *best;
  }

  /// A node that two columns claim belongs to neither.
  void part_claims() {
    std::map<Index, std::size_t> claims;
    for (const Index node : next_) ++claims[node];
    for (std::size_t s = 0; s < strips_.size(); ++s) {
      if (!strips_[s].open) continue;
      for (const std::size_t c : {strips_[s].left, strips_[s].right}) {
        if (next_[c] < 0 || claims[next_[c]] < 2 || !strips_[s].open) continue;
        close(s, strips_[s].rows.empty() ? LayerEnd::elements : LayerEnd::meeting);
      }
    }
  }

  /// Closes strips whose columns do not go on to nodes of one and the same step; in whole rows, all
  /// others beside them as well.
  void settle() {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t s = 0; s < strips_.size(); ++s) {
        const Strip& strip = strips_[s];
        if (strip.open) {
          std::erase_if(steps_[s], [&](const StripStep& step) {
            return step.left != next_[strip.left] || step.right != next_[strip.right];
          });
          if (!steps_[s].empty()) continue;
          close(s, LayerEnd::elements);
          changed = true;
        }
        if (extent_ == LayerExtent::stretched) continue;
        for (const std::size_t c : {strip.left, strip.right}) {
          changed = changed || next_[c] >= 0;
          next_[c] = -1;
        }
      }
    }
  }

  /// Closes strips whose next row is none of layers.
  void judge_shapes() {
    for (std::size_t s = 0; s < strips_.size(); ++s) {
      Strip& strip = strips_[s];
      if (!strip.open) continue;
      const StripStep& step = steps_[s].front();
      const Vec2 left = xy(columns_[strip.left].nodes.back());
      const Vec2 right = xy(columns_[strip.right].nodes.back());
      const double height = 0.5 * ((xy(step.left) - left).norm() + (xy(step.right) - right).norm());
      const double bottom = (right - left).norm(), top = (xy(step.right) - xy(step.left)).norm();
      const LayerEnd fault = fault_of_row(strip, height, 0.5 * (bottom + top));
      strip.next_height = height;
      if (fault != LayerEnd::none) close(s, fault);
    }
    close_where_heights_shrink(strips_, [&](std::size_t s) { close(s, LayerEnd::growth); });
  }

  /// Columns take no more of a gap than the rules of insertion would give them.
  void keep_clear() {
    std::vector<Vec2> normals(columns_.size(), Vec2(0, 0));
    double tallest = 0;
    for (const Strip& strip : strips_) {
      const Vec2 along = xy(columns_[strip.right].wall_node) - xy(columns_[strip.left].wall_node);
      if (along.norm() > 0) {
        const Vec2 normal = Vec2(-along.y(), along.x()).normalized();
        normals[strip.left] += normal;
        normals[strip.right] += normal;
      }
      double height = 0;
      for (const Strip::Row& row : strip.rows) height += row.height;
      tallest = std::max(tallest, height);
    }
    if (tallest == 0) return;
    const Clearance clearance(topology_, mesh_.coordinates, tallest / options_.clearance);
    std::vector<std::size_t> most(columns_.size());
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const auto& nodes = columns_[c].nodes;
      most[c] = nodes.size() - 1;
      if (columns_[c].end_of_wall || !(normals[c].norm() > 0)) continue;
      const double width = 2 * clearance.radius(nodes.front(), normals[c].normalized());
      double height = 0;
      for (std::size_t k = 0; k < most[c]; ++k) {
        height += (xy(nodes[k + 1]) - xy(nodes[k])).norm();
        if (height > options_.clearance * width) most[c] = k;
      }
    }
    for (Strip& strip : strips_) {
      shorten(strip, std::min(most[strip.left], most[strip.right]), LayerEnd::clearance);
    }
  }

  bool add_next_rows() {
    bool any = false;
    std::vector<bool> rises(columns_.size(), false);
    for (std::size_t s = 0; s < strips_.size(); ++s) {
      Strip& strip = strips_[s];
      if (!strip.open) continue;
      const StripStep& step = steps_[s].front();
      strip.rows.push_back({step.elements, strip.next_height});
      for (const Index e : step.elements) {
        if (e >= 0) used_[at(e)] = true;
      }
      tops_[s] = step.top;
      rises[strip.left] = rises[strip.right] = any = true;
    }
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (!rises[c]) continue;
      columns_[c].nodes.push_back(next_[c]);
      taken_[next_[c]] = c;
    }
    return any;
  }

  /// Columns as high as the higher one of the strips beside them.
  LayerStack stack() const {
    LayerStack stack;
    stack.layer_of_element.assign(at(topology_.element_count()), -1);
    std::vector<std::size_t> rows(columns_.size(), 0);
    std::vector<LayerEnd> ends(columns_.size(), LayerEnd::none);
    for (const Strip& strip : strips_) {
      stack.pairs.push_back({strip.left, strip.right});
      for (std::size_t k = 0; k < strip.rows.size(); ++k) {
        for (const Index e : strip.rows[k].elements) {
          if (e >= 0) stack.layer_of_element[at(e)] = static_cast<int>(k);
        }
      }
      for (const std::size_t c : {strip.left, strip.right}) {
        if (ends[c] != LayerEnd::none && strip.rows.size() < rows[c]) continue;
        rows[c] = strip.rows.size();
        ends[c] = strip.end;
      }
    }
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      LayerColumn column;
      column.wall_node = columns_[c].wall_node;
      column.wall = columns_[c].wall;
      const auto begin = columns_[c].nodes.begin();
      column.nodes.assign(begin, begin + static_cast<std::ptrdiff_t>(rows[c]) + 1);
      column.end = ends[c];
      stack.columns.push_back(std::move(column));
    }
    return stack;
  }

  const Mesh& mesh_;
  const Topology& topology_;
  const HalfEdgeMesh& half_edges_;
  const LayerOptions& options_;
  LayerExtent extent_;
  std::vector<Column> columns_;
  std::vector<Strip> strips_;
  std::vector<HalfEdge> tops_;  // of each strip: its upper edge; invalid under the tip of a fan
  std::vector<bool> used_;      // #elements: in a layer
  std::map<Index, std::size_t> taken_;  // column of each node above the wall

  // Of the row that is being looked for.
  std::vector<std::vector<StripStep>> steps_;  // of each strip
  std::vector<Index> next_;                    // of each column; -1: none
};

}  // namespace

LayerStack climb_layers(const Mesh& mesh, const LayerOptions& options, LayerExtent extent) {
  return Climb(mesh, options, extent).run();
}

}  // namespace winslow
