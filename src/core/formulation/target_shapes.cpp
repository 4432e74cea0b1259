#include "core/formulation/target_shapes.h"

#include "core/error.h"
#include "core/formulation/stretch_field.h"
#include "core/formulation/target_metric.h"
#include "core/quality/metric.h"

namespace winslow {

namespace {

class Builder {
 public:
  Builder(const VirtualControlVolumes& vcv, const TargetBlend& blend, const Coordinates* given,
          int threads, std::span<const Index> urgent, const NodeClasses* classes,
          std::span<const Vec3> normals, const ElementRoles* roles)
      : vcv_(vcv),
        topology_(vcv.topology()),
        classes_(classes),
        blend_(normalized(blend)),
        given_(given),
        normals_(normals),
        roles_(roles) {
    require_role_of_each(roles, topology_);
    if (refers_to_given(blend) && !given) throw UsageError("targets that refer to no mesh");
    if (blend.automatic > 0) {
      stretch_ = stretch_field(topology_, *given, threads, normals);
      shapes_.stretched = stretch_.stretched;
      for (const Index e : urgent) stretch_.weight[at(e)] *= 4;
    }
    edited_blend_ = {0, 0, blend_.automatic + blend_.element + blend_.vcv, blend_.rest};
  }

  TargetShapes build() {
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
  bool movable(const std::array<Index, 3>& nodes) const {
    return std::any_of(nodes.begin(), nodes.end(), [&](Index node) {
      return !topology_.on_boundary(node) || (classes_ && classes_->moves(node));
    });
  }

  static std::array<Index, 3> corner_nodes(std::span<const Index> element, std::size_t k) {
    const std::size_t n = element.size();
    return {element[k], element[(k + 1) % n], element[(k + n - 1) % n]};
  }

  /// The shares at a corner: an edited VCV takes the place of the element's own shape.
  const TargetBlend& blend_at(Index node) const {
    return vcv_.edited(node) ? edited_blend_ : blend_;
  }
  bool any_edited(std::span<const Index> nodes) const {
    return !vcv_.edits().empty() &&
           std::any_of(nodes.begin(), nodes.end(), [&](Index node) { return vcv_.edited(node); });
  }

  /// Rest metric of a corner, times the share.
  void add_rest(TargetMetric& metric, const std::array<Index, 3>& nodes, Index e) const {
    if (blend_.rest == 0) return;
    const auto own = own_metric(nodes, e);
    if (!own) {
      throw MeshError(MeshEntity::element, e,
                      "element " + std::to_string(e) +
                          " is inverted in the rest mesh, which is to be the target; choose other "
                          "targets");
    }
    metric.add(blend_.rest, *own);
  }

  /// Of a corner in the mesh as given; none if it is inverted.
  std::optional<TargetMetric> own_metric(const std::array<Index, 3>& nodes, Index e) const {
    if (is_surface(topology_)) {
      const Vec3 m1 = given_->xyz(nodes[1]) - given_->xyz(nodes[0]);
      const Vec3 m2 = given_->xyz(nodes[2]) - given_->xyz(nodes[0]);
      const Vec3 area = m1.cross(m2);
      if (!(area.norm() > 0) || is_turned_over(area, normals_[at(e)])) return std::nullopt;
      return TargetMetric::in_space(m1, m2);
    }
    const Vec2 m1 = given_->xy(nodes[1]) - given_->xy(nodes[0]);
    const Vec2 m2 = given_->xy(nodes[2]) - given_->xy(nodes[0]);
    if (!(m1.x() * m2.y() - m1.y() * m2.x() > 0)) return std::nullopt;
    return TargetMetric::of(m1, m2);
  }

  /// How much of the way from the regular shape to its own the target of a corner lies.
  double own_share(Index e, const TargetMetric& regular, const TargetMetric& own) const {
    const double stretch = 0.5 * stretch_between(regular, own);
    const double limit = stretch > stretch_.longest[at(e)] ? stretch_.longest[at(e)] / stretch : 1;
    return stretch_.share[at(e)] * limit;
  }

  double weight_of(Index e) const { return element_weight(e, blend_, stretch_, roles_); }
  /// Metric of a corner of a regular element, and of one that keeps its stretch as the field says,
  /// times their shares.
  void add_regular(TargetMetric& metric, const TargetBlend& blend,
                   const std::array<Index, 3>& nodes, Index e) const {
    const double angle = topology_.element_type(e) == ElementType::triangle ? pi / 3 : pi / 2;
    const TargetMetric regular = TargetMetric::of_angle(angle);
    metric.add(blend.element, regular);
    if (blend.automatic == 0) return;
    const auto own = own_metric(nodes, e);
    metric.add(blend.automatic,
               own ? between(regular, *own, own_share(e, regular, *own)) : regular);
  }

  /// VCV metric of the corner at a free node, times the share. A VCV of two edges has straight
  /// angles, which are no shape to strive for: there the element's own target stands in.
  void add_vcv(TargetMetric& metric, Index e, Index node) const {
    const double ideal = topology_.element_type(e) == ElementType::triangle ? pi / 3 : pi / 2;
    if (topology_.neighbours(node).size() == 2) {
      metric.add(blend_at(node).vcv, TargetMetric::of_angle(ideal));
    } else {
      const auto [first, second] = vcv_edges(e, node);
      metric.add(blend_at(node).vcv, TargetMetric::of(first, second));
    }
  }

  /// VCV metric of a corner at the boundary, where there is no VCV, times the share: the corner of
  /// the parallelogram that the VCVs of the adjacent corners span, or that of the opposite corner.
  void add_parallelogram(TargetMetric& metric, Index e, std::size_t corner) const {
    const auto element = topology_.element(e);
    const auto node = [&](std::size_t step) { return element[(corner + step) % 4]; };
    const double share = edited_blend_.vcv;
    // Two edges are no shape, see add_vcv.
    const auto counts = [&](std::size_t step) {
      return vcv_.edited(node(step)) && topology_.neighbours(node(step)).size() > 2;
    };
    const bool next = counts(1), previous = counts(3);
    const double each = next && previous ? share / 2 : share;
    if (next) {
      const auto [to_opposite, to_corner] = vcv_edges(e, node(1));
      metric.add(each, TargetMetric::of(-to_corner, to_opposite));
    }
    if (previous) {
      const auto [to_corner, to_opposite] = vcv_edges(e, node(3));
      metric.add(each, TargetMetric::of(to_opposite, -to_corner));
    }
    if (next || previous) return;
    if (counts(2)) {
      const auto [to_previous, to_next] = vcv_edges(e, node(2));
      metric.add(each, TargetMetric::of(-to_previous, -to_next));
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
    if (blend_.vcv > 0 || (any_edited(element) && !ignores_vcvs(role_of(roles_, e)))) {
      add_vcv_terms(e);
    } else {
      shapes_.terms.push_back(common_metric(blend_, first, e).normalized().term(weight_of(e)));
    }
    shapes_.offsets.push_back(static_cast<Index>(shapes_.terms.size()));
  }

  /// What a triangle's target has besides VCVs, over its edges at corner 0.
  TargetMetric common_metric(const TargetBlend& blend, const std::array<Index, 3>& first,
                             Index e) const {
    TargetMetric common;
    add_regular(common, blend, first, e);
    add_rest(common, first, e);
    return common;
  }

  /// One term for each corner with a VCV that counts.
  void add_vcv_terms(Index e) {
    const auto element = topology_.element(e);
    const auto counts = [&](Index node) {
      return !topology_.on_boundary(node) && (blend_.vcv > 0 || vcv_.edited(node));
    };
    const auto corners = std::count_if(element.begin(), element.end(), counts);
    if (corners == 0) {  // all of its nodes move on the boundary, where there are no VCVs
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

  /// A metric over the edges at corner 0, over those at corner k of the same triangle.
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
      const bool own = ignores_vcvs(role_of(roles_, e));
      const bool follows = !own && topology_.on_boundary(nodes[0]) && any_edited(element);
      const TargetBlend& blend = own ? blend_ : follows ? edited_blend_ : blend_at(nodes[0]);
      TargetMetric metric;
      add_regular(metric, blend, nodes, e);
      if (follows) {
        add_parallelogram(metric, e, k);
      } else if (blend.vcv > 0) {
        if (topology_.on_boundary(nodes[0])) {
          metric.add(blend.vcv, TargetMetric::of_angle(pi / 2));  // there is no VCV at the boundary
        } else {
          add_vcv(metric, e, nodes[0]);
        }
      }
      add_rest(metric, nodes, e);
      shapes_.cells.push_back(nodes);
      shapes_.terms.push_back(metric.normalized().term(weight_of(e) / count));
      shapes_.offsets.push_back(static_cast<Index>(shapes_.terms.size()));
    }
  }

  const VirtualControlVolumes& vcv_;
  const Topology& topology_;
  const NodeClasses* classes_;  // null: nothing slides
  TargetBlend blend_;
  TargetBlend edited_blend_;  // at nodes whose VCVs were edited
  const Coordinates* given_;
  std::span<const Vec3> normals_;  // of the elements of a surface mesh
  const ElementRoles* roles_;      // null: nothing is known of elements
  StretchField stretch_;           // where the blend has a share for it
  TargetShapes shapes_;
};

}  // namespace

TargetShapes TargetShapes::build(const VirtualControlVolumes& vcv, const TargetBlend& blend,
                                 const Coordinates* given, int threads,
                                 std::span<const Index> urgent, const NodeClasses* classes,
                                 std::span<const Vec3> normals, const ElementRoles* roles) {
  return Builder(vcv, blend, given, threads, urgent, classes, normals, roles).build();
}

}  // namespace winslow
