#include "gui/document/session/quality_watch.h"

#include "core/strategy/surface_shape.h"

namespace winslow::gui {

namespace {

// While a solver runs, measuring more often than the eye can follow would only slow it down.
constexpr std::chrono::milliseconds live_interval{120};

/// The inputs of a measurement.
struct Order {
  QualityMonitor::Wish wish;
  const void* named = nullptr;  // identity of wish.before, or of its original
  bool live = false;
  int threads = 0;  // 0: all cores
};

bool by_deviation(const std::optional<ElementField>& field) { return field && field->surface(); }

/// Measures the colours and the deviation of a surface mesh.
void measure_surface(const QualityMonitor::Subject& subject, const Order& order,
                     std::span<const Vec3> normals, QualityMonitor::Measured& measured) {
  const Mesh& mesh = *subject.mesh;
  const auto& field = order.wish.field;
  const SurfaceDistance& given = *order.wish.given;
  if (field) measured.values = surface_values(mesh, *field, normals, given, order.threads);
  if (!subject.surface || (order.live && !by_deviation(field))) return;
  const std::vector<double> distances =
      by_deviation(field) ? measured.values : element_distances(mesh, given, order.threads);
  QualityMonitor::Deviation deviation;
  deviation.change = compare_surfaces({mesh.topology, subject.surface->given}, given, mesh,
                                      distances, order.threads);
  deviation.worst =
      worst_elements(mesh, distances, field_info(SurfaceField::deviation), most_worst);
  measured.deviation = std::move(deviation);
}

std::shared_ptr<const QualityMonitor::Measured> measure(std::uint64_t shape,
                                                        const QualityMonitor::Subject& subject,
                                                        const Order& order) {
  auto measured = std::make_shared<QualityMonitor::Measured>();
  const QualityMonitor::Wish& wish = order.wish;
  measured->shape = shape;
  measured->topology = subject.mesh->topology;
  measured->field = wish.field;
  measured->before = order.named;
  const Mesh& mesh = *subject.mesh;
  const std::vector<Vec3> normals =
      subject.surface ? subject.surface->normals->of_elements(mesh.coordinates, order.threads)
                      : std::vector<Vec3>();
  measured->report = measure_quality(mesh, {.histogram_bins = 40,
                                            .worst = most_worst,
                                            .threads = order.threads,
                                            .normals = normals,
                                            .before = wish.before});
  const MeshKind kind = mesh.topology->kind();
  if (kind == MeshKind::surface && wish.given)
    measure_surface(subject, order, normals, *measured);
  else if (kind == MeshKind::surface && wish.field && wish.field->metric())
    measured->values = element_values(mesh, *wish.field->metric(), normals);
  else if (wish.field && kind == MeshKind::volume)
    measured->values = volume_values(mesh, *wish.field, wish.before);
  else if (wish.field && kind == MeshKind::plane)
    measured->values = element_values(*subject.vcv, mesh.coordinates, *wish.field, 1,
                                      {.layers = subject.layers.get(), .before = wish.before});
  return measured;
}

}  // namespace

bool QualityMonitor::wants(std::uint64_t shape, const Wish& wish, bool live) const {
  if (worker_.busy()) return false;
  const bool met = latest_ && wish.met_by(*latest_);
  // A deviation omitted while the solver was running is still needed.
  const bool whole = live || !wish.given || (latest_ && latest_->deviation);
  if (met && whole && latest_->shape == shape) return false;
  return !live || !met || std::chrono::steady_clock::now() - last_start_ >= live_interval;
}

void QualityMonitor::request(std::uint64_t shape, const Subject& subject, const Wish& wish,
                             bool live) {
  if (!wants(shape, wish, live)) return;
  last_start_ = std::chrono::steady_clock::now();
  // A copy: the history may drop that state before the measurement has begun.
  const bool compared = wish.before && !is_surface(*subject.mesh->topology);
  auto before = compared ? std::make_shared<const Coordinates>(*wish.before) : nullptr;
  // While a solver runs, use only one core; otherwise the colours wait for the measurement.
  Order order{wish, wish.before_numbers(), live, live ? 1 : 0};
  order.wish.before = before.get();
  worker_.start([shape, subject, order, before] { return measure(shape, subject, order); });
}

void QualityMonitor::measure_now(std::uint64_t shape, const Subject& subject, const Wish& wish) {
  if (latest_ && latest_->shape == shape && wish.met_by(*latest_)) return;
  latest_ = measure(shape, subject, {wish, wish.before_numbers()});
}

bool QualityMonitor::poll() {
  auto result = worker_.poll();
  if (!result) return false;
  if (discard_) {
    discard_ = false;
    return true;
  }
  // A synchronous measurement may be newer.
  if (!latest_ || (*result)->shape >= latest_->shape) latest_ = std::move(*result);
  return true;
}

void QualityMonitor::clear() {
  latest_.reset();
  discard_ = worker_.busy();
}

namespace {

/// True if the deviation was omitted while a solver was running and is still missing.
bool lacks_deviation(const LiveMesh& mesh, const QualityMonitor::Measured& measured) {
  return mesh.document()->given() && !mesh.in_motion() && !measured.deviation;
}

}  // namespace

void QualityWatch::watch(const std::optional<ElementField>& field, BeforeState before) {
  if (!mesh_.document()) return;
  // While the solver is paused, measure everything.
  const bool live = mesh_.in_motion() && !mesh_.work().job().paused();
  const QualityMonitor::Wish wanted = wish(field, before);
  if (monitor_.wants(mesh_.shape(), wanted, live))
    monitor_.request(mesh_.shape(), on_screen(), wanted, live);
}

void QualityWatch::measure_now(const std::optional<ElementField>& field, BeforeState before) {
  if (!mesh_.document()) return;
  monitor_.measure_now(mesh_.shape(), on_screen(), wish(field, before));
}

bool QualityWatch::up_to_date(const std::optional<ElementField>& field, BeforeState before) const {
  const auto& measured = monitor_.latest();
  return measured && mesh_.document() && measured->shape == mesh_.shape() &&
         wish(field, before).met_by(*measured) && !lacks_deviation(mesh_, *measured);
}

QualityMonitor::Wish QualityWatch::wish(const std::optional<ElementField>& field,
                                        BeforeState before) const {
  const MeshState& state = mesh_.document()->history().state(position_before(mesh_, before));
  // With another connectivity the nodes do not correspond.
  return {field, state.mesh.topology == mesh_.topology() ? &state.mesh.coordinates : nullptr,
          mesh_.document()->given()};
}

QualityMonitor::Subject QualityWatch::on_screen() const {
  return {mesh_.shared(), mesh_.vcv(), mesh_.layers(), mesh_.document()->state().surface};
}

std::size_t position_before(const LiveMesh& mesh, BeforeState which) {
  const History& history = mesh.document()->history();
  if (which == BeforeState::loaded) return 0;
  // During a command the state before it, otherwise the state before the last command.
  if (mesh.in_motion()) return history.position();
  return history.position() > 0 ? history.position() - 1 : 0;
}

}  // namespace winslow::gui
