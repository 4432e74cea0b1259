#include "gui/view/mesh/mesh_layer.h"

#include <string>
#include <utility>

#include "gui/render/metric_scale.h"
#include "gui/view/mesh/isolated_elements.h"

namespace winslow::gui {

namespace {

constexpr int histogram_bins = 40;
/// Below this a mesh is prepared faster than a thread could hand it over: a millisecond or two.
constexpr Index small_mesh = 12000;  // nodes

ColorScale scale_of(const QualityMonitor::Measured& measured, const std::string& map, int bands,
                    const std::optional<std::array<double, 2>>& range) {
  ColorScale scale = automatic_scale(*measured.field, measured.values, map);
  if (range && (*range)[1] > (*range)[0]) {
    scale.low = (*range)[0];
    scale.high = (*range)[1];
  }
  scale.bands = bands;
  return scale;
}

Legend legend_of(const QualityMonitor::Measured& measured, const ColorScale& scale) {
  Legend legend;
  legend.title = std::string(field_info(*measured.field).label);
  legend.scale = scale;
  legend.histogram = histogram_over(measured.values, scale, histogram_bins);
  for (double v : measured.values) {
    legend.more_below |= v < scale.low;
    legend.more_above |= v > scale.high;
  }
  return legend;
}

}  // namespace

void MeshLayer::update(const std::shared_ptr<const Topology>& topology,
                       const Coordinates& coordinates, std::uint64_t generation,
                       std::uint64_t shape) {
  if (generation_ != generation) {
    generation_ = generation;
    shape_ = 0;
    ready_ = false;
    painted_.reset();
    legend_.reset();
  }
  if (shape_ == shape || builder_.busy()) return;
  shape_ = shape;
  small_ = topology->node_count() < small_mesh;
  auto groups = ready_ && renderer_.topology() == topology ? renderer_.edge_groups() : nullptr;
  if (small_)
    return take(Built{generation, prepare_mesh(topology, coordinates, std::move(groups))});
  builder_.start([topology, coordinates, groups = std::move(groups), generation] {
    return std::make_shared<Built>(Built{generation, prepare_mesh(topology, coordinates, groups)});
  });
}

void MeshLayer::color(const std::shared_ptr<const QualityMonitor::Measured>& measured,
                      const ViewOptions& view) {
  if (!ready_) return;
  if (!view.color) {
    if (painted_) renderer_.clear_values();
    painted_.reset();
    legend_.reset();
    return;
  }
  // Until the field asked for is measured, the colours stay what they are.
  if (!measured || measured->field != view.color || painter_.busy()) return;
  if (measured->topology != renderer_.topology()) return;
  ColorKey key{measured, view.color_map, view.bands, view.range, view.isolation};
  if (painted_ == key) return;
  painted_ = key;
  if (small_) return take(compute(key, generation_));
  painter_.start([key = std::move(key), generation = generation_] {
    return std::make_shared<Colors>(compute(key, generation));
  });
}

MeshLayer::Colors MeshLayer::compute(const ColorKey& key, std::uint64_t generation) {
  const ColorScale scale = scale_of(*key.measured, key.map, key.bands, key.range);
  Colors colors;
  colors.generation = generation;
  colors.topology = key.measured->topology;
  colors.opacity = element_opacity(key.measured->values, key.isolation);
  colors.rgba = element_colors(key.measured->values, scale, colors.opacity);
  colors.legend = legend_of(*key.measured, scale);
  return colors;
}

bool MeshLayer::poll() {
  auto built = builder_.poll();
  if (built) take(std::move(**built));
  auto colors = painter_.poll();
  if (colors) take(std::move(**colors));
  return built || colors;
}

void MeshLayer::take(Built built) {
  if (built.generation != generation_) return;  // of a mesh that is gone
  // Colours of other elements are gone with the elements.
  if (renderer_.topology() != built.mesh.topology) {
    painted_.reset();
    legend_.reset();
  }
  renderer_.set_mesh(std::move(built.mesh));
  ready_ = true;
}

void MeshLayer::take(Colors colors) {
  if (colors.generation != generation_ || !painted_) return;
  if (colors.topology != renderer_.topology()) return;
  renderer_.set_colors(std::move(colors.rgba), std::move(colors.opacity));
  legend_ = std::move(colors.legend);
}

}  // namespace winslow::gui
