#include "core/formulation/stretch_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "core/formulation/target_metric.h"
#include "core/formulation/volume_metric.h"
#include "core/mesh/corner_tetrahedra.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

constexpr double inverted = std::numeric_limits<double>::quiet_NaN();

double rising_step(double value, double low, double high) {
  const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

bool is_inverted(std::span<const Index> nodes, const PlanePoints& x) {
  const std::size_t n = nodes.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 a = x[nodes[k]], to_b = x[nodes[(k + 1) % n]] - a,
               to_c = x[nodes[(k + n - 1) % n]] - a;
    if (!(to_b.x() * to_c.y() - to_b.y() * to_c.x() > 0)) return true;
  }
  return false;
}

bool has_any(std::span<const Index> nodes, std::span<const Index> of_these) {
  return std::ranges::any_of(of_these, [&](Index node) {
    return std::find(nodes.begin(), nodes.end(), node) != nodes.end();
  });
}

/// s of StretchField; NaN of an inverted element.
double stretch_of(std::span<const Index> nodes, const PlanePoints& x) {
  if (is_inverted(nodes, x)) return inverted;
  if (nodes.size() == 3) {
    return 0.5 *
           stretch_between(TargetMetric::of_angle(pi / 3),
                           TargetMetric::of(x[nodes[1]] - x[nodes[0]], x[nodes[2]] - x[nodes[0]]));
  }
  const Vec2 p = x[nodes[1]] - x[nodes[0]] + x[nodes[2]] - x[nodes[3]];
  const Vec2 q = x[nodes[3]] - x[nodes[0]] + x[nodes[2]] - x[nodes[1]];
  return 0.5 * stretch_between(TargetMetric::of_angle(pi / 2), TargetMetric::of(p, q));
}

/// The same of a volume element; NaN of one that is flat, too.
double stretch_of(ElementType type, std::span<const Index> nodes, const SpacePoints& x) {
  double sum = 0;
  const auto corners = corner_tetrahedra(type);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto corner = by_nodes(corners[k], nodes);
    Edges3 edges;
    for (int i = 0; i < 3; ++i) edges.col(i) = x[corner[at(i + 1)]] - x[corner[0]];
    if (!has_metric(edges)) return inverted;
    sum += stretch_between(regular_metrics(type)[k], volume_metric(edges));
  }
  return 0.5 * sum / static_cast<double>(corners.size());
}

class Field {
 public:
  Field(const Topology& topology, const Coordinates& given, int threads)
      : topology_(topology), threads_(threads), stretch_(at(topology.element_count())) {
    if (topology.cell_dimension() == 3) {
      const SpacePoints x(given);
      for_each_element([&](Index e) {
        stretch_[at(e)] = stretch_of(topology_.element_type(e), topology_.element(e), x);
      });
      return;
    }
    const PlanePoints x(given);
    for_each_element([&](Index e) { stretch_[at(e)] = stretch_of(topology_.element(e), x); });
  }

  StretchField build() const {
    StretchField field;
    field.share.assign(stretch_.size(), 0.0);
    field.longest.assign(stretch_.size(), 0.0);
    field.weight.assign(stretch_.size(), 1.0);
    if (tangled()) return field;
    std::vector<double>& around = field.longest;
    for_each_element([&](Index e) {
      around[at(e)] = stretch_around(e);
      field.share[at(e)] = share_by_neighbours(e, around[at(e)]);
    });
    constexpr int rows = 3;
    for (int row = 0; row < rows; ++row) spread(field.share);
    for_each_element([&](Index e) {
      if (std::isnan(around[at(e)])) {
        field.share[at(e)] = field.longest[at(e)] = 0;
        return;
      }
      hold_wall(e, field);
      field.longest[at(e)] = around[at(e)] + tolerance(e, around[at(e)]);
    });
    field.stretched = stretched_part(field.share);
    return field;
  }

 private:
  template <class Visit>
  void for_each_element(Visit&& visit) const {
    parallel_for(threads_, topology_.element_count(), [&](Index begin, Index end) {
      for (Index e = begin; e < end; ++e) visit(e);
    });
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
    return is_simplex(e) ? rising_step(around, 0.45, 0.8) : 1;
  }

  /// Of the corners of stretched quadrilaterals some are sharp by the shape of the boundary, as at
  /// a trailing edge, and far more stretched than the element.
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

  double stretched_part(const std::vector<double>& share) const {
    constexpr double twice_as_long = 0.35;
    std::size_t count = 0;
    for (std::size_t e = 0; e < share.size(); ++e)
      count += share[e] > 0.5 && stretch_[e] > twice_as_long ? 1 : 0;
    return share.empty() ? 0 : static_cast<double>(count) / static_cast<double>(share.size());
  }

  /// Median of the stretch of the elements of this type around, the element itself included; NaN if
  /// one of those around, of whatever type, is inverted.
  double stretch_around(Index e) const {
    std::vector<double> found;
    const auto nodes = topology_.element(e);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      for (const Index other : topology_.star(nodes[k])) {
        if (std::isnan(stretch_[at(other)])) return inverted;
        // An element that shares several nodes is found at the first of them.
        if (topology_.element_type(other) == topology_.element_type(e) &&
            !has_any(topology_.element(other), nodes.first(k)))
          found.push_back(stretch_[at(other)]);
      }
    }
    const auto middle = found.begin() + static_cast<std::ptrdiff_t>((found.size() - 1) / 2);
    std::nth_element(found.begin(), middle, found.end());
    return *middle;
  }

  /// One more row: each share rises to the mean of the shares around, or stays.
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
      double mean = 0;
      const auto nodes = topology_.element(e);
      for (const Index node : nodes) mean += at_node[at(node)];
      mean /= static_cast<double>(nodes.size());
      share[at(e)] = std::max(share[at(e)], mean);
    });
  }

  const Topology& topology_;
  int threads_;
  std::vector<double> stretch_;  // #elements
};

}  // namespace

StretchField stretch_field(const Topology& topology, const Coordinates& given, int threads) {
  return Field(topology, given, threads).build();
}

}  // namespace winslow
