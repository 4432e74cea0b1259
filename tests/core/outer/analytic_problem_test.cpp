#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "core/outer/energy_newton.h"
#include "core/outer/energy_untangler.h"
#include "core/outer/path_follower.h"
#include "support/coordinate.h"

using namespace winslow;
using winslow::test::coordinate;

/// The solvers know a problem by its interface alone: here is one that is no mesh.
namespace {

/// A chain of beads in d dimensions, the first and the last prescribed, that minimises
///
///   E = sum_k stiffness (g_k^2 / 2 + 1 / g_k) + 1/2 sum_{c > 0} |difference of component c|^2,
///
/// g_k being the gap between beads k and k + 1 along the first axis: a barrier against a bead that
/// passes its neighbour. Solution: equal gaps on a straight line where the gaps have the length 1.
/// With unknowns in a single component (`sliding`), the beads slide along the first axis.
class Chain final : public UntanglingProblem {
 public:
  Chain(int dimension, bool sliding, double stiffness)
      : dimension_(dimension), components_(sliding ? 1 : dimension), stiffness_(stiffness) {
    auto pattern = std::make_shared<SparsityPattern>();
    for (Index i = 0; i < beads; ++i) {
      for (Index j = std::max(0, i - 1); j <= std::min(beads - 1, i + 1); ++j) {
        if (j == i) pattern->diagonal.push_back(static_cast<Index>(pattern->columns.size()));
        pattern->columns.push_back(j);
      }
      pattern->offsets.push_back(static_cast<Index>(pattern->columns.size()));
    }
    pattern_ = std::move(pattern);
  }

  static constexpr Index beads = 6;  // that move; 0 and beads + 1 are prescribed

  /// Equal gaps of length 1 along the first axis.
  Coordinates straight() const {
    Coordinates x(dimension_, beads + 2);
    for (Index k = 0; k < x.size(); ++k) coordinate(x, k, 0) = k;
    return x;
  }

  std::string_view name() const override { return "chain"; }
  std::size_t unknowns() const override { return static_cast<std::size_t>(beads * components_); }
  void values(const Coordinates& x, std::span<double> out) const override {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = *number(x, i);
  }
  void lengths(const Coordinates&, std::span<double> out) const override {
    std::fill(out.begin(), out.end(), 1.0);
  }
  double advance(std::span<const double> direction, double step, Coordinates& x) const override {
    double longest = 0;
    for (std::size_t i = 0; i < direction.size(); ++i) {
      x.values()[place(i)] += step * direction[i];
      longest = std::max(longest, std::abs(step * direction[i]));
    }
    return longest;
  }
  void velocities(const Coordinates&, std::span<const double> rates,
                  Coordinates& out) const override {
    for (std::size_t i = 0; i < rates.size(); ++i) out.values()[place(i)] = rates[i];
  }
  double largest_valid_step(const Coordinates& from, const Coordinates& to,
                            double most) const override {
    double smallest = most;
    for (Index k = 0; k <= beads; ++k) {
      const double closes = gap(from, k) - gap(to, k);
      if (closes > 0) smallest = std::min(smallest, gap(from, k) / closes);
    }
    return smallest;
  }
  Validity validity(const Coordinates& x) const override {
    Validity validity{0, 1};
    for (Index k = 0; k <= beads; ++k) {
      validity.inverted += gap(x, k) > 0 ? 0 : 1;
      validity.min_sine = std::min(validity.min_sine, gap(x, k));
    }
    return validity;
  }
  ResidualNorms residual(const Coordinates& x, std::span<double> out) const override {
    SparseMatrix unused;
    std::vector<double> r(unknowns());
    const ResidualNorms norms = linearise(x, Curvature::exact, unused, r).norms;
    std::copy(r.begin(), r.begin() + static_cast<std::ptrdiff_t>(out.size()), out.begin());
    return norms;
  }
  double residual_round_off(const Coordinates&) const override { return 1e-14; }
  void boundary_response(const Coordinates& x, const Coordinates& displacement,
                         std::span<double> out) const override {
    std::fill(out.begin(), out.end(), 0.0);
    for (const auto& [end, bead] : {std::array<Index, 2>{0, 1}, {beads + 1, beads}}) {
      for (int c = 0; c < components_; ++c) {
        out[static_cast<std::size_t>((bead - 1) * components_ + c)] =
            bend(x, std::min(end, bead), c, 0) * coordinate(displacement, end, c);
      }
    }
  }

  double energy(const Coordinates& x) const override { return sum(x, 0); }
  Linearisation linearise(const Coordinates& x, Curvature, SparseMatrix& hessian,
                          std::span<double> residual) const override {
    return assemble(x, 0, hessian, residual);
  }

  std::vector<double> cell_sizes(const Coordinates&) const override {
    return std::vector<double>(beads + 1, 1.0);
  }
  Regularisation regularisation(const Coordinates& x, std::span<const double> sizes,
                                const Softness& softness) const override {
    Regularisation out;
    for (Index k = 0; k <= beads; ++k) {
      out.size.push_back(std::hypot(softness.of_size * sizes[static_cast<std::size_t>(k)],
                                    softness.of_inverted * std::min(0.0, gap(x, k))));
    }
    return out;
  }
  Regularisation full_regularisation(const Coordinates&) const override {
    return {std::vector<double>(beads + 1, 1e6)};
  }
  double regularised_energy(const Coordinates& x, const Regularisation& r) const override {
    return sum(x, *std::max_element(r.size.begin(), r.size.end()));
  }
  Linearisation linearise_regularised(const Coordinates& x, const Regularisation& r,
                                      SparseMatrix& hessian,
                                      std::span<double> residual) const override {
    return assemble(x, *std::max_element(r.size.begin(), r.size.end()), hessian, residual);
  }

 private:
  std::size_t place(std::size_t unknown) const {
    const auto d = static_cast<std::size_t>(dimension_), c = static_cast<std::size_t>(components_);
    return (unknown / c + 1) * d + unknown % c;
  }
  const double* number(const Coordinates& x, std::size_t unknown) const {
    return x.values().data() + place(unknown);
  }
  static double gap(const Coordinates& x, Index k) {
    return coordinate(x, k + 1, 0) - coordinate(x, k, 0);
  }

  /// chi(g) of a gap regularised by e, and its slope: see Regularisation.
  static std::array<double, 2> softened(double g, double e) {
    if (e == 0) return {g, 1};
    const double root = std::hypot(e, g);
    return {g > 0 ? 0.5 * (g + root) : 0.5 * e * e / (root - g), 0.5 * (1 + g / root)};
  }
  double sum(const Coordinates& x, double e) const {
    double energy = 0;
    for (Index k = 0; k <= beads; ++k) {
      const double chi = softened(gap(x, k), e)[0];
      if (!(chi > 0)) return std::numeric_limits<double>::infinity();
      energy += stiffness_ * (0.5 * gap(x, k) * gap(x, k) + 1 / chi);
      for (int c = 1; c < components_; ++c) {
        energy += 0.5 * std::pow(coordinate(x, k + 1, c) - coordinate(x, k, c), 2);
      }
    }
    return energy;
  }
  /// First derivative of the energy by the difference in component c over gap k.
  double pull(const Coordinates& x, Index k, int c, double e) const {
    if (c > 0) return coordinate(x, k + 1, c) - coordinate(x, k, c);
    const auto [chi, slope] = softened(gap(x, k), e);
    return stiffness_ * (gap(x, k) - slope / (chi * chi));
  }
  /// Second one; with a softened gap its part that is positive by construction.
  double bend(const Coordinates& x, Index k, int c, double e) const {
    if (c > 0) return 1;
    const auto [chi, slope] = softened(gap(x, k), e);
    return stiffness_ * (1 + 2 * slope * slope / (chi * chi * chi));
  }
  Linearisation assemble(const Coordinates& x, double e, SparseMatrix& matrix,
                         std::span<double> residual) const {
    const auto n = static_cast<std::size_t>(components_);
    matrix.pattern = pattern_;
    matrix.block = components_;
    matrix.symmetric = true;
    matrix.values.assign(pattern_->columns.size() * n * n, 0.0);
    Linearisation result{{}, sum(x, e)};
    const auto set = [&](Index entry, int c, double value) {
      const auto k = static_cast<std::size_t>(c);
      matrix.values[(static_cast<std::size_t>(entry) * n + k) * n + k] = value;
    };
    for (Index row = 0; row < beads; ++row) {
      for (int c = 0; c < components_; ++c) {
        const double left = bend(x, row, c, e), right = bend(x, row + 1, c, e);
        const Index diagonal = pattern_->diagonal[static_cast<std::size_t>(row)];
        set(diagonal, c, left + right);
        if (row > 0) set(diagonal - 1, c, -left);
        if (row + 1 < beads) set(diagonal + 1, c, -right);
        double& r = residual[static_cast<std::size_t>(row * components_ + c)];
        r = pull(x, row + 1, c, e) - pull(x, row, c, e);
        result.norms.max = std::max(result.norms.max, std::abs(r) / (left + right));
      }
    }
    return result;
  }

  int dimension_, components_;
  double stiffness_;
  std::shared_ptr<const SparsityPattern> pattern_;
};

/// Counts the matrices that it is given.
class CountingSolver final : public LinearSolver {
 public:
  int matrices = 0;

  std::string_view name() const override { return solver_->name(); }
  std::string description() const override { return solver_->description(); }
  void set_matrix(const SparseMatrix& matrix, bool keep) override {
    ++matrices;
    solver_->set_matrix(matrix, keep);
  }
  LinearResult solve(std::span<const double> rhs, int columns, std::span<double> x) override {
    return solver_->solve(rhs, columns, x);
  }
  void set_tolerance(double relative_residual) override {
    solver_->set_tolerance(relative_residual);
  }

 private:
  std::unique_ptr<LinearSolver> solver_ = make_linear_solver({.solver = "direct"});
};

struct Case {
  int dimension;
  bool sliding;
};
constexpr std::array<Case, 4> cases{{{2, true}, {2, false}, {3, false}, {3, true}}};

/// Beads off their places, in the components that are unknowns, all gaps open.
Coordinates shaken(const Chain& chain) {
  Coordinates x = chain.straight();
  std::vector<double> shift(chain.unknowns());
  for (std::size_t i = 0; i < shift.size(); ++i) shift[i] = 0.4 * std::sin(3.0 * double(i) + 1);
  chain.advance(shift, 1, x);
  return x;
}

double largest_difference(const Coordinates& a, const Coordinates& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    largest = std::max(largest, std::abs(a.values()[i] - b.values()[i]));
  }
  return largest;
}

void solve(EnergyNewton& newton, Coordinates& x) {
  newton.start(x);
  for (int k = 0; k < 50 && !newton.converged(); ++k) newton.step(x);
  REQUIRE(newton.converged());
}

}  // namespace

TEST_CASE("Newton's method solves a problem that is no mesh, in 1 to 3 unknowns a node") {
  for (const Case& c : cases) {
    CAPTURE(c.dimension);
    CAPTURE(c.sliding);
    const auto chain = std::make_shared<const Chain>(c.dimension, c.sliding, 1);
    CountingSolver linear;
    EnergyNewton newton(chain, linear, {});
    Coordinates x = shaken(*chain);
    REQUIRE(chain->validity(x).inverted == 0);
    solve(newton, x);
    CHECK(largest_difference(x, chain->straight()) < 1e-9);
  }
}

TEST_CASE("a path leads a problem that is no mesh to its stretched solution") {
  for (const Case& c : cases) {
    CAPTURE(c.dimension);
    CAPTURE(c.sliding);
    const auto chain = std::make_shared<const Chain>(c.dimension, c.sliding, 1);
    CountingSolver linear;
    EnergyNewton newton(chain, linear, {});
    Coordinates x = chain->straight();
    solve(newton, x);
    const int last = c.dimension - 1;
    const auto pull = [&](double fraction, Coordinates& at) {
      coordinate(at, Chain::beads + 1, 0) = Chain::beads + 1 + 5 * fraction;
      if (last > 0 && !c.sliding) coordinate(at, Chain::beads + 1, last) = 3 * fraction;
    };
    double before = 0;
    const double reached =
        PathFollower(newton, {})
            .follow(pull, 0, x, [&](const IterationRecord& record, const Coordinates& at) {
              CHECK(record.fraction > before);
              CHECK(chain->validity(at).inverted == 0);
              before = record.fraction;
              return true;
            });
    CHECK(reached == 1);
    solve(newton, x);
    // Equal gaps along every axis.
    for (Index k = 0; k <= Chain::beads + 1; ++k) {
      const double share = static_cast<double>(k) / (Chain::beads + 1);
      CHECK(coordinate(x, k, 0) == doctest::Approx(share * (Chain::beads + 6)));
      if (last > 0 && !c.sliding) CHECK(coordinate(x, k, last) == doctest::Approx(3 * share));
    }
  }
}

TEST_CASE("a path that is blocked ends before the last gap closes, mesh or not") {
  const auto chain = std::make_shared<const Chain>(2, true, 1);
  CountingSolver linear;
  EnergyNewton newton(chain, linear, {});
  Coordinates x = chain->straight();
  solve(newton, x);
  const double reached =
      PathFollower(newton, {})
          .follow(
              [&](double fraction, Coordinates& at) {
                coordinate(at, Chain::beads + 1, 0) = (Chain::beads + 1) * (1 - 2 * fraction);
              },
              0, x, [](const IterationRecord&, const Coordinates&) { return true; });
  CHECK(reached < 0.5);
  CHECK(reached > 0.4);
  CHECK(chain->validity(x).inverted == 0);
}

TEST_CASE("beads in the wrong order are untangled by the regularised energy") {
  for (const Interior interior : {Interior::as_given, Interior::harmonic}) {
    for (const Case& c : cases) {
      CAPTURE(c.dimension);
      const auto chain = std::make_shared<const Chain>(c.dimension, c.sliding, 1);
      CountingSolver linear;
      EnergyUntangler untangler(chain, linear, 1e-3, nullptr, interior);
      Coordinates x = chain->straight();
      std::swap(coordinate(x, 2, 0), coordinate(x, 5, 0));
      CHECK(untangler.start(x).inverted > 0);
      for (int k = 0; k < 50 && !untangler.converged(); ++k) untangler.step(x);
      CHECK(untangler.converged());
      CHECK(chain->validity(x).inverted == 0);
    }
  }
}

TEST_CASE("a factorisation serves one problem: another one, or a rejected way, means a new one") {
  const auto soft = std::make_shared<const Chain>(2, false, 1);
  const auto stiff = std::make_shared<const Chain>(2, false, 100);
  CountingSolver linear;
  EnergyNewton newton(soft, linear, {});
  Coordinates x = shaken(*soft);
  solve(newton, x);
  const Coordinates still(2, x.size());
  std::vector<double> answer(soft->unknowns());
  newton.predict(x, still, answer);
  const int before = linear.matrices;
  newton.predict(x, still, answer);
  CHECK(linear.matrices == before);
  newton.set_problem(stiff);
  newton.predict(x, still, answer);
  CHECK(linear.matrices == before + 1);
  newton.predict(x, still, answer);
  CHECK(linear.matrices == before + 1);
  newton.reject();
  newton.predict(x, still, answer);
  CHECK(linear.matrices == before + 2);
}

TEST_CASE("after a change of the problem predictions are those of the new one") {
  Coordinates pull(2, Chain::beads + 2);
  coordinate(pull, Chain::beads + 1, 0) = 1;
  coordinate(pull, Chain::beads + 1, 1) = 1;
  const auto soft = std::make_shared<const Chain>(2, false, 1);
  const auto stiff = std::make_shared<const Chain>(2, false, 100);
  const Coordinates x = shaken(*soft);
  const auto predicted = [&](EnergyNewton& newton) {
    std::vector<double> answer(newton.problem().unknowns());
    newton.predict(x, pull, answer);
    return answer;
  };
  CountingSolver one, other;
  EnergyNewton changed(soft, one, {}), direct(stiff, other, {});
  const auto before = predicted(changed);
  changed.set_problem(stiff);
  CHECK(predicted(changed) == predicted(direct));
  // Equal gaps are what either strives for; along the chain the answer is the same, whatever the
  // stiffness, and across it has none.
  for (std::size_t i = 0; i < before.size(); ++i) {
    CHECK(predicted(changed)[i] == doctest::Approx(before[i]));
  }
}
