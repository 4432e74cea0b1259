#include "core/formulation/target_shapes.h"

#include "core/error.h"
#include "core/formulation/kept_shapes.h"
#include "core/formulation/stretch_field.h"
#include "core/formulation/target_metric.h"
#include "core/mesh/element_type.h"
#include "core/parallel/parallel_for.h"
#include "core/quality/metric.h"

namespace winslow {

namespace {

/// The common part of the targets in the plane, on surfaces and in space.
class TargetBuilder {
 protected:
  /// given: null if the blend does not refer to it. normals: of the elements of a surface mesh.
  TargetBuilder(const Topology& topology, const TargetBlend& blend, const Coordinates* given,
                int threads, std::span<const Index> urgent, const NodeClasses* classes,
                const ElementRoles* roles, std::span<const Vec3> normals)
      : topology_(topology), blend_(normalized(blend)), classes_(classes), roles_(roles) {
    require_role_of_each(roles, topology);
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
  bool is_layer(Index e) const {
    const ElementRole role = role_of(roles_, e);
    return role == ElementRole::layer || role == ElementRole::found_layer;
  }
  bool heeds_vcvs(Index e) const {
    return keeps() ? is_layer(e) : !ignores_vcvs(role_of(roles_, e));
  }
  double weight_of(Index e) const { return element_weight(e, blend_, stretch_, roles_); }
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
    Index count = 0;
    lost_.assign(at(topology_.element_count()), false);
    for (Index e = 0; e < topology_.element_count(); ++e) {
      lost_[at(e)] = !has_shape(e);
      count += lost_[at(e)] ? 1 : 0;
    }
    if (count > most * static_cast<double>(lost_.size())) lost_.assign(lost_.size(), true);
    return count;
  }
  bool is_lost(Index e) const { return lost_[at(e)]; }
  [[noreturn]] static void refuse_rest(Index e, const char* fault) {
    throw MeshError(MeshEntity::element, e,
                    "element " + std::to_string(e) + " is " + fault +
                        " in the rest mesh, which is to be the target; choose other targets");
  }

  const Topology& topology_;
  const TargetBlend blend_;
  const NodeClasses* classes_;  // null: nothing slides

 private:
  const ElementRoles* roles_;  // null: all ordinary
  StretchField stretch_;       // if the blend has an `automatic` share
  std::vector<bool> lost_;     // #elements, under `keep`: it has no shape of its own
};

/// Builds targets for the elements of plane and surface meshes.
class FaceTargets : TargetBuilder {
 public:
  FaceTargets(const VirtualControlVolumes& vcv, const TargetBlend& blend, const Coordinates* given,
              int threads, std::span<const Index> urgent, const NodeClasses* classes,
              std::span<const Vec3> normals, const ElementRoles* roles)
      : TargetBuilder(vcv.topology(), blend, given, threads, urgent, classes, roles, normals),
        vcv_(vcv),
        given_(given),
        normals_(normals) {
    shapes_.stretched = stretched();
    edited_blend_ = {.vcv = blend_.automatic + blend_.element + blend_.vcv + blend_.keep,
                     .rest = blend_.rest};
  }

  TargetShapes build() {
    if (keeps()) shapes_.without_shape = find_lost([&](Index e) { return has_shape(e); });
    for (Index e = 0; e < topology_.element_count(); ++e) {
      if (topology_.element_type(e) == ElementType::triangle) {
        add_triangle(e);
      } else {
        add_quadrilateral(e);
      }
    }
    return std::move(shapes_);
  }

 private:
  static std::array<Index, 3> corner_nodes(std::span<const Index> element, std::size_t k) {
    const std::size_t n = element.size();
    return {element[k], element[(k + 1) % n], element[(k + n - 1) % n]};
  }

  /// Whether no corner of an element is inverted in the mesh as given.
  bool has_shape(Index e) const {
    const auto element = topology_.element(e);
    for (std::size_t k = 0; k < element.size(); ++k)
      if (!own_metric(corner_nodes(element, k), e)) return false;
    return true;
  }

  /// The shares at a corner: an edited VCV replaces the element's own shape.
  const TargetBlend& blend_at(Index node) const {
    return vcv_.edited(node) ? edited_blend_ : blend_;
  }
  bool any_edited(std::span<const Index> nodes) const {
    return !vcv_.edits().empty() &&
           std::any_of(nodes.begin(), nodes.end(), [&](Index node) { return vcv_.edited(node); });
  }

  /// Adds the rest metric of a corner, times the share.
  void add_rest(TargetMetric& metric, const std::array<Index, 3>& nodes, Index e) const {
    if (blend_.rest == 0) return;
    const auto own = own_metric(nodes, e);
    if (!own) refuse_rest(e, "inverted");
    metric.add(blend_.rest, *own);
  }

  /// Metric of a corner in the mesh as given; none if it is inverted.
  std::optional<TargetMetric> own_metric(const std::array<Index, 3>& nodes, Index e) const {
    const Vec3 first = place_of(*given_, nodes[0]);
    const Vec3 m1 = place_of(*given_, nodes[1]) - first, m2 = place_of(*given_, nodes[2]) - first;
    const Vec3 area = m1.cross(m2), normal = normals_.empty() ? Vec3::UnitZ() : normals_[at(e)];
    if (!(area.norm() > 0) || is_turned_over(area, normal)) return std::nullopt;
    return TargetMetric::of(m1, m2);
  }

  /// Adds the metrics of a corner of the regular element, and of one that keeps its stretch by the
  /// StretchField, times their shares.
  void add_regular(TargetMetric& metric, const TargetBlend& blend,
                   const std::array<Index, 3>& nodes, std::size_t corner, Index e) const {
    const double angle = topology_.element_type(e) == ElementType::triangle ? pi / 3 : pi / 2;
    const TargetMetric regular = TargetMetric::of_angle(angle);
    metric.add(blend.element, regular);
    if (blend.automatic == 0) return;
    const auto own = own_metric(nodes, e);
    metric.add(blend.automatic, own ? automatic(e, corner, regular, *own) : regular);
  }

  TargetMetric automatic(Index e, std::size_t corner, const TargetMetric& regular,
                         const TargetMetric& own) const {
    const double share = own_share(e, 0.5 * stretch_between(regular, own));
    const auto sides = box(e);
    if (!sides) return between(regular, own, share);
    const int first = static_cast<int>(corner % 2);  // the axis along the edge to the next corner
    const Vec2 next((*sides)[first], 0), previous(0, (*sides)[1 - first]);
    return between(TargetMetric::of<2>(next, previous), own, share);
  }

  /// Adds the VCV metric of the corner at a free node, times the share. A VCV of two edges has
  /// straight angles, which are unsuitable as a target: the element's own target replaces it.
  void add_vcv(TargetMetric& metric, Index e, Index node) const {
    const double ideal = topology_.element_type(e) == ElementType::triangle ? pi / 3 : pi / 2;
    if (topology_.neighbours(node).size() == 2) {
      metric.add(blend_at(node).vcv, TargetMetric::of_angle(ideal));
    } else {
      const auto [first, second] = vcv_edges(e, node);
      metric.add(blend_at(node).vcv, TargetMetric::of(first, second));
    }
  }

  /// Adds the VCV metric of a corner at the boundary, which has no VCV of its own, times the share:
  /// the corner of the parallelogram spanned by the VCVs of the adjacent corners, or by that of the
  /// opposite corner.
  void add_parallelogram(TargetMetric& metric, Index e, std::size_t corner) const {
    const auto element = topology_.element(e);
    const auto node = [&](std::size_t step) { return element[(corner + step) % 4]; };
    const double share = edited_blend_.vcv;
    // A VCV of two edges is no target, see add_vcv.
    const auto counts = [&](std::size_t step) {
      return vcv_.edited(node(step)) && topology_.neighbours(node(step)).size() > 2;
    };
    const bool next = counts(1), previous = counts(3);
    const double each = next && previous ? share / 2 : share;
    if (next) {
      const auto [to_opposite, to_corner] = vcv_edges(e, node(1));
      metric.add(each, TargetMetric::of<2>(-to_corner, to_opposite));
    }
    if (previous) {
      const auto [to_corner, to_opposite] = vcv_edges(e, node(3));
      metric.add(each, TargetMetric::of<2>(to_opposite, -to_corner));
    }
    if (next || previous) return;
    if (counts(2)) {
      const auto [to_previous, to_next] = vcv_edges(e, node(2));
      metric.add(each, TargetMetric::of<2>(-to_previous, -to_next));
    } else {
      metric.add(each, TargetMetric::of_angle(pi / 2));
    }
  }

  /// The two edges of an element in the VCV of one of its nodes, counter-clockwise.
  std::pair<Vec2, Vec2> vcv_edges(Index e, Index node) const {
    const auto star = topology_.star(node);
    const auto k = static_cast<Index>(std::find(star.begin(), star.end(), e) - star.begin());
    const auto count = static_cast<Index>(topology_.neighbours(node).size());
    return {vcv_.point(node, k), vcv_.point(node, (k + 1) % count)};
  }

  void add_triangle(Index e) {
    const auto element = topology_.element(e);
    const auto first = corner_nodes(element, 0);
    if (!movable(first)) return;
    shapes_.cells.push_back(first);
    if (keeps()) {
      add_kept(e, first, pi / 3, 1);
    } else if (blend_.vcv > 0 || (any_edited(element) && heeds_vcvs(e))) {
      add_vcv_terms(e);
    } else {
      shapes_.terms.push_back(common_metric(blend_, first, e).normalized().term(weight_of(e)));
    }
    shapes_.offsets.push_back(static_cast<Index>(shapes_.terms.size()));
  }

  /// Factor of the weight of held layers under `keep`: guards of elements that are squashed against
  /// them push ten times as hard as other targets do.
  static constexpr double weight_beside_guards = 10;
  /// Whether VCVs, not its own shape, are the targets of an element under `keep`: they hold the
  /// wanted heights of layers.
  bool spaced_by_vcvs(Index e) const { return is_layer(e) && any_edited(topology_.element(e)); }
  TargetMetric own_or(const TargetMetric& regular, const std::array<Index, 3>& nodes,
                      Index e) const {
    return is_lost(e) ? regular : *own_metric(nodes, e);
  }

  /// Adds the terms of a corner under `keep`. part: share of the element's weight.
  void add_kept(Index e, const std::array<Index, 3>& nodes, double angle, double part) {
    const TargetMetric regular = TargetMetric::of_angle(angle);
    const TargetMetric own = own_or(regular, nodes, e);
    append(shapes_, kept_terms(topology_.element_type(e), regular, own, part * weight_of(e)));
  }

  /// The part of a triangle's target without VCVs, over its edges at corner 0.
  TargetMetric common_metric(const TargetBlend& blend, const std::array<Index, 3>& first,
                             Index e) const {
    TargetMetric common;
    add_regular(common, blend, first, 0, e);
    add_rest(common, first, e);
    return common;
  }

  /// Adds one term for each corner with an effective VCV.
  void add_vcv_terms(Index e) {
    const auto element = topology_.element(e);
    const auto counts = [&](Index node) {
      return !topology_.on_boundary(node) && (blend_.vcv > 0 || vcv_.edited(node));
    };
    const auto corners = std::count_if(element.begin(), element.end(), counts);
    if (corners == 0) {  // all its moving nodes are on the boundary, where there are no VCVs
      TargetBlend regular = blend_;
      regular.element += std::exchange(regular.vcv, 0);
      shapes_.terms.push_back(
          common_metric(regular, corner_nodes(element, 0), e).normalized().term(weight_of(e)));
      return;
    }
    const double weight = weight_of(e) / static_cast<double>(corners);
    for (std::size_t k = 0; k < 3; ++k) {
      if (!counts(element[k])) continue;
      // The VCV's metric belongs to the edges at corner k: express the common part there too.
      TargetMetric metric =
          rotated(common_metric(blend_at(element[k]), corner_nodes(element, 0), e), k);
      add_vcv(metric, e, element[k]);
      const ShapeTerm t = metric.normalized().term(weight);
      shapes_.terms.push_back(k == 0   ? t
                              : k == 1 ? ShapeTerm{t.ac, t.bc, t.ab, weight}
                                       : ShapeTerm{t.bc, t.ab, t.ac, weight});
    }
  }

  /// Transforms a metric over the edges at corner 0 to those at corner k of the same triangle.
  static TargetMetric rotated(const TargetMetric& m, std::size_t k) {
    if (k == 0) return m;
    // Edges from corner 1 are (c - b, a - b), from corner 2 (a - c, b - c). The form is the same
    // function of the three edge vectors.
    const double ab = m.a11 + m.a12, ac = m.a22 + m.a12, bc = -m.a12;
    if (k == 1) return {bc + ac, -ac, ab + ac};
    return {ac + ab, -ab, bc + ab};
  }

  void add_quadrilateral(Index e) {
    const auto element = topology_.element(e);
    std::array<bool, 4> live{};
    int count = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      live[k] = movable(corner_nodes(element, k));
      count += live[k] ? 1 : 0;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      if (!live[k]) continue;
      const auto nodes = corner_nodes(element, k);
      if (keeps() && !spaced_by_vcvs(e)) {
        shapes_.cells.push_back(nodes);
        add_kept(e, nodes, pi / 2, 1.0 / count);
        shapes_.offsets.push_back(static_cast<Index>(shapes_.terms.size()));
        continue;
      }
      const bool own = !heeds_vcvs(e);
      const bool follows = !own && topology_.on_boundary(nodes[0]) && any_edited(element);
      const TargetBlend& blend = own ? blend_ : follows ? edited_blend_ : blend_at(nodes[0]);
      TargetMetric metric;
      add_regular(metric, blend, nodes, k, e);
      if (blend.keep > 0) metric.add(blend.keep, own_or(TargetMetric::of_angle(pi / 2), nodes, e));
      if (follows) {
        add_parallelogram(metric, e, k);
      } else if (blend.vcv > 0) {
        if (topology_.on_boundary(nodes[0])) {
          metric.add(blend.vcv, TargetMetric::of_angle(pi / 2));  // boundary nodes have no VCV
        } else {
          add_vcv(metric, e, nodes[0]);
        }
      }
      add_rest(metric, nodes, e);
      shapes_.cells.push_back(nodes);
      shapes_.terms.push_back(
          metric.normalized().term((keeps() ? weight_beside_guards : 1) * weight_of(e) / count));
      if (keeps()) shapes_.inverse_limits.push_back(0);
      shapes_.offsets.push_back(static_cast<Index>(shapes_.terms.size()));
    }
  }

  const VirtualControlVolumes& vcv_;
  TargetBlend edited_blend_;  // at nodes whose VCVs were edited
  const Coordinates* given_;
  std::span<const Vec3> normals_;  // of the elements of a surface mesh
  TargetShapes shapes_;
};

}  // namespace

TargetShapes TargetShapes::build(const VirtualControlVolumes& vcv, const TargetBlend& blend,
                                 const Coordinates* given, int threads,
                                 std::span<const Index> urgent, const NodeClasses* classes,
                                 std::span<const Vec3> normals, const ElementRoles* roles) {
  return FaceTargets(vcv, blend, given, threads, urgent, classes, normals, roles).build();
}

namespace {

/// Builds targets for the elements of volume meshes.
class VolumeTargets : TargetBuilder {
 public:
  VolumeTargets(const Topology& topology, const VolumeVcvs* vcvs, const TargetBlend& blend,
                const Coordinates* given, int threads, std::span<const Index> urgent,
                const VolumeTargetDetails& details)
      : TargetBuilder(topology, blend, given, threads, urgent, details.classes, details.roles, {}),
        vcvs_(vcvs),
        stencils_(details.stencils),
        threads_(threads),
        guarded_(details.guarded) {
    if (blend_.vcv > 0 && !vcvs) throw UsageError("targets that refer to no VCVs");
    if (refers_to_given(blend)) given_.emplace(*given);
    targets_.stretched = stretched();
  }

  CellTargets<3> build() {
    if (keeps()) targets_.without_shape = find_lost([&](Index e) { return has_shape(e); });
    for (Index e = 0; e < topology_.element_count(); ++e) list_element(e);
    targets_.terms.resize(at(targets_.offsets.back()));
    if (keeps()) targets_.inverse_limits.resize(targets_.terms.size());
    const auto count = static_cast<Index>(targets_.cells.size());
    parallel_for(threads_, count, [&](Index begin, Index end) {
      for (Index cell = begin; cell < end; ++cell) fill(cell);
    });
    return std::move(targets_);
  }

 private:
  /// The origin of a cell.
  struct Origin {
    Index element;
    int corner;     ///< index into corner_tetrahedra(), continued by edge_tetrahedra()
    double weight;  ///< sum over all its terms
  };

  /// Whether no corner of an element is inverted or flat in the mesh as given.
  bool has_shape(Index e) const {
    return std::ranges::all_of(
        corner_tetrahedra(topology_.element_type(e)), [&](const auto& corner) {
          return own_metric(by_nodes(corner, topology_.element(e))).has_value();
        });
  }
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
    if (topology_.element_type(e) != ElementType::tetrahedron) return 0;
    if (blend_.vcv == 0 && !stencils_) return 0;
    return static_cast<Index>(std::count_if(nodes.begin(), nodes.end(),
                                            [&](Index node) { return vcv_share(e, node) > 0; }));
  }

  /// Lists the cells of an element and the number of terms of each.
  void list_element(Index e) {
    const auto corners = corner_tetrahedra(topology_.element_type(e));
    const std::size_t first = targets_.cells.size();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto nodes = by_nodes(corners[k], topology_.element(e));
      if (!movable(nodes)) continue;
      if (blend_.rest > 0 && !own_metric(nodes)) refuse_rest(e, "inverted or flat");
      targets_.cells.push_back(nodes);
      targets_.offsets.push_back(targets_.offsets.back() +
                                 (keeps() ? 2 : std::max(vcv_terms(e, nodes), 1)));
      origins_.push_back({e, static_cast<int>(k), 0});
    }
    if (std::ranges::binary_search(guarded_, e)) list_edges(e);
    const auto live = static_cast<double>(targets_.cells.size() - first);
    for (std::size_t cell = first; cell < origins_.size(); ++cell)
      origins_[cell].weight = weight_of(e) / live;
  }

  void list_edges(Index e) {
    const ElementType type = topology_.element_type(e);
    const auto corners = corner_tetrahedra(type).size();
    const auto edges = edge_tetrahedra(type);
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const auto nodes = by_nodes(edges[k], topology_.element(e));
      if (!movable(nodes)) continue;
      if (blend_.rest > 0 && !own_metric(nodes)) continue;
      targets_.cells.push_back(nodes);
      targets_.offsets.push_back(targets_.offsets.back() + (keeps() ? 2 : 1));
      origins_.push_back({e, static_cast<int>(corners + k), 0});
    }
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
    if (keeps()) {
      fill_kept(cell, regular);
      return;
    }
    const Eigen::Matrix3d common = common_part(e, corner, regular, nodes);
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
    // Boundary nodes have no VCV.
    const Eigen::Matrix3d sum = common + blend_.vcv * regular;
    *term = volume_term(normalized_metric(sum), weight);
  }

  /// The terms of a cell under `keep`.
  void fill_kept(Index cell, const Eigen::Matrix3d& regular) {
    const auto [e, corner, weight] = origins_[at(cell)];
    const auto first = at(targets_.offsets[at(cell)]);
    const auto own = is_lost(e) ? std::nullopt : own_metric(targets_.cells[at(cell)]);
    const auto terms =
        kept_terms(topology_.element_type(e), regular, own.value_or(regular), weight);
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
    const auto own = own_metric(nodes);
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
  Eigen::Matrix3d rest_part(const std::array<Index, 4>& nodes) const {
    if (!(blend_.rest > 0)) return Eigen::Matrix3d::Zero();
    return blend_.rest * *own_metric(nodes);
  }

  /// Metric of a corner in the mesh as given; none if it is inverted or flat.
  std::optional<Eigen::Matrix3d> own_metric(const std::array<Index, 4>& nodes) const {
    Edges3 edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = (*given_)[nodes[at(k + 1)]] - (*given_)[nodes[0]];
    if (!has_metric(edges)) return std::nullopt;
    return volume_metric(edges);
  }

  const VolumeVcvs* vcvs_;
  const SphereStencils* stencils_;  // null: none
  int threads_;
  std::span<const Index> guarded_;
  std::vector<Origin> origins_;       // of each cell
  std::optional<SpacePoints> given_;  // if the blend refers to it
  CellTargets<3> targets_;
};

}  // namespace

CellTargets<3> volume_targets(const Topology& topology, const VolumeVcvs* vcvs,
                              const TargetBlend& blend, const Coordinates* given, int threads,
                              std::span<const Index> urgent, const VolumeTargetDetails& details) {
  require_volume(topology, "targets of volume elements: the mesh is a ");
  return VolumeTargets(topology, vcvs, blend, given, threads, urgent, details).build();
}

}  // namespace winslow
