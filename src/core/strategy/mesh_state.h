#pragma once

#include <variant>

#include "core/formulation/cell_targets.h"
#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"
#include "core/vcv/sphere/node_vcv.h"
#include "core/vcv/virtual_control_volumes.h"

namespace winslow {

struct SurfaceShape;

/// The virtual control volumes of a state. For a plane or surface mesh these are all VCVs; for a
/// volume mesh only those given by hand (the others are computed where an equation needs them).
class Vcvs {
 public:
  using Plane = std::shared_ptr<const VirtualControlVolumes>;
  using ByHand = std::shared_ptr<const SphereStencils>;

  /// For a volume mesh, with no VCVs given by hand.
  Vcvs() = default;
  Vcvs(Plane vcvs) : vcvs_(std::move(vcvs)) {}
  /// For a volume mesh; null: none given by hand.
  Vcvs(ByHand vcvs) : vcvs_(std::move(vcvs)) {}

  /// Null for a volume mesh.
  Plane plane() const { return of<Plane>(); }
  /// Null for a plane or surface mesh, and if none were given.
  ByHand by_hand() const { return of<ByHand>(); }

  /// Whether they are the same objects.
  bool operator==(const Vcvs&) const = default;

 private:
  template <typename Kind>
  Kind of() const {
    const Kind* vcvs = std::get_if<Kind>(&vcvs_);
    return vcvs ? *vcvs : nullptr;
  }

  std::variant<ByHand, Plane> vcvs_;
};

/// A mesh with all data that determine how it is smoothed: the state on which runs and commands
/// act.
struct MeshState {
  Mesh mesh;
  Vcvs vcvs = {};
  /// Roles of the elements in the targets of a run: in layers, beside layers. Null: none.
  std::shared_ptr<const ElementRoles> roles = nullptr;
  /// Layers of a plane mesh that were inserted; if they are held, every motion keeps their spacing.
  /// Null: none.
  std::shared_ptr<const LayerStack> layers = nullptr;
  /// The shape on which the nodes of a surface mesh stay, from the first smoothing on. Null: not
  /// found yet, or another kind of mesh.
  std::shared_ptr<const SurfaceShape> surface = nullptr;
  /// The reference mesh: coordinates, in the same connectivity, whose element shapes motions keep.
  /// It is the mesh as opened, or as the last smoothing or insertion of layers left it; motions do
  /// not change it. Null: the mesh itself.
  std::shared_ptr<const Coordinates> reference = nullptr;
  /// Markers of a volume mesh at which every motion holds the heights of the layers
  /// (held_walls.h).
  std::vector<std::string> held_walls = {};
};
/// The reference mesh of a state.
inline std::shared_ptr<const Coordinates> reference_of(const MeshState& state) {
  return state.reference ? state.reference
                         : std::make_shared<const Coordinates>(state.mesh.coordinates);
}
/// Whether every motion of the state holds the heights of layers.
inline bool holds_layers(const MeshState& state) {
  return (state.layers && state.layers->held) || !state.held_walls.empty();
}
/// The state with another reference mesh, e.g. the mesh before the first of several runs from file
/// to file. A mesh with polyhedra or polygons gets the topology of the reference mesh, which says
/// what corners are flat, if their markers and regions are the same. Throws UsageError, naming the
/// first difference, unless both meshes have the same nodes, elements and markers in the same
/// order.
MeshState with_reference(MeshState state, const Mesh& reference);

/// A state with the paper's VCVs of a plane or surface mesh: equal angles, unit edges.
inline MeshState make_state(Mesh mesh) {
  Vcvs vcvs;  // those of a volume mesh are made where an equation needs them
  if (mesh.topology->cell_dimension() == 2)
    vcvs = std::make_shared<const VirtualControlVolumes>(mesh.topology);
  return {std::move(mesh), std::move(vcvs)};
}

}  // namespace winslow
