#pragma once

#include "core/formulation/kept_shapes.h"
#include "core/formulation/stretch_field.h"
#include "core/formulation/tangled_rest.h"
#include "core/formulation/target_metric.h"
#include "core/formulation/target_shapes.h"
#include "core/parallel/parallel_for.h"
#include "core/problem/node_classes.h"

/// The base of the classes that build targets: of faces (target_shapes.cpp) and of volume elements
/// (volume_targets.cpp).
namespace winslow {

/// The common part of the targets in the plane, on surfaces and in space.
class TargetBuilder {
 protected:
  /// given: null if the blend does not refer to it. normals: of the elements of a surface mesh.
  TargetBuilder(const Topology& topology, const TargetBlend& blend, const Coordinates* given,
                int threads, std::span<const Index> urgent, const NodeClasses* classes,
                std::span<const Vec3> normals, const ElementDetails& details)
      : topology_(topology),
        blend_(normalized(blend)),
        classes_(classes),
        threads_(threads),
        wall_stretch_(blend_.keep > 0 ? details.wall_stretch : nullptr),
        roles_(details.roles) {
    require_role_of_each(roles_, topology);
    if (refers_to_given(blend) && !given) throw UsageError("targets that refer to no mesh");
    if (blend.automatic == 0) return;
    stretch_ = stretch_field(topology, *given, threads, normals);
    for (const Index e : urgent) stretch_.weight[at(e)] *= 4;
  }

  /// Whether any of the nodes can move.
  bool movable(std::span<const Index> nodes) const {
    return std::ranges::any_of(nodes, [&](Index node) {
      if (topology_.on_boundary(node)) return classes_ && classes_->moves(node);
      return !classes_ || (*classes_)[node] != NodeClass::prescribed;
    });
  }
  bool keeps() const { return blend_.keep > 0; }
  /// An edge of an element in the mesh as given, as long as a stretched wall makes it.
  Vec3 with_wall(Index e, const Vec3& edge) const {
    const Eigen::Matrix3d* map = wall_stretch_ ? wall_stretch_->map_of(e) : nullptr;
    return map ? Vec3(*map * edge) : edge;
  }
  bool is_layer(Index e) const {
    const ElementRole role = role_of(roles_, e);
    return role == ElementRole::layer || role == ElementRole::found_layer;
  }
  bool heeds_vcvs(Index e) const {
    return keeps() ? is_layer(e) : !ignores_vcvs(role_of(roles_, e));
  }
  double weight_of(Index e) const {
    const double stiffness = wall_stretch_ ? wall_stretch_->stiffness_of(e) : 1;
    return stiffness * element_weight(e, blend_, stretch_, roles_);
  }
  /// CellTargets::stretched.
  std::optional<double> stretched() const {
    return blend_.automatic > 0 ? std::optional(stretch_.stretched) : std::nullopt;
  }
  /// Position of a corner's target between the regular shape (0) and its own shape (1). stretch: of
  /// its own shape.
  double own_share(Index e, double stretch) const {
    const double longest = stretch_.longest[at(e)];
    return stretch_.share[at(e)] * (stretch > longest ? longest / stretch : 1);
  }
  /// Side lengths, along the axes of an element, of the box that takes the place of its regular
  /// shape (BoxField); empty: none does.
  std::optional<Vec3> box(Index e) const {
    if (stretch_.sides.empty() || stretch_.sides[at(e)].isZero(0)) return std::nullopt;
    return stretch_.sides[at(e)].array().exp().matrix();
  }
  bool has_own_share(Index e) const { return stretch_.share[at(e)] != 0; }
  /// Finds the elements without a shape, and returns their number. If more than one in twenty has
  /// none, the mesh has no shape to keep: all are lost.
  template <class HasShape>
  Index find_lost(const HasShape& has_shape) {
    constexpr double most = 0.05;
    lost_.assign(at(topology_.element_count()), 0);
    parallel_for(threads_, topology_.element_count(), [&](Index begin, Index end) {
      for (Index e = begin; e < end; ++e) lost_[at(e)] = has_shape(e) ? 0 : 1;
    });
    const auto count = static_cast<Index>(std::ranges::count(lost_, 1));
    if (count > most * static_cast<double>(lost_.size())) lost_.assign(lost_.size(), 1);
    return count;
  }
  bool is_lost(Index e) const { return !lost_.empty() && lost_[at(e)] != 0; }
  [[noreturn]] static void refuse_rest(Index e, const char* fault) { throw TangledRest(e, fault); }

  const Topology& topology_;
  const TargetBlend blend_;
  const NodeClasses* classes_;  // null: nothing slides
  const int threads_;

 private:
  const WallStretch* wall_stretch_;  // null: no wall is stretched
  const ElementRoles* roles_;        // null: all ordinary
  StretchField stretch_;             // if the blend has an `automatic` share
  std::vector<unsigned char>
      lost_;  // #elements, under `keep`: it has no shape of its own; empty: not looked for
};

}  // namespace winslow
