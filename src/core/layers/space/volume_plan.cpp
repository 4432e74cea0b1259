#include "core/layers/space/volume_plan.h"

#include "core/error.h"
#include "core/layers/space/ball_clearance.h"
#include "core/layers/space/column_direction.h"
#include "core/quality/validity.h"

namespace winslow {

namespace {

/// Height of a regular tetrahedron on edges of length 1.
const double regular_height = std::sqrt(2.0 / 3);

/// Sets the columns of a plan with the heights that are asked for, regardless of the room.
class ColumnPlanner {
 public:
  ColumnPlanner(const Mesh& mesh, const WallSurface& surface, LayerOptions& options)
      : mesh_(mesh), surface_(surface), options_(options), x_(mesh.coordinates) {}

  LayerStack plan() {
    agree_on_counts();
    const std::vector<ColumnDirection> directions = column_directions(mesh_, surface_);
    for (Index i = 0; i < size(); ++i) add_column(i, directions[at(i)]);
    blend();
    for (Index i = 0; i < size(); ++i) apply_override(stack_.columns[at(i)]);
    add_faces();
    require_columns(options_.overrides, stack_);
    return std::move(stack_);
  }

 private:
  Index size() const { return static_cast<Index>(surface_.nodes.size()); }
  LayerSpacing& spacing(int wall) { return options_.walls[at(wall)].spacing; }

  /// Walls that meet have the same number of layers, which matching the elements outside may raise.
  void agree_on_counts() {
    JoinedSets sets(options_.walls.size());
    for (Index i = 0; i < size(); ++i) {
      const auto faces = surface_.faces_at[i];
      for (const Index f : faces)
        sets.join(surface_.faces[at(faces.front())].wall, surface_.faces[at(f)].wall);
    }
    for (Index w = 0; w < static_cast<Index>(options_.walls.size()); ++w) {
      for (Index v = 0; v < w; ++v) {
        if (sets.find(v) != sets.find(w) || spacing(v).count == spacing(w).count) continue;
        const Index fewer = spacing(v).count < spacing(w).count ? v : w;
        if (!spacing(fewer).match_outside) refuse_counts(v, w);
        spacing(fewer).count = spacing(v + w - fewer).count;
      }
    }
  }

  [[noreturn]] void refuse_counts(Index v, Index w) {
    const auto text = [&](Index wall) {
      return "'" + options_.walls[at(wall)].markers.front() + "' " +
             std::to_string(spacing(wall).count);
    };
    throw UsageError("walls that meet need the same number of layers, but of marker " + text(v) +
                     " and of marker " + text(w) + " are asked for: give both the same number");
  }

  /// Mean length of the wall's edges at a node.
  double edge_length(Index i) const {
    double sum = 0;
    const auto edges = surface_.edges_at[i];
    for (const Index e : edges) {
      const auto& [a, b] = surface_.edges[at(e)].nodes;
      sum += (x_[b] - x_[a]).norm();
    }
    return sum / static_cast<double>(edges.size());
  }

  void add_column(Index i, const ColumnDirection& direction) {
    LayerColumn column;
    column.wall_node = surface_.nodes[at(i)];
    column.direction = direction.direction;
    column.slant = direction.slant;
    column.along_boundary = direction.along_boundary;
    std::vector<int> walls;
    for (const Index f : surface_.faces_at[i]) walls.push_back(surface_.faces[at(f)].wall);
    sort_unique(walls);
    column.wall = walls.front();
    // Where walls meet, the geometric mean of what they ask for.
    double first = 0, thickness = 0;
    for (const int w : walls) {
      const LayerSpacing& wanted = spacing(w);
      const auto heights = wanted.match_outside
                               ? layer_heights_ending_with(wanted, regular_height * edge_length(i))
                               : layer_heights(wanted);
      first += std::log(heights.front());
      thickness += std::log(sum_of(heights));
      if (walls.size() > 1) continue;
      column.first = heights.front();
      column.asked = sum_of(heights);
    }
    if (walls.size() > 1) {
      column.first = std::exp(first / static_cast<double>(walls.size()));
      column.asked = std::exp(thickness / static_cast<double>(walls.size()));
      several_ = true;
    }
    column.room = column.asked;
    constexpr double most = 0.6;  // of an edge that a column follows
    ends_.push_back(most * direction.edge / column.slant);
    stack_.columns.push_back(std::move(column));
  }

  /// Where walls meet, heights change smoothly along them by diffusion of their logarithms.
  void blend() {
    constexpr int passes = 16;  // about 5 columns on either side
    for (int pass = 0; several_ && pass < passes; ++pass) {
      const std::vector<LayerColumn> old = stack_.columns;
      for (Index i = 0; i < size(); ++i) {
        double first = 0, thickness = 0;
        for (const Index e : surface_.edges_at[i]) {
          const auto& ends = surface_.edges[at(e)].nodes;
          const Index other = ends[0] == surface_.nodes[at(i)] ? ends[1] : ends[0];
          first += std::log(old[at(surface_.number(other))].first / old[at(i)].first);
          thickness += std::log(old[at(surface_.number(other))].asked / old[at(i)].asked);
        }
        const auto count = static_cast<double>(surface_.edges_at[i].size());
        LayerColumn& column = stack_.columns[at(i)];
        column.first *= std::exp(0.5 * first / count);
        column.asked *= std::exp(0.5 * thickness / count);
      }
    }
    for (Index i = 0; i < size(); ++i) {
      LayerColumn& column = stack_.columns[at(i)];
      column.room = column.asked;
      if (!(ends_[at(i)] < column.room)) continue;
      column.room = ends_[at(i)];
      column.limit = LayerLimit::end;
    }
  }

  void apply_override(LayerColumn& column) const {
    const auto own = std::ranges::find(options_.overrides, column.wall_node, &ColumnOverride::node);
    if (own == options_.overrides.end()) return;
    const std::string node = "node " + std::to_string(own->node);
    if (own->columns && *own->columns > 1)
      throw UsageError(node + " cannot have several columns: volume meshes have no fans yet");
    if (!own->thickness) return;
    if (!(*own->thickness > 0))
      throw UsageError(node + " cannot be without layers: layers of volume meshes do not end yet");
    if (column.limit == LayerLimit::end && *own->thickness > column.room) return;
    column.prescribed = true;
    column.asked = column.room = *own->thickness;
    column.limit = LayerLimit::none;
  }

  void add_faces() {
    for (const WallFace& face : surface_.faces) {
      ColumnFace& own = stack_.faces.emplace_back();
      own.count = static_cast<int>(face.nodes.size());
      for (std::size_t k = 0; k < face.nodes.size(); ++k)
        own.columns[k] = at(surface_.number(face.nodes[k]));
    }
  }

  const Mesh& mesh_;
  const WallSurface& surface_;
  LayerOptions& options_;
  const SpacePoints x_;
  LayerStack stack_;
  std::vector<double> ends_;  // room along the edge of a curved boundary
  bool several_ = false;      // walls meet
};

/// Limits the room of columns. Rules only reduce the room, so they can be applied repeatedly and in
/// any order.
class RoomOfWalls {
 public:
  RoomOfWalls(LayerStack& stack, const WallSurface& surface, const LayerOptions& options,
              const Mesh& mesh)
      : columns_(stack.columns),
        faces_(stack.faces),
        surface_(surface),
        options_(options),
        mesh_(mesh),
        x_(mesh.coordinates) {
    const Topology& topology = *mesh.topology;
    for (Index e = 0; e < topology.element_count(); ++e) {
      const auto on_wall = [&](Index node) {
        return topology.on_boundary(node) && surface_.number(node) >= 0;
      };
      if (std::ranges::all_of(topology.element(e), on_wall)) elements_on_rim_.push_back(e);
    }
  }

  /// Limits layers on both sides of a gap to their shares of its width.
  void keep_clear() {
    const BallClearance clearance(mesh_);
    for (LayerColumn& c : columns_) {
      if (c.limit == LayerLimit::end) continue;
      const double reach = c.room * c.slant / (2 * options_.clearance);
      const double width = 2 * clearance.radius(c.wall_node, c.direction, reach);
      limit(c, options_.clearance * width / c.slant, LayerLimit::clearance);
    }
  }

  /// Applies the limits of faces, edges and steepness until nothing changes.
  void keep_gentle() {
    constexpr int most_sweeps = 200;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
      changed_ = false;
      for (const WallEdge& edge : surface_.edges) settle(edge);
      for (std::size_t f = 0; f < faces_.size(); ++f) settle(f);
      for (std::size_t e = surface_.edges.size(); e-- > 0;) settle(surface_.edges[e]);
      if (!changed_) break;
    }
  }

  /// Sets the heights of all columns to fit their room.
  void distribute() {
    require_room();
    for (LayerColumn& c : columns_) {
      LayerSpacing spacing = options_.walls[at(c.wall)].spacing;
      spacing.first = c.first;
      const auto count = static_cast<std::size_t>(spacing.count);
      const double all = static_cast<double>(count);
      if (options_.scale_all) {
        c.heights = layer_heights_within(spacing, c.asked);
        for (double& h : c.heights) h *= c.room / c.asked;
      } else {
        c.heights = layer_heights_within(spacing, c.room);
      }
      if (c.heights.size() != count) c.heights.assign(count, c.room / all);
    }
  }

  /// Makes columns thinner between which an element of the layers is nearly inverted, or an element
  /// outside that has all its nodes on the rim, so that no smoothing can mend it. False: there were
  /// none.
  bool reduce_inverted() {
    std::vector<std::size_t> bad;
    for (const ColumnFace& face : faces_) {
      if (!is_sound(face)) bad.insert(bad.end(), face.corners().begin(), face.corners().end());
    }
    for (const Index e : elements_on_rim_) {
      if (is_sound(e)) continue;
      for (const Index node : mesh_.topology->element(e)) bad.push_back(at(surface_.number(node)));
    }
    sort_unique(bad);
    constexpr double thinner = 0.8;
    for (const std::size_t c : bad) {
      columns_[c].room *= thinner;
      columns_[c].limit = LayerLimit::crossing;
    }
    return !bad.empty();
  }

 private:
  /// Thickness of layers that are all as high as the first.
  double constant_thickness(const LayerColumn& c) const {
    return options_.walls[at(c.wall)].spacing.count * c.first;
  }

  /// Refuses the plan at the column with the least room for its layers.
  void require_room() const {
    constexpr double least = 0.1;  // of the first height
    const auto share = [&](const LayerColumn& c) { return c.room / constant_thickness(c); };
    const LayerColumn& worst = *std::ranges::min_element(columns_, {}, share);
    if (!(share(worst) >= least)) refuse(worst);
  }

  [[noreturn]] void refuse(const LayerColumn& c) const {
    const auto number = [](double value) {
      char text[32];
      std::snprintf(text, sizeof text, "%.3g", value);
      return std::string(text);
    };
    const int count = options_.walls[at(c.wall)].spacing.count;
    throw UsageError("there is no room for " + std::to_string(count) + " layers above " +
                     node_text(mesh_, c.wall_node) + ": only " + number(c.room) +
                     " is left there (" + std::string(limit_name(c.limit)) +
                     "), and layers of the first height take " + number(constant_thickness(c)) +
                     "; ask for fewer or thinner layers");
  }

  void limit(LayerColumn& column, double room, LayerLimit reason) {
    if (column.prescribed) return;
    // Round-off is no reason for another sweep.
    if (!(room < column.room * (1 - 1e-9))) return;
    column.room = room;
    column.limit = reason;
    changed_ = true;
  }

  LayerColumn& column_at(Index node) { return columns_[at(surface_.number(node))]; }
  static Vec3 tip(const LayerColumn& c) { return c.room * c.slant * c.direction; }

  void settle(const WallEdge& of_wall) {
    LayerColumn &a = column_at(of_wall.nodes[0]), &b = column_at(of_wall.nodes[1]);
    const Vec3 edge = x_[b.wall_node] - x_[a.wall_node];
    const double length = edge.norm();
    limit(a, b.room + options_.steepest * length, LayerLimit::neighbour);
    limit(b, a.room + options_.steepest * length, LayerLimit::neighbour);
    // The part of the edge that each column covers.
    const double of_a = std::max(0.0, tip(a).dot(edge) / length);
    const double of_b = std::max(0.0, -tip(b).dot(edge) / length);
    constexpr double least_length = 0.65;
    const double most = (1 - std::max(options_.crossing, least_length)) * length;
    if (of_a + of_b <= most) return;
    const double scale = most / (of_a + of_b);
    if (of_a > 0) limit(a, a.room * scale, LayerLimit::crossing);
    if (of_b > 0) limit(b, b.room * scale, LayerLimit::crossing);
  }

  /// The corners of a face that span it: those of the triangle, or of all of the quadrilateral's.
  void settle(std::size_t f) {
    const auto corners = faces_[f].corners();
    if (corners.size() == 3) return settle(f, corners[0], corners[1], corners[2]);
    for (std::size_t k = 0; k < corners.size(); ++k)
      settle(f, corners[k], corners[(k + 1) % 4], corners[(k + 3) % 4]);
  }

  /// Keeps n.[(e1 + l1 - l0) x (e2 + l2 - l0)] >= q n.(e1 x e2), where l are the vectors to the
  /// tips.
  /// Columns without which the area were larger are scaled, which makes it a quadratic.
  void settle(std::size_t f, std::size_t c0, std::size_t c1, std::size_t c2) {
    constexpr double least_area = 0.45;
    const std::array<std::size_t, 3> corners{c0, c1, c2};
    const Vec3 p = x_[columns_[c0].wall_node];
    const Vec3 e1 = x_[columns_[c1].wall_node] - p, e2 = x_[columns_[c2].wall_node] - p;
    const Vec3& n = surface_.faces[f].normal;
    const std::array<Vec3, 3> tips{tip(columns_[c0]), tip(columns_[c1]), tip(columns_[c2])};
    const double least = least_area * n.dot(e1.cross(e2));
    const Vec3 f1 = e1 + tips[1] - tips[0], f2 = e2 + tips[2] - tips[0];
    if (n.dot(f1.cross(f2)) >= least) return;
    // The change of the area as each column grows.
    const std::array<double, 3> slopes{-n.dot(tips[0].cross(f2)) - n.dot(f1.cross(tips[0])),
                                       n.dot(tips[1].cross(f2)), n.dot(f1.cross(tips[2]))};
    for (const bool all : {false, true}) {
      std::array<Vec3, 3> fixed, scaled;
      for (std::size_t k = 0; k < 3; ++k) {
        const bool shrinks = all || slopes[k] < 0;
        fixed[k] = shrinks ? Vec3(0, 0, 0) : tips[k];
        scaled[k] = shrinks ? tips[k] : Vec3(0, 0, 0);
      }
      const Vec3 a1 = e1 + fixed[1] - fixed[0], a2 = e2 + fixed[2] - fixed[0];
      const Vec3 b1 = scaled[1] - scaled[0], b2 = scaled[2] - scaled[0];
      const double d0 = n.dot(a1.cross(a2)) - least;
      if (!(d0 > 0)) continue;
      const double t =
          first_positive_root(d0, n.dot(a1.cross(b2) + b1.cross(a2)), n.dot(b1.cross(b2)));
      for (std::size_t k = 0; k < 3; ++k) {
        LayerColumn& c = columns_[corners[k]];
        if (all || slopes[k] < 0) limit(c, c.room * std::min(t, 1.0), LayerLimit::crossing);
      }
      return;
    }
  }

  /// Whether the corners of the layers on a face, along straight columns, have a part of the volume
  /// that they would have in right prisms on the wall.
  bool is_sound(const ColumnFace& face) const {
    constexpr double least_volume = 0.2;
    const auto corners = face.corners();
    const ElementShape& shape =
        shape_of(corners.size() == 3 ? ElementType::prism : ElementType::hexahedron);
    const std::size_t n = corners.size();
    std::array<Vec3, 8> points;
    std::array<double, 4> heights{}, areas{};
    for (std::size_t k = 0; k < n; ++k) points[n + k] = x_[columns_[corners[k]].wall_node];
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3& p = points[n + k];
      areas[k] = (points[n + (k + 1) % n] - p).cross(points[n + (k + n - 1) % n] - p).norm();
    }
    for (std::size_t layer = 0; layer < columns_[corners[0]].count(); ++layer) {
      for (std::size_t k = 0; k < n; ++k) {
        const LayerColumn& c = columns_[corners[k]];
        points[k] = points[n + k];
        heights[k] += c.heights[layer];
        points[n + k] = x_[c.wall_node] + heights[k] * c.slant * c.direction;
      }
      const auto volume = [&](const std::array<Index, 4>& t) {
        const Vec3& o = points[at(t[0])];
        return (points[at(t[1])] - o).cross(points[at(t[2])] - o).dot(points[at(t[3])] - o);
      };
      const auto large = [&](const std::array<Index, 4>& t) {
        const std::size_t k = at(t[0]) % n;
        return volume(t) > least_volume * areas[k] * columns_[corners[k]].heights[layer];
      };
      if (!std::ranges::all_of(shape.corner_tetrahedra, large) ||
          !std::ranges::all_of(shape.edge_tetrahedra, [&](const auto& t) { return volume(t) > 0; }))
        return false;
    }
    return true;
  }

  /// Whether the corners of an element keep a part of their volume at the rim.
  bool is_sound(Index e) const {
    constexpr double least_volume = 0.2;
    const auto element = mesh_.topology->element(e);
    const auto volume = [&](const std::array<Index, 4>& t, double share) {
      std::array<Vec3, 4> p;
      for (std::size_t k = 0; k < 4; ++k) {
        const Index node = element[at(t[k])];
        p[k] = x_[node] + share * tip(columns_[at(surface_.number(node))]);
      }
      return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
    };
    return std::ranges::all_of(mesh_.topology->shape(e).corner_tetrahedra, [&](const auto& t) {
      return volume(t, 1) > least_volume * volume(t, 0);
    });
  }

  std::vector<LayerColumn>& columns_;
  const std::vector<ColumnFace>& faces_;
  const WallSurface& surface_;
  const LayerOptions& options_;
  const Mesh& mesh_;
  const SpacePoints x_;
  std::vector<Index> elements_on_rim_;  // of which all nodes are on walls
  bool changed_ = false;
};

}  // namespace

LayerStack plan_volume_layers(const Mesh& mesh, const LayerOptions& given) {
  require_kind(*mesh.topology, MeshKind::volume, "layers in space");
  validate(given);
  const WallSurface surface = find_wall_surface(mesh, given.walls);
  LayerOptions options = with_counts(given, mesh);
  LayerStack stack = ColumnPlanner(mesh, surface, options).plan();
  RoomOfWalls room(stack, surface, options, mesh);
  room.keep_clear();
  constexpr int most_rounds = 60;
  for (int round = 0; round < most_rounds; ++round) {
    room.keep_gentle();
    room.distribute();
    if (!room.reduce_inverted()) break;
  }
  return stack;
}

}  // namespace winslow
