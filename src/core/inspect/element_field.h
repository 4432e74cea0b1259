#pragma once

#include <variant>

#include "core/layers/layer_stack.h"
#include "core/mesh/topology.h"
#include "core/quality/metric.h"
#include "core/quality/surface_distance.h"
#include "core/quality/wall_measures.h"
#include "core/vcv/virtual_control_volumes.h"

/// A number for each element, by its name:
///
///     const winslow::ElementField field = winslow::parse_field("normalized_jacobian");
///     const std::vector<double> values =
///         winslow::element_values(*state.vcvs.plane(), state.mesh.coordinates, field);
namespace winslow {

/// Measures of the paper's operator at each free node (see NodalView):
/// - kappa: ratio of the singular values of the nodal Jacobian. 1 (conformal) is best.
/// - smallest_weight: smallest weight of a neighbour over the mean magnitude of the weights. 1 (all
///   equal) is best; a row with a negative weight has no maximum principle.
/// - residual: distance to the position to which the operator would move this node alone, over its
///   mean edge. 0 at the solution of the operator.
/// Nodes without a VCV have NaN.
enum class NodalField { kappa, smallest_weight, residual };

/// Values of all nodes (#nodes). threads: 0 for all cores; the result does not depend on it.
std::vector<double> node_values(const VirtualControlVolumes& vcv, const Coordinates& x,
                                NodalField field, int threads = 0);

/// Measures of layers: the number of the layer of an element, 1 at the wall; the relative error of
/// its height, the larger one of its two columns. Elements outside layers have NaN.
enum class LayerField { layer, spacing_error };

/// Distance of the elements of a surface mesh from the given mesh, see element_distances().
enum class SurfaceField { deviation };

/// A field: a number for each element. It is a metric, a nodal field (the worst value at the nodes
/// of the element), a layer field, a wall field or a surface field.
class ElementField {
 public:
  // Implicit: a metric is such a field. cell_dimension: of the elements, 2 or 3.
  ElementField(Metric metric, int cell_dimension = 2)  // NOLINT(google-explicit-constructor)
      : field_(metric), cell_dimension_(cell_dimension) {}
  ElementField(NodalField field) : field_(field) {}    // NOLINT(google-explicit-constructor)
  ElementField(LayerField field) : field_(field) {}    // NOLINT(google-explicit-constructor)
  ElementField(WallField field) : field_(field) {}     // NOLINT(google-explicit-constructor)
  ElementField(SurfaceField field) : field_(field) {}  // NOLINT(google-explicit-constructor)

  // Null if the field is of another kind.
  const Metric* metric() const { return std::get_if<Metric>(&field_); }
  const NodalField* nodal() const { return std::get_if<NodalField>(&field_); }
  const LayerField* layer() const { return std::get_if<LayerField>(&field_); }
  const WallField* wall() const { return std::get_if<WallField>(&field_); }
  const SurfaceField* surface() const { return std::get_if<SurfaceField>(&field_); }
  int cell_dimension() const { return cell_dimension_; }

  bool operator==(const ElementField&) const = default;

 private:
  std::variant<Metric, NodalField, LayerField, WallField, SurfaceField> field_;
  int cell_dimension_ = 2;
};

/// All fields of the elements of a kind of mesh, in the order of lists on screen. Volume meshes
/// have the metrics and the wall fields, surface meshes the metrics and the deviation, plane meshes
/// all but the deviation.
const std::vector<ElementField>& all_element_fields(MeshKind kind = MeshKind::plane);

const FieldInfo& field_info(const ElementField& field);
/// The field with a FieldInfo::name. Throws UsageError listing the names.
ElementField parse_field(std::string_view name, MeshKind kind = MeshKind::plane);

/// Input of some fields besides the mesh; a field whose input is null has no values.
struct FieldContext {
  const LayerStack* layers = nullptr;   ///< of this mesh
  const Coordinates* before = nullptr;  ///< earlier coordinates of the nodes (#nodes by 2)
};

/// Value for each element of a plane mesh (#elements); NaN for an element without a value. threads:
/// as above.
std::vector<double> element_values(const VirtualControlVolumes& vcv, const Coordinates& x,
                                   const ElementField& field, int threads = 0,
                                   const FieldContext& context = {});

/// Value for each element of a volume mesh (#elements); empty for a field that volume meshes do not
/// have. before: earlier coordinates of the nodes (#nodes by 3), for WallField::first_height_ratio,
/// which has no values if it is null.
std::vector<double> volume_values(const Mesh& mesh, const ElementField& field,
                                  const Coordinates* before = nullptr);

/// Value for each element of a surface mesh (#elements); empty for a field that surface meshes do
/// not have. normals: reference normals, see reference_normals(). given: of the given mesh.
std::vector<double> surface_values(const Mesh& mesh, const ElementField& field,
                                   std::span<const Vec3> normals, const SurfaceDistance& given,
                                   int threads = 0);

}  // namespace winslow
