#include "gui/view/mesh/mesh_layer.h"

#include "core/quality/quality.h"
#include "gui/document/session/quality_watch.h"
#include "gui/view/mesh/mesh_colors.h"

namespace winslow::gui {

namespace {

/// A mesh with fewer nodes is prepared faster, in a millisecond or two, than a thread could hand it
/// over.
constexpr Index small_mesh = 12000;  // nodes

}  // namespace

void MeshLayer::update(const std::shared_ptr<const Topology>& topology,
                       const Coordinates& coordinates, std::uint64_t generation,
                       std::uint64_t shape) {
  if (generation_ != generation) {
    generation_ = generation;
    shape_ = 0;
    shown_.reset();
    painted_.reset();
    legend_.reset();
  }
  if (shape_ == shape || builder_.busy()) return;
  shape_ = shape;
  small_ = topology->node_count() < small_mesh;
  auto groups = shown_ && renderer_.topology() == topology ? renderer_.edge_groups() : nullptr;
  if (small_) return adopt(build(generation, shape, topology, coordinates, std::move(groups)));
  builder_.start([=] {
    return std::make_shared<Built>(build(generation, shape, topology, coordinates, groups));
  });
}

MeshLayer::Built MeshLayer::build(std::uint64_t generation, std::uint64_t shape,
                                  const std::shared_ptr<const Topology>& topology,
                                  const Coordinates& coordinates,
                                  std::shared_ptr<const EdgeGroups> groups) {
  return {generation,
          {shape, check_validity(*topology, coordinates, 1)},
          prepare_mesh(topology, coordinates, std::move(groups))};
}

void MeshLayer::color(const std::shared_ptr<const QualityMonitor::Measured>& measured,
                      const ViewOptions& view) {
  if (!shown_) return;
  if (!view.color) {
    if (painted_) renderer_.clear_values();
    painted_.reset();
    legend_.reset();
    return;
  }
  // Until the requested field is measured, the colours stay.
  if (!measured || measured->field != view.color || painter_.busy()) return;
  if (measured->topology != renderer_.topology()) return;
  ColorKey key{measured, color_choice(view), view.isolation, {}};
  if (view.mark_inverted && measured->report.inverted > 0) {
    const Rgba& red = mesh_colors(view).inverted;
    key.inverted = Rgb{red[0], red[1], red[2]};
  }
  if (painted_ == key) return;
  painted_ = key;
  if (small_) return adopt(compute(key, generation_));
  painter_.start([key = std::move(key), generation = generation_] {
    return std::make_shared<Colors>(compute(key, generation));
  });
}

MeshLayer::Colors MeshLayer::compute(const ColorKey& key, std::uint64_t generation) {
  const ElementField& field = *key.measured->field;
  const ColorScale scale = color_scale(field, key.measured->values, key.choice);
  Colors colors;
  colors.generation = generation;
  colors.topology = key.measured->topology;
  colors.opacity = element_opacity(key.measured->values, key.isolation);
  colors.rgba = element_colors(key.measured->values, scale, colors.opacity);
  colors.legend = legend_of(field, key.measured->values, scale);
  colors.legend.inverted = key.inverted;
  return colors;
}

bool MeshLayer::poll() {
  auto built = builder_.poll();
  if (built) adopt(std::move(**built));
  auto colors = painter_.poll();
  if (colors) adopt(std::move(**colors));
  return built || colors;
}

void MeshLayer::adopt(Built built) {
  if (built.generation != generation_) return;  // made for a mesh that is no longer open
  // The colours belong to the previous elements.
  if (renderer_.topology() != built.mesh.topology) {
    painted_.reset();
    legend_.reset();
  }
  renderer_.set_mesh(std::move(built.mesh));
  shown_ = built.shown;
}

void MeshLayer::adopt(Colors colors) {
  if (colors.generation != generation_ || !painted_) return;
  if (colors.topology != renderer_.topology()) return;
  renderer_.set_colors(std::move(colors.rgba), std::move(colors.opacity));
  legend_ = std::move(colors.legend);
}

void BeforeMesh::update(const LiveMesh& mesh, const ViewOptions& view) {
  document_ = mesh.document();
  if (!document_) {
    coordinates_ = nullptr;
    topology_.reset();
    return;
  }
  if (generation_ != mesh.generation()) {
    generation_ = mesh.generation();
    monitor_.clear();
    key_ = nullptr;
  }
  const std::size_t position = position_before(mesh, view.before);
  const MeshState& state = document_->history().state(position);
  const Coordinates& now = state.mesh.coordinates;
  loaded_ = position == 0;
  // The history moves its steps in memory, but not the arrays that they hold.
  const void* key = now.values().data();
  if (key != key_) ++shape_;
  key_ = key;
  coordinates_ = &now;
  topology_ = state.mesh.topology;
  const bool values = view.comparison == Comparison::split && view.color;
  if (loaded_ && !values) return;
  // The mesh before is the present one: nothing has changed yet.
  const QualityMonitor::Wish wish{values ? view.color : std::nullopt, &now, document_->given()};
  if (!monitor_.wants(shape_, wish, false)) return;
  monitor_.request(
      shape_,
      {std::make_shared<const Mesh>(state.mesh), state.vcvs.plane(), state.layers, state.surface},
      wish, false);
}

const QualityReport* BeforeMesh::report() const {
  if (!document_) return nullptr;
  if (loaded_) return &document_->loaded_quality();
  const auto& latest = monitor_.latest();
  return latest && latest->shape == shape_ ? &latest->report : nullptr;
}

std::shared_ptr<const QualityMonitor::Measured> BeforeMesh::measured() const {
  const auto& latest = monitor_.latest();
  return latest && latest->shape == shape_ ? latest : nullptr;
}

}  // namespace winslow::gui
