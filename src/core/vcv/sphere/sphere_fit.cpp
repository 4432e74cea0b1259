#include "core/vcv/sphere/sphere_fit.h"

#include <Eigen/Cholesky>
#include <bit>

#include "core/error.h"

namespace winslow {

namespace {

/// The triangle to hold: the one whose corners have the most neighbours, which spreads the other
/// vertices best.
Index outer_triangle(const SphereLink& link) {
  Index best = 0, most = -1;
  for (Index t = 0; t < link.triangle_count(); ++t) {
    Index sum = 0;
    for (const Index v : link.triangles()[at(t)]) sum += link.degree(v);
    if (sum > most) {
      most = sum;
      best = t;
    }
  }
  return best;
}

/// Stress of an edge: any positive stresses give an embedding. With equal ones the vertices around
/// a vertex with very many neighbours would crowd together.
double stress(const SphereLink& link, Index a, Index b) {
  const double product = link.degree(a) * link.degree(b);
  return 1 / (product * product);
}

}  // namespace

bool covers_sphere(const SphereLink& link, std::span<const Vec3> directions) {
  double sum = 0;
  for (const auto& [a, b, c] : link.triangles()) {
    const double angle = solid_angle(directions[at(a)], directions[at(b)], directions[at(c)]);
    if (!(angle > 0)) return false;
    sum += angle;
  }
  return std::abs(sum - 4 * pi) < 1;  // a multiple cover has a multiple of 4 pi
}

void SphereStart::place(const SphereLink& link, std::span<Vec3> directions) {
  const Index outer = outer_triangle(link);
  embed(link, link.triangles()[at(outer)]);
  lift(link, outer);
  spread(directions);
  if (!covers_sphere(link, directions)) {
    throw NumericError("triangles of the link are nested too deeply to be told apart");
  }
}

void SphereStart::embed(const SphereLink& link, const SphereLink::Triangle& outer) {
  points_.assign(at(link.vertex_count()), Vec3(0, 0, 0));
  row_.assign(points_.size(), 0);
  for (const Index v : outer) row_[at(v)] = -1;
  Index rows = 0;
  for (Index& row : row_) {
    if (row == 0) row = rows++;
  }
  // The outer triangle is viewed from its other side, so that the inner ones are counter-clockwise.
  points_[at(outer[0])] = Vec3(0, 1, 0);
  points_[at(outer[1])] = Vec3(std::sqrt(0.75), -0.5, 0);
  points_[at(outer[2])] = Vec3(-std::sqrt(0.75), -0.5, 0);
  laplacian_.reset(at(rows));
  x_.assign(at(rows), 0.0);
  y_.assign(at(rows), 0.0);
  for (Index v = 0; v < link.vertex_count(); ++v) {
    const Index i = row_[at(v)];
    if (i < 0) continue;
    for (const Index h : link.outgoing(v)) {
      const Index other = link.end_of(h);
      const Index k = row_[at(other)];
      const double weight = stress(link, v, other);
      laplacian_(at(i), at(i)) += weight;
      if (k > i) laplacian_(at(i), at(k)) = -weight;
      if (k >= 0) continue;
      x_[at(i)] += weight * points_[at(other)].x();
      y_[at(i)] += weight * points_[at(other)].y();
    }
  }
  if (!laplacian_.factorise()) throw NumericError("Tutte's embedding of a link has no solution");
  laplacian_.solve(x_);
  laplacian_.solve(y_);
  for (std::size_t v = 0; v < points_.size(); ++v) {
    if (row_[v] >= 0) points_[v].head<2>() = Vec2(x_[at(row_[v])], y_[at(row_[v])]);
  }
}

void SphereStart::lift(const SphereLink& link, Index outer) {
  planes_.assign(at(link.triangle_count()), Vec3(0, 0, 0));
  reached_.assign(planes_.size(), 0);
  reached_[at(outer)] = 1;
  const Index first = link.twin(3 * outer) / 3;
  reached_[at(first)] = 1;
  todo_.assign(1, first);
  for (std::size_t head = 0; head < todo_.size(); ++head) {
    const Index t = todo_[head];
    for (Index h = 3 * t; h < 3 * t + 3; ++h) {
      const Index next = link.twin(h) / 3;
      if (reached_[at(next)]) continue;
      reached_[at(next)] = 1;
      todo_.push_back(next);
      const Vec3& p = points_[at(link.start_of(h))];
      const Vec3& q = points_[at(link.end_of(h))];
      // The slope falls by stress times length from the left of an edge to its right: a roof.
      const Vec2 bend =
          stress(link, link.start_of(h), link.end_of(h)) * Vec2(p.y() - q.y(), q.x() - p.x());
      Vec3 plane = planes_[at(t)];
      plane.head<2>() += bend;
      plane.z() -= bend.dot(p.head<2>());
      planes_[at(next)] = plane;
    }
  }
  for (const Index t : todo_) {
    for (const Index v : link.triangles()[at(t)]) {
      Vec3& p = points_[at(v)];
      p.z() = planes_[at(t)].x() * p.x() + planes_[at(t)].y() * p.y() + planes_[at(t)].z();
    }
  }
}

void SphereStart::spread(std::span<Vec3> directions) {
  constexpr int rounds = 4;
  const auto count = static_cast<double>(points_.size());
  for (int round = 0; round <= rounds; ++round) {
    // In the coordinates of the last round distances are 1 on average, so the first weights are
    // equal.
    const bool first = round == 0;
    Vec3 centre(0, 0, 0);
    double total = 0;
    for (const Vec3& p : points_) {
      const double weight = first ? 1 : 1 / p.norm();
      centre += weight * p;
      total += weight;
    }
    centre /= total;
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (Vec3& p : points_) {
      p -= centre;
      moments += p * p.transpose() / (first ? 1 : p.squaredNorm());
    }
    const Eigen::LLT<Eigen::Matrix3d> factor(moments * (3 / count));
    if (factor.info() != Eigen::Success) throw NumericError("a link has no volume");
    for (Vec3& p : points_) factor.matrixL().solveInPlace(p);
  }
  for (std::size_t v = 0; v < points_.size(); ++v) directions[v] = points_[v].normalized();
}

namespace {

std::array<Vec3, 2> tangents_at(const Vec3& p) {
  const Vec3 first = p.unitOrthogonal();
  return {first, p.cross(first)};
}

}  // namespace

/// Returns false, with `state` incomplete, at a triangle without a positive solid angle.
bool SphereFit::evaluate(const SphereLink& link, std::span<const double> targets,
                         State& state) const {
  const auto& p = state.directions;
  state.squares = state.edges = state.largest = 0;
  state.shape = 1;
  double sum = 0;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const auto [a, b, c] = link.triangles()[t];
    const Vec3 &pa = p[at(a)], &pb = p[at(b)], &pc = p[at(c)];
    const SolidAngleGradient angle = solid_angle_gradient(pa, pb, pc);
    if (!(angle.angle > 0)) return false;
    sum += angle.angle;
    const double inverse = 1 / targets[t];
    const double residual = angle.angle * inverse - 1;
    state.residuals[t] = residual;
    state.gradients[t] = {inverse * angle.by_a, inverse * angle.by_b, inverse * angle.by_c};
    state.squares += residual * residual;
    state.largest = std::max(state.largest, std::abs(residual));
    const double chords =
        (pb - pa).squaredNorm() + (pc - pb).squaredNorm() + (pa - pc).squaredNorm();
    state.edges += 0.5 * chords;  // every edge is visited twice
    const double volume6 = solid_angle_tangent(pa, pb, pc).n, size = 3 + chords;
    state.shape = std::min(state.shape, 432 * volume6 * volume6 / (size * size * size));
  }
  return std::abs(sum - 4 * pi) < 1;  // a multiple cover of the sphere has a multiple of 4 pi
}

/// Order of elimination by minimum degree, fill included: most of the factor's rows stay short.
void SphereFit::order_vertices(const SphereLink& link) {
  using Set = std::uint64_t;
  constexpr Index most = 64;
  const Index n = link.vertex_count();
  place_.resize(at(n));
  if (n > most) {
    order_by_degree(link);
    return;
  }
  std::array<Set, most> around{};
  for (Index v = 0; v < n; ++v) {
    for (const Index h : link.outgoing(v)) around[at(v)] |= Set{1} << link.end_of(h);
  }
  Set left = n == most ? ~Set{0} : (Set{1} << n) - 1;
  for (std::size_t next = 0; left != 0; ++next) {
    Index best = -1, least = most + 1;
    for (Set rest = left; rest != 0; rest &= rest - 1) {
      const auto v = static_cast<Index>(std::countr_zero(rest));
      const auto degree = static_cast<Index>(std::popcount(around[at(v)] & left));
      if (degree >= least) continue;
      least = degree;
      best = v;
    }
    place_[at(best)] = next;
    left &= ~(Set{1} << best);
    const Set clique = around[at(best)] & left;
    for (Set rest = clique; rest != 0; rest &= rest - 1) {
      const int v = std::countr_zero(rest);
      around[at(v)] |= clique & ~(Set{1} << v);
    }
  }
}

void SphereFit::order_by_degree(const SphereLink& link) {
  std::size_t next = 0;
  for (Index degree = 3; next < place_.size(); ++degree) {
    for (Index v = 0; v < link.vertex_count(); ++v) {
      if (link.degree(v) == degree) place_[at(v)] = next++;
    }
  }
}

/// Assembles the normal equations at now_: J^T J and -J^T r of half the cost.
void SphereFit::assemble(const SphereLink& link, double mu) {
  const auto& p = now_.directions;
  const std::size_t n = p.size();
  tangents_.resize(n);
  for (std::size_t v = 0; v < n; ++v) tangents_[v] = tangents_at(p[v]);
  normal_.reset(2 * n);
  descent_.assign(2 * n, 0.0);
  const double pull = 0.5 * mu;  // of an edge, for half the cost
  for (std::size_t t = 0; t < link.triangles().size(); ++t) {
    const auto& corners = link.triangles()[t];
    std::array<std::array<double, 2>, 3> slope;
    std::array<std::size_t, 3> first;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& [e, f] = tangents_[at(corners[k])];
      slope[k] = {now_.gradients[t][k].dot(e), now_.gradients[t][k].dot(f)};
      first[k] = 2 * place_[at(corners[k])];
      descent_[first[k]] -= now_.residuals[t] * slope[k][0];
      descent_[first[k] + 1] -= now_.residuals[t] * slope[k][1];
      normal_(first[k], first[k]) += slope[k][0] * slope[k][0] + pull;
      normal_(first[k], first[k] + 1) += slope[k][0] * slope[k][1];
      normal_(first[k] + 1, first[k] + 1) += slope[k][1] * slope[k][1] + pull;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      std::size_t i = k, j = (k + 1) % 3;
      // Another triangle has the same edge in the opposite direction: only the one with ascending
      // vertices adds its term.
      const bool own = corners[i] < corners[j];
      if (first[i] > first[j]) std::swap(i, j);
      const auto& u = tangents_[at(corners[i])];
      const auto& w = tangents_[at(corners[j])];
      for (std::size_t r = 0; r < 2; ++r) {
        for (std::size_t c = 0; c < 2; ++c) {
          double entry = slope[i][r] * slope[j][c];
          if (own) entry -= pull * u[r].dot(w[c]);
          normal_(first[i] + r, first[j] + c) += entry;
        }
      }
      if (!own) continue;
      for (std::size_t r = 0; r < 2; ++r) {
        descent_[first[i] + r] += pull * u[r].dot(p[at(corners[j])]);
        descent_[first[j] + r] += pull * w[r].dot(p[at(corners[i])]);
      }
    }
  }
}

/// Solves the damped normal equations for step_. Returns false if round-off makes them singular.
bool SphereFit::solve(double damping) {
  factor_ = normal_;
  for (std::size_t i = 0; i < factor_.size(); ++i) factor_(i, i) += damping;
  if (!factor_.factorise()) return false;
  step_ = descent_;
  factor_.solve(step_);
  return true;
}

/// trial_ = now_ moved by step_.
void SphereFit::advance() {
  const std::size_t n = now_.directions.size();
  for (std::size_t v = 0; v < n; ++v) {
    const double* const s = step_.data() + 2 * place_[v];
    trial_.directions[v] =
        (now_.directions[v] + s[0] * tangents_[v][0] + s[1] * tangents_[v][1]).normalized();
  }
}

SphereFitResult SphereFit::fit(const SphereLink& link, std::span<const double> targets,
                               const SphereFitOptions& options, std::span<Vec3> directions) {
  for (State* state : {&now_, &trial_}) {
    state->directions.assign(directions.begin(), directions.end());
    state->residuals.resize(targets.size());
    state->gradients.resize(targets.size());
  }
  if (!evaluate(link, targets, now_)) {
    throw UsageError("a fit of solid angles has to start from directions that cover the sphere");
  }
  order_vertices(link);
  SphereFitResult result = iterate(link, targets, options);
  if (now_.largest <= options.tolerance) result.end = SphereFitEnd::converged;
  result.largest_error = now_.largest;
  std::copy(now_.directions.begin(), now_.directions.end(), directions.begin());
  return result;
}

SphereFitResult SphereFit::iterate(const SphereLink& link, std::span<const double> targets,
                                   const SphereFitOptions& options) {
  constexpr double least_damping = 1e-3, most_damping = 1e8;  // of the sum of squares
  constexpr double worthwhile = 1e-5;                         // decrease of the cost
  const double least = options.least_shape;
  const double least_shape = std::min(least * least * least, 0.1 * now_.shape);
  SphereFitResult result;
  double mu = options.regularisation;
  double damping = 0.1;
  bool assembled = false;
  const bool angles_alone = options.least_regularisation < options.regularisation;
  while (result.steps < options.most_steps) {
    if (angles_alone && now_.largest <= options.tolerance) break;
    if (!assembled) assemble(link, mu);
    assembled = true;
    ++result.steps;
    double gain = -1;
    if (solve(damping * now_.squares)) {
      advance();
      if (evaluate(link, targets, trial_)) gain = now_.cost(mu) - trial_.cost(mu);
    }
    if (damping > most_damping || (gain > 0 && trial_.shape < least_shape)) {
      result.end = SphereFitEnd::limited_by_shape;
      return result;
    }
    if (!(gain > 0)) {
      damping *= 8;
      continue;
    }
    const bool settled = gain < worthwhile * now_.cost(mu) && mu <= options.least_regularisation;
    std::swap(now_, trial_);
    assembled = false;
    damping = std::max(0.5 * damping, least_damping);
    mu = std::max(0.1 * mu, options.least_regularisation);
    if (settled) {
      result.end = SphereFitEnd::limited_by_shape;
      return result;
    }
  }
  return result;
}

}  // namespace winslow
