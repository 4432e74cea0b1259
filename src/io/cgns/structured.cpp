#include "io/cgns/structured.h"

#include <cstdlib>

#include "io/cgns/zone_markers.h"

namespace winslow::io::cgns {
namespace {

using Point = std::array<std::int64_t, 2>;

std::string shown(const Point& p) {
  return "(" + std::to_string(p[0]) + ", " + std::to_string(p[1]) + ")";
}

/// Joins vertices into nodes.
class Joined {
 public:
  explicit Joined(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  /// The lowest vertex represents all that are joined.
  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// One-to-one pairs of vertices of a zone (GridConnectivity1to1_t).
struct Pairs {
  Point begin, end, donor;
  std::array<std::int64_t, 2> transform;

  std::array<std::int64_t, 2> steps() const {
    return {std::abs(end[0] - begin[0]), std::abs(end[1] - begin[1])};
  }
  Point vertex(std::int64_t a, std::int64_t b) const {
    return {begin[0] + (end[0] < begin[0] ? -a : a), begin[1] + (end[1] < begin[1] ? -b : b)};
  }
  /// SIDS, GridConnectivity1to1_t: index2 = T (index1 - begin1) + begin2.
  Point donor_of(const Point& p) const {
    Point q = donor;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::int64_t direction = std::abs(transform[k]);
      q[static_cast<std::size_t>(direction - 1)] += (transform[k] < 0 ? -1 : 1) * (p[k] - begin[k]);
    }
    return q;
  }
};

std::optional<Pairs> read_pairs(const NodeView& connection) {
  const auto range = connection.child("PointRange"), donor = connection.child("PointRangeDonor");
  const auto transform = connection.child("Transform");
  if (!range || !donor) return std::nullopt;
  const auto a = range->integers(), b = donor->integers();
  const auto t = transform ? transform->integers() : std::vector<std::int64_t>{1, 2};
  const auto direction = [](std::int64_t k) { return std::abs(k) == 1 || std::abs(k) == 2; };
  if (a.size() != 4 || b.size() != 4 || t.size() != 2 || !direction(t[0]) || !direction(t[1]) ||
      std::abs(t[0]) == std::abs(t[1])) {
    connection.fail("ranges and a Transform that do not fit a zone of two indices",
                    "four numbers, four numbers and two of 1 and 2");
  }
  return Pairs{{a[0], a[1]}, {a[2], a[3]}, {b[0], b[1]}, {t[0], t[1]}};
}

double extent(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

class CutJoiner {
 public:
  CutJoiner(const Lattice& lattice, const std::vector<double>& x, const std::vector<double>& y)
      : lattice_(lattice), x_(x), y_(y), joined_(x.size()) {
    constexpr double same_place = 1e-7;  // of the extent: what single precision can tell apart
    tolerance_ = same_place * std::max(extent(x), extent(y));
  }

  /// Returns false if the two sides do not coincide.
  bool join(const NodeView& connection, const Pairs& pairs) {
    std::vector<std::pair<std::size_t, std::size_t>> found;
    const auto steps = pairs.steps();
    if (!inside(pairs.donor))
      connection.fail("vertex " + shown(pairs.donor) + " as a donor", "one of the zone");
    if (!inside(pairs.begin) || !inside(pairs.end))
      connection.fail("a range up to " + shown(pairs.end), "vertices of the zone");
    for (std::int64_t b = 0; b <= steps[1]; ++b) {
      for (std::int64_t a = 0; a <= steps[0]; ++a) {
        const Point p = pairs.vertex(a, b), q = pairs.donor_of(p);
        if (!inside(q)) connection.fail("vertex " + shown(q) + " as a donor", "one of the zone");
        const std::size_t v = lattice_.vertex(p[0], p[1]), w = lattice_.vertex(q[0], q[1]);
        if (!(std::hypot(x_[v] - x_[w], y_[v] - y_[w]) <= tolerance_)) return false;
        found.emplace_back(v, w);
      }
    }
    for (const auto& [v, w] : found) joined_.join(v, w);
    return true;
  }

  void number(Lattice& lattice) {
    lattice.node_of_vertex.resize(x_.size());
    for (std::size_t v = 0; v < x_.size(); ++v) {
      const std::size_t first = joined_.find(v);
      lattice.node_of_vertex[v] = first == v ? lattice.nodes++ : lattice.node_of_vertex[first];
    }
  }

 private:
  bool inside(const Point& p) const { return lattice_.has(p[0], p[1]); }

  const Lattice& lattice_;
  const std::vector<double>& x_;
  const std::vector<double>& y_;
  double tolerance_;
  Joined joined_;
};

}  // namespace

Lattice make_lattice(const NodeView& zone, const ZoneHead& head, const std::vector<double>& x,
                     const std::vector<double>& y, std::vector<std::string>& joined,
                     std::vector<std::string>& warnings) {
  Lattice lattice;
  lattice.ni = head.vertices[0];
  lattice.nj = head.vertices[1];
  CutJoiner joiner(lattice, x, y);
  for (const NodeView& all : zone.children("ZoneGridConnectivity_t")) {
    for (const NodeView& connection : all.children("GridConnectivity1to1_t")) {
      if (!leads_to(connection, zone.name()) || is_periodic(connection)) continue;
      const auto pairs = read_pairs(connection);
      if (!pairs) continue;
      if (joiner.join(connection, *pairs)) {
        joined.push_back(connection.name());
      } else {
        warnings.push_back("the two sides of the connection \"" + connection.name() +
                           "\" of the zone to itself lie apart: the cut stays open");
      }
    }
  }
  joiner.number(lattice);
  return lattice;
}

std::vector<PeriodicPair> lattice_pairs(const NodeView& connection, const Lattice& lattice) {
  const auto pairs = read_pairs(connection);
  if (!pairs) return {};
  std::vector<PeriodicPair> out;
  const auto steps = pairs->steps();
  const auto inside = [&](const Point& p) {
    if (!lattice.has(p[0], p[1]))
      connection.fail("vertex " + shown(p) + " of a periodic side", "one of the zone");
  };
  inside(pairs->begin);
  inside(pairs->end);
  for (std::int64_t b = 0; b <= steps[1]; ++b) {
    for (std::int64_t a = 0; a <= steps[0]; ++a) {
      const Point p = pairs->vertex(a, b), q = pairs->donor_of(p);
      inside(q);
      out.push_back({lattice.node(p[0], p[1]), lattice.node(q[0], q[1])});
    }
  }
  return out;
}

void add_cells(const Lattice& lattice, const std::vector<double>& x, const std::vector<double>& y,
               MeshData& mesh) {
  double area = 0;
  for (std::int64_t j = 1; j < lattice.nj; ++j) {
    for (std::int64_t i = 1; i < lattice.ni; ++i) {
      const auto a = lattice.vertex(i, j), b = lattice.vertex(i + 1, j),
                 c = lattice.vertex(i + 1, j + 1), d = lattice.vertex(i, j + 1);
      area += (x[c] - x[a]) * (y[d] - y[b]) - (x[d] - x[b]) * (y[c] - y[a]);
    }
  }
  for (std::int64_t j = 1; j < lattice.nj; ++j) {
    for (std::int64_t i = 1; i < lattice.ni; ++i) {
      std::array<Index, 4> corners{lattice.node(i, j), lattice.node(i + 1, j),
                                   lattice.node(i + 1, j + 1), lattice.node(i, j + 1)};
      if (area < 0) std::swap(corners[1], corners[3]);
      mesh.add_element(ElementType::quadrilateral, corners);
    }
  }
}

void StructuredBoundary::check(const PointSet& set, const Point& p) const {
  if (lattice_.has(p[0], p[1])) return;
  set.view.fail("index " + shown(p), "(1, 1) to " + shown({lattice_.ni, lattice_.nj}));
}

std::vector<Face> StructuredBoundary::edges_along(Point p, Point q) const {
  std::vector<Face> faces;
  while (p != q) {
    Point next = p;
    for (std::size_t k = 0; k < 2; ++k) next[k] += p[k] < q[k] ? 1 : p[k] > q[k] ? -1 : 0;
    faces.emplace_back(lattice_.node(p[0], p[1]), lattice_.node(next[0], next[1]));
    p = next;
  }
  return faces;
}

/// Faces are numbered by their lowest vertex: face (i, j) of IFaceCenter lies between (i, j) and
/// (i, j + 1), of JFaceCenter between (i, j) and (i + 1, j).
std::vector<Face> StructuredBoundary::faces_at(const PointSet& set, Point p, Point q) const {
  bool along_j = set.location.starts_with("I");
  if (!along_j && !set.location.starts_with("J")) {
    // FaceCenter or EdgeCenter: the side of the zone decides the direction.
    const bool ambiguous = p == q;
    along_j = ambiguous ? (p[0] == 1 || p[0] == lattice_.ni) && p[1] < lattice_.nj : p[0] == q[0];
  }
  const std::size_t k = along_j ? 1 : 0;
  if (p[k] > q[k]) std::swap(p, q);
  ++q[k];
  check(set, q);
  return edges_along(p, q);
}

std::vector<Face> StructuredBoundary::faces_of(const PointSet& set,
                                               std::vector<std::string>& warnings) const {
  const bool vertices = set.of_vertices();
  if (set.elements || set.location == "CellCenter") {
    warnings.push_back("\"" + set.view.path() +
                       "\" names cells of a structured zone, not edges: they are in no marker");
    return {};
  }
  const std::vector<std::int64_t>& v = set.values;
  if (set.range) {
    const Point p{v[0], v[1]}, q{v[2], v[3]};
    check(set, p);
    check(set, q);
    if (p[0] != q[0] && p[1] != q[1]) {
      warnings.push_back("\"" + set.view.path() + "\" is an area, " + shown(p) + " to " + shown(q) +
                         ", no line: it is in no marker");
      return {};
    }
    return vertices ? edges_along(p, q) : faces_at(set, p, q);
  }
  std::vector<bool> nodes(at(lattice_.nodes), false);
  std::vector<Face> faces;
  for (std::size_t k = 0; k + 1 < v.size(); k += 2) {
    const Point p{v[k], v[k + 1]};
    check(set, p);
    if (vertices) {
      nodes[at(lattice_.node(p[0], p[1]))] = true;
    } else {
      const auto one = faces_at(set, p, p);
      faces.insert(faces.end(), one.begin(), one.end());
    }
  }
  return vertices ? by_nodes_.faces_between(nodes) : faces;
}

}  // namespace winslow::io::cgns
