#include "core/inspect/element_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/inspect/nodal_view.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct NodalName {
  NodalField field;
  std::string_view name, label;
};
constexpr std::array<NodalName, 3> nodal_names{
    {{NodalField::kappa, "kappa", "VCV kappa"},
     {NodalField::smallest_weight, "smallest_weight", "VCV smallest weight"},
     {NodalField::residual, "residual", "VCV residual"}}};

const NodalName& named(NodalField field) {
  return *std::find_if(nodal_names.begin(), nodal_names.end(),
                       [&](const NodalName& n) { return n.field == field; });
}

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
  return field == NodalField::smallest_weight ? std::min(a, b) : std::max(a, b);
}

}  // namespace

std::vector<double> node_values(const VirtualControlVolumes& vcv, const Coordinates& x,
                                NodalField field, int threads) {
  const Topology& topology = vcv.topology();
  const StencilFunctionals functionals(vcv);
  std::vector<double> values(static_cast<std::size_t>(topology.node_count()), none);
  const auto free = topology.free_nodes();
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

const std::array<ElementField, element_field_count>& all_element_fields() {
  static const std::array<ElementField, element_field_count> fields{
      Metric::normalized_jacobian, Metric::aspect_ratio,
      Metric::condition_number,    Metric::area,
      NodalField::kappa,           NodalField::smallest_weight,
      NodalField::residual,        LayerField::layer,
      LayerField::spacing_error};
  return fields;
}

std::string_view field_name(const ElementField& field) {
  if (field.layer()) return *field.layer() == LayerField::layer ? "layer" : "spacing_error";
  return field.metric() ? metric_name(*field.metric()) : named(*field.nodal()).name;
}

std::string_view field_label(const ElementField& field) {
  if (field.layer()) return *field.layer() == LayerField::layer ? "Layer" : "Layer spacing error";
  return field.metric() ? metric_label(*field.metric()) : named(*field.nodal()).label;
}

ElementField parse_field(std::string_view name) {
  std::string list;
  for (const ElementField& field : all_element_fields()) {
    if (field_name(field) == name) return field;
    list += (list.empty() ? "" : ", ") + std::string(field_name(field));
  }
  throw UsageError("found \"" + std::string(name) + "\", expected one of " + list);
}

std::vector<double> element_values(const VirtualControlVolumes& vcv, const Coordinates& x,
                                   const ElementField& field, int threads,
                                   const LayerStack* layers) {
  const Topology& topology = vcv.topology();
  if (field.layer()) return layer_values(topology, x, *field.layer(), layers);
  if (field.metric()) return element_values(Mesh{vcv.shared_topology(), x}, *field.metric());
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
