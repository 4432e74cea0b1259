#include "python/measures.h"

#include <pybind11/stl.h>

#include <nlohmann/json.hpp>

#include "app/job/edit_job.h"
#include "core/command/command.h"
#include "core/error.h"
#include "core/inspect/element_field.h"
#include "core/quality/quality.h"
#include "python/arrays.h"
#include "python/mesh_value.h"

namespace py = pybind11;

namespace winslow::python {
namespace {

/// What `winslow quality --report` writes of a mesh, as JSON.
std::string quality(const MeshPointer& mesh, int worst, int bins, int threads) {
  const py::gil_scoped_release released;
  QualityOptions options;
  options.worst = worst;
  options.histogram_bins = bins;
  options.threads = threads;
  const QualityReport report = measure_quality(mesh->mesh(), options);
  std::optional<OpenFoamMeasures> openfoam;
  if (mesh->topology().kind() == MeshKind::volume)
    openfoam = openfoam_measures(mesh->mesh(), threads);
  const auto& details = mesh->file.details;
  const app::ZoneResult zone{0,
                             &mesh->mesh(),
                             &report,
                             nullptr,
                             nullptr,
                             nullptr,
                             details ? details->periodic.get() : nullptr,
                             details ? details->regions_array : std::string(),
                             openfoam ? &*openfoam : nullptr};
  nlohmann::json described = app::describe_zones({zone});
  nlohmann::json histograms;
  for (const Metric metric : reported_metrics(report.cell_dimension)) {
    const Histogram& of = report.of(metric).histogram;
    histograms[std::string(metric_name(metric))] = {
        {"low", of.low}, {"high", of.high}, {"counts", of.counts}};
  }
  described["histograms"] = std::move(histograms);
  return described.dump();
}

std::vector<double> values_of(const Mesh& mesh, const ElementField& field,
                              const Coordinates* before) {
  if (const Metric* metric = field.metric()) return element_values(mesh, *metric);
  if (mesh.topology->kind() == MeshKind::volume) return volume_values(mesh, field, before);
  return element_values(*make_state(mesh).vcvs.plane(), mesh.coordinates, field, 0,
                        {.before = before});
}

/// Whether a field says something of a mesh alone, or beside an earlier one.
bool is_of_mesh(const ElementField& field) { return !field.layer() && !field.surface(); }

/// The value of a field for each element, #elements; NaN where it has none.
py::array values(const MeshPointer& mesh, const std::string& name, const MeshPointer& before) {
  std::vector<double> of_elements;
  {
    const py::gil_scoped_release released;
    const ElementField field = parse_field(name, mesh->topology().kind());
    if (!is_of_mesh(field)) throw UsageError(name + ": needs more than a mesh");
    of_elements = values_of(mesh->mesh(), field, before ? &before->mesh().coordinates : nullptr);
  }
  return frozen(std::move(of_elements));
}

Index inverted(const MeshPointer& mesh) {
  const py::gil_scoped_release released;
  return check_validity(mesh->topology(), mesh->mesh().coordinates).inverted;
}

std::vector<std::string> fields(const MeshPointer& mesh) {
  std::vector<std::string> names;
  for (const ElementField& field : all_element_fields(mesh->topology().kind()))
    if (is_of_mesh(field)) names.emplace_back(field_info(field).name);
  return names;
}

}  // namespace

void bind_measures(py::module_& module) {
  module.def("quality", &quality);
  module.def("values", &values);
  module.def("inverted", &inverted);
  module.def("fields", &fields);
}

}  // namespace winslow::python
