#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/curve.h"
#include "core/search/box_tree.h"

namespace winslow {

/// Cubic pieces between knots, by the second derivatives there.
template <int D>
class SplineCurve final : public Curve<D> {
 public:
  SplineCurve(std::span<const Vec<D>> points, bool closed) : knots_(points.begin(), points.end()) {
    count_ = static_cast<Index>(points.size());
    if (closed) knots_.push_back(points.front());
    for (std::size_t k = 0; k + 1 < knots_.size(); ++k)
      chord_.push_back((knots_[k + 1] - knots_[k]).norm());
    bends_ = closed ? periodic_bends() : natural_bends();
    tree_ = BoxTree<D>(std::span<const Vec<D>>(knots_));
    for (std::size_t k = 0; k < chord_.size(); ++k)
      arcs_.push_back(arcs_.back() + arc_in_piece(k, chord_[k]));
  }

  CurvePoint<D> nearest(const Vec<D>& p) const override { return at_place(nearest_place(p)); }

  double arc_of(const Vec<D>& p) const override {
    const Place place = nearest_place(p);
    return wrapped(arcs_[place.piece] + arc_in_piece(place.piece, place.t));
  }

  CurvePoint<D> at_arc(double arc) const override {
    const double along = closed() ? wrapped(arc) : std::clamp(arc, 0.0, arcs_.back());
    const auto after = std::upper_bound(arcs_.begin() + 1, arcs_.end() - 1, along);
    const auto piece = static_cast<std::size_t>(after - arcs_.begin() - 1);
    return at_place({piece, parameter_at(piece, along - arcs_[piece]), 0});
  }

  double period() const override { return closed() ? arcs_.back() : 0; }

  std::string description() const override {
    return "smooth curve through " + std::to_string(count_) + " nodes";
  }

 private:
  struct Place {
    std::size_t piece = 0;
    double t = 0;  // 0 to the chord
    double distance = 0;
  };

  Place nearest_place(const Vec<D>& p) const {
    const auto knot = static_cast<std::ptrdiff_t>(
        tree_.nearest(p, std::numeric_limits<double>::infinity())->item);
    const auto pieces = static_cast<std::ptrdiff_t>(chord_.size());
    // The nearest knot is next to the nearest place but where the curve bends as fast as its knots
    // lie apart; two pieces on either side are enough for that.
    constexpr std::ptrdiff_t reach = 2;
    std::optional<Place> best;
    for (std::ptrdiff_t k = knot - reach; k < knot + reach; ++k) {
      const bool wraps = closed();
      if (!wraps && (k < 0 || k >= pieces)) continue;
      const Place place = on_piece(static_cast<std::size_t>((k + 2 * pieces) % pieces), p);
      if (!best || place.distance < best->distance) best = place;
    }
    return *best;
  }

  double wrapped(double arc) const {
    if (!closed()) return arc;
    const double rest = std::fmod(arc, arcs_.back());
    return rest < 0 ? rest + arcs_.back() : rest;
  }

  /// Length of arc of a piece up to t: Gauss's rule with 8 points, exact to round-off for pieces
  /// that do not bend by much more than their chord.
  double arc_in_piece(std::size_t k, double t) const {
    constexpr std::array<double, 4> places{0.18343464249564980494, 0.52553240991632898582,
                                           0.79666647741362673959, 0.96028985649753623168};
    constexpr std::array<double, 4> weights{0.36268378337836198297, 0.31370664587788728734,
                                            0.22238103445337447054, 0.10122853629037625915};
    double sum = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
      for (const double side : {-1.0, 1.0})
        sum += weights[i] * derivatives(k, 0.5 * t * (1 + side * places[i])).first.norm();
    return 0.5 * t * sum;
  }

  /// The t of a piece at a length of arc, by Newton's method.
  double parameter_at(std::size_t k, double arc) const {
    constexpr int iterations = 20;
    const double h = chord_[k];
    double t = h * arc / (arcs_[k + 1] - arcs_[k]);
    for (int i = 0; i < iterations; ++i) {
      const double change = (arc_in_piece(k, t) - arc) / derivatives(k, t).first.norm();
      t = std::clamp(t - change, 0.0, h);
      if (std::abs(change) <= 2 * std::numeric_limits<double>::epsilon() * h) break;
    }
    return t;
  }

  struct Derivatives {
    Vec<D> r, first, second;
  };

  bool closed() const { return static_cast<Index>(knots_.size()) > count_; }

  Derivatives derivatives(std::size_t k, double t) const {
    const double h = chord_[k], a = (h - t) / h, b = t / h;
    const Vec<D>&p = knots_[k], &q = knots_[k + 1], &m = bends_[k], &n = bends_[k + 1];
    return {a * p + b * q + (h * h / 6) * ((a * a * a - a) * m + (b * b * b - b) * n),
            (q - p) / h + (h / 6) * ((1 - 3 * a * a) * m + (3 * b * b - 1) * n), a * m + b * n};
  }

  /// By Newton's method on the derivative of the squared distance, safeguarded by a bracket.
  Place on_piece(std::size_t k, const Vec<D>& p) const {
    constexpr int samples = 4, iterations = 60;
    const double h = chord_[k];
    Place best{k, 0, std::numeric_limits<double>::infinity()};
    for (int s = 0; s <= samples; ++s) {
      const double t = h * s / samples, distance = (derivatives(k, t).r - p).norm();
      if (distance < best.distance) best = {k, t, distance};
    }
    double low = std::max(0.0, best.t - h / samples), high = std::min(h, best.t + h / samples);
    double t = best.t;
    for (int i = 0; i < iterations; ++i) {
      const Derivatives d = derivatives(k, t);
      const double slope = d.first.dot(d.r - p);
      const double curvature = d.first.squaredNorm() + d.second.dot(d.r - p);
      (slope > 0 ? high : low) = t;
      double next = curvature > 0 ? t - slope / curvature : 0.5 * (low + high);
      if (!(next >= low && next <= high)) next = 0.5 * (low + high);
      const double change = std::abs(next - t);
      t = next;
      if (change <= 4 * std::numeric_limits<double>::epsilon() * h) break;
    }
    const double distance = (derivatives(k, t).r - p).norm();
    return distance <= best.distance ? Place{k, t, distance} : best;
  }

  CurvePoint<D> at_place(const Place& place) const {
    const Derivatives d = derivatives(place.piece, place.t);
    const double speed2 = d.first.squaredNorm();
    const Vec<D> tangent = d.first / std::sqrt(speed2);
    return {d.r, tangent, (d.second - tangent.dot(d.second) * tangent) / speed2};
  }

  Vec<D> jump(std::size_t before, std::size_t k, std::size_t next) const {
    return 6 *
           ((knots_[next] - knots_[k]) / chord_[k] - (knots_[k] - knots_[before]) / chord_[before]);
  }

  /// h_(k-1) m_(k-1) + 2 (h_(k-1) + h_k) m_k + h_k m_(k+1) = 6 (slope_k - slope_(k-1)).
  std::vector<Vec<D>> natural_bends() const {
    const std::size_t n = knots_.size();
    std::vector<Vec<D>> m(n, Vec<D>(Vec<D>::Zero()));
    if (n < 3) return m;
    std::vector<double> diagonal(n, 1);
    for (std::size_t k = 1; k + 1 < n; ++k) {
      diagonal[k] = 2 * (chord_[k - 1] + chord_[k]);
      m[k] = jump(k - 1, k, k + 1);
      if (k == 1) continue;
      const double factor = chord_[k - 1] / diagonal[k - 1];
      diagonal[k] -= factor * chord_[k - 1];
      m[k] -= factor * m[k - 1];
    }
    for (std::size_t k = n - 2; k >= 1; --k) {
      const Vec<D> after = k + 2 < n ? Vec<D>(chord_[k] * m[k + 1]) : Vec<D>(Vec<D>::Zero());
      m[k] = (m[k] - after) / diagonal[k];
    }
    return m;
  }

  /// The same in a ring, by the Sherman-Morrison formula.
  std::vector<Vec<D>> periodic_bends() const {
    const std::size_t n = chord_.size();
    std::vector<double> lower(n), diagonal(n), upper(n);
    std::vector<Vec<D>> rhs(n);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t before = (k + n - 1) % n;
      lower[k] = chord_[before];
      upper[k] = chord_[k];
      diagonal[k] = 2 * (chord_[before] + chord_[k]);
      rhs[k] = 6 * ((knots_[k + 1] - knots_[k]) / chord_[k] -
                    (knots_[k] - knots_[before]) / chord_[before]);
    }
    const double corner = lower[0], gamma = -diagonal[0];
    diagonal[0] -= gamma;
    diagonal[n - 1] -= corner * upper[n - 1] / gamma;
    std::vector<double> u(n, 0.0);
    u[0] = gamma;
    u[n - 1] = upper[n - 1];
    for (std::size_t k = 1; k < n; ++k) {
      const double factor = lower[k] / diagonal[k - 1];
      diagonal[k] -= factor * upper[k - 1];
      rhs[k] -= factor * rhs[k - 1];
      u[k] -= factor * u[k - 1];
    }
    for (std::size_t k = n; k-- > 0;) {
      const bool last = k + 1 == n;
      rhs[k] =
          (rhs[k] - (last ? Vec<D>(Vec<D>::Zero()) : Vec<D>(upper[k] * rhs[k + 1]))) / diagonal[k];
      u[k] = (u[k] - (last ? 0.0 : upper[k] * u[k + 1])) / diagonal[k];
    }
    const double weight = corner / gamma;
    const double denominator = 1 + u[0] + weight * u[n - 1];
    const Vec<D> share = (rhs[0] + weight * rhs[n - 1]) / denominator;
    std::vector<Vec<D>> m(n + 1);
    for (std::size_t k = 0; k < n; ++k) m[k] = rhs[k] - u[k] * share;
    m[n] = m[0];
    return m;
  }

  Index count_ = 0;
  std::vector<Vec<D>> knots_;
  std::vector<double> chord_;
  std::vector<double> arcs_{0};  // up to each knot
  std::vector<Vec<D>> bends_;    // second derivatives at the knots
  BoxTree<D> tree_;
};

}  // namespace winslow
