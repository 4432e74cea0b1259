#pragma once

#include <variant>

#include "core/layers/layer_stack.h"
#include "core/mesh/topology.h"
#include "core/quality/metric.h"
#include "core/quality/surface_distance.h"
#include "core/quality/wall_field.h"
#include "core/vcv/virtual_control_volumes.h"

/// A number for each element, by its name:
///
///     const winslow::ElementField field = winslow::parse_field("normalized_jacobian");
///     const std::vector<double> values =
///         winslow::element_values(*state.vcvs.plane(), state.mesh.coordinates, field);
namespace winslow {

/// What the paper's operator says of each free node (see NodalView):
/// - kappa: ratio of the singular values of the nodal Jacobian. 1 (conformal) is best.
/// - smallest_weight: of the neighbours' weights, over their mean magnitude. 1 (all equal) is best;
///   a negative weight costs the row its maximum principle.
/// - residual: distance to where the node alone would go, over its mean edge. 0 at the operator's
///   own solution.
/// Nodes without a VCV have NaN.
enum class NodalField { kappa, smallest_weight, residual };

/// Values of all nodes (#nodes). threads: 0 for all cores; the result does not depend on it.
std::vector<double> node_values(const VirtualControlVolumes& vcv, const Coordinates& x,
                                NodalField field, int threads = 0);

/// What inserted layers are like: the layer of an element, 1 at the wall; the relative error of its
/// height, the larger of its two sides'. Elements outside layers have NaN.
enum class LayerField { layer, spacing_error };

/// Where elements of a surface mesh are: how far from the mesh as it was given, see
/// element_distances().
enum class SurfaceField { deviation };

/// A number for each element: a quality metric, the worst value of a nodal field at its nodes, or
/// of its layer, or of the walls, or of its place.
class ElementField {
 public:
  // Implicit: a metric is such a field. cell_dimension: of the elements, 2 or 3.
  ElementField(Metric metric, int cell_dimension = 2)  // NOLINT(google-explicit-constructor)
      : field_(metric), cell_dimension_(cell_dimension) {}
  ElementField(NodalField field) : field_(field) {}  // NOLINT(google-explicit-constructor)

  ElementField(LayerField field) : field_(field) {}  // NOLINT(google-explicit-constructor)
  ElementField(WallField field) : field_(field) {}   // NOLINT(google-explicit-constructor)

  ElementField(SurfaceField field) : field_(field) {}  // NOLINT(google-explicit-constructor)

  /// Null if it is another kind of field; so are the others.
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

/// All that elements of such meshes have, as lists show them; of volume elements the metrics, of
/// those of a surface the deviation as well.
const std::vector<ElementField>& all_element_fields(MeshKind kind = MeshKind::plane);

const FieldInfo& field_info(const ElementField& field);
/// By FieldInfo::name. Throws UsageError listing the names.
ElementField parse_field(std::string_view name, MeshKind kind = MeshKind::plane);

/// What some fields are about beside the mesh itself; null: they have no values.
struct FieldContext {
  const LayerStack* layers = nullptr;   ///< of this mesh
  const Coordinates* before = nullptr;  ///< the same nodes as they were before (#nodes by 2)
};

/// Value for each element of a plane mesh (#elements); NaN where no node has a VCV. threads: as
/// above.
std::vector<double> element_values(const VirtualControlVolumes& vcv, const Coordinates& x,
                                   const ElementField& field, int threads = 0,
                                   const FieldContext& context = {});

/// Value for each element of a surface mesh (#elements); empty for a field that such meshes do not
/// have. normals: reference normals, see reference_normals(). given: the mesh as it was given.
std::vector<double> surface_values(const Mesh& mesh, const ElementField& field,
                                   std::span<const Vec3> normals, const SurfaceDistance& given,
                                   int threads = 0);

}  // namespace winslow
