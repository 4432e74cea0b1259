#include "core/formulation/volume_targets.h"

#include "core/error.h"
#include "core/formulation/stretch_field.h"
#include "core/formulation/target_metric.h"
#include "core/mesh/element_type.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

class Builder {
 public:
  Builder(const Topology& topology, const VolumeVcvs* vcvs, const TargetBlend& blend,
          const Coordinates* given, int threads, std::span<const Index> urgent,
          const VolumeTargetDetails& details)
      : topology_(topology),
        vcvs_(vcvs),
        stencils_(details.stencils),
        blend_(normalized(blend)),
        threads_(threads),
        classes_(details.classes),
        guarded_(details.guarded),
        roles_(details.roles) {
    if (topology.cell_dimension() != 3)
      throw UsageError("targets of volume elements: the mesh is a " +
                       std::string(mesh_kind(topology)));
    require_role_of_each(roles_, topology);
    if (blend_.vcv > 0 && !vcvs) throw UsageError("targets that refer to no VCVs");
    if (refers_to_given(blend) && !given) throw UsageError("targets that refer to no mesh");
    if (refers_to_given(blend)) given_.emplace(*given);
    if (blend_.automatic > 0) {
      stretch_ = stretch_field(topology_, *given, threads);
      targets_.stretched = stretch_.stretched;
      for (const Index e : urgent) stretch_.weight[at(e)] *= 4;
    }
  }

  CellTargets<3> build() {
    for (Index e = 0; e < topology_.element_count(); ++e) list_element(e);
    targets_.terms.resize(at(targets_.offsets.back()));
    const auto count = static_cast<Index>(targets_.cells.size());
    parallel_for(threads_, count, [&](Index begin, Index end) {
      for (Index cell = begin; cell < end; ++cell) fill(cell);
    });
    return std::move(targets_);
  }

 private:
  /// Where a cell comes from.
  struct Origin {
    Index element;
    int corner;     ///< of corner_tetrahedra(); beyond these, of edge_tetrahedra()
    double weight;  ///< of all its terms together
  };

  bool free(Index node) const { return !topology_.on_boundary(node); }
  Index free_nodes(const std::array<Index, 4>& nodes) const {
    return static_cast<Index>(
        std::count_if(nodes.begin(), nodes.end(), [&](Index node) { return free(node); }));
  }
  bool moves(const std::array<Index, 4>& nodes) const {
    return classes_ && std::any_of(nodes.begin(), nodes.end(),
                                   [&](Index node) { return classes_->moves(node); });
  }
  /// The VCV that a node was given, as far as an element heeds it; null: none.
  const SphereStencil* by_hand(Index e, Index node) const {
    if (!stencils_ || ignores_vcvs(role_of(roles_, e))) return nullptr;
    const auto found = stencils_->find(node);
    return found != stencils_->end() ? &found->second : nullptr;
  }
  /// The share of VCVs in a target of an element at a node.
  double vcv_share(Index e, Index node) const {
    if (!free(node)) return 0;
    return by_hand(e, node) ? 1 - blend_.rest : blend_.vcv;
  }
  /// How many nodes of a tetrahedron have a target with a VCV in it; 0: one target for all.
  Index vcv_terms(Index e, const std::array<Index, 4>& nodes) const {
    if (topology_.element_type(e) != ElementType::tetrahedron) return 0;
    if (blend_.vcv == 0 && !stencils_) return 0;
    return static_cast<Index>(std::count_if(nodes.begin(), nodes.end(),
                                            [&](Index node) { return vcv_share(e, node) > 0; }));
  }

  /// The cells of an element, and how many terms each is to have.
  void list_element(Index e) {
    const auto corners = corner_tetrahedra(topology_.element_type(e));
    const std::size_t first = targets_.cells.size();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto nodes = by_nodes(corners[k], topology_.element(e));
      if (free_nodes(nodes) == 0 && !moves(nodes)) continue;
      if (blend_.rest > 0) require_valid(e, nodes);
      targets_.cells.push_back(nodes);
      targets_.offsets.push_back(targets_.offsets.back() + std::max(vcv_terms(e, nodes), 1));
      origins_.push_back({e, static_cast<int>(k), 0});
    }
    if (std::ranges::binary_search(guarded_, e)) list_edges(e);
    const auto live = static_cast<double>(targets_.cells.size() - first);
    for (std::size_t cell = first; cell < origins_.size(); ++cell)
      origins_[cell].weight = element_weight(e, blend_, stretch_, roles_) / live;
  }

  void list_edges(Index e) {
    const ElementType type = topology_.element_type(e);
    const auto corners = corner_tetrahedra(type).size();
    const auto edges = edge_tetrahedra(type);
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const auto nodes = by_nodes(edges[k], topology_.element(e));
      if (free_nodes(nodes) == 0 && !moves(nodes)) continue;
      if (blend_.rest > 0 && !own_metric(nodes)) continue;
      targets_.cells.push_back(nodes);
      targets_.offsets.push_back(targets_.offsets.back() + 1);
      origins_.push_back({e, static_cast<int>(corners + k), 0});
    }
  }

  void require_valid(Index e, const std::array<Index, 4>& nodes) const {
    if (has_metric(given_edges(nodes))) return;
    throw MeshError(MeshEntity::element, e,
                    "element " + std::to_string(e) +
                        " is inverted or flat in the rest mesh, which is to be the target; choose "
                        "other targets");
  }

  void fill(Index cell) {
    const auto& nodes = targets_.cells[at(cell)];
    const Index e = origins_[at(cell)].element;
    const int corner = origins_[at(cell)].corner;
    const double weight = origins_[at(cell)].weight;
    VolumeTerm* term = targets_.terms.data() + targets_.offsets[at(cell)];
    const ElementType type = topology_.element_type(e);
    const std::size_t corners = corner_tetrahedra(type).size();
    const bool at_edge = at(corner) >= corners;
    const Eigen::Matrix3d& regular = at_edge ? regular_edge_metrics(type)[at(corner) - corners]
                                             : regular_metrics(type)[at(corner)];
    const Eigen::Matrix3d common = common_part(e, regular, nodes);
    const auto at_node = [&](std::size_t k, double share) {
      const double vcv = vcv_share(e, nodes[k]);
      const Eigen::Matrix3d others = by_hand(e, nodes[k]) ? rest_part(nodes) : common;
      return volume_term(normalized_metric(others + vcv * vcv_metric(e, nodes, k)), share);
    };
    if (const Index terms = vcv_terms(e, nodes); terms > 0) {
      for (std::size_t k = 0; k < 4; ++k)
        if (vcv_share(e, nodes[k]) > 0) *term++ = at_node(k, weight / static_cast<double>(terms));
      return;
    }
    const bool tetrahedron = type == ElementType::tetrahedron;
    if (!tetrahedron && !at_edge && vcv_share(e, nodes[0]) > 0) {
      *term = at_node(0, weight);
      return;
    }
    // There is no VCV at the boundary.
    const Eigen::Matrix3d sum = common + blend_.vcv * regular;
    *term = volume_term(normalized_metric(sum), weight);
  }

  /// Metric, over the edges from the first node, of the tetrahedron that the VCV of node `centre`
  /// of these has in the place of theirs.
  Eigen::Matrix3d vcv_metric(Index e, const std::array<Index, 4>& nodes, std::size_t centre) const {
    const auto neighbours = topology_.neighbours(nodes[centre]);
    const auto place = [&](std::size_t k) -> Vec3 {
      if (k == centre) return {0, 0, 0};
      const auto found = std::find(neighbours.begin(), neighbours.end(), nodes[k]);
      const auto at_ring = static_cast<std::size_t>(found - neighbours.begin());
      if (const SphereStencil* given = by_hand(e, nodes[centre]))
        return given->lengths[at_ring] * given->directions[at_ring];
      return vcvs_->point(nodes[centre], static_cast<Index>(at_ring));
    };
    const Vec3 origin = place(0);
    Edges3 edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = place(at(k + 1)) - origin;
    return volume_metric(edges);
  }

  /// What a target has besides VCVs: metrics times their shares.
  Eigen::Matrix3d common_part(Index e, const Eigen::Matrix3d& regular,
                              const std::array<Index, 4>& nodes) const {
    Eigen::Matrix3d sum = blend_.element * regular;
    if (!given_) return sum;
    const auto own = own_metric(nodes);
    if (blend_.automatic > 0)
      sum += blend_.automatic * (own ? automatic(e, regular, *own) : regular);
    if (blend_.rest > 0) sum += blend_.rest * *own;
    return sum;
  }

  Eigen::Matrix3d automatic(Index e, const Eigen::Matrix3d& regular,
                            const Eigen::Matrix3d& own) const {
    if (stretch_.share[at(e)] == 0) return regular;
    const RelativeMetric relative(regular, own);
    const double stretch = 0.5 * relative.stretch();
    const double limit = stretch > stretch_.longest[at(e)] ? stretch_.longest[at(e)] / stretch : 1;
    return relative.between(stretch_.share[at(e)] * limit);
  }

  /// The share of the mesh as given alone.
  Eigen::Matrix3d rest_part(const std::array<Index, 4>& nodes) const {
    if (!(blend_.rest > 0)) return Eigen::Matrix3d::Zero();
    return blend_.rest * *own_metric(nodes);
  }

  Edges3 given_edges(const std::array<Index, 4>& nodes) const {
    Edges3 edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = (*given_)[nodes[at(k + 1)]] - (*given_)[nodes[0]];
    return edges;
  }

  /// Of a corner in the mesh as given; none if it is inverted or flat.
  std::optional<Eigen::Matrix3d> own_metric(const std::array<Index, 4>& nodes) const {
    const Edges3 edges = given_edges(nodes);
    if (!has_metric(edges)) return std::nullopt;
    return volume_metric(edges);
  }

  const Topology& topology_;
  const VolumeVcvs* vcvs_;
  const SphereStencils* stencils_;  // null: none
  TargetBlend blend_;
  int threads_;
  const NodeClasses* classes_;  // null: nothing slides
  std::span<const Index> guarded_;
  const ElementRoles* roles_;         // null: nothing is known of elements
  std::vector<Origin> origins_;       // of each cell
  std::optional<SpacePoints> given_;  // where the blend refers to it
  StretchField stretch_;              // where the blend has a share for it
  CellTargets<3> targets_;
};

}  // namespace

CellTargets<3> volume_targets(const Topology& topology, const VolumeVcvs* vcvs,
                              const TargetBlend& blend, const Coordinates* given, int threads,
                              std::span<const Index> urgent, const VolumeTargetDetails& details) {
  return Builder(topology, vcvs, blend, given, threads, urgent, details).build();
}

}  // namespace winslow
