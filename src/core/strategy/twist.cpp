#include "core/strategy/twist.h"

#include <Eigen/Geometry>

#include "core/linear/linear_solver.h"
#include "core/linear/pattern_builder.h"

namespace winslow {

namespace {

/// A rigid motion as the flow of a constant velocity field: v(x) = linear + angular x (x - origin).
struct Velocity {
  Vec3 angular{0, 0, 0}, linear{0, 0, 0};
};

/// The field whose flow during unit time is the part of a motion between two fractions.
Velocity velocity_between(const RigidMotion& motion, double from, double to, const Vec3& origin) {
  const double angle = radians(motion.rotate) * (to - from);
  const Vec3 axis = axis_of(motion).normalized();
  const Vec3 pivot = pivot_of(motion) + from * motion.translate;
  const Vec3 way = (to - from) * motion.translate;
  const Vec3 along = axis.dot(way) * axis, across = way - along;
  const double half = 0.5 * angle;
  // half * cot(half), also for small angles
  const double stretch = std::abs(half) < 1e-4 ? 1 - half * half / 3 : half / std::tan(half);
  const Vec3 at_pivot = along + stretch * across - half * axis.cross(across);
  const Vec3 angular = angle * axis;
  return {angular, at_pivot + angular.cross(origin - pivot)};
}

/// The displacement of a point by the flow of a velocity field during unit time.
Vec3 flow(const Velocity& velocity, const Vec3& from_origin) {
  const Vec3& w = velocity.angular;
  const Vec3 u = velocity.linear + w.cross(from_origin);
  const double angle2 = w.squaredNorm(), angle = std::sqrt(angle2);
  constexpr double small = 1e-4;
  const double first = angle < small ? 1 - angle2 / 6 : std::sin(angle) / angle;
  const double second = angle < small ? 0.5 : 2 * std::pow(std::sin(0.5 * angle) / angle, 2);
  const double third = angle < small ? 1.0 / 6 : (1 - first) / angle2;
  return first * u + second * w.cross(u) + third * w.dot(u) * w;
}

/// Laplace's equation on a mesh: the stiffness matrix of linear finite elements with quadrature at
/// the corners. There the gradients are those on the corner simplices.
class LaplaceMatrix {
 public:
  /// known: #nodes, whether the value at a node is known. Nodes of no element count as known.
  LaplaceMatrix(const Topology& topology, const Coordinates& x, const std::vector<bool>& known,
                int threads)
      : topology_(topology), x_(x), threads_(threads), numbers_(known.size(), -1) {
    for (Index node = 0; node < topology.node_count(); ++node) {
      if (known[at(node)] || !topology.used(node)) continue;
      numbers_[at(node)] = static_cast<Index>(nodes_.size());
      nodes_.push_back(node);
    }
    rows_.resize(nodes_.size());
    for_each_row([&](std::size_t i) { make_row(nodes_[i], rows_[i]); });
  }

  /// The nodes with unknowns, in the order of the rows.
  std::span<const Index> nodes() const { return nodes_; }

  SparseMatrix build() const {
    SparseMatrix matrix;
    const auto count = static_cast<Index>(nodes_.size());
    matrix.pattern = build_pattern(count, parallel_block, threads_, [&] {
      return [&](Index i, std::vector<Index>& columns) {
        for (const auto& [node, value] : rows_[at(i)])
          if (numbers_[at(node)] >= 0) columns.push_back(numbers_[at(node)]);
      };
    });
    matrix.symmetric = true;
    matrix.in_space = topology_.cell_dimension() == 3;
    matrix.values.resize(matrix.pattern->columns.size());
    for_each_row([&](std::size_t i) {
      std::size_t entry = at(matrix.pattern->offsets[i]);
      for (const auto& [node, value] : rows_[i])
        if (numbers_[at(node)] >= 0) matrix.values[entry++] = value;
      // Parts of a mesh without any known value get u = 0.
      constexpr double shift = 1e-10;  // relative
      matrix.values[at(matrix.pattern->diagonal[i])] *= 1 + shift;
    });
    make_symmetric(matrix);
    return matrix;
  }

  /// The right-hand side for known values (#nodes).
  std::vector<double> right_hand_side(std::span<const double> known) const {
    std::vector<double> out(nodes_.size());
    for_each_row([&](std::size_t i) {
      for (const auto& [node, value] : rows_[i])
        if (numbers_[at(node)] < 0) out[i] -= value * known[at(node)];
    });
    return out;
  }

 private:
  /// The entries of all nodes in a row, ascending, once each.
  using Row = std::vector<std::pair<Index, double>>;

  template <typename Work>
  void for_each_row(const Work& work) const {
    parallel_for(threads_, static_cast<Index>(nodes_.size()), [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) work(at(i));
    });
  }

  void make_row(Index node, Row& row) const {
    for (const Index e : topology_.star(node)) add_element(e, node, row);
    std::ranges::sort(row, {}, [](const auto& entry) { return entry.first; });
    std::size_t last = 0;
    for (std::size_t k = 1; k < row.size(); ++k) {
      if (row[k].first == row[last].first)
        row[last].second += row[k].second;
      else
        row[++last] = row[k];
    }
    row.resize(last + 1);
  }

  /// Volume (in the plane: area) that a corner stands for, over the determinant of its edges:
  /// quadrature at the corners.
  static double share_of_corner(ElementType type) {
    switch (type) {
      case ElementType::triangle:
        return 1.0 / 2;
      case ElementType::quadrilateral:
        return 1.0 / 4;
      case ElementType::tetrahedron:
        return 1.0 / 6;
      case ElementType::hexahedron:
        return 1.0 / 8;
      default:
        return 1.0 / 12;  // pyramid, prism
    }
  }
  void add_element(Index e, Index node, Row& row) const {
    const auto element = topology_.element(e);
    const ElementType type = topology_.element_type(e);
    const double share = share_of_corner(type);
    if (topology_.cell_dimension() == 3) {
      for (const auto& corner : corner_tetrahedra(type))
        add_simplex<3>(by_nodes(corner, element), share, node, row);
      return;
    }
    const std::size_t n = element.size();
    for (std::size_t k = 0; k < (n == 3 ? 1 : n); ++k)
      add_simplex<2>({element[k], element[(k + 1) % n], element[(k + n - 1) % n]}, share, node,
                     row);
  }

  template <int D>
  void add_simplex(const std::array<Index, D + 1>& simplex, double share, Index node,
                   Row& row) const {
    const auto found = std::ranges::find(simplex, node);
    if (found == simplex.end()) return;
    const auto own = static_cast<std::size_t>(found - simplex.begin());
    Eigen::Matrix<double, D, D> edges;
    for (int k = 0; k < D; ++k)
      edges.col(k) = x_.get<D>(simplex[at(k + 1)]) - x_.get<D>(simplex[0]);
    const double size = edges.determinant();
    if (!(size > 0)) return;
    Eigen::Matrix<double, D + 1, D> gradients;
    gradients.template bottomRows<D>() = edges.inverse();
    gradients.row(0) = -gradients.template bottomRows<D>().colwise().sum();
    for (std::size_t k = 0; k < simplex.size(); ++k)
      row.emplace_back(
          simplex[k],
          share * size *
              gradients.row(static_cast<int>(own)).dot(gradients.row(static_cast<int>(k))));
  }

  /// Rows add their entries in different orders: copies the lower triangle.
  static void make_symmetric(SparseMatrix& matrix) {
    const SparsityPattern& pattern = *matrix.pattern;
    for (Index row = 0; row < pattern.rows(); ++row)
      for (Index e = pattern.diagonal[at(row)] + 1; e < pattern.offsets[at(row) + 1]; ++e)
        matrix.values[at(e)] = matrix.values[at(pattern.find(pattern.columns[at(e)], row))];
  }

  const Topology& topology_;
  const Coordinates& x_;
  int threads_;
  std::vector<Index> numbers_;  // #nodes, of the unknowns; -1: none
  std::vector<Index> nodes_;    // that have unknowns
  std::vector<Row> rows_;       // of nodes_
};

std::vector<const Motion*> single_bodies(const Motion& motion) {
  const Motion& bodies = motion.of_bodies();
  std::vector<const Motion*> out;
  for (const auto& body : bodies.bodies()) out.push_back(body.get());
  if (out.empty()) out.push_back(&bodies);
  return out;
}

}  // namespace

/// u: of each body (#nodes).
void Twist::set_weights(const std::vector<const Motion*>& bodies,
                        std::vector<std::vector<double>> u) {
  for (std::size_t node = 0; node < u.front().size(); ++node) {
    double sum = 0, sum_of_steps = 0;
    for (const auto& of_body : u) {
      sum += of_body[node];
      sum_of_steps += smooth_step(of_body[node]);
    }
    if (!(sum_of_steps > 0)) continue;
    for (auto& of_body : u)
      of_body[node] = smooth_step(sum) * smooth_step(of_body[node]) / sum_of_steps;
  }
  for (std::size_t b = 0; b < bodies.size(); ++b)
    bodies_.push_back({*bodies[b]->rigid(), std::move(u[b])});
}

std::optional<Twist> Twist::find(const NodeClasses& classes, const Coordinates& x,
                                 const Motion& motion, int threads) {
  const Topology& topology = classes.topology();
  const auto bodies = single_bodies(motion);
  if (!std::ranges::all_of(bodies, [](const Motion* body) { return body->rigid() != nullptr; }))
    return std::nullopt;
  const Index count = topology.node_count();
  std::vector<std::vector<double>> u(bodies.size(), std::vector<double>(at(count)));
  std::vector<bool> known(at(count));
  for (Index node = 0; node < count; ++node) known[at(node)] = classes[node] == NodeClass::fixed;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (const Index node : bodies[b]->nodes()) {
      known[at(node)] = true;
      u[b][at(node)] = 1;
    }
  const LaplaceMatrix laplace(topology, x, known, threads);
  const SparseMatrix matrix = laplace.build();
  constexpr double accuracy = 1e-4;  // relative; any smooth field is a start
  const auto solver = make_linear_solver({.tolerance = accuracy}, threads);
  solver->set_matrix(matrix);
  for (auto& of_body : u) {
    std::vector<double> solution(laplace.nodes().size());
    solver->solve(laplace.right_hand_side(of_body), 1, solution);
    for (std::size_t i = 0; i < solution.size(); ++i) of_body[at(laplace.nodes()[i])] = solution[i];
  }
  Twist twist(classes, body_centre(body_box(x, motion.nodes())));
  twist.set_weights(bodies, std::move(u));
  return twist;
}

void Twist::carry(double from, double to, Coordinates& x) const {
  std::vector<Velocity> velocities;
  velocities.reserve(bodies_.size());
  for (const Body& body : bodies_)
    velocities.push_back(velocity_between(body.motion, from, to, origin_));
  for (Index node = 0; node < classes_.topology().node_count(); ++node) {
    if (classes_.unknowns(node) == 0) continue;
    Velocity own;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      own.angular += bodies_[b].weights[at(node)] * velocities[b].angular;
      own.linear += bodies_[b].weights[at(node)] * velocities[b].linear;
    }
    const Vec3 place = place_of(x, node);
    Vec3 move = flow(own, place - origin_);
    if (classes_.slides(node)) {
      const Vec3 free = move;
      move.setZero();
      for (const Vec3& direction : classes_.foot(node, place).frame)
        move += direction.dot(free) * direction;
    }
    set_place(x, node, place + move);
  }
}

double Twist::largest_turn() const {
  double turn = 0;
  for (const Body& body : bodies_) turn = std::max(turn, std::abs(body.motion.rotate));
  return turn;
}

}  // namespace winslow
