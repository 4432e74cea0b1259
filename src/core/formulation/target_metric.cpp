#include "core/formulation/target_metric.h"

#include "core/mesh/element_type.h"
#include "core/mesh/polygon.h"
#include "core/mesh/polyhedron.h"

namespace winslow {

namespace {

using Tetrahedra = std::span<const std::array<Index, 4>>;

std::vector<Eigen::Matrix3d> make(ElementType type, Tetrahedra tetrahedra) {
  std::vector<Eigen::Matrix3d> list;
  const auto places = regular_corners(type);
  for (const auto& corner : tetrahedra) {
    const auto place = [&](std::size_t k) { return Vec3(places[at(corner[k])].data()); };
    Edges3 edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = place(at(k + 1)) - place(0);
    list.push_back(volume_metric(edges));
  }
  return list;
}

auto make_all(Tetrahedra (*tetrahedra)(ElementType)) {
  return table_by_type([&](ElementType type) { return make(type, tetrahedra(type)); });
}

}  // namespace

std::optional<TargetMetric> regular_metric_of_face(const ElementShape& shape,
                                                   std::size_t triangle) {
  if (shape.type != ElementType::polygon) return TargetMetric::of_angle(regular_angle(shape));
  if (triangle >= shape.side_edges.size()) return std::nullopt;
  const double angle = regular_angle(shape);
  const auto [next, previous] = shape.side_edges[triangle];
  return TargetMetric::of<2>(Vec2(1, 0) / next, Vec2(std::cos(angle), std::sin(angle)) / previous);
}

const std::vector<Eigen::Matrix3d>& regular_metrics(ElementType type) {
  static const auto lists = make_all(corner_tetrahedra);
  return lists[static_cast<std::size_t>(type)];
}

std::optional<Eigen::Matrix3d> regular_metric(const ElementShape& shape, std::size_t corner) {
  if (shape.type != ElementType::polyhedron) return regular_metrics(shape.type)[corner];
  const auto edges = regular_corner(shape.face_sizes[corner]);
  Edges3 columns;
  for (int k = 0; k < 3; ++k) columns.col(k) = edges[at(k)];
  if (!has_metric(columns)) return std::nullopt;
  return volume_metric(columns);
}

const std::vector<Eigen::Matrix3d>& regular_factors(ElementType type) {
  static const auto lists = table_by_type([](ElementType of) {
    std::vector<Eigen::Matrix3d> list;
    for (const Eigen::Matrix3d& metric : regular_metrics(of))
      list.push_back(metric.llt().matrixL());
    return list;
  });
  return lists[static_cast<std::size_t>(type)];
}

const std::vector<Eigen::Matrix3d>& regular_edge_metrics(ElementType type) {
  static const auto lists = make_all(edge_tetrahedra);
  return lists[static_cast<std::size_t>(type)];
}

double quick_stretch(const Eigen::Matrix3d& lower, const Eigen::Matrix3d& metric) {
  Eigen::Matrix3d c = relative_metric(lower, metric);
  const double mean = c.trace() / 3;
  c.diagonal().array() -= mean;
  // The eigenvalues are mean + 2 root cos(angle + 2 pi k / 3).
  const double root = std::sqrt(c.squaredNorm() / 6);
  if (!(root > 0)) return 0;
  const double cosine = c.determinant() / (2 * root * root * root);
  const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) / 3;
  const double least = mean + 2 * root * std::cos(angle + 2 * pi / 3);
  const double largest = mean + 2 * root * std::cos(angle);
  return least > 0 ? 0.5 * std::log(largest / least) : std::numeric_limits<double>::infinity();
}

namespace {

/// Share of a metric's larger entries below which an entry is round-off: a right angle.
constexpr double round_off = 1e-9;

/// Choices of edges, as pairs of a cell's nodes, in which a target may be right-angled: those from
/// the first node, and in space those of edge_tetrahedra() at the edge of the first two nodes,
/// where one edge starts from the second.
using EdgeNodes = std::array<std::array<std::size_t, 2>, 3>;
constexpr std::array<EdgeNodes, 3> edge_choices{
    {{{{0, 1}, {0, 2}, {0, 3}}}, {{{0, 1}, {0, 2}, {1, 3}}}, {{{0, 1}, {1, 2}, {0, 3}}}}};

/// The edges from the first node in terms of the edges of a choice, as columns.
Eigen::Matrix3d in_edges(std::size_t choice) {
  Eigen::Matrix3d columns = Eigen::Matrix3d::Identity();
  if (choice > 0) columns(0, choice == 1 ? 2 : 1) = 1;
  return columns;
}

/// The edge of a metric that is at right angles to both others (all_right: if all three are).
std::optional<int> right_edge(const Eigen::Matrix3d& metric, bool all_right) {
  const auto right = [&](int k, int l) {
    return std::abs(metric(k, l)) <= round_off * std::sqrt(metric(k, k) * metric(l, l));
  };
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3, m = (k + 2) % 3;
    if (right(k, l) && right(k, m) && (!all_right || right(l, m))) return k;
  }
  return std::nullopt;
}

/// The metric with the given edge lengths, if it has a right_edge().
std::optional<Eigen::Matrix3d> with_lengths(const Eigen::Matrix3d& metric, const Vec3& lengths,
                                            bool all_right) {
  const auto edge = right_edge(metric, all_right);
  if (!edge) return std::nullopt;
  const int l = (*edge + 1) % 3, m = (*edge + 2) % 3;
  const Eigen::Matrix3d gram = metric.inverse();
  Vec3 scale = lengths.cwiseQuotient(gram.diagonal().cwiseSqrt());
  if (!right_edge(metric, true)) scale[l] = scale[m] = std::sqrt(scale[l] * scale[m]);
  const Vec3 inverse = scale.cwiseInverse();
  return normalized_metric(inverse.asDiagonal() * metric * inverse.asDiagonal());
}

template <int S>
void take_lengths(ShapeTerm& term, const std::array<Index, 3>& cell, const Points<S>& x) {
  if (!(std::abs(term.bc) <= round_off * (term.ab + term.ac))) return;
  const double first = (x[cell[1]] - x[cell[0]]).norm(), second = (x[cell[2]] - x[cell[0]]).norm();
  const double ratio = second / first;
  term.ab = ratio;
  term.ac = 1 / ratio;
  term.bc = 0;
}

void take_lengths(VolumeTerm& term, const std::array<Index, 4>& cell, const SpacePoints& x) {
  const Eigen::Matrix3d metric = metric_of(term);
  const auto try_choice = [&](std::size_t choice, bool all_right) {
    Vec3 lengths;
    for (int k = 0; k < 3; ++k) {
      const auto [from, to] = edge_choices[choice][at(k)];
      lengths[k] = (x[cell[to]] - x[cell[from]]).norm();
    }
    const Eigen::Matrix3d t = in_edges(choice);
    const auto scaled = with_lengths(t * metric * t.transpose(), lengths, all_right);
    if (!scaled) return false;
    const Eigen::Matrix3d back = t.inverse();
    term = volume_term(normalized_metric(back * *scaled * back.transpose()), term.weight);
    return true;
  };
  // all_right first: at an edge of a hexahedron, the edges from the first node also include one at
  // right angles to both others.
  for (const bool all_right : {true, false})
    for (std::size_t choice = 0; choice < edge_choices.size(); ++choice)
      if (try_choice(choice, all_right)) return;
}

}  // namespace

TargetMetric with_lengths_of(const TargetMetric& own, const TargetMetric& regular) {
  if (std::abs(regular.a12) > round_off * (regular.a11 + regular.a22)) return regular;
  const double ratio = std::sqrt(own.a11 / own.a22);  // of the second edge to the first
  return {ratio, 0, 1 / ratio};
}

Eigen::Matrix3d with_lengths_of(const Eigen::Matrix3d& own, const Eigen::Matrix3d& regular) {
  if (!right_edge(regular, false)) return regular;
  const Vec3 lengths = own.inverse().diagonal().cwiseSqrt();
  for (const bool all_right : {true, false})
    if (const auto scaled = with_lengths(regular, lengths, all_right)) return *scaled;
  return regular;
}

template <int D, int S>
CellTargets<D> with_corner_lengths(CellTargets<D> targets, const Points<S>& x) {
  for (std::size_t t = 0; t < targets.cells.size(); ++t)
    for (auto& term : targets.terms_of(t)) take_lengths(term, targets.cells[t], x);
  return targets;
}
template CellTargets<2> with_corner_lengths(CellTargets<2> targets, const PlanePoints& x);
template CellTargets<2> with_corner_lengths(CellTargets<2> targets, const SpacePoints& x);
template CellTargets<3> with_corner_lengths(CellTargets<3> targets, const SpacePoints& x);

}  // namespace winslow
