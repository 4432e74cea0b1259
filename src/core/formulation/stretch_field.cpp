#include "core/formulation/stretch_field.h"

#include <utility>

#include "core/formulation/box_field.h"
#include "core/formulation/target_metric.h"
#include "core/mesh/element_type.h"
#include "core/mesh/node_stars.h"
#include "core/mesh/polyhedron.h"
#include "core/parallel/parallel_for.h"
#include "core/quality/metric.h"

namespace winslow {

namespace {

constexpr double inverted = std::numeric_limits<double>::quiet_NaN();
constexpr double unknown = -1;           // a stretch is not negative
constexpr double stretched_from = 0.45;  // median of s above which simplices keep shares
constexpr double twice_as_long = 0.35;   // s

double rising_step(double value, double low, double high) {
  const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Whether a face is inverted; normal: of the side from which it is viewed.
bool is_inverted(std::span<const Index> nodes, const Coordinates& x, const Vec3& normal) {
  const std::size_t n = nodes.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 a = place_of(x, nodes[k]), to_b = place_of(x, nodes[(k + 1) % n]) - a,
               to_c = place_of(x, nodes[(k + n - 1) % n]) - a;
    const Vec3 area = to_b.cross(to_c);
    if (!(area.norm() > 0) || is_turned_over(area, normal)) return true;
  }
  return false;
}

/// s of StretchField for a face; NaN if it is inverted.
double face_stretch(std::span<const Index> nodes, const Coordinates& coordinates,
                    const Vec3& normal) {
  if (is_inverted(nodes, coordinates, normal)) return inverted;
  const auto x = [&](std::size_t k) { return place_of(coordinates, nodes[k]); };
  if (nodes.size() == 3) {
    const Vec3 u = x(1) - x(0), v = x(2) - x(0);
    return 0.5 * stretch_between(TargetMetric::of_angle(pi / 3), TargetMetric::of(u, v));
  }
  const Vec3 p = x(1) - x(0) + x(2) - x(3), q = x(3) - x(0) + x(2) - x(1);
  return 0.5 * stretch_between(TargetMetric::of_angle(pi / 2), TargetMetric::of(p, q));
}

/// The same for a polygon: the mean over its corners.
double polygon_stretch(const ElementShape& shape, std::span<const Index> nodes,
                       const Coordinates& x) {
  double sum = 0;
  int count = 0;
  for (std::size_t k = 0; k < shape.corner_triangles.size(); ++k) {
    const auto [a, b, c] = shape.corner_triangles[k];
    const Vec2 p = x.xy(nodes[at(a)]), u = x.xy(nodes[at(b)]) - p, v = x.xy(nodes[at(c)]) - p;
    if (!(cross(u, v) > 0)) return inverted;
    const auto regular = regular_metric_of_face(shape, k);
    if (!regular) continue;
    sum += 0.5 * stretch_between(*regular, TargetMetric::of(u, v));
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

/// The edges of a corner from its first node.
Edges3 edges_of(const std::array<Index, 4>& corner, const SpacePoints& x) {
  Edges3 edges;
  for (int i = 0; i < 3; ++i) edges.col(i) = x[corner[at(i + 1)]] - x[corner[0]];
  return edges;
}

/// The same for a volume element; NaN also if it is flat.
double cell_stretch(const ElementShape& shape, std::span<const Index> nodes, const SpacePoints& x) {
  double sum = 0;
  const auto corners = shape.corner_tetrahedra;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Edges3 edges = edges_of(by_nodes(corners[k], nodes), x);
    if (!has_metric(edges)) return inverted;
    const Eigen::Matrix3d own = volume_metric(edges);
    sum += stretch_between(regular_metric(shape, k).value_or(own), own);
  }
  return corners.empty() ? 0 : 0.5 * sum / static_cast<double>(corners.size());
}

/// The elements around nodes. Those of a volume mesh are counted along a curve, so that what is
/// stored for neighbours lies in the same caches.
class Surroundings {
 public:
  Surroundings(const Topology& topology, const Coordinates& x) : topology_(topology) {
    if (topology.kind() != MeshKind::volume) return;
    const SpacePoints points(x);
    Box<3> box = Box<3>::empty();
    for (Index node = 0; node < topology.node_count(); ++node) box.add(points[node]);
    order_.emplace(points, topology.node_count(), box, topology.elements());
    stars_ = star_rows(order_->corners, topology.node_count());
  }

  /// The element of the mesh at a place of the order.
  Index element(Index place) const { return order_ ? order_->elements[at(place)] : place; }
  /// Nodes of the element at a place, by numbers of the order.
  std::span<const Index> nodes(Index place) const {
    return order_ ? order_->corners[place] : topology_.element(place);
  }
  /// Places of the elements around a node of the order.
  std::span<const Index> star(Index node) const {
    return order_ ? stars_[node] : topology_.star(node);
  }

 private:
  const Topology& topology_;
  std::optional<CurveOrder> order_;  // of volume meshes
  CompressedRows stars_;
};

/// Visits the elements around single elements.
class Neighbourhood {
 public:
  std::vector<double> found;  ///< work memory of visits

  Neighbourhood(const Surroundings& around, std::size_t elements)
      : around_(around), seen_from_(elements, -1) {}

  /// Calls visit(place) for each element with a node of the element at a place, that one included.
  template <typename Visit>
  void for_each(Index place, const Visit& visit) {
    for (const Index node : around_.nodes(place)) {
      for (const Index other : around_.star(node))
        if (std::exchange(seen_from_[at(other)], place) != place) visit(other);
    }
  }

 private:
  const Surroundings& around_;
  std::vector<Index> seen_from_;  // #elements: the place around which each was visited last
};

class Field {
 public:
  Field(const Topology& topology, const Coordinates& given, int threads,
        std::span<const Vec3> normals)
      : topology_(topology),
        given_(given),
        threads_(threads),
        around_(topology, given),
        stretch_(at(topology.element_count())),
        exact_(stretch_.size(), 1) {
    for (Index e = 1; e < topology.element_count(); ++e)
      is_of_one_type_ &= topology.element_type(e) == topology.element_type(0);
    for_each_element([&](Index e) {
      const auto nodes = topology_.element(e);
      const Vec3 normal = normals.empty() ? Vec3::UnitZ() : normals[at(e)];
      if (topology_.element_type(e) == ElementType::polygon)
        stretch_[at(e)] = polygon_stretch(topology_.shape(e), nodes, given);
      else if (topology_.cell_dimension() == 2)
        stretch_[at(e)] = face_stretch(nodes, given, normal);
      else
        set_cell_stretch(e);
    });
  }

  StretchField build() {
    StretchField field;
    field.share.assign(stretch_.size(), 0.0);
    field.longest.assign(stretch_.size(), 0.0);
    field.weight.assign(stretch_.size(), 1.0);
    field.stiffness.assign(stretch_.size(), 1.0);
    if (tangled()) return field;
    std::vector<double>& around = field.longest;
    find_medians(around);
    for_each_element([&](Index e) { field.share[at(e)] = share_by_neighbours(e, around[at(e)]); });
    straighten_rough_grids(field);
    constexpr int rows = 3;
    for (int row = 0; row < rows; ++row) spread(field.share);
    for_each_element([&](Index e) { hold_wall(e, field); });
    set_medians(around,
                [&](Index e) { return field.share[at(e)] > 0 && around[at(e)] == unknown; });
    for_each_element([&](Index e) { finish(e, field); });
    field.stretched = stretched_part(field);
    return field;
  }

 private:
  template <class Visit>
  void for_each_element(Visit&& visit) const {
    parallel_for(threads_, topology_.element_count(), [&](Index begin, Index end) {
      for (Index e = begin; e < end; ++e) visit(e);
    });
  }

  /// The same with the place of each element in the order, and with a Neighbourhood, which is as
  /// large as the mesh: therefore uses few blocks of elements.
  template <class Visit>
  void for_each_neighbourhood(Visit&& visit) const {
    const auto run = [&](Index begin, Index end) {
      Neighbourhood near(around_, stretch_.size());
      for (Index place = begin; place < end; ++place) visit(place, near);
    };
    const Index n = topology_.element_count();
    parallel_for(threads_, n, run, few_blocks(n));
  }

  /// The stretch of a volume element. That of a tetrahedron is found quickly unless it is near a
  /// limit: then only limits can be compared with it, until make_exact().
  void set_cell_stretch(Index e) {
    const ElementType type = topology_.element_type(e);
    const SpacePoints x(given_);
    double& s = stretch_[at(e)];
    if (type == ElementType::tetrahedron) {
      const Edges3 edges =
          edges_of(by_nodes(corner_tetrahedra(type).front(), topology_.element(e)), x);
      s = has_metric(edges)
              ? 0.5 * quick_stretch(regular_factors(type).front(), volume_metric(edges))
              : inverted;
      const auto decides = [&](double limit) { return !(std::abs(s - limit) <= stretch_error); };
      exact_[at(e)] = std::isnan(s) ? 1 : 0;
      if (std::isnan(s) || (decides(stretched_from) && decides(twice_as_long))) return;
    }
    make_exact(e);
  }
  void make_exact(Index e) {
    stretch_[at(e)] = cell_stretch(topology_.shape(e), topology_.element(e), SpacePoints(given_));
    exact_[at(e)] = 1;
  }

  /// Finds for each element the median stretch of the surrounding elements of the same type,
  /// including the element itself: NaN if a surrounding element of any type is inverted; of a
  /// simplex `unknown` if the median is at most `stretched_from`, which is faster to detect, and
  /// true of most elements of most meshes.
  void find_medians(std::vector<double>& around) {
    constexpr double to_do = -2;
    const std::vector<Index> stretched_at = count_stretched();
    const std::vector<unsigned char> sizes = sizes_by_place();
    const bool all_exact = std::ranges::find(exact_, 0) == exact_.end();
    for_each_neighbourhood([&](Index place, Neighbourhood& near) {
      const Index e = around_.element(place);
      double& median = around[at(e)];
      if (!may_be_stretched(e, stretched_at))
        median = unknown;
      else if (all_exact)
        median = median_around(place, near, is_simplex(e) ? stretched_from : -1);
      else
        median = is_simplex(e) ? compare_median(place, near, sizes, to_do) : to_do;
    });
    set_medians(around, [&](Index e) { return around[at(e)] == to_do; });
  }

  /// For each place whether the stretch is above `stretched_from`, or NaN: what compare_median()
  /// counts, packed so that it stays in the caches.
  enum Size : unsigned char { low, high, lost };
  std::vector<unsigned char> sizes_by_place() const {
    std::vector<unsigned char> sizes(stretch_.size());
    for_each_element([&](Index place) {
      const double s = stretch_[at(around_.element(place))];
      sizes[at(place)] = std::isnan(s) ? lost : s > stretched_from ? high : low;
    });
    return sizes;
  }

  /// NaN and `unknown` as find_medians(), and `larger` for a larger median.
  double compare_median(Index place, Neighbourhood& near, std::span<const unsigned char> sizes,
                        double larger) const {
    const ElementType type = topology_.element_type(around_.element(place));
    std::size_t above = 0, all = 0;
    bool spoilt = false;
    near.for_each(place, [&](Index other) {
      spoilt |= sizes[at(other)] == lost;
      if (!is_of_one_type_ && topology_.element_type(around_.element(other)) != type) return;
      ++all;
      above += sizes[at(other)] == high ? 1 : 0;
    });
    if (spoilt) return inverted;
    return 2 * above < all ? unknown : larger;
  }

  /// Sets the medians of the elements for which wanted(e) is true.
  template <typename Wanted>
  void set_medians(std::vector<double>& around, const Wanted& wanted) {
    std::vector<unsigned char> beside(at(topology_.node_count()), 0);
    bool any = false;
    for (Index e = 0; e < topology_.element_count(); ++e) {
      if (!wanted(e)) continue;
      any = true;
      for (const Index node : topology_.element(e)) beside[at(node)] = 1;
    }
    if (!any) return;
    for_each_element([&](Index e) {
      const auto is_beside = [&](Index node) { return beside[at(node)] != 0; };
      if (exact_[at(e)] == 0 && std::ranges::any_of(topology_.element(e), is_beside)) make_exact(e);
    });
    for_each_neighbourhood([&](Index place, Neighbourhood& near) {
      const Index e = around_.element(place);
      if (wanted(e)) around[at(e)] = median_around(place, near);
    });
  }

  /// The median around an element, of which all stretches are exact, as find_medians(); `unknown`
  /// if it is at most `least`.
  double median_around(Index place, Neighbourhood& near, double least = -1) const {
    const ElementType type = topology_.element_type(around_.element(place));
    std::vector<double>& found = near.found;
    found.clear();
    std::size_t above = 0;
    bool spoilt = false;
    near.for_each(place, [&](Index other) {
      const Index e = around_.element(other);
      spoilt |= std::isnan(stretch_[at(e)]);
      if (topology_.element_type(e) != type) return;
      found.push_back(stretch_[at(e)]);
      above += found.back() > least ? 1 : 0;
    });
    if (spoilt) return inverted;
    if (2 * above < found.size()) return unknown;
    const auto middle = found.begin() + static_cast<std::ptrdiff_t>((found.size() - 1) / 2);
    std::nth_element(found.begin(), middle, found.end());
    return *middle;
  }

  bool is_triangle(Index e) const { return topology_.element_type(e) == ElementType::triangle; }
  bool is_simplex(Index e) const {
    return is_triangle(e) || topology_.element_type(e) == ElementType::tetrahedron;
  }

  bool tangled() const {
    constexpr double most = 0.05;
    const auto lost =
        std::count_if(stretch_.begin(), stretch_.end(), [](double s) { return std::isnan(s); });
    return static_cast<double>(lost) > most * static_cast<double>(stretch_.size());
  }

  double share_by_neighbours(Index e, double around) const {
    if (std::isnan(around)) return 0;
    return is_simplex(e) ? rising_step(around, stretched_from, 0.8) : 1;
  }

  /// Reduces the shares of rough quadrilaterals, hexahedra and prisms, and sets their sides.
  void straighten_rough_grids(StretchField& field) const {
    constexpr double smooth = 0.025, rough = 0.05;
    bool any = false;
    for (Index e = 0; e < topology_.element_count() && !any; ++e)
      any = has_box(topology_.element_type(e));
    if (!any) return;
    BoxField boxes = box_field(topology_, given_, smooth, threads_);
    if (boxes.sides.empty()) return;
    for_each_element([&](Index e) {
      const double kept = 1 - rising_step(boxes.roughness[at(e)], smooth, rough);
      Vec3& sides = boxes.sides[at(e)];
      // Where nothing is straightened, slivers become less stretched, as if there were no boxes.
      if (kept == 1 || std::isnan(field.longest[at(e)])) {
        sides.setZero();
      } else {
        field.share[at(e)] *= kept;
        sides *= rising_step(box_stretch(sides), 0.2, 0.45);
      }
    });
    field.sides = std::move(boxes.sides);
  }

  /// s of a box.
  static double box_stretch(const Vec3& sides) {
    return 0.5 * (sides.maxCoeff() - sides.minCoeff());
  }

  /// #nodes: number of elements at the node that are sufficiently stretched, or inverted.
  std::vector<Index> count_stretched() const {
    std::vector<Index> count(at(topology_.node_count()), 0);
    for (Index e = 0; e < topology_.element_count(); ++e) {
      if (stretch_[at(e)] <= stretched_from) continue;
      for (const Index node : topology_.element(e)) ++count[at(node)];
    }
    return count;
  }

  /// Returns false only if the median around is certainly too small to matter. Computing the median
  /// is slow, and most meshes need it for few elements. stretched_at: see count_stretched.
  bool may_be_stretched(Index e, std::span<const Index> stretched_at) const {
    if (!is_simplex(e)) return true;
    Index most = 0, around = 1;  // bounds of the stretched elements around and of all of them
    for (const Index node : topology_.element(e)) {
      most += stretched_at[at(node)];
      if (is_of_one_type_)
        around = std::max(around, static_cast<Index>(topology_.star(node).size()));
    }
    return 2 * most >= around;
  }

  /// Completes the field from the spread shares and the surrounding stretch, which field.longest
  /// holds.
  void finish(Index e, StretchField& field) const {
    double& share = field.share[at(e)];
    double& longest = field.longest[at(e)];
    if (std::isnan(longest)) {
      share = longest = 0;
      field.weight[at(e)] = 1;
    } else {
      if (longest != unknown)
        field.stiffness[at(e)] =
            stiffness(kept_stretch(e, field, std::min(stretch_[at(e)], longest)));
      longest = longest == unknown ? 0 : longest + tolerance(e, longest);
    }
    if (!is_of_one_type_) field.stiffness[at(e)] *= weight_of_type(topology_.shape(e));
  }

  /// s of a target of an element whose own s, perhaps limited, is given.
  double kept_stretch(Index e, const StretchField& field, double own) const {
    const double share = field.share[at(e)];
    const double of_box = field.sides.empty() ? 0 : box_stretch(field.sides[at(e)]);
    return share * own + (1 - share) * of_box;
  }

  /// If there is less room than before, stretched elements should keep their height and others give
  /// way. A factor above some hundreds has no benefit, and along wakes it costs iterations.
  static double stiffness(double kept_stretch) {
    constexpr double from_aspect = 4, most = 300;
    return std::clamp(std::exp(2 * kept_stretch) / from_aspect, 1.0, most);
  }

  /// Of one element among others. That of prisms and hexahedra is the volume of the regular
  /// element, in tetrahedra: where many small cells share the room with few large ones, both give
  /// way alike.
  static double weight_of_type(const ElementShape& shape) {
    switch (shape.like) {
      case ElementType::pyramid:
        return 30;
      case ElementType::prism:
        return 3.7;
      case ElementType::hexahedron:
        return 8.5;
      case ElementType::polyhedron:
        return regular_volume(shape);
      default:
        return 1;
    }
  }

  /// Some corners of stretched quadrilaterals are sharp because of the boundary's shape, e.g. at a
  /// trailing edge, and are far more stretched than the element.
  double tolerance(Index e, double around) const {
    if (is_simplex(e)) return 0.35;
    return 0.7 + 1.8 * rising_step(around, 0.45, 0.8);
  }

  /// A well-shaped triangle at the boundary keeps its shape, and with it its height.
  void hold_wall(Index e, StretchField& field) const {
    const auto nodes = topology_.element(e);
    if (!is_triangle(e) || std::none_of(nodes.begin(), nodes.end(),
                                        [&](Index node) { return topology_.on_boundary(node); })) {
      return;
    }
    constexpr double more = 1;
    const double held = 1 - rising_step(stretch_[at(e)], 0, 0.2);
    field.share[at(e)] = std::max(field.share[at(e)], held);
    field.weight[at(e)] = 1 + more * held;
  }

  double stretched_part(const StretchField& field) const {
    std::size_t count = 0;
    for (Index e = 0; e < topology_.element_count(); ++e) {
      const double own = stretch_[at(e)];
      count += own > twice_as_long && kept_stretch(e, field, own) > 0.5 * own ? 1 : 0;
    }
    return stretch_.empty() ? 0 : static_cast<double>(count) / static_cast<double>(stretch_.size());
  }

  /// Spreads the shares by one row: each share of a simplex rises to the mean of the surrounding
  /// shares, or stays. Those of other elements are smooth.
  void spread(std::vector<double>& share) const {
    std::vector<double> at_node(at(topology_.node_count()), 0.0);
    parallel_for(threads_, topology_.node_count(), [&](Index begin, Index end) {
      for (Index node = begin; node < end; ++node) {
        const auto star = topology_.star(node);
        for (const Index e : star) at_node[at(node)] += share[at(e)];
        if (!star.empty()) at_node[at(node)] /= static_cast<double>(star.size());
      }
    });
    for_each_element([&](Index e) {
      if (!is_simplex(e)) return;
      double mean = 0;
      const auto nodes = topology_.element(e);
      for (const Index node : nodes) mean += at_node[at(node)];
      mean /= static_cast<double>(nodes.size());
      share[at(e)] = std::max(share[at(e)], mean);
    });
  }

  const Topology& topology_;
  const Coordinates& given_;
  int threads_;
  Surroundings around_;
  bool is_of_one_type_ = true;
  std::vector<double> stretch_;       // #elements
  std::vector<unsigned char> exact_;  // #elements: whether the stretch is more than a comparison
};

}  // namespace

StretchField stretch_field(const Topology& topology, const Coordinates& given, int threads,
                           std::span<const Vec3> normals) {
  return Field(topology, given, threads, normals).build();
}

}  // namespace winslow
