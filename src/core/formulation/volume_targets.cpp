#include "core/formulation/target_builder.h"
#include "core/formulation/target_shapes.h"
#include "core/mesh/element_type.h"
#include "core/parallel/parallel_for.h"
#include "core/quality/metric.h"

namespace winslow {

namespace {

/// Builds targets for the elements of volume meshes.
class VolumeTargets : TargetBuilder {
 public:
  VolumeTargets(const Topology& topology, const VolumeVcvs* vcvs, const TargetBlend& blend,
                const Coordinates* given, int threads, std::span<const Index> urgent,
                const VolumeTargetDetails& details)
      : TargetBuilder(topology, blend, given, threads, urgent, details.classes, {},
                      {details.roles, details.wall_stretch}),
        vcvs_(vcvs),
        stencils_(details.stencils),
        guarded_(details.guarded) {
    if (blend_.vcv > 0 && !vcvs) throw UsageError("targets that refer to no VCVs");
    if (refers_to_given(blend)) given_.emplace(*given);
    if (details.layer_shapes) layer_shapes_.emplace(*details.layer_shapes);
    targets_.stretched = stretched();
  }

  CellTargets<3> build() {
    targets_.cells.reserve(at(topology_.element_count()));
    targets_.offsets.reserve(at(topology_.element_count()) + 1);
    origins_.reserve(at(topology_.element_count()));
    if (keeps()) targets_.without_shape = find_lost([&](Index e) { return has_shape(e); });
    for (Index e = 0; e < topology_.element_count(); ++e) list_element(e);
    return fill_all();
  }

  TargetsOfSome<3> build_some(std::span<const Index> elements, bool any_lost) {
    if (keeps() && any_lost) find_lost([&](Index e) { return has_shape(e); });
    TargetsOfSome<3> out;
    Index number = 0;
    for (Index e = 0; e < topology_.element_count(); ++e) {
      if (!std::ranges::binary_search(elements, e)) {
        number += count_cells(e);
        continue;
      }
      const std::size_t first = targets_.cells.size();
      list_element(e);
      for (std::size_t k = first; k < targets_.cells.size(); ++k) {
        out.cells.push_back(number++);
        out.elements.push_back(e);
      }
    }
    out.targets = fill_all();
    return out;
  }

 private:
  CellTargets<3> fill_all() {
    regular_terms_ = make_regular_terms();
    targets_.terms.resize(at(targets_.offsets.back()));
    if (keeps()) targets_.inverse_limits.resize(targets_.terms.size());
    const auto count = static_cast<Index>(targets_.cells.size());
    parallel_for(threads_, count, [&](Index begin, Index end) {
      for (Index cell = begin; cell < end; ++cell) fill(cell);
    });
    return std::move(targets_);
  }

  /// The origin of a cell.
  struct Origin {
    Index element;
    /// index into corner_tetrahedra, continued by edge_tetrahedra and face_tetrahedra
    int corner;
    double weight;  ///< sum over all its terms
  };

  /// Whether no corner of an element is inverted or flat in the mesh as given.
  bool has_shape(Index e) const {
    return std::ranges::all_of(topology_.shape(e).corner_tetrahedra, [&](const auto& corner) {
      return has_metric(own_edges(e, by_nodes(corner, topology_.element(e))));
    });
  }
  /// Whether the target of an element is its shape in the wanted layers.
  bool has_layer_shape(Index e) const { return layer_shapes_ && is_layer(e); }
  bool free(Index node) const { return !topology_.on_boundary(node); }
  /// The VCV given by hand to a node; null if there is none or the element ignores it.
  const SphereStencil* by_hand(Index e, Index node) const {
    if (!stencils_ || !heeds_vcvs(e)) return nullptr;
    const auto found = stencils_->find(node);
    return found != stencils_->end() ? &found->second : nullptr;
  }
  /// The share of VCVs in a target of an element at a node.
  double vcv_share(Index e, Index node) const {
    if (!free(node)) return 0;
    return by_hand(e, node) ? 1 - blend_.rest : blend_.vcv;
  }
  /// Number of nodes of a tetrahedron with their own VCV target; 0: one common target.
  Index vcv_terms(Index e, const std::array<Index, 4>& nodes) const {
    if (topology_.element_type(e) != ElementType::tetrahedron || has_layer_shape(e)) return 0;
    if (blend_.vcv == 0 && !stencils_) return 0;
    return static_cast<Index>(std::count_if(nodes.begin(), nodes.end(),
                                            [&](Index node) { return vcv_share(e, node) > 0; }));
  }

  /// Lists the cells of an element and the number of terms of each.
  void list_element(Index e) {
    const auto corners = topology_.shape(e).corner_tetrahedra;
    const std::size_t first = targets_.cells.size();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto nodes = by_nodes(corners[k], topology_.element(e));
      if (!movable(nodes)) continue;
      if (has_layer_shape(e) && !own_metric(e, nodes)) refuse_layer_shape(e);
      if (blend_.rest > 0 && !own_metric(e, nodes)) refuse_rest(e, "inverted or flat");
      targets_.cells.push_back(nodes);
      end_cell(keeps() ? 2 : std::max(vcv_terms(e, nodes), 1));
      origins_.push_back({e, static_cast<int>(k), 0});
    }
    if (std::ranges::binary_search(guarded_, e)) list_edges(e);
    const std::size_t faces = targets_.cells.size();
    if (!topology_.shape(e).face_tetrahedra.empty()) list_faces(e);
    // Targets that make corners regular have none for faces: these only keep the cell valid.
    const double share = keeps() ? 1 : 0.1;
    const auto live = static_cast<double>(faces - first) +
                      share * static_cast<double>(targets_.cells.size() - faces);
    for (std::size_t cell = first; cell < origins_.size(); ++cell)
      origins_[cell].weight = (cell < faces ? 1 : share) * weight_of(e) / live;
  }

  /// The number of cells that list_element() lists.
  Index count_cells(Index e) const {
    const ElementShape& shape = topology_.shape(e);
    const auto listed = [&](const auto& tetrahedra, bool further) {
      return static_cast<Index>(std::ranges::count_if(tetrahedra, [&](const auto& corners) {
        const auto nodes = by_nodes(corners, topology_.element(e));
        return movable(nodes) && !(further && needs_own_metric(e) && !own_metric(e, nodes));
      }));
    };
    Index count = listed(shape.corner_tetrahedra, false) + listed(shape.face_tetrahedra, true);
    if (std::ranges::binary_search(guarded_, e)) count += listed(shape.edge_tetrahedra, true);
    return count;
  }

  /// Ends the cell that was listed last, which has so many terms.
  void end_cell(Index terms) {
    targets_.offsets.push_back(
        index_count(at(targets_.offsets.back()) + at(terms), "target shapes of elements"));
  }

  void list_edges(Index e) {
    const ElementShape& shape = topology_.shape(e);
    list_further(e, shape.edge_tetrahedra, shape.corner_tetrahedra.size());
  }
  void list_faces(Index e) {
    const ElementShape& shape = topology_.shape(e);
    list_further(e, shape.face_tetrahedra,
                 shape.corner_tetrahedra.size() + shape.edge_tetrahedra.size());
  }
  /// before: number of the tetrahedra of an element that come before these (Origin::corner).
  void list_further(Index e, std::span<const std::array<Index, 4>> tetrahedra, std::size_t before) {
    for (std::size_t k = 0; k < tetrahedra.size(); ++k) {
      const auto nodes = by_nodes(tetrahedra[k], topology_.element(e));
      if (!movable(nodes)) continue;
      if (needs_own_metric(e) && !own_metric(e, nodes)) continue;
      targets_.cells.push_back(nodes);
      end_cell(keeps() ? 2 : 1);
      origins_.push_back({e, static_cast<int>(before + k), 0});
    }
  }

  void fill(Index cell) {
    const auto& nodes = targets_.cells[at(cell)];
    const Index e = origins_[at(cell)].element;
    const int corner = origins_[at(cell)].corner;
    const double weight = origins_[at(cell)].weight;
    VolumeTerm* term = targets_.terms.data() + targets_.offsets[at(cell)];
    const ElementShape& shape = topology_.shape(e);
    const ElementType type = shape.type;
    const std::size_t corners = shape.corner_tetrahedra.size();
    const bool at_edge = at(corner) >= corners;
    if (type == ElementType::polyhedron) {
      fill_polyhedron(cell, shape);
      return;
    }
    const Eigen::Matrix3d& regular = at_edge ? regular_edge_metrics(type)[at(corner) - corners]
                                             : regular_metrics(type)[at(corner)];
    if (keeps()) {
      fill_kept(cell, regular);
      return;
    }
    if (has_layer_shape(e)) {
      *term = volume_term(own_metric(e, nodes).value_or(regular), weight);
      return;
    }
    if (is_regular(e)) {
      *term = regular_terms_[static_cast<std::size_t>(type)][at(corner)];
      term->weight = weight;
      return;
    }
    const Eigen::Matrix3d common = common_part(e, corner, regular, nodes);
    const auto at_node = [&](std::size_t k, double share) {
      const double vcv = vcv_share(e, nodes[k]);
      const Eigen::Matrix3d others = by_hand(e, nodes[k]) ? rest_part(e, nodes) : common;
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
    // Boundary nodes have no VCV.
    const Eigen::Matrix3d sum = common + blend_.vcv * regular;
    *term = volume_term(normalized_metric(sum), weight);
  }

  /// The term of a polyhedron, which keeps its own shape where other elements become regular: cells
  /// between split hexahedra have none that is regular.
  void fill_polyhedron(Index cell, const ElementShape& shape) {
    const auto [e, corner, weight] = origins_[at(cell)];
    const auto& nodes = targets_.cells[at(cell)];
    const auto own = given_ ? own_metric(e, nodes) : std::nullopt;
    const auto corners = shape.corner_tetrahedra.size();
    const auto known =
        at(corner) < corners ? regular_metric(shape, at(corner)) : std::optional<Eigen::Matrix3d>();
    const Eigen::Matrix3d regular = known ? *known
                                    : own ? *own
                                          : volume_metric(Edges3(Edges3::Identity()));
    if (keeps()) return fill_kept(cell, regular);
    const double vcv = vcv_share(e, nodes[0]);
    Eigen::Matrix3d sum = blend_.element * regular + blend_.automatic * own.value_or(regular);
    if (blend_.rest > 0) sum += blend_.rest * *own;
    if (by_hand(e, nodes[0])) sum = rest_part(e, nodes);
    if (at(corner) < corners && vcv > 0)
      sum += vcv * vcv_metric(e, nodes, 0);
    else
      sum += blend_.vcv * regular;
    targets_.terms[at(targets_.offsets[at(cell)])] = volume_term(normalized_metric(sum), weight);
  }

  /// Whether the targets of an element are regular: those of most elements under `automatic`.
  bool is_regular(Index e) const {
    if (blend_.vcv > 0 || blend_.rest > 0 || stencils_) return false;
    return !(blend_.automatic > 0) || (!has_own_share(e) && !box(e));
  }
  /// The terms of regular targets by element type, as fill() makes them, in the order of
  /// Origin::corner, without weights.
  std::array<std::vector<VolumeTerm>, element_type_count> make_regular_terms() const {
    return table_by_type([&](ElementType type) {
      std::vector<VolumeTerm> terms;
      for (const auto* metrics : {&regular_metrics(type), &regular_edge_metrics(type)}) {
        for (const Eigen::Matrix3d& regular : *metrics) {
          Eigen::Matrix3d sum = blend_.element * regular;
          if (given_ && blend_.automatic > 0) sum += blend_.automatic * regular;
          terms.push_back(volume_term(normalized_metric(sum + blend_.vcv * regular), 0));
        }
      }
      return terms;
    });
  }

  /// The terms of a cell under `keep`.
  void fill_kept(Index cell, const Eigen::Matrix3d& regular) {
    const auto [e, corner, weight] = origins_[at(cell)];
    const auto first = at(targets_.offsets[at(cell)]);
    const auto own = is_lost(e) ? std::nullopt : own_metric(e, targets_.cells[at(cell)]);
    const auto terms = kept_terms(topology_.shape(e), regular, own.value_or(regular), weight);
    targets_.terms[first] = terms.own;
    targets_.terms[first + 1] = terms.guard;
    targets_.inverse_limits[first + 1] = terms.inverse_limit;
  }

  /// Metric, over the edges from the first node, of the tetrahedron in the VCV of node `centre`
  /// that corresponds to these nodes.
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

  /// The part of a target without VCVs: metrics times their shares.
  Eigen::Matrix3d common_part(Index e, int corner, const Eigen::Matrix3d& regular,
                              const std::array<Index, 4>& nodes) const {
    Eigen::Matrix3d sum = blend_.element * regular;
    if (!given_) return sum;
    const auto own = own_metric(e, nodes);
    if (blend_.automatic > 0)
      sum += blend_.automatic * (own ? automatic(e, corner, regular, *own) : regular);
    if (blend_.rest > 0) sum += blend_.rest * *own;
    return sum;
  }

  Eigen::Matrix3d automatic(Index e, int corner, const Eigen::Matrix3d& regular,
                            const Eigen::Matrix3d& own) const {
    const auto sides = box(e);
    if (!has_own_share(e)) return sides ? box_metric(e, corner, *sides) : regular;
    const RelativeMetric relative(regular, own);
    const double share = own_share(e, 0.5 * relative.stretch());
    return sides ? RelativeMetric(box_metric(e, corner, *sides), own).between(share)
                 : relative.between(share);
  }

  /// Metric of a corner of the box with these sides. corner: as Origin::corner.
  Eigen::Matrix3d box_metric(Index e, int corner, const Vec3& sides) const {
    const ElementType type = topology_.element_type(e);
    const auto corners = corner_tetrahedra(type);
    const auto& nodes = at(corner) < corners.size()
                            ? corners[at(corner)]
                            : edge_tetrahedra(type)[at(corner) - corners.size()];
    const auto places = regular_corners(type);
    const auto place = [&](std::size_t k) {
      return sides.cwiseProduct(Vec3(places[at(nodes[k])].data())).eval();
    };
    Edges3 edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = place(at(k + 1)) - place(0);
    return volume_metric(edges);
  }

  /// The `rest` part of a target.
  Eigen::Matrix3d rest_part(Index e, const std::array<Index, 4>& nodes) const {
    if (!(blend_.rest > 0)) return Eigen::Matrix3d::Zero();
    return blend_.rest * *own_metric(e, nodes);
  }

  /// Whether an element has no target at edges where own_metric() is none.
  bool needs_own_metric(Index e) const { return blend_.rest > 0 && !has_layer_shape(e); }
  [[noreturn]] static void refuse_layer_shape(Index e) {
    throw UsageError("element " + std::to_string(e) +
                     " is inverted or flat in the shape that its layer is to have");
  }
  /// Metric of a corner in the mesh as given, with the stretch of a wall under it, or in the wanted
  /// layers; none if it is inverted or flat.
  std::optional<Eigen::Matrix3d> own_metric(Index e, const std::array<Index, 4>& nodes) const {
    const Edges3 edges = own_edges(e, nodes);
    if (!has_metric(edges)) return std::nullopt;
    return volume_metric(edges);
  }
  Edges3 own_edges(Index e, const std::array<Index, 4>& nodes) const {
    Edges3 edges;
    if (has_layer_shape(e)) {
      for (int k = 0; k < 3; ++k)
        edges.col(k) = (*layer_shapes_)[nodes[at(k + 1)]] - (*layer_shapes_)[nodes[0]];
      return edges;
    }
    for (int k = 0; k < 3; ++k)
      edges.col(k) = with_wall(e, (*given_)[nodes[at(k + 1)]] - (*given_)[nodes[0]]);
    return edges;
  }

  const VolumeVcvs* vcvs_;
  const SphereStencils* stencils_;  // null: none
  std::span<const Index> guarded_;
  std::array<std::vector<VolumeTerm>, element_type_count> regular_terms_;
  std::vector<Origin> origins_;       // of each cell
  std::optional<SpacePoints> given_;  // if the blend refers to it
  std::optional<SpacePoints> layer_shapes_;
  CellTargets<3> targets_;
};

}  // namespace

CellTargets<3> volume_targets(const Topology& topology, const VolumeVcvs* vcvs,
                              const TargetBlend& blend, const Coordinates* given, int threads,
                              std::span<const Index> urgent, const VolumeTargetDetails& details) {
  require_volume(topology, "targets of volume elements: the mesh is a ");
  return VolumeTargets(topology, vcvs, blend, given, threads, urgent, details).build();
}

TargetsOfSome<3> volume_targets_of(std::span<const Index> elements, const Topology& topology,
                                   const VolumeVcvs* vcvs, const TargetBlend& blend,
                                   const Coordinates* given, int threads,
                                   std::span<const Index> urgent,
                                   const VolumeTargetDetails& details) {
  require_volume(topology, "targets of volume elements: the mesh is a ");
  return VolumeTargets(topology, vcvs, blend, given, threads, urgent, details)
      .build_some(elements, details.any_without_shape);
}

}  // namespace winslow
