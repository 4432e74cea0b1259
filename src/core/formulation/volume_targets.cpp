#include "core/formulation/volume_targets.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/formulation/stretch_field.h"
#include "core/formulation/volume_metric.h"
#include "core/mesh/corner_tetrahedra.h"

namespace winslow {

namespace {

class Builder {
 public:
  Builder(const Topology& topology, const TargetBlend& blend, const Coordinates* given, int threads,
          std::span<const Index> urgent)
      : topology_(topology), blend_(normalized(blend)) {
    if (topology.cell_dimension() != 3)
      throw UsageError("targets of volume elements: the mesh is a " +
                       std::string(mesh_kind(topology)));
    if (blend_.vcv > 0)
      throw UsageError(
          "the virtual control volumes of a volume mesh are no targets of the variational form "
          "yet; "
          "choose 'auto', 'element' or 'rest'");
    if (refers_to_given(blend) && !given) throw UsageError("targets that refer to no mesh");
    if (refers_to_given(blend)) given_.emplace(*given);
    if (blend_.automatic > 0) {
      stretch_ = stretch_field(topology_, *given, threads);
      targets_.stretched = stretch_.stretched;
      for (const Index e : urgent) stretch_.weight[at(e)] *= 4;
    }
  }

  CellTargets<3> build() {
    for (Index e = 0; e < topology_.element_count(); ++e) add_element(e);
    return std::move(targets_);
  }

 private:
  bool movable(const std::array<Index, 4>& nodes) const {
    return std::any_of(nodes.begin(), nodes.end(),
                       [&](Index node) { return !topology_.on_boundary(node); });
  }

  void add_element(Index e) {
    const ElementType type = topology_.element_type(e);
    const auto corners = corner_tetrahedra(type);
    const auto live = static_cast<double>(
        std::count_if(corners.begin(), corners.end(), [&](const std::array<Index, 4>& corner) {
          return movable(by_nodes(corner, topology_.element(e)));
        }));
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto nodes = by_nodes(corners[k], topology_.element(e));
      if (!movable(nodes)) continue;
      targets_.cells.push_back(nodes);
      targets_.terms.push_back(
          volume_term(target_of(e, regular_metrics(type)[k], nodes), weight_of(e) / live));
      targets_.offsets.push_back(static_cast<Index>(targets_.terms.size()));
    }
  }

  double weight_of(Index e) const {
    const double held = blend_.automatic > 0 ? stretch_.weight[at(e)] : 1;
    return blend_.automatic * held + 1 - blend_.automatic;
  }

  Eigen::Matrix3d target_of(Index e, const Eigen::Matrix3d& regular,
                            const std::array<Index, 4>& nodes) const {
    Eigen::Matrix3d sum = blend_.element * regular;
    if (!given_) return normalized_metric(sum);
    const auto own = own_metric(nodes);
    if (blend_.automatic > 0)
      sum += blend_.automatic * (own ? automatic(e, regular, *own) : regular);
    if (blend_.rest > 0) {
      if (!own) {
        throw MeshError(MeshEntity::element, e,
                        "element " + std::to_string(e) +
                            " is inverted in the rest mesh, which is to be the target; choose "
                            "other targets");
      }
      sum += blend_.rest * *own;
    }
    return normalized_metric(sum);
  }

  Eigen::Matrix3d automatic(Index e, const Eigen::Matrix3d& regular,
                            const Eigen::Matrix3d& own) const {
    if (stretch_.share[at(e)] == 0) return regular;
    const RelativeMetric relative(regular, own);
    const double stretch = 0.5 * relative.stretch();
    const double limit = stretch > stretch_.longest[at(e)] ? stretch_.longest[at(e)] / stretch : 1;
    return relative.between(stretch_.share[at(e)] * limit);
  }

  /// Of a corner in the mesh as given; none if it is inverted.
  std::optional<Eigen::Matrix3d> own_metric(const std::array<Index, 4>& nodes) const {
    Edges3 edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = (*given_)[nodes[at(k + 1)]] - (*given_)[nodes[0]];
    if (!(edges.determinant() > 0)) return std::nullopt;
    return volume_metric(edges);
  }

  const Topology& topology_;
  TargetBlend blend_;
  std::optional<SpacePoints> given_;  // where the blend refers to it
  StretchField stretch_;              // where the blend has a share for it
  CellTargets<3> targets_;
};

}  // namespace

CellTargets<3> volume_targets(const Topology& topology, const TargetBlend& blend,
                              const Coordinates* given, int threads,
                              std::span<const Index> urgent) {
  return Builder(topology, blend, given, threads, urgent).build();
}

}  // namespace winslow
