#include "core/formulation/box_field.h"

#include "core/formulation/target_metric.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

/// Numbers of pairs of axes: pair k is that of axes k and k + 1 (cyclic).
struct AxisShape {
  std::array<double, 3> ratio{};  ///< logarithm of length k over length k + 1
  std::array<double, 3> skew{};   ///< right angle minus the angle between the axes, in radians

  bool is_finite() const {
    const auto good = [](double value) { return std::isfinite(value); };
    return std::ranges::all_of(ratio, good) && std::ranges::all_of(skew, good);
  }
};

/// A neighbour of the same type: axis k of the element is its axis axis[k], in the same direction
/// (sign 1) or in the opposite one (-1).
struct Neighbour {
  Index element;
  int along;  ///< axis of the element that leads to it; of a prism 2 in its column, else 0
  std::array<signed char, 3> axis{0, 1, 2}, sign{1, 1, 1};
};

/// Whether a corner lies at the end of each axis.
std::array<bool, 3> ends(ElementType type, Index corner) {
  const auto& place = shape_of(type).corners[at(corner)];
  return {place[0] > 0.5, place[1] > 0.5, place[2] > 0.5};
}

Index corner_of(std::span<const Index> element, Index node) {
  return static_cast<Index>(std::ranges::find(element, node) - element.begin());
}

/// Axes of a quadrilateral or hexahedron at one of its faces: one along each edge at the first node
/// of the face, then the one that leads out through the face; with their directions.
struct FaceAxes {
  std::array<int, 3> axis{}, sign{};

  FaceAxes(ElementType type, std::span<const Index> element, const Face& face) {
    const auto dimension = at(dimension_of(type));
    const auto first = ends(type, corner_of(element, face[0]));
    int through = static_cast<int>(dimension * (dimension - 1) / 2);
    for (std::size_t k = 0; k + 1 < dimension; ++k) {
      const auto other = ends(type, corner_of(element, face[k == 0 ? 1 : 3]));
      for (std::size_t i = 0; i < dimension; ++i) {
        if (first[i] == other[i]) continue;
        axis[k] = static_cast<int>(i);
        sign[k] = other[i] ? 1 : -1;
      }
      through -= axis[k];
    }
    axis[dimension - 1] = through;
    sign[dimension - 1] = first[at(through)] ? 1 : -1;
  }
};

Neighbour neighbour_across(const Topology& topology, Index e, Index other, const Face& face) {
  const ElementType type = topology.element_type(e);
  Neighbour out{.element = other, .along = face.size() == 3 ? 2 : 0};
  if (type == ElementType::prism) return out;
  const FaceAxes mine(type, topology.element(e), face), its(type, topology.element(other), face);
  const auto dimension = at(dimension_of(type));
  out.along = mine.axis[dimension - 1];
  for (std::size_t k = 0; k < dimension; ++k) {
    const int alike = k + 1 == dimension ? -1 : 1;  // what leads out here leads in there
    const std::size_t axis = at(mine.axis[k]);
    out.axis[axis] = static_cast<signed char>(its.axis[k]);
    out.sign[axis] = static_cast<signed char>(alike * mine.sign[k] * its.sign[k]);
  }
  return out;
}

AxisShape seen_from(const Neighbour& neighbour, const AxisShape& shape) {
  AxisShape out;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const auto a = at(neighbour.axis[k]), b = at(neighbour.axis[next]);
    const bool forward = b == (a + 1) % 3;
    out.ratio[k] = forward ? shape.ratio[a] : -shape.ratio[b];
    out.skew[k] = neighbour.sign[k] * neighbour.sign[next] * shape.skew[forward ? a : b];
  }
  return out;
}

/// Of an even number: the one nearest to the first value of those between the two in the middle.
double median(std::span<double> values) {
  const double first = values.front();
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  if (values.size() % 2 == 1) return values[half];
  return std::clamp(first, values[half - 1], values[half]);
}

double mean(std::span<double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

class Boxes {
 public:
  Boxes(const Topology& topology, const Coordinates& given, int threads)
      : topology_(topology), given_(given), threads_(threads) {}

  BoxField build(double smooth) {
    BoxField field;
    const auto count = at(topology_.element_count());
    field.roughness.assign(count, 0.0);
    find_neighbours();
    std::vector<AxisShape> own(count);
    for_each_box([&](Index e) { own[at(e)] = shape(e); });
    std::vector<AxisShape> shapes = around(own, median, Lines::enclosed);
    const std::vector<AxisShape> by_all = around(own, median, Lines::all);
    std::vector<double> single(count, 0.0);
    for_each_box([&](Index e) {
      const AxisShape& mine = own[at(e)];
      const double departs =
          std::min(difference(mine, shapes[at(e)]), difference(mine, by_all[at(e)]));
      single[at(e)] = std::max(departs, change_in_column(e));
    });
    constexpr int rows = 3;
    constexpr double own_part = 0.25;
    field.roughness = single;
    for (int row = 0; row < rows; ++row) spread(field.roughness);
    for (std::size_t e = 0; e < count; ++e)
      field.roughness[e] = std::max(field.roughness[e], own_part * single[e]);
    if (std::ranges::all_of(field.roughness, [&](double r) { return r <= smooth; })) return field;
    shapes = around(shapes, median, Lines::enclosed);
    constexpr int averages = 4;
    for (int k = 0; k < averages; ++k) shapes = around(shapes, mean, Lines::enclosed);
    field.sides.assign(count, Vec3::Zero());
    for_each_box([&](Index e) {
      const auto& ratio = shapes[at(e)].ratio;
      field.sides[at(e)] =
          dimension(e) == 2
              ? Vec3(0.5 * ratio[0], -0.5 * ratio[0], 0)
              : Vec3(ratio[0] - ratio[2], ratio[1] - ratio[0], ratio[2] - ratio[1]).eval() / 3;
    });
    return field;
  }

 private:
  template <class Visit>
  void for_each_box(Visit&& visit) const {
    parallel_for(threads_, topology_.element_count(), [&](Index begin, Index end) {
      for (Index e = begin; e < end; ++e)
        if (has_box(topology_.element_type(e))) visit(e);
    });
  }
  int dimension(Index e) const { return dimension_of(topology_.element_type(e)); }

  template <class Visit>
  void for_each_pair(Visit&& visit) const {
    for (Index f = 0; f < topology_.face_count(); ++f) {
      const Topology::SharedFace face = topology_.face(f);
      const auto [a, b] = face.elements;
      if (b < 0 || topology_.element_type(a) != topology_.element_type(b)) continue;
      if (has_box(topology_.element_type(a))) visit(a, b, face.nodes);
    }
  }

  void find_neighbours() {
    offsets_.assign(at(topology_.element_count()) + 1, 0);
    for_each_pair([&](Index a, Index b, const Face&) {
      ++offsets_[at(a) + 1];
      ++offsets_[at(b) + 1];
    });
    for (std::size_t e = 1; e < offsets_.size(); ++e) offsets_[e] += offsets_[e - 1];
    neighbours_.resize(at(offsets_.back()));
    std::vector<Index> next(offsets_.begin(), offsets_.end() - 1);
    for_each_pair([&](Index a, Index b, const Face& face) {
      neighbours_[at(next[at(a)]++)] = neighbour_across(topology_, a, b, face);
      neighbours_[at(next[at(b)]++)] = neighbour_across(topology_, b, a, face);
    });
  }
  std::span<const Neighbour> neighbours(Index e) const {
    return std::span(neighbours_)
        .subspan(at(offsets_[at(e)]), at(offsets_[at(e) + 1] - offsets_[at(e)]));
  }

  /// Mean edges along the axes, times a number; of a prism that along its height alone.
  Edges3 mean_edges(Index e) const {
    const auto nodes = topology_.element(e);
    const ElementType type = topology_.element_type(e);
    Edges3 edges = Edges3::Zero();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const auto end = ends(type, static_cast<Index>(k));
      for (int i = 0; i < dimension(e); ++i)
        edges.col(i) += (end[at(i)] ? 1.0 : -1.0) * place_of(given_, nodes[k]);
    }
    return edges;
  }

  /// The triangle halfway up a prism.
  std::array<Vec3, 3> middle(std::span<const Index> prism) const {
    std::array<Vec3, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k)
      triangle[k] = 0.5 * (place_of(given_, prism[k]) + place_of(given_, prism[k + 3]));
    return triangle;
  }

  AxisShape prism_shape(Index e) const {
    const auto nodes = topology_.element(e);
    const auto triangle = middle(nodes);
    double side = 0, height = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      side += std::log((triangle[(k + 1) % 3] - triangle[k]).norm()) / 3;
      height += (place_of(given_, nodes[k + 3]) - place_of(given_, nodes[k])).norm() / 3;
    }
    AxisShape out;
    out.ratio = {0, side - std::log(height), std::log(height) - side};
    return out;
  }

  /// That of a cube where edges have no length.
  AxisShape shape(Index e) const {
    AxisShape out;
    if (topology_.element_type(e) == ElementType::prism) {
      out = prism_shape(e);
    } else {
      const Edges3 edges = mean_edges(e);
      for (int k = 0; k < (dimension(e) == 2 ? 1 : 3); ++k) {
        const Vec3 a = edges.col(k), b = edges.col((k + 1) % 3);
        out.ratio[at(k)] = std::log(a.norm() / b.norm());
        out.skew[at(k)] = std::asin(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0));
      }
    }
    return out.is_finite() ? out : AxisShape();
  }

  /// Mean distance between the triangle of a prism and those of the prisms on it; 0 of others.
  double change_in_column(Index e) const {
    if (topology_.element_type(e) != ElementType::prism) return 0;
    const auto nodes = topology_.element(e);
    const auto triangle = middle(nodes);
    double sum = 0, count = 0;
    for (const Neighbour& neighbour : neighbours(e)) {
      if (neighbour.along != 2) continue;
      const auto its_nodes = topology_.element(neighbour.element);
      const auto its = middle(its_nodes);
      std::array<Vec3, 3> same;  // the corners of its triangle over those of this one
      for (std::size_t k = 0; k < 3; ++k) {
        const bool below = std::ranges::find(its_nodes, nodes[k]) != its_nodes.end();
        same[k] = its[at(corner_of(its_nodes, nodes[below ? k : k + 3]) % 3)];
      }
      const auto metric = [](const std::array<Vec3, 3>& t) {
        return TargetMetric::of<3>(t[1] - t[0], t[2] - t[0]);
      };
      const double change = 0.5 * stretch_between(metric(triangle), metric(same));
      if (std::isfinite(change)) sum += change;
      ++count;
    }
    return count > 0 ? sum / count : 0;
  }

  /// Whether an element has neighbours on all sides along an axis. Beside a boundary the others
  /// would be those on one side of a graded line.
  bool is_enclosed(Index e, int along) const {
    const bool around_prism = topology_.element_type(e) == ElementType::prism && along == 0;
    const auto count = std::ranges::count(neighbours(e), along, &Neighbour::along);
    return count == (around_prism ? 3 : 2);
  }

  /// Neighbours to heed: all of them, or those along the axes in which an element is enclosed.
  enum class Lines { all, enclosed };

  /// Combines each number of an element with those of its neighbours.
  template <class Combine>
  std::vector<AxisShape> around(const std::vector<AxisShape>& shapes, Combine&& combine,
                                Lines lines) const {
    constexpr std::size_t most = 7;
    std::vector<AxisShape> out(shapes.size());
    for_each_box([&](Index e) {
      std::array<AxisShape, most> seen;
      std::size_t count = 0;
      seen[count++] = shapes[at(e)];
      for (const Neighbour& neighbour : neighbours(e))
        if (lines == Lines::all || is_enclosed(e, neighbour.along))
          seen[count++] = seen_from(neighbour, shapes[at(neighbour.element)]);
      for (std::size_t k = 0; k < (dimension(e) == 2 ? 1 : 3); ++k) {
        std::array<double, most> ratios{}, skews{};
        for (std::size_t i = 0; i < count; ++i) {
          ratios[i] = seen[i].ratio[k];
          skews[i] = seen[i].skew[k];
        }
        out[at(e)].ratio[k] = combine(std::span(ratios).first(count));
        out[at(e)].skew[k] = combine(std::span(skews).first(count));
      }
    });
    return out;
  }

  static double difference(const AxisShape& a, const AxisShape& b) {
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double of_pair =
          0.5 * (std::abs(a.ratio[k] - b.ratio[k]) + std::abs(a.skew[k] - b.skew[k]));
      largest = std::max(largest, of_pair);
    }
    return largest;
  }

  /// Replaces each value by the mean over the boxes around.
  void spread(std::vector<double>& values) const {
    std::vector<double> at_node(at(topology_.node_count()), 0.0);
    parallel_for(threads_, topology_.node_count(), [&](Index begin, Index end) {
      for (Index node = begin; node < end; ++node) {
        double count = 0;
        for (const Index e : topology_.star(node)) {
          if (!has_box(topology_.element_type(e))) continue;
          at_node[at(node)] += values[at(e)];
          ++count;
        }
        if (count > 0) at_node[at(node)] /= count;
      }
    });
    for_each_box([&](Index e) {
      double sum = 0;
      const auto nodes = topology_.element(e);
      for (const Index node : nodes) sum += at_node[at(node)];
      values[at(e)] = sum / static_cast<double>(nodes.size());
    });
  }

  const Topology& topology_;
  const Coordinates& given_;
  int threads_;
  std::vector<Index> offsets_;  // #elements + 1, into neighbours_
  std::vector<Neighbour> neighbours_;
};

}  // namespace

bool has_box(ElementType type) {
  return type == ElementType::quadrilateral || type == ElementType::hexahedron ||
         type == ElementType::prism;
}

BoxField box_field(const Topology& topology, const Coordinates& given, double smooth, int threads) {
  return Boxes(topology, given, threads).build(smooth);
}

}  // namespace winslow
