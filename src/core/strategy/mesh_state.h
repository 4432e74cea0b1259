#pragma once

#include <variant>

#include "core/formulation/cell_targets.h"
#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"
#include "core/vcv/sphere/node_vcv.h"
#include "core/vcv/virtual_control_volumes.h"

namespace winslow {

struct SurfaceShape;

/// The virtual control volumes of a state: of a plane or surface mesh all of them; of a volume mesh
/// those that were given by hand, all others being worked out where an equation needs them.
class Vcvs {
 public:
  using Plane = std::shared_ptr<const VirtualControlVolumes>;
  using ByHand = std::shared_ptr<const SphereStencils>;

  /// Of a volume mesh, none given by hand.
  Vcvs() = default;
  Vcvs(Plane vcvs) : vcvs_(std::move(vcvs)) {}
  /// Of a volume mesh; null: none.
  Vcvs(ByHand vcvs) : vcvs_(std::move(vcvs)) {}

  /// Null for a volume mesh.
  Plane plane() const { return of<Plane>(); }
  /// Null for a plane or surface mesh, and where there are none.
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

/// A mesh with all that says how it is to be smoothed: what runs and commands act on.
struct MeshState {
  Mesh mesh;
  Vcvs vcvs = {};
  /// What elements are to the targets of a run: in layers, beside them. Null: nothing is known.
  std::shared_ptr<const ElementRoles> roles = nullptr;
  /// Layers that were inserted; if held, their spacing is kept whatever moves. Null: none.
  std::shared_ptr<const LayerStack> layers = nullptr;
  /// What the nodes of a surface mesh stay on, from the first smoothing on. Null: not found yet, or
  /// another kind of mesh.
  std::shared_ptr<const SurfaceShape> surface = nullptr;
};
/// A state with the paper's VCVs of a plane or surface mesh: equal angles, unit edges.
inline MeshState make_state(Mesh mesh) {
  Vcvs vcvs;  // those of a volume mesh are made where an equation needs them
  if (mesh.topology->cell_dimension() == 2)
    vcvs = std::make_shared<const VirtualControlVolumes>(mesh.topology);
  return {std::move(mesh), std::move(vcvs)};
}

}  // namespace winslow
