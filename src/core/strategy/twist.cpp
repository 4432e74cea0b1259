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

/// The nodes of a body in space, and how far each of them moves.
std::vector<std::pair<Index, Vec3>> displacements_of(const Motion& body, const Coordinates& x) {
  Coordinates end = x;
  body.apply(x, 1, end);
  std::vector<std::pair<Index, Vec3>> out;
  for (const Index node : body.nodes()) out.emplace_back(node, end.xyz(node) - x.xyz(node));
  return out;
}

void scale_fields(std::span<std::vector<double>> fields, double factor) {
  for (auto& field : fields)
    for (double& value : field) value *= factor;
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
  const Topology& topology = classes.topology();
  const bool in_space = topology.cell_dimension() == 3;
  std::vector<const Motion*> rigid, others;
  for (const Motion* body : single_bodies(motion))
    (body->rigid() != nullptr ? rigid : others).push_back(body);
  if (!in_space && !others.empty()) return std::nullopt;
  const std::size_t weights = rigid.size(), components = others.empty() ? 0 : 3;
  const Index count = topology.node_count();
  // A first guess, exact where nothing but one rigid body holds the mesh.
  const double share = weights > 0 ? 1 / static_cast<double>(weights) : 0;
  std::vector<std::vector<double>> u(weights, std::vector<double>(at(count), share));
  u.resize(weights + components, std::vector<double>(at(count), 0));
  std::vector<bool> known(at(count));
  const auto set_known = [&](Index node, std::size_t field) {
    known[at(node)] = true;
    for (std::size_t f = 0; f < u.size(); ++f) u[f][at(node)] = f == field ? 1 : 0;
  };
  const std::size_t none = u.size();
  for (Index node = 0; node < count; ++node)
    if (classes[node] == NodeClass::fixed || !topology.used(node)) set_known(node, none);
  for (std::size_t b = 0; b < weights; ++b)
    for (const Index node : rigid[b]->nodes()) set_known(node, b);
  // Displacements are solved for as shares of the largest one, so that they count like weights.
  double largest = 0;
  for (const Motion* body : others) {
    for (const auto& [node, way] : displacements_of(*body, x)) {
      set_known(node, none);
      for (std::size_t c = 0; c < 3; ++c) u[weights + c][at(node)] = way[static_cast<int>(c)];
      largest = std::max(largest, way.norm());
    }
  }
  scale_fields(std::span(u).subspan(weights), largest > 0 ? 1 / largest : 0);
  LaplaceEquation equation(topology, x, known, threads);
  equation.solve({.exponent = in_space ? 3.0 : 2.0}, u);
  scale_fields(std::span(u).subspan(weights), largest);

  Twist twist(classes, body_centre(body_box(x, motion.nodes())));
  if (components > 0) {
    twist.displacements_.resize(at(count));
    for (std::size_t node = 0; node < at(count); ++node)
      twist.displacements_[node] =
          Vec3(u[weights][node], u[weights + 1][node], u[weights + 2][node]);
    u.resize(weights);
  }
  if (!in_space) make_steps(u);
  for (std::size_t b = 0; b < weights; ++b)
    twist.bodies_.push_back({*rigid[b]->rigid(), std::move(u[b])});
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
