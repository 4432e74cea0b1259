#include "core/formulation/target_shapes.h"

#include "core/formulation/target_builder.h"
#include "core/mesh/polygon.h"
#include "core/quality/metric.h"

namespace winslow {

namespace {

/// Builds targets for the elements of plane and surface meshes.
class FaceTargets : TargetBuilder {
 public:
  FaceTargets(const VirtualControlVolumes& vcv, const TargetBlend& blend, const Coordinates* given,
              int threads, std::span<const Index> urgent, const NodeClasses* classes,
              std::span<const Vec3> normals, const ElementDetails& details)
      : TargetBuilder(vcv.topology(), blend, given, threads, urgent, classes, normals, details),
        vcv_(vcv),
        given_(given),
        normals_(normals) {
    shapes_.stretched = stretched();
    edited_blend_ = {.vcv = blend_.automatic + blend_.element + blend_.vcv + blend_.keep,
                     .rest = blend_.rest};
  }

  TargetShapes build() {
    if (keeps()) shapes_.without_shape = find_lost([&](Index e) { return has_shape(e); });
    for (Index e = 0; e < topology_.element_count(); ++e) add(e);
    return std::move(shapes_);
  }

  TargetsOfSome<2> build_some(std::span<const Index> elements, bool any_lost) {
    if (keeps() && any_lost) find_lost([&](Index e) { return has_shape(e); });
    TargetsOfSome<2> out;
    Index number = 0;
    for (Index e = 0; e < topology_.element_count(); ++e) {
      if (!std::ranges::binary_search(elements, e)) {
        number += count_cells(e);
        continue;
      }
      const std::size_t first = shapes_.cells.size();
      add(e);
      for (std::size_t k = first; k < shapes_.cells.size(); ++k) {
        out.cells.push_back(number++);
        out.elements.push_back(e);
      }
    }
    out.targets = std::move(shapes_);
    return out;
  }

 private:
  void add(Index e) {
    if (topology_.element_type(e) == ElementType::triangle) {
      add_triangle(e);
    } else {
      add_corners(e);
    }
  }
  /// The number of cells that add() adds.
  Index count_cells(Index e) const {
    const auto element = topology_.element(e);
    if (topology_.element_type(e) == ElementType::triangle) return movable(element) ? 1 : 0;
    return static_cast<Index>(std::ranges::count_if(
        topology_.shape(e).corner_triangles,
        [&](const auto& triangle) { return movable(by_nodes(triangle, element)); }));
  }
  static std::array<Index, 3> corner_nodes(std::span<const Index> element, std::size_t k) {
    const std::size_t n = element.size();
    return {element[k], element[(k + 1) % n], element[(k + n - 1) % n]};
  }
  static std::array<Index, 3> by_nodes(const std::array<Index, 3>& triangle,
                                       std::span<const Index> element) {
    return {element[at(triangle[0])], element[at(triangle[1])], element[at(triangle[2])]};
  }

  /// Whether no corner of an element is inverted in the mesh as given.
  bool has_shape(Index e) const {
    return std::ranges::all_of(topology_.shape(e).corner_triangles, [&](const auto& triangle) {
      return own_metric(by_nodes(triangle, topology_.element(e)), e).has_value();
    });
  }

  /// The corner of the regular element. That of a polygon at a flat corner is its own, if the blend
  /// refers to a mesh, or else a right angle.
  TargetMetric regular_corner(Index e, std::size_t triangle,
                              const std::array<Index, 3>& nodes) const {
    if (const auto known = regular_metric_of_face(topology_.shape(e), triangle)) return *known;
    const auto own = given_ ? own_metric(nodes, e) : std::nullopt;
    return own.value_or(TargetMetric::of_angle(pi / 2));
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

  /// Metric of a corner in the mesh as given, with the stretch of a wall under it; none if it is
  /// inverted.
  std::optional<TargetMetric> own_metric(const std::array<Index, 3>& nodes, Index e) const {
    const Vec3 first = place_of(*given_, nodes[0]);
    const Vec3 m1 = with_wall(e, place_of(*given_, nodes[1]) - first);
    const Vec3 m2 = with_wall(e, place_of(*given_, nodes[2]) - first);
    const Vec3 area = m1.cross(m2), normal = normals_.empty() ? Vec3::UnitZ() : normals_[at(e)];
    if (!(area.norm() > 0) || is_turned_over(area, normal)) return std::nullopt;
    return TargetMetric::of(m1, m2);
  }

  /// Adds the metrics of a corner of the regular element, and of one that keeps its stretch by the
  /// StretchField, times their shares.
  void add_regular(TargetMetric& metric, const TargetBlend& blend,
                   const std::array<Index, 3>& nodes, std::size_t corner, Index e) const {
    const TargetMetric regular = regular_corner(e, corner, nodes);
    metric.add(blend.element, regular);
    if (blend.automatic == 0) return;
    const auto own = own_metric(nodes, e);
    metric.add(blend.automatic, own ? automatic(e, corner, regular, *own) : regular);
  }

  TargetMetric automatic(Index e, std::size_t corner, const TargetMetric& regular,
                         const TargetMetric& own) const {
    // Cells around split ones, and those of a dual mesh, have no shape that is regular.
    if (topology_.element_type(e) == ElementType::polygon) return own;
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
    if (topology_.neighbours(node).size() == 2) {
      metric.add(blend_at(node).vcv, TargetMetric::of_angle(regular_angle(topology_.shape(e))));
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
      add_kept(e, first, TargetMetric::of_angle(pi / 3), 1);
    } else if (blend_.vcv > 0 || (any_edited(element) && heeds_vcvs(e))) {
      add_vcv_terms(e);
    } else {
      shapes_.terms.push_back(common_metric(blend_, first, e).normalized().term(weight_of(e)));
    }
    shapes_.end_cell();
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
  void add_kept(Index e, const std::array<Index, 3>& nodes, const TargetMetric& regular,
                double part) {
    const TargetMetric own = own_or(regular, nodes, e);
    append(shapes_, kept_terms(topology_.shape(e), regular, own, part * weight_of(e)));
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

  /// Adds the terms of the corners of a quadrilateral or a polygon.
  void add_corners(Index e) {
    const auto element = topology_.element(e);
    const ElementShape& shape = topology_.shape(e);
    const bool quadrilateral = shape.type == ElementType::quadrilateral;
    const auto triangles = shape.corner_triangles;
    live_.assign(triangles.size(), 0);
    int count = 0;
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      live_[k] = movable(by_nodes(triangles[k], element)) ? 1 : 0;
      count += live_[k];
    }
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      if (live_[k] == 0) continue;
      const auto nodes = by_nodes(triangles[k], element);
      if (keeps() && !spaced_by_vcvs(e)) {
        shapes_.cells.push_back(nodes);
        add_kept(e, nodes, regular_corner(e, k, nodes), 1.0 / count);
        shapes_.end_cell();
        continue;
      }
      const bool own = !heeds_vcvs(e);
      const bool follows =
          quadrilateral && !own && topology_.on_boundary(nodes[0]) && any_edited(element);
      const TargetBlend& blend = own ? blend_ : follows ? edited_blend_ : blend_at(nodes[0]);
      TargetMetric metric;
      add_regular(metric, blend, nodes, k, e);
      if (blend.keep > 0) metric.add(blend.keep, own_or(regular_corner(e, k, nodes), nodes, e));
      if (follows) {
        add_parallelogram(metric, e, k);
      } else if (blend.vcv > 0) {
        // Boundary nodes have no VCV, and flat corners no angle in one.
        if (topology_.on_boundary(nodes[0]) || k >= at(shape.real_corners)) {
          metric.add(blend.vcv, regular_corner(e, k, nodes));
        } else {
          add_vcv(metric, e, nodes[0]);
        }
      }
      add_rest(metric, nodes, e);
      shapes_.cells.push_back(nodes);
      shapes_.terms.push_back(
          metric.normalized().term((keeps() ? weight_beside_guards : 1) * weight_of(e) / count));
      if (keeps()) shapes_.inverse_limits.push_back(0);
      shapes_.end_cell();
    }
  }

  const VirtualControlVolumes& vcv_;
  TargetBlend edited_blend_;  // at nodes whose VCVs were edited
  const Coordinates* given_;
  std::span<const Vec3> normals_;  // of the elements of a surface mesh
  std::vector<int> live_;          // work memory: whether a corner has a node that moves
  TargetShapes shapes_;
};

}  // namespace

TargetShapes TargetShapes::build(const VirtualControlVolumes& vcv, const TargetBlend& blend,
                                 const Coordinates* given, int threads,
                                 std::span<const Index> urgent, const NodeClasses* classes,
                                 std::span<const Vec3> normals, const ElementDetails& details) {
  return FaceTargets(vcv, blend, given, threads, urgent, classes, normals, details).build();
}

TargetsOfSome<2> TargetShapes::build_some(std::span<const Index> elements,
                                          const VirtualControlVolumes& vcv,
                                          const TargetBlend& blend, const Coordinates* given,
                                          int threads, std::span<const Index> urgent,
                                          const NodeClasses* classes,
                                          const ElementDetails& details) {
  return FaceTargets(vcv, blend, given, threads, urgent, classes, {}, details)
      .build_some(elements, details.any_without_shape);
}

}  // namespace winslow
