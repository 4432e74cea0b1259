#include "core/layers/layer_detection.h"

#include <map>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/layers/wall_chain.h"
#include "core/mesh/half_edge.h"
#include "core/mesh/topology.h"

namespace winslow {

namespace {

/// The elements between two neighbouring columns, row by row from the wall.
struct Strip {
  struct Row {
    std::array<Index, 2> elements{-1, -1};
    double height = 0;  ///< mean length of the edges of its two columns, in units of the mesh
  };
  std::size_t left = 0, right = 0;  ///< columns
  std::size_t chain = 0;            ///< number of its chain of wall edges
  bool fan = false;                 ///< its first element is a triangle with its tip on the wall
  std::vector<Row> rows;
  bool open = true;  ///< a row may follow
  LayerEnd end = LayerEnd::none;
  double next_height = 0;  ///< of the row that may follow
};

/// One row of a strip: a quadrilateral, or two triangles that are a quadrilateral together.
struct StripStep {
  Index left = -1, right = -1;            ///< next nodes of the two columns
  std::array<Index, 2> elements{-1, -1};  ///< second: -1 if the first is a quadrilateral
  OpenMesh::HalfedgeHandle top;           ///< from `left` to `right`, with the next row on its left
};

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Removes the rows above the first `rows` ones, for the reason `why`.
void shorten(Strip& strip, std::size_t rows, LayerEnd why) {
  if (strip.rows.size() <= rows) return;
  strip.rows.resize(rows);
  strip.end = why;
}

/// Why a row of this height and width (along the wall) is no layer: it is less than twice as wide
/// as high, or much higher or lower than the row below; none if it is a layer. Sectors of fans may
/// be narrow.
LayerEnd fault_of_row(const Strip& strip, double height, double width) {
  constexpr double least_aspect = 2, steepest_rise = 3, steepest_fall = 0.5;
  if (!strip.fan && width < least_aspect * height) return LayerEnd::isotropic;
  if (strip.rows.empty()) return LayerEnd::none;
  const double ratio = height / strip.rows.back().height;
  return ratio > steepest_rise || ratio < steepest_fall ? LayerEnd::growth : LayerEnd::none;
}

/// Calls close(s) for the open strips of each chain whose next rows are mostly lower than the rows
/// below: there the cells grow from another wall.
void close_where_heights_shrink(const std::vector<Strip>& strips,
                                const std::function<void(std::size_t)>& close) {
  constexpr double least_ratio = 0.95;
  std::map<std::size_t, std::vector<double>> ratios;
  for (const Strip& strip : strips) {
    if (!strip.open || strip.rows.empty()) continue;
    ratios[strip.chain].push_back(strip.next_height / strip.rows.back().height);
  }
  for (auto& [chain, values] : ratios) {
    if (median(values) >= least_ratio) continue;
    for (std::size_t s = 0; s < strips.size(); ++s) {
      if (strips[s].open && strips[s].chain == chain) close(s);
    }
  }
}

/// Removes the outermost rows of a chain up to the last row that is mostly higher than the row
/// below, by at least 1 %; all rows if there is none.
void end_where_growth_ends(std::vector<Strip>& strips, std::size_t chain) {
  constexpr double least_ratio = 1.01;
  std::size_t most = 0;
  for (const Strip& strip : strips) {
    if (strip.chain == chain) most = std::max(most, strip.rows.size());
  }
  std::size_t last = 0;  // rows that are left
  for (std::size_t k = 1; k < most; ++k) {
    std::vector<double> ratios;
    for (const Strip& strip : strips) {
      if (strip.chain != chain || strip.rows.size() <= k) continue;
      ratios.push_back(strip.rows[k].height / strip.rows[k - 1].height);
    }
    if (median(ratios) >= least_ratio) last = k + 1;
  }
  for (Strip& strip : strips) {
    if (strip.chain == chain) shorten(strip, last, LayerEnd::growth);
  }
}

/// Shortens strips to at most two rows more than the strips beside them; a sector of a fan to no
/// more rows than these.
void level_neighbours(std::vector<Strip>& strips, std::size_t columns) {
  std::vector<std::optional<std::size_t>> on_left(columns), on_right(columns);
  for (std::size_t s = 0; s < strips.size(); ++s) {
    on_right[strips[s].left] = s;
    on_left[strips[s].right] = s;
  }
  const auto settle = [&](std::size_t s) {
    bool changed = false;
    for (const auto& beside : {on_left[strips[s].left], on_right[strips[s].right]}) {
      if (!beside) continue;
      const std::size_t most = strips[*beside].rows.size() + (strips[s].fan ? 0 : 2);
      changed = changed || strips[s].rows.size() > most;
      shorten(strips[s], most, LayerEnd::neighbours);
    }
    return changed;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t s = 0; s < strips.size(); ++s) changed = settle(s) || changed;
    for (std::size_t s = strips.size(); s-- > 0;) changed = settle(s) || changed;
  }
}

/// The possible rows above an edge, which leads from the left column to the right one with the rows
/// on its left: one for a quadrilateral; for a triangle up to two, with the triangle beyond either
/// of its other sides; none at the boundary.
std::vector<StripStep> steps_above(const Topology& topology, OpenMesh::HalfedgeHandle edge) {
  const HalfEdgeMesh& mesh = topology.half_edges();
  const auto from = [&](auto h) { return mesh.from_vertex_handle(h).idx(); };
  const auto to = [&](auto h) { return mesh.to_vertex_handle(h).idx(); };
  const Index first = mesh.face_handle(edge).idx();
  if (first < 0) return {};
  const auto rising = mesh.next_halfedge_handle(edge);  // at the right column, if it is a quad
  const auto second_side = mesh.next_halfedge_handle(rising);
  const auto opposite = [&](auto h) { return mesh.opposite_halfedge_handle(h); };
  if (topology.element_type(first) == ElementType::quadrilateral) {
    return {{to(second_side), from(second_side), {first, -1}, opposite(second_side)}};
  }
  if (topology.element_type(first) != ElementType::triangle) return {};
  std::vector<StripStep> steps;
  // The diagonal is the right side of the triangle (its apex lies in the left column) or the left.
  for (const bool right : {true, false}) {
    const auto beyond = opposite(right ? rising : second_side);
    const Index second = mesh.face_handle(beyond).idx();
    if (second < 0 || topology.element_type(second) != ElementType::triangle) continue;
    const auto a = mesh.next_halfedge_handle(beyond), b = mesh.next_halfedge_handle(a);
    const auto far = right ? b : a;  // from the right column to the left one
    steps.push_back({to(far), from(far), {first, second}, opposite(far)});
  }
  return steps;
}

using HalfEdge = OpenMesh::HalfedgeHandle;

/// Detects the layers of a mesh from the walls, row by row. Columns have along_boundary set if they
/// stand at an end of a wall: they may lie on the next boundary.
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
    while (add_row()) {
    }
    if (extent_ == LayerExtent::stretched) {
      for (std::size_t k = 0; k < chains.size(); ++k) end_where_growth_ends(strips_, k);
      keep_clear();
      level_neighbours(strips_, columns_.size());
    }
    return stack();
  }

 private:
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
      LayerColumn column;
      column.wall_node = chain.nodes[i];
      column.wall = wall;
      column.along_boundary = end;
      column.nodes = {chain.nodes[i]};
      columns_.resize(last[i] + 1, column);
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
    strips_.push_back({left, right, chain, !edge.is_valid(), {}});
    tops_.push_back(edge);
  }

  /// Whether the strips on the two sides of a wall node have no next node in common, as at a
  /// trailing edge with a wake behind it. Then each strip has a column of its own there.
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

  /// The triangles at a wall node between the two quadrilaterals on its wall edges, in the order
  /// along the wall; none if the star has any other element.
  std::vector<Index> fan_triangles(Index node) const {
    const auto star = topology_.star(node);
    if (star.size() < 3 || !quad(star.front()) || !quad(star.back())) return {};
    std::vector<Index> triangles(star.rbegin() + 1, star.rend() - 1);
    if (std::ranges::any_of(
            triangles, [&](Index e) { return topology_.element_type(e) != ElementType::triangle; }))
      return {};
    return triangles;
  }

  /// The row at the wall in one sector of a fan: a triangle.
  StripStep fan_step(const Strip& strip) const {
    const Index node = columns_[strip.left].wall_node;
    std::size_t first = strip.left;
    while (first > 0 && columns_[first - 1].wall_node == node) --first;
    const Index element = fan_triangles(node)[strip.left - first];
    HalfEdge far = half_edges_.halfedge_handle(OpenMesh::FaceHandle(element));
    while (from(far) == node || to(far) == node) far = half_edges_.next_halfedge_handle(far);
    return {to(far), from(far), {element, -1}, half_edges_.opposite_halfedge_handle(far)};
  }

  /// The next rows of a strip with free elements and nodes; if there is none, `why` is the reason.
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
    const auto owner = column_of_node_.find(node);
    if (owner != column_of_node_.end() && owner->second != column) {
      why = LayerEnd::meeting;
      return false;
    }
    if (topology_.on_boundary(node) && !columns_[column].along_boundary) {
      why = LayerEnd::boundary;
      return false;
    }
    return true;
  }

  /// Adds the next row of all strips that have one. False if none has.
  bool add_row() {
    steps_.assign(strips_.size(), {});
    for (std::size_t s = 0; s < strips_.size(); ++s) {
      if (!strips_[s].open) continue;
      LayerEnd why = LayerEnd::none;
      steps_[s] = free_steps(s, why);
      if (steps_[s].empty()) close(s, why);
    }
    choose_next_nodes();
    close_at_shared_nodes();
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

  /// Chooses the next node of each column: one that the open strips on both of its sides can have;
  /// of several the one nearest to the direction of the column.
  void choose_next_nodes() {
    std::vector<std::optional<std::set<Index>>> candidates(columns_.size());
    const auto narrow = [&](std::size_t column, const std::set<Index>& nodes) {
      auto& known = candidates[column];
      if (!known) known = nodes;
      std::erase_if(*known, [&](Index node) { return !nodes.contains(node); });
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

  Index straightest(const LayerColumn& column, const std::set<Index>& nodes,
                    const Vec2& normal) const {
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

  /// Closes the strips of columns that have the same next node.
  void close_at_shared_nodes() {
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

  /// Closes strips without a row between the next nodes of their columns; for whole rows
  /// (LayerExtent::connected) also all strips beside these.
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

  /// Closes strips whose next row does not have the shape of a layer.
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

  /// Shortens columns to the share of a gap that the rules of insertion would give them.
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
      if (columns_[c].along_boundary || !(normals[c].norm() > 0)) continue;
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
      column_of_node_[next_[c]] = c;
    }
    return any;
  }

  /// Builds the result. A column is as high as the higher of the strips on its two sides.
  LayerStack stack() {
    LayerStack stack;
    stack.layer_of_element.assign(at(topology_.element_count()), -1);
    std::vector<std::size_t> rows(columns_.size(), 0);
    for (const Strip& strip : strips_) {
      stack.pairs.push_back({strip.left, strip.right});
      for (std::size_t k = 0; k < strip.rows.size(); ++k) {
        for (const Index e : strip.rows[k].elements) {
          if (e >= 0) stack.layer_of_element[at(e)] = static_cast<int>(k);
        }
      }
      for (const std::size_t c : {strip.left, strip.right}) {
        if (columns_[c].end != LayerEnd::none && strip.rows.size() < rows[c]) continue;
        rows[c] = strip.rows.size();
        columns_[c].end = strip.end;
      }
    }
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      columns_[c].nodes.resize(rows[c] + 1);
      columns_[c].along_boundary = false;
    }
    stack.columns = std::move(columns_);
    return stack;
  }

  const Mesh& mesh_;
  const Topology& topology_;
  const HalfEdgeMesh& half_edges_;
  const LayerOptions& options_;
  LayerExtent extent_;
  std::vector<LayerColumn> columns_;
  std::vector<Strip> strips_;
  std::vector<HalfEdge> tops_;  // of each strip: its upper edge; invalid under the tip of a fan
  std::vector<bool> used_;      // #elements: in a layer
  std::map<Index, std::size_t> column_of_node_;  // of nodes above the wall

  // For the row that is being added:
  std::vector<std::vector<StripStep>> steps_;  // of each strip
  std::vector<Index> next_;                    // of each column; -1: none
};

}  // namespace

LayerStack climb_layers(const Mesh& mesh, const LayerOptions& options, LayerExtent extent) {
  return Climb(mesh, options, extent).run();
}

}  // namespace winslow
