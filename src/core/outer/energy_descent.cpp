#include "core/outer/energy_descent.h"

#include <cmath>

#include "core/error.h"
#include "core/linear/multigrid.h"
#include "core/linear/vector_operations.h"
#include "core/outer/newton_step.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// Inner product of short vectors, in eight sums so that an addition need not wait for the one
/// before.
template <typename A, typename B>
double inner_product(const A* a, const B* b, std::size_t count) {
  constexpr std::size_t lanes = 8;
  double sums[lanes]{};
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    for (std::size_t l = 0; l < lanes; ++l)
      sums[l] += static_cast<double>(a[i + l]) * static_cast<double>(b[i + l]);
  for (; i < count; ++i) sums[0] += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

/// body(first, count) for short pieces of a vector, on several threads; those of a block in order.
/// Several vectors' pieces fit into the fastest cache.
template <typename Body>
void each_piece(int threads, std::size_t size, Body&& body) {
  constexpr Index longest = 1024;
  static_assert(parallel_block % longest == 0);
  parallel_for(worthwhile(threads, size), static_cast<Index>(size), [&](Index begin, Index end) {
    for (Index first = begin; first < end; first += longest)
      body(at(first), at(std::min(longest, end - first)));
  });
}

}  // namespace

/// The inner products of s and z of each pair with g, and of those of the last one, a new pair,
/// with g_before as well: at the end.
std::vector<double> CurvatureMemory::products(std::span<const double> g_before,
                                              std::span<const double> g, const Pair& last) const {
  const std::size_t count = 2 * pairs_.size() + 4;
  std::vector<double> parts(count * block_count(static_cast<Index>(g.size())), 0.0);
  each_piece(threads_, g.size(), [&](std::size_t first, std::size_t size) {
    double* out = &parts[count * (first / at(parallel_block))];
    const auto with = [&](const std::vector<float>& v, std::span<const double> gradient) {
      *out++ += inner_product(&v[first], &gradient[first], size);
    };
    for (const Pair& pair : pairs_) {
      with(pair.s, g);
      with(pair.z, g);
    }
    with(last.s, g);
    with(last.z, g);
    with(last.s, g_before);
    with(last.z, g_before);
  });
  std::vector<double> sums(count, 0.0);
  for (std::size_t i = 0; i < parts.size(); ++i) sums[i % count] += parts[i];
  return sums;
}

void CurvatureMemory::add(std::span<const double> s, std::span<const double> g_before,
                          std::span<const double> mg_before, std::span<const double> g,
                          std::span<const double> mg) {
  Pair last = std::move(spare_);
  last.s.resize(s.size());
  last.z.resize(s.size());
  each_piece(threads_, s.size(), [&](std::size_t first, std::size_t size) {
    for (std::size_t i = first; i < first + size; ++i) {
      last.s[i] = static_cast<float>(s[i]);
      last.z[i] = static_cast<float>(mg[i] - mg_before[i]);
    }
  });
  const std::vector<double> of = products(g_before, g, last);
  const double* own = &of[2 * pairs_.size()];
  const double sy = own[0] - own[2], zy = own[1] - own[3];
  constexpr double flat = 1e-10;
  const bool is_convex = sy > flat * std::abs(own[2]) && zy > 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    Pair& pair = pairs_[i];
    if (is_convex) {
      pair.sy.push_back(of[2 * i] - pair.sg);
      pair.zy.push_back(of[2 * i + 1] - pair.zg);
    }
    pair.sg = of[2 * i];
    pair.zg = of[2 * i + 1];
  }
  if (!is_convex) {
    spare_ = std::move(last);
    return;
  }
  last.sg = own[0];
  last.zg = own[1];
  last.sy.assign(1, sy);
  last.zy.assign(1, zy);
  pairs_.push_back(std::move(last));
  if (pairs_.size() <= depth_) return;
  spare_ = std::move(pairs_.front());
  pairs_.erase(pairs_.begin());
}

/// The two loops of L-BFGS, in which all vectors are combinations of M^-1 g, s_i and z_i.
void CurvatureMemory::direction(std::span<const double> mg, std::span<double> out) const {
  const std::size_t count = pairs_.size();
  const double gamma = scale();
  std::vector<double> a(count), c(count);  // of -gamma z_i and of s_i
  for (std::size_t i = count; i-- > 0;) {
    double sum = pairs_[i].sg;
    for (std::size_t j = i + 1; j < count; ++j) sum -= a[j] * pairs_[i].sy[j - i];
    a[i] = sum / pairs_[i].sy[0];
  }
  for (std::size_t i = 0; i < count; ++i) {
    double sum = pairs_[i].zg;
    for (std::size_t j = 0; j < count; ++j)
      sum -= a[j] * (j >= i ? pairs_[i].zy[j - i] : pairs_[j].zy[i - j]);
    sum *= gamma;
    for (std::size_t j = 0; j < i; ++j) sum += c[j] * pairs_[j].sy[i - j];
    c[i] = a[i] - sum / pairs_[i].sy[0];
  }
  each_piece(threads_, out.size(), [&](std::size_t first, std::size_t size) {
    for (std::size_t i = first; i < first + size; ++i) out[i] = -gamma * mg[i];
    for (std::size_t k = 0; k < count; ++k) {
      const double of_z = gamma * a[k], of_s = -c[k];
      const float *z = pairs_[k].z.data(), *s = pairs_[k].s.data();
      for (std::size_t i = first; i < first + size; ++i)
        out[i] += of_z * static_cast<double>(z[i]) + of_s * static_cast<double>(s[i]);
    }
  });
}

namespace {

constexpr std::size_t memory_depth = 8;  // 6 to 20 take as many iterations, within a tenth

}  // namespace

EnergyDescent::EnergyDescent(std::shared_ptr<const EnergyProblem> problem,
                             const DescentOptions& options)
    : options_(options),
      preconditioner_(make_multigrid_of_components(options.threads)),
      memory_(memory_depth, options.threads) {
  set_problem(std::move(problem));
}

void EnergyDescent::set_problem(std::shared_ptr<const EnergyProblem> problem) {
  problem_ = std::move(problem);
  form_ = problem_->first_order();
  if (!form_) throw UsageError("the energy has no form for first-order methods");
  const auto rows = at(form_->rows());
  for (auto* v : {&gradient_, &preconditioned_, &direction_, &places_, &trial_.gradient, &way_,
                  &preconditioned_before_})
    v->resize(3 * rows);
  scales_.resize(rows);
  rates_.resize(problem_->unknowns());
}

void EnergyDescent::rest() {
  memory_.release();
  laplacian_.values = {};
  trial_ = {};
  for (auto* v : {&gradient_, &preconditioned_, &direction_, &places_, &way_,
                  &preconditioned_before_, &scales_, &rates_})
    *v = {};
}

/// The largest scaled residual, with the scales of the mesh where these were found.
double EnergyDescent::scaled_residual() const {
  std::vector<double> largest(block_count(form_->rows()), 0.0);
  parallel_for(options_.threads, form_->rows(), [&](Index begin, Index end) {
    double most = 0;
    for (auto i = at(begin); i < at(end); ++i) {
      const double* g = &gradient_[3 * i];
      const double scaled2 = (g[0] * g[0] + g[1] * g[1] + g[2] * g[2]) / (scales_[i] * scales_[i]);
      if (!(scaled2 <= most)) most = scaled2;
    }
    largest[at(begin / parallel_block)] = most;
  });
  return largest.empty() ? 0 : std::sqrt(*std::ranges::max_element(largest));
}

/// Finds what would be too slow to find after every step.
void EnergyDescent::assess(const Coordinates& x) {
  form_->scales(x, scales_);
  record(problem_->validity(x));
  round_off_ = problem_->residual_round_off(x);
  record_.residual = scaled_residual();
}

IterationRecord EnergyDescent::start(const Coordinates& x) {
  begin_record(1);
  stalled_ = false;
  history_.clear();
  since_built_ = -1;
  energy_ = form_->gradient(x, gradient_);
  if (!std::isfinite(energy_))
    throw UsageError("first-order steps on the energy start from a mesh without inverted elements");
  form_->positions(x, places_);
  assess(x);
  return record_;
}

/// Whether the preconditioner still fits. Near the solution it does to the end.
bool EnergyDescent::fits() const {
  constexpr int lifetime = 15;   // iterations far from the solution
  constexpr double near = 0.01;  // scaled residual
  return since_built_ >= 0 && (since_built_ < lifetime || built_at_ <= near);
}

/// Makes the preconditioner for the mesh x.
void EnergyDescent::precondition(const Coordinates& x) {
  if (since_built_ > 0) assess(x);
  form_->laplacian(x, laplacian_);
  preconditioner_->build(laplacian_);
  preconditioner_->apply(gradient_, preconditioned_);
  memory_.clear();
  since_built_ = 0;
  built_at_ = record_.residual;
}

void EnergyDescent::attempt(const Coordinates& x, double t) {
  trial_.x = x;
  trial_.t = t;
  trial_.move = problem_->advance(rates_, t, trial_.x);
  trial_.energy = form_->gradient(trial_.x, trial_.gradient);
}

/// Whether the step of trial_ lowers the energy enough. slope: its rate of decrease at first.
bool EnergyDescent::acceptable(double slope) {
  constexpr double armijo = 1e-4;
  constexpr double flat = 1e-11;  // relative change of the energy that round-off can cause
  bool good = trial_.energy <= energy_ - armijo * trial_.t * slope;
  if (!good && std::abs(trial_.energy - energy_) <= flat * energy_) {
    const double there = -dot(trial_.gradient, direction_, options_.threads);
    good = std::abs(there) <= (1 - armijo) * slope;
  }
  if (!good || form_->is_barrier()) return good;
  // The Jacobian of a hexahedron can change its sign between its corners first.
  trial_.validity = problem_->validity(trial_.x);
  return trial_.validity.inverted == 0 || record_.inverted > 0;
}

/// Finds a step from x that lowers the energy: trial_. Returns false if there is none.
bool EnergyDescent::descend(const Coordinates& x) {
  constexpr int most_trials = 30;
  memory_.direction(preconditioned_, direction_);
  const double slope = -dot(gradient_, direction_, options_.threads);
  if (!(slope > 0)) return false;
  form_->rates(x, direction_, rates_);
  double t = 1;
  for (int i = 0; i < most_trials; ++i) {
    attempt(x, t);
    if (acceptable(slope)) return true;
    // The largest valid step takes longer to find than a gradient, so it is asked for only here.
    t = std::isfinite(trial_.energy) ? shorter_step(t, slope, trial_.energy - energy_ + t * slope)
                                     : std::min(0.5 * t, first_valid_step(*problem_, rates_, t, x));
  }
  return false;
}

/// Goes to the mesh of trial_.
void EnergyDescent::take_up(Coordinates& x) {
  std::swap(x, trial_.x);
  std::swap(gradient_, trial_.gradient);
  energy_ = trial_.energy;
  if (!form_->is_barrier()) record(trial_.validity);
  record_.damping = trial_.t;
  record_.largest_move = trial_.move;
  std::swap(places_, way_);
  std::swap(preconditioned_, preconditioned_before_);
  form_->positions(x, places_);
  each_piece(options_.threads, way_.size(), [&](std::size_t first, std::size_t size) {
    for (std::size_t i = first; i < first + size; ++i) way_[i] = places_[i] - way_[i];
  });
  preconditioner_->apply(gradient_, preconditioned_);
  memory_.add(way_, trial_.gradient, preconditioned_before_, gradient_, preconditioned_);
  ++since_built_;
  record_.residual = scaled_residual();
}

/// Whether Newton's method is faster from here. Far from a solution it takes many steps with
/// systems that are hard to solve, so first-order steps go on as long as they lower the energy:
/// meanwhile the largest residual rises and falls. Near a solution Newton's method has a price that
/// is known. Once that has been spent, first-order steps go on only if they need less than it from
/// here.
bool EnergyDescent::is_slow() const {
  constexpr std::ptrdiff_t window = 30, long_window = 90;
  constexpr std::ptrdiff_t price = 130;  // of Newton's method near a solution, in these steps
  constexpr double near = 0.05;          // scaled residual
  constexpr double least_gain = 1e-6;    // of the energy, over the long window
  const auto first_near = std::ranges::find_if(
      history_, [](const Reached& reached) { return reached.residual < near; });
  const double wanted = std::max(options_.tolerance, round_off_);
  if (history_.end() - first_near < price) {
    if (std::ssize(history_) <= long_window) return false;
    const double gain = (history_.end() - 1 - long_window)->energy - energy_;
    return !(gain > least_gain * std::abs(energy_)) && first_near == history_.end();
  }
  const auto recent = history_.end() - window;
  const auto smaller = [](const Reached& a, const Reached& b) { return a.residual < b.residual; };
  const double before = std::min_element(history_.begin(), recent, smaller)->residual;
  const double now = std::min_element(recent, history_.end(), smaller)->residual;
  if (!(now < before)) return true;
  const double left = static_cast<double>(window) * std::log(now / wanted) / std::log(before / now);
  return left > static_cast<double>(price);
}

IterationRecord EnergyDescent::step(Coordinates& x) {
  ++record_.iteration;
  if (form_->rows() == 0) return record_;
  const bool fresh = !fits();
  if (fresh) precondition(x);
  bool found = descend(x);
  if (!found && !fresh) {
    pass_checkpoint();
    precondition(x);
    found = descend(x);
  }
  if (found) {
    take_up(x);
    history_.push_back({record_.residual, energy_});
    if (converged()) assess(x);
    stalled_ = is_slow();
  } else {
    stalled_ = true;
    record_.damping = record_.largest_move = 0;
  }
  if (stalled_) assess(x);
  return record_;
}

bool EnergyDescent::converged() const {
  return record_.residual <= std::max(options_.tolerance, round_off_);
}

}  // namespace winslow
