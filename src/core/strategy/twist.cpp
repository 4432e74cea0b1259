#include "core/strategy/twist.h"

#include <Eigen/Geometry>

#include "core/strategy/laplace_equation.h"

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

std::vector<const Motion*> single_bodies(const Motion& motion) {
  const Motion& bodies = motion.of_bodies();
  std::vector<const Motion*> out;
  for (const auto& body : bodies.bodies()) out.push_back(body.get());
  if (out.empty()) out.push_back(&bodies);
  return out;
}

/// Flattens the fields of bodies (each #nodes) where they are 0 and 1.
void make_steps(std::vector<std::vector<double>>& u) {
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
}

}  // namespace

std::optional<Twist> Twist::find(const NodeClasses& classes, const Coordinates& x,
                                 const Motion& motion, int threads) {
  const auto bodies = single_bodies(motion);
  Twist twist(classes, body_centre(body_box(x, motion.nodes())));
  if (std::ranges::all_of(bodies, [](const Motion* body) { return body->rigid() != nullptr; }))
    twist.find_weights(x, bodies, threads);
  else if (classes.topology().cell_dimension() == 3)
    twist.find_displacements(x, motion.of_bodies(), threads);
  else
    return std::nullopt;
  return twist;
}

/// Whether a node is fixed, or belongs to no element.
bool Twist::stays(Index node) const {
  return classes_[node] == NodeClass::fixed || !classes_.topology().used(node);
}

void Twist::find_weights(const Coordinates& x, const std::vector<const Motion*>& bodies,
                         int threads) {
  const Topology& topology = classes_.topology();
  const Index count = topology.node_count();
  // A first guess, exact where nothing but one body holds the mesh.
  const double share = 1 / static_cast<double>(bodies.size());
  std::vector<std::vector<double>> u(bodies.size(), std::vector<double>(at(count), share));
  std::vector<bool> known(at(count));
  const auto set_known = [&](Index node, std::size_t body) {
    known[at(node)] = true;
    for (std::size_t b = 0; b < u.size(); ++b) u[b][at(node)] = b == body ? 1 : 0;
  };
  for (Index node = 0; node < count; ++node)
    if (stays(node)) set_known(node, u.size());
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (const Index node : bodies[b]->nodes()) set_known(node, b);
  const bool in_space = topology.cell_dimension() == 3;
  LaplaceEquation(topology, x, known, threads).solve({.exponent = in_space ? 3.0 : 2.0}, u);
  if (!in_space) make_steps(u);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    bodies_.push_back({*bodies[b]->rigid(), std::move(u[b])});
}

void Twist::find_displacements(const Coordinates& x, const Motion& motion, int threads) {
  const Topology& topology = classes_.topology();
  const Index count = topology.node_count();
  std::vector<std::vector<double>> u(3, std::vector<double>(at(count), 0.0));
  std::vector<bool> known(at(count));
  for (Index node = 0; node < count; ++node) known[at(node)] = stays(node);
  Coordinates end = x;
  motion.apply(x, 1, end);
  for (const Index node : motion.nodes()) {
    known[at(node)] = true;
    const Vec3 way = end.xyz(node) - x.xyz(node);
    for (std::size_t c = 0; c < 3; ++c) u[c][at(node)] = way[static_cast<int>(c)];
  }
  LaplaceEquation(topology, x, known, threads).solve({.exponent = 3}, u);
  displacements_.resize(at(count));
  for (std::size_t node = 0; node < at(count); ++node)
    displacements_[node] = Vec3(u[0][node], u[1][node], u[2][node]);
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
    if (!displacements_.empty()) move += (to - from) * displacements_[at(node)];
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
