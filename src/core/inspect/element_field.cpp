#include "core/inspect/element_field.h"

#include "core/error.h"
#include "core/inspect/nodal_view.h"
#include "core/parallel/parallel_for.h"
#include "core/quality/quality.h"

namespace winslow {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// In the order of the enumerations.
constexpr std::array nodal_fields{
    FieldInfo{.name = "kappa",
              .label = "VCV kappa",
              .help = "Ratio of the singular values of the nodal Jacobian, which maps the virtual "
                      "control volume to the mesh. 1 is best.",
              .larger_is_better = false,
              .colors = ColorRange::from_one,
              .threshold = 1.5},
    FieldInfo{.name = "smallest_weight",
              .label = "VCV smallest weight",
              .help = "Smallest weight of a neighbour over the mean magnitude of the weights. 1 is "
                      "best; below 0 the operator may leave the range of its neighbours.",
              .larger_is_better = true,
              .colors = ColorRange::up_to_one,
              .threshold = 0,
              .has_sign = true},
    FieldInfo{.name = "residual",
              .label = "VCV residual",
              .help =
                  "Distance to where the operator would move this node alone, over its mean edge. "
                  "0 at the operator's own solution.",
              .larger_is_better = false,
              .colors = ColorRange::from_zero,
              .threshold = 0.01},
};

constexpr std::array layer_fields{
    FieldInfo{.name = "layer",
              .label = "Layer",
              .help = "Number of the layer, 1 at the wall.",
              .larger_is_better = false,
              .colors = ColorRange::counts,
              .threshold = 0.5},
    FieldInfo{.name = "spacing_error",
              .label = "Layer spacing error",
              .help = "Relative error of the layer's height, the larger of its two sides'.",
              .larger_is_better = false,
              .colors = ColorRange::from_zero,
              .threshold = 0.01},
};

constexpr std::array surface_fields{
    FieldInfo{.name = "deviation",
              .label = "Deviation",
              .help = "Largest distance of an element's nodes, the middles of its edges and its "
                      "own from the surface as it was given, in units of the mesh. On a curved "
                      "surface most of it is that between chords.",
              .larger_is_better = false,
              .colors = ColorRange::from_zero,
              .threshold = 0,
              .unit = "units of the mesh"},
};

double kappa_of(const NodalGradient& jacobian) {
  const auto s = singular_values(jacobian);
  return s[1] > 0 ? s[0] / s[1] : std::numeric_limits<double>::infinity();
}

/// Relative error of each layer of a column.
std::vector<double> height_errors(const LayerColumn& column, const Coordinates& x) {
  std::vector<double> errors;
  for (std::size_t k = 0; k + 1 < column.nodes.size(); ++k) {
    const double length = (x.xy(column.nodes[k + 1]) - x.xy(column.nodes[k])).norm();
    errors.push_back(std::abs(length / wanted_length(column, k) - 1));
  }
  return errors;
}

/// Values of elements in layers: those of the columns on either side.
std::vector<double> layer_values(const Topology& topology, const Coordinates& x, LayerField field,
                                 const LayerStack* layers) {
  std::vector<double> values(static_cast<std::size_t>(topology.element_count()), none);
  if (!layers || layers->layer_of_element.size() != values.size()) return values;
  // Nodes of a column but the first, which columns share: the layer below each.
  std::vector<double> below(static_cast<std::size_t>(topology.node_count()), none);
  for (const LayerColumn& column : layers->columns) {
    const auto errors = height_errors(column, x);
    for (std::size_t k = 0; k < errors.size(); ++k)
      below[static_cast<std::size_t>(column.nodes[k + 1])] = errors[k];
  }
  std::vector<int> layer_of_node(below.size(), -1);
  for (const LayerColumn& column : layers->columns)
    for (std::size_t k = 1; k < column.nodes.size(); ++k)
      layer_of_node[static_cast<std::size_t>(column.nodes[k])] = static_cast<int>(k) - 1;
  for (Index e = 0; e < topology.element_count(); ++e) {
    const int layer = layers->layer_of_element[static_cast<std::size_t>(e)];
    if (layer < 0) continue;
    double& value = values[static_cast<std::size_t>(e)];
    if (field == LayerField::layer) {
      value = layer + 1;
      continue;
    }
    for (const Index node : topology.element(e)) {
      const auto i = static_cast<std::size_t>(node);
      if (layer_of_node[i] == layer)
        value = std::isnan(value) ? below[i] : std::max(value, below[i]);
    }
  }
  return values;
}

/// The worse of two values, of which one may be missing.
double worse(NodalField field, double a, double b) {
  if (std::isnan(a)) return b;
  if (std::isnan(b)) return a;
  return field_info(field).larger_is_better ? std::min(a, b) : std::max(a, b);
}

}  // namespace

std::vector<double> node_values(const VirtualControlVolumes& vcv, const Coordinates& x,
                                NodalField field, int threads) {
  const Topology& topology = vcv.topology();
  const StencilFunctionals functionals(vcv);
  std::vector<double> values(static_cast<std::size_t>(topology.node_count()), none);
  const auto free = topology.interior_nodes();
  parallel_for(threads, static_cast<Index>(free.size()), [&](Index begin, Index end) {
    std::vector<double> weights;
    for (Index i = begin; i < end; ++i) {
      const Index node = free[static_cast<std::size_t>(i)];
      const auto neighbours = topology.neighbours(node);
      const auto row_functionals = functionals[node];
      const NodalGradient gradient = nodal_gradient(x, node, neighbours, row_functionals);
      double& value = values[static_cast<std::size_t>(node)];
      if (field == NodalField::kappa) {
        value = kappa_of(gradient);
        continue;
      }
      const WinslowCoefficients c = winslow_coefficients(gradient);
      weights.clear();
      for (const auto& f : row_functionals) weights.push_back(winslow_weight(c, f));
      const NodalRow row = evaluate_row(x, node, neighbours, weights);
      value = field == NodalField::residual ? row.scaled() : row.smallest_weight(weights);
    }
  });
  return values;
}

namespace {

std::vector<ElementField> metric_fields(int cell_dimension) {
  std::vector<ElementField> list;
  for (const Metric metric : all_metrics(cell_dimension)) list.emplace_back(metric, cell_dimension);
  return list;
}

std::vector<ElementField> plane_fields() {
  std::vector<ElementField> list = metric_fields(2);
  for (std::size_t i = 0; i < nodal_fields.size(); ++i)
    list.emplace_back(static_cast<NodalField>(i));
  for (const WallField field : all_wall_fields()) list.emplace_back(field);
  for (std::size_t i = 0; i < layer_fields.size(); ++i)
    list.emplace_back(static_cast<LayerField>(i));
  return list;
}

}  // namespace

const std::vector<ElementField>& all_element_fields(MeshKind kind) {
  static const std::vector<ElementField> plane = plane_fields();
  static const std::vector<ElementField> volume = metric_fields(3);
  static const std::vector<ElementField> surface = [] {
    std::vector<ElementField> list = metric_fields(2);
    list.emplace_back(SurfaceField::deviation);
    return list;
  }();
  if (kind == MeshKind::surface) return surface;
  return kind == MeshKind::volume ? volume : plane;
}

const FieldInfo& field_info(const ElementField& field) {
  if (field.layer()) return layer_fields[static_cast<std::size_t>(*field.layer())];
  if (field.wall()) return wall_field_info(*field.wall());
  if (field.surface()) return surface_fields[static_cast<std::size_t>(*field.surface())];
  if (field.nodal()) return nodal_fields[static_cast<std::size_t>(*field.nodal())];
  return metric_info(*field.metric(), field.cell_dimension()).field;
}

ElementField parse_field(std::string_view name, MeshKind kind) {
  std::string list;
  for (const ElementField& field : all_element_fields(kind)) {
    const std::string_view known = field_info(field).name;
    if (known == name) return field;
    list += (list.empty() ? "" : ", ") + std::string(known);
  }
  throw UsageError("found \"" + std::string(name) + "\", expected one of " + list);
}

std::vector<double> surface_values(const Mesh& mesh, const ElementField& field,
                                   std::span<const Vec3> normals, const SurfaceDistance& given,
                                   int threads) {
  if (field.surface()) return element_distances(mesh, given, threads);
  if (field.metric() && field.cell_dimension() == 2)
    return element_values(mesh, *field.metric(), normals);
  return {};
}

std::vector<double> element_values(const VirtualControlVolumes& vcv, const Coordinates& x,
                                   const ElementField& field, int threads,
                                   const FieldContext& context) {
  const Topology& topology = vcv.topology();
  if (field.layer()) return layer_values(topology, x, *field.layer(), context.layers);
  if (field.metric()) return element_values(Mesh{vcv.shared_topology(), x}, *field.metric());
  if (field.wall())
    return element_values(Mesh{vcv.shared_topology(), x}, *field.wall(), context.before);
  if (field.surface()) return std::vector<double>(at(topology.element_count()), none);
  const NodalField nodal = *field.nodal();
  const std::vector<double> at_nodes = node_values(vcv, x, nodal, threads);
  std::vector<double> values(static_cast<std::size_t>(topology.element_count()), none);
  parallel_for(threads, topology.element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      double& value = values[static_cast<std::size_t>(e)];
      for (const Index node : topology.element(e)) {
        value = worse(nodal, value, at_nodes[static_cast<std::size_t>(node)]);
      }
    }
  });
  return values;
}

}  // namespace winslow
