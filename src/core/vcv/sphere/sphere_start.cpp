#include "core/vcv/sphere/sphere_start.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "core/error.h"
#include "core/vcv/sphere/solid_angle.h"

namespace winslow {

namespace {

/// The triangle to be held: the one whose corners have the most neighbours, so that the others are
/// spread best.
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

/// Stress of an edge: any positive ones make an embedding. With equal ones the vertices around a
/// vertex of very many neighbours would crowd, closer with every further one.
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
  return std::abs(sum - 4 * pi) < 1;  // another cover has a multiple of 4 pi
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
  // The outer triangle is seen from its other side: the inner ones are counter-clockwise.
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
    // In the coordinates of the last round distances are 1 on average: the first weights are equal.
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

}  // namespace winslow
