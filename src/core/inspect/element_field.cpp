#include "core/inspect/element_field.h"

#include "core/error.h"
#include "core/inspect/nodal_view.h"
#include "core/parallel/parallel_for.h"
#include "core/quality/quality.h"

namespace winslow {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// In the order of the enumerations.

constexpr std::array nodal_fields{
    FieldInfo("kappa", "VCV kappa",
              "Ratio of the singular values of the nodal Jacobian, which maps the virtual control "
              "volume to the mesh. 1 is best.",
              Better::smaller, ColorRange::from_one, 1.5),
    FieldInfo("smallest_weight", "VCV smallest weight",
              "Smallest weight of a neighbour over the mean magnitude of the weights. 1 is best; "
              "below 0 the operator may leave the range of its neighbours.",
              Better::larger, ColorRange::up_to_one, 0, {.has_sign = true}),
    FieldInfo("residual", "VCV residual",
              "Distance to where the operator would move this node alone, over its mean edge. 0 at "
              "the operator's own solution.",
              Better::smaller, ColorRange::from_zero, 0.01),
};

constexpr std::array layer_fields{
    FieldInfo("layer", "Layer", "Number of the layer, 1 at the wall.", Better::smaller,
              ColorRange::counts, 0.5),
    FieldInfo("spacing_error", "Layer spacing error",
              "Relative error of the layer's height, the larger of its two sides'.",
              Better::smaller, ColorRange::from_zero, 0.01),
};

constexpr std::array surface_fields{
    FieldInfo("deviation", "Deviation",
              "Largest distance of an element's nodes, the middles of its edges and its own from "
              "the surface as it was given, in units of the mesh. On a curved surface most of it "
              "is that between chords.",
              Better::smaller, ColorRange::from_zero, 0, {.unit = "units of the mesh"}),
};

double kappa_of(const NodalGradient& jacobian) {
  const auto s = singular_values(jacobian);
  return s[1] > 0 ? s[0] / s[1] : std::numeric_limits<double>::infinity();
}

/// Values of elements in layers: those of the columns on either side.
std::vector<double> layer_values(const Topology& topology, const Coordinates& x, LayerField field,
                                 const LayerStack* layers) {
  std::vector<double> values(at(topology.element_count()), none);
  if (!layers || layers->layer_of_element.size() != values.size()) return values;
  // For each node of a column: the layer below it, and the relative error of that layer's height.
  // Columns may share their first node, which has no layer below.
  std::vector<int> layer_of_node(at(topology.node_count()), -1);
  std::vector<double> error(layer_of_node.size(), none);
  for (const LayerColumn& column : layers->columns)
    for (std::size_t k = 0; k + 1 < column.nodes.size(); ++k) {
      const double length = (x.xy(column.nodes[k + 1]) - x.xy(column.nodes[k])).norm();
      layer_of_node[at(column.nodes[k + 1])] = static_cast<int>(k);
      error[at(column.nodes[k + 1])] = std::abs(length / wanted_length(column, k) - 1);
    }
  for (Index e = 0; e < topology.element_count(); ++e) {
    const int layer = layers->layer_of_element[at(e)];
    if (layer < 0) continue;
    double& value = values[at(e)];
    if (field == LayerField::layer) {
      value = layer + 1;
      continue;
    }
    for (const Index node : topology.element(e))
      if (layer_of_node[at(node)] == layer)
        value = std::isnan(value) ? error[at(node)] : std::max(value, error[at(node)]);
  }
  return values;
}

/// The worse of two values; NaN counts as missing.
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
  std::vector<double> values(at(topology.node_count()), none);
  const auto free = topology.interior_nodes();
  parallel_for(threads, static_cast<Index>(free.size()), [&](Index begin, Index end) {
    std::vector<double> weights;
    for (Index i = begin; i < end; ++i) {
      const Index node = free[at(i)];
      const auto neighbours = topology.neighbours(node);
      const auto row_functionals = functionals[node];
      const NodalGradient gradient = nodal_gradient(x, node, neighbours, row_functionals);
      double& value = values[at(node)];
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

std::vector<ElementField> fields_of(MeshKind kind) {
  std::vector<ElementField> list;
  const auto append = [&]<class Field>(Field, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) list.emplace_back(static_cast<Field>(i));
  };
  const int dimension = cell_dimension_of(kind);
  for (const Metric metric : all_metrics(dimension)) list.emplace_back(metric, dimension);
  if (kind == MeshKind::surface) append(SurfaceField{}, surface_fields.size());
  if (kind == MeshKind::plane) append(NodalField{}, nodal_fields.size());
  if (kind != MeshKind::surface) append(WallField{}, all_wall_fields().size());
  if (kind == MeshKind::plane) append(LayerField{}, layer_fields.size());
  return list;
}

}  // namespace

const std::vector<ElementField>& all_element_fields(MeshKind kind) {
  static const std::array lists{fields_of(MeshKind::plane), fields_of(MeshKind::surface),
                                fields_of(MeshKind::volume)};
  return lists[static_cast<std::size_t>(kind)];
}

const FieldInfo& field_info(const ElementField& field) {
  if (field.layer()) return layer_fields[static_cast<std::size_t>(*field.layer())];
  if (field.wall()) return wall_field_info(*field.wall());
  if (field.surface()) return surface_fields[static_cast<std::size_t>(*field.surface())];
  if (field.nodal()) return nodal_fields[static_cast<std::size_t>(*field.nodal())];
  return metric_info(*field.metric(), field.cell_dimension()).field;
}

ElementField parse_field(std::string_view name, MeshKind kind) {
  const auto name_of = [](const ElementField& field) { return field_info(field).name; };
  const auto& all = all_element_fields(kind);
  const auto found = std::ranges::find(all, name, name_of);
  if (found != all.end()) return *found;
  throw UsageError("found \"" + std::string(name) + "\", expected one of " + listed(all, name_of));
}

std::vector<double> surface_values(const Mesh& mesh, const ElementField& field,
                                   std::span<const Vec3> normals, const SurfaceDistance& given,
                                   int threads) {
  if (field.surface()) return element_distances(mesh, given, threads);
  if (field.metric() && field.cell_dimension() == mesh.topology->cell_dimension())
    return element_values(mesh, *field.metric(), normals);
  return {};
}

std::vector<double> volume_values(const Mesh& mesh, const ElementField& field,
                                  const Coordinates* before) {
  if (field.wall()) return element_values(mesh, *field.wall(), before);
  if (field.metric() && field.cell_dimension() == 3) return element_values(mesh, *field.metric());
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
  std::vector<double> values(at(topology.element_count()), none);
  parallel_for(threads, topology.element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      double& value = values[at(e)];
      for (const Index node : topology.element(e)) value = worse(nodal, value, at_nodes[at(node)]);
    }
  });
  return values;
}

}  // namespace winslow
