#include "gui/document/jobs/quality_monitor.h"

namespace winslow::gui {

namespace {

// While a solver runs, measuring more often than the eye can follow would only slow it down.
constexpr std::chrono::milliseconds live_interval{120};

/// named: the numbers of wish.before, or of what it is a copy of. threads: 0 for all cores.
std::shared_ptr<const QualityMonitor::Measured> measure(std::uint64_t shape,
                                                        const QualityMonitor::Subject& subject,
                                                        const QualityMonitor::Wish& wish,
                                                        const void* named, int threads) {
  auto measured = std::make_shared<QualityMonitor::Measured>();
  measured->shape = shape;
  measured->topology = subject.mesh->topology;
  measured->field = wish.field;
  measured->before = named;
  measured->report = measure_quality(*subject.mesh, {.histogram_bins = 40,
                                                     .worst = most_worst,
                                                     .threads = threads,
                                                     .normals = {},
                                                     .before = wish.before});
  if (wish.field && subject.mesh->topology->cell_dimension() == 3)
    // Fields of plane meshes alone have no values here.
    measured->values = wish.field->metric() && wish.field->cell_dimension() == 3
                           ? element_values(*subject.mesh, *wish.field->metric())
                           : std::vector<double>();
  else if (wish.field)
    measured->values = element_values(*subject.vcv, subject.mesh->coordinates, *wish.field, 1,
                                      {.layers = subject.layers.get(), .before = wish.before});
  return measured;
}

}  // namespace

bool QualityMonitor::wants(std::uint64_t shape, const Wish& wish, bool live) const {
  if (worker_.busy()) return false;
  const bool met = latest_ && wish.met_by(*latest_);
  if (met && latest_->shape == shape) return false;
  return !live || !met || std::chrono::steady_clock::now() - last_start_ >= live_interval;
}

void QualityMonitor::request(std::uint64_t shape, const Subject& subject, const Wish& wish,
                             bool live) {
  if (!wants(shape, wish, live)) return;
  last_start_ = std::chrono::steady_clock::now();
  // A copy: the history may drop that state before the measurement has ended. Volume meshes, the
  // largest ones, have no first heights to compare.
  const bool compared = wish.before && subject.mesh->topology->cell_dimension() == 2;
  auto before = compared ? std::make_shared<const Coordinates>(*wish.before) : nullptr;
  // Beside a solver one core is enough; else the colours wait for it.
  const int threads = live ? 1 : 0;
  worker_.start(
      [shape, subject, field = wish.field, before, named = wish.before_numbers(), threads] {
        return measure(shape, subject, {field, before.get()}, named, threads);
      });
}

void QualityMonitor::measure_now(std::uint64_t shape, const Subject& subject, const Wish& wish) {
  if (latest_ && latest_->shape == shape && wish.met_by(*latest_)) return;
  latest_ = measure(shape, subject, wish, wish.before_numbers(), 0);
}

bool QualityMonitor::poll() {
  auto result = worker_.poll();
  if (!result) return false;
  if (discard_) {
    discard_ = false;
    return true;
  }
  // One that was taken at once may be newer.
  if (!latest_ || (*result)->shape >= latest_->shape) latest_ = std::move(*result);
  return true;
}

void QualityMonitor::clear() {
  latest_.reset();
  discard_ = worker_.busy();
}

}  // namespace winslow::gui
