#pragma once

#include <initializer_list>

#include "core/mesh/mesh_kind.h"

namespace winslow::gui {

/// Which meshes something is for.
class MeshKinds {
 public:
  constexpr MeshKinds(std::initializer_list<MeshKind> kinds) {
    for (const MeshKind kind : kinds) bits_ |= bit(kind);
  }
  constexpr bool contains(MeshKind kind) const { return (bits_ & bit(kind)) != 0; }

 private:
  static constexpr unsigned bit(MeshKind kind) { return 1U << static_cast<unsigned>(kind); }
  unsigned bits_ = 0;
};

inline constexpr MeshKinds all_meshes{MeshKind::plane, MeshKind::surface, MeshKind::volume};
inline constexpr MeshKinds plane_meshes{MeshKind::plane};
inline constexpr MeshKinds volume_meshes{MeshKind::volume};
inline constexpr MeshKinds meshes_in_space{MeshKind::surface, MeshKind::volume};
/// Those whose boundary can be moved: a surface keeps its shape.
inline constexpr MeshKinds movable_meshes{MeshKind::plane, MeshKind::volume};

}  // namespace winslow::gui
