#include "core/outer/energy_untangler.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/outer/advance.h"
#include "core/outer/shifted_matrix.h"

namespace winslow {

namespace {

/// Share of a triangle's size by which its determinant is regularised at first.
constexpr double softest = 0.1;

double determinant(const std::array<Index, 3>& nodes, const Coordinates& x) {
  const Vec2 u = x.xy(nodes[1]) - x.xy(nodes[0]);
  const Vec2 v = x.xy(nodes[2]) - x.xy(nodes[0]);
  return u.x() * v.y() - u.y() * v.x();
}

/// Mean |determinant| of the triangles around each triangle's nodes.
std::vector<double> neighbourhood_sizes(const Topology& topology, const TargetShapes& shapes,
                                        const Coordinates& x) {
  std::vector<double> sum(static_cast<std::size_t>(topology.node_count()), 0.0);
  std::vector<int> count(sum.size(), 0);
  for (const auto& nodes : shapes.triangles) {
    const double size = std::abs(determinant(nodes, x));
    for (const Index node : nodes) {
      sum[static_cast<std::size_t>(node)] += size;
      ++count[static_cast<std::size_t>(node)];
    }
  }
  std::vector<double> sizes;
  sizes.reserve(shapes.triangles.size());
  for (const auto& nodes : shapes.triangles) {
    double size = 0;
    for (const Index node : nodes) {
      size += sum[static_cast<std::size_t>(node)] / count[static_cast<std::size_t>(node)];
    }
    sizes.push_back(std::max(size / 3, std::numeric_limits<double>::min()));
  }
  return sizes;
}

}  // namespace

EnergyUntangler::EnergyUntangler(const Topology& topology, const VariationalWinslow& formulation,
                                 LinearSolver& linear, const SmoothOptions& options,
                                 const Coordinates* reference, Interior interior)
    : topology_(topology),
      formulation_(formulation),
      linear_(linear),
      options_(options),
      reference_(reference),
      interior_(interior) {
  regularisation_.epsilon = 1;
  // What is left of a looser residual may be larger than the triangles at a small body.
  constexpr double loosest = 1e-6;
  linear_.set_tolerance(std::min(options_.linear.tolerance, loosest));
}

/// Once and for all: sizes measured anew as the mesh changes would let nodes that draw together go
/// on to one point, the regularisation shrinking with their triangles.
void EnergyUntangler::measure_sizes(const Coordinates& x) {
  sizes_ = neighbourhood_sizes(topology_, formulation_.shapes(), reference_ ? *reference_ : x);
}

/// So much, and the same for all triangles, that nothing is left of their determinants: the energy
/// is the sum of the targets' quadratic forms, and one Newton step leads to its only minimum.
void EnergyUntangler::regularise_away(const Coordinates& x) {
  constexpr double far_beyond = 1e6;  // the largest determinant
  const auto& triangles = formulation_.shapes().triangles;
  double largest = std::numeric_limits<double>::min();
  for (const auto& nodes : triangles) largest = std::max(largest, std::abs(determinant(nodes, x)));
  regularisation_.size.assign(triangles.size(), far_beyond * largest);
}

void EnergyUntangler::choose_regularisation(const Coordinates& x) {
  if (harmonic_step()) return regularise_away(x);
  constexpr double share = 1;  // of an inverted triangle's determinant
  const auto& triangles = formulation_.shapes().triangles;
  regularisation_.size.resize(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const double negative = std::min(0.0, determinant(triangles[t], x));
    regularisation_.size[t] = std::hypot(softness_ * sizes_[t], share * negative);
  }
}

void EnergyUntangler::assess(const Coordinates& x) {
  const Validity validity = check_validity(topology_, x, options_.threads);
  record_.inverted = validity.inverted;
  record_.min_sine = validity.min_sine;
  // A soft determinant untangles the bulk, a sharp one the last few elements.
  constexpr int patience = 8;
  constexpr double sharpening = 0.25;
  if (record_.inverted < least_inverted_) {
    least_inverted_ = record_.inverted;
    last_progress_ = record_.iteration;
  } else if (record_.iteration - last_progress_ >= patience) {
    softness_ *= sharpening;
    last_progress_ = record_.iteration;
  }
}

IterationRecord EnergyUntangler::start(const Coordinates& x) {
  record_ = {};
  record_.damping = 1;
  softness_ = softest;
  least_inverted_ = std::numeric_limits<Index>::max();
  last_progress_ = 0;
  measure_sizes(x);
  assess(x);
  choose_regularisation(x);
  std::vector<double> residual(2 * topology_.free_nodes().size());
  record_.residual =
      formulation_.linearise(x, Curvature::projected, hessian_, residual, &regularisation_)
          .norms.max;
  return record_;
}

IterationRecord EnergyUntangler::step(Coordinates& x) {
  ++record_.iteration;
  if (interior_ == Interior::harmonic && record_.iteration == 2) {
    measure_sizes(x);
    least_inverted_ = record_.inverted;
    last_progress_ = 1;
  }
  choose_regularisation(x);
  const auto free = topology_.free_nodes();
  std::vector<double> residual(2 * free.size()), direction(2 * free.size(), 0.0);
  record_.residual =
      formulation_.linearise(x, Curvature::projected, hessian_, residual, &regularisation_)
          .norms.max;
  record_.linear_iterations = solve_shifted(linear_, hessian_, residual, direction).iterations;
  ++linear_solves_;
  double slope = 0;
  for (std::size_t i = 0; i < residual.size(); ++i) slope += residual[i] * direction[i];
  const double energy = formulation_.energy(x, &regularisation_);
  double t = 1;
  constexpr double armijo = 1e-4;
  constexpr int most_trials = 20;
  for (int trial = 0; trial < most_trials; ++trial, t *= 0.5) {
    Coordinates candidate = x;
    const double move = advance(topology_, direction, t, candidate);
    // To the minimum of a quadratic form needs no search, which round-off would end if x is there.
    if (!harmonic_step() &&
        formulation_.energy(candidate, &regularisation_) > energy - armijo * t * slope) {
      continue;
    }
    x = std::move(candidate);
    record_.damping = t;
    record_.largest_move = move;
    assess(x);
    return record_;
  }
  record_.damping = 0;
  record_.largest_move = 0;
  return record_;
}

}  // namespace winslow
