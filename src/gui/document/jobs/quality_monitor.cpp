#include "gui/document/jobs/quality_monitor.h"

namespace winslow::gui {

namespace {

// While a solver runs, measuring more often than the eye can follow would only slow it down.
constexpr std::chrono::milliseconds live_interval{120};

std::shared_ptr<const QualityMonitor::Measured> measure(std::uint64_t shape, const MeshState& state,
                                                        std::optional<ElementField> field) {
  auto measured = std::make_shared<QualityMonitor::Measured>();
  measured->shape = shape;
  measured->topology = state.mesh.topology;
  measured->field = field;
  measured->report =
      measure_quality(state.mesh, {.histogram_bins = 40, .worst = most_worst, .threads = 1});
  if (field)
    measured->values =
        element_values(*state.vcv, state.mesh.coordinates, *field, 1, state.layers.get());
  return measured;
}

}  // namespace

bool QualityMonitor::wants(std::uint64_t shape, const std::optional<ElementField>& field,
                           bool live) const {
  if (worker_.busy()) return false;
  if (latest_ && latest_->shape == shape && latest_->field == field) return false;
  const bool same_field = latest_ && latest_->field == field;
  return !live || !same_field || std::chrono::steady_clock::now() - last_start_ >= live_interval;
}

void QualityMonitor::request(std::uint64_t shape, const MeshState& state,
                             std::optional<ElementField> field, bool live) {
  if (!wants(shape, field, live)) return;
  last_start_ = std::chrono::steady_clock::now();
  worker_.start([shape, state, field] { return measure(shape, state, field); });
}

void QualityMonitor::measure_now(std::uint64_t shape, const MeshState& state,
                                 std::optional<ElementField> field) {
  if (latest_ && latest_->shape == shape && latest_->field == field) return;
  latest_ = measure(shape, state, field);
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
