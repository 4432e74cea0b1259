#include "io/cgns/structured.h"

#include <Eigen/Geometry>
#include <cstdlib>

#include "io/cgns/zone_markers.h"

namespace winslow::io::cgns {
namespace {

using Point = LatticePoint;

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
  Point transform;

  /// Calls visit(p, q) for each vertex p and its donor q.
  template <class Visit>
  void for_each(Visit visit) const {
    const auto steps = [&](std::size_t d) { return std::abs(end[d] - begin[d]); };
    const auto place = [&](std::size_t d, std::int64_t step) {
      return begin[d] + (end[d] < begin[d] ? -step : step);
    };
    for (std::int64_t c = 0; c <= steps(2); ++c)
      for (std::int64_t b = 0; b <= steps(1); ++b)
        for (std::int64_t a = 0; a <= steps(0); ++a) {
          const Point p{place(0, a), place(1, b), place(2, c)};
          visit(p, donor_of(p));
        }
  }
  /// SIDS, GridConnectivity1to1_t: index2 = T (index1 - begin1) + begin2.
  Point donor_of(const Point& p) const {
    Point q = donor;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t direction = std::abs(transform[k]);
      q[static_cast<std::size_t>(direction - 1)] += (transform[k] < 0 ? -1 : 1) * (p[k] - begin[k]);
    }
    return q;
  }
};

/// True if the numbers are the directions, each once, of either sign.
bool are_directions(const std::vector<std::int64_t>& numbers, std::size_t directions) {
  std::array<bool, 3> seen{};
  for (const std::int64_t number : numbers) {
    if (number == 0 || std::abs(number) > static_cast<std::int64_t>(directions)) return false;
    if (std::exchange(seen[static_cast<std::size_t>(std::abs(number) - 1)], true)) return false;
  }
  return numbers.size() == directions;
}

Point point_of(const std::vector<std::int64_t>& numbers, std::size_t first,
               std::size_t directions) {
  Point p{1, 1, 1};
  for (std::size_t d = 0; d < directions; ++d) p[d] = numbers[first + d];
  return p;
}

std::optional<Pairs> read_pairs(const NodeView& connection, const Lattice& lattice) {
  const auto range = connection.child("PointRange"), donor = connection.child("PointRangeDonor");
  const auto transform = connection.child("Transform");
  if (!range || !donor) return std::nullopt;
  const std::size_t n = lattice.directions;
  const auto a = range->integers(), b = donor->integers();
  std::vector<std::int64_t> t{1, 2, 3};
  t.resize(n);
  if (transform) t = transform->integers();
  if (a.size() != 2 * n || b.size() != 2 * n || !are_directions(t, n)) {
    connection.fail("ranges and a Transform that do not fit a zone of " +
                        std::string(n == 2 ? "two" : "three") + " indices",
                    n == 2 ? "four numbers, four numbers and two of 1 and 2"
                           : "six numbers, six numbers and three of 1, 2 and 3");
  }
  Pairs pairs{point_of(a, 0, n), point_of(a, n, n), point_of(b, 0, n), {1, 2, 3}};
  std::ranges::copy(t, pairs.transform.begin());
  const auto inside = [&](const Point& p, const char* what) {
    if (!lattice.has(p)) connection.fail("vertex " + lattice.shown(p) + what, "one of the zone");
  };
  inside(pairs.begin, " of a range");
  inside(pairs.end, " of a range");
  inside(pairs.donor, " as a donor");
  inside(pairs.donor_of(pairs.end), " as a donor");
  return pairs;
}

double extent(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

class CutJoiner {
 public:
  CutJoiner(const Lattice& lattice, const VertexPlaces& places)
      : lattice_(lattice), places_(places), joined_(places.of[0].size()) {
    constexpr double same_place = 1e-7;  // of the extent: what single precision can tell apart
    for (const std::vector<double>& x : places.of)
      if (!x.empty()) tolerance_ = std::max(tolerance_, same_place * extent(x));
  }

  /// Returns false if the two sides do not coincide.
  bool join(const Pairs& pairs) {
    std::vector<std::pair<std::size_t, std::size_t>> found;
    bool coincide = true;
    pairs.for_each([&](const Point& p, const Point& q) {
      found.emplace_back(lattice_.vertex(p), lattice_.vertex(q));
      coincide = coincide && distance(found.back().first, found.back().second) <= tolerance_;
    });
    if (!coincide) return false;
    for (const auto& [v, w] : found) joined_.join(v, w);
    return true;
  }

  void number(Lattice& lattice) {
    const std::size_t count = places_.of[0].size();
    lattice.node_of_vertex.resize(count);
    for (std::size_t v = 0; v < count; ++v) {
      const std::size_t first = joined_.find(v);
      lattice.node_of_vertex[v] = first == v ? lattice.nodes++ : lattice.node_of_vertex[first];
    }
  }

 private:
  double distance(std::size_t v, std::size_t w) const {
    double squares = 0;
    for (const std::vector<double>& x : places_.of)
      if (!x.empty()) squares += (x[v] - x[w]) * (x[v] - x[w]);
    return std::sqrt(squares);
  }

  const Lattice& lattice_;
  const VertexPlaces& places_;
  double tolerance_ = 0;
  Joined joined_;
};

}  // namespace

std::string Lattice::shown(const LatticePoint& p) const {
  return "(" +
         list_of(std::span(p).first(directions), [](std::int64_t i) { return std::to_string(i); }) +
         ")";
}

Lattice make_lattice(const NodeView& zone, const ZoneHead& head, const VertexPlaces& places,
                     std::vector<std::string>& joined, std::vector<std::string>& warnings) {
  Lattice lattice;
  lattice.directions = head.vertices.size();
  std::ranges::copy(head.vertices, lattice.size.begin());
  CutJoiner joiner(lattice, places);
  for (const NodeView& all : zone.children("ZoneGridConnectivity_t")) {
    for (const NodeView& connection : all.children("GridConnectivity1to1_t")) {
      if (!leads_to(connection, zone.name()) || is_periodic(connection)) continue;
      const auto pairs = read_pairs(connection, lattice);
      if (!pairs) continue;
      if (joiner.join(*pairs)) {
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
  const auto pairs = read_pairs(connection, lattice);
  std::vector<PeriodicPair> out;
  if (pairs)
    pairs->for_each([&](const Point& p, const Point& q) {
      out.push_back({lattice.node(p), lattice.node(q)});
    });
  return out;
}

namespace {

/// Calls visit(p) for the lowest vertex of each cell of a box of vertices.
template <class Visit>
void for_each_cell(const Point& low, const Point& high, std::size_t directions, Visit visit) {
  const std::int64_t last = directions == 2 ? low[2] + 1 : high[2];
  for (std::int64_t k = low[2]; k < last; ++k)
    for (std::int64_t j = low[1]; j < high[1]; ++j)
      for (std::int64_t i = low[0]; i < high[0]; ++i) visit(Point{i, j, k});
}

Point moved(Point p, std::size_t direction) {
  ++p[direction];
  return p;
}

/// The corners of a quadrilateral in two directions, around it.
std::array<Point, 4> quadrilateral(const Point& p, std::size_t a, std::size_t b) {
  return {p, moved(p, a), moved(moved(p, a), b), moved(p, b)};
}

Vec3 place(const VertexPlaces& places, std::size_t vertex) {
  const auto& [x, y, z] = places.of;
  return {x[vertex], y[vertex], z.empty() ? 0.0 : z[vertex]};
}

/// Twice the area of a plane cell, or the volume of a parallelepiped between the means of the sides
/// of a cell in space: only the sign of their sum counts.
double measure(const Lattice& lattice, const VertexPlaces& places, const Point& p) {
  const auto at_vertex = [&](const Point& q) { return place(places, lattice.vertex(q)); };
  const auto low = quadrilateral(p, 0, 1);
  const auto mean = [&](std::array<Point, 4> corners, std::size_t up) {
    Vec3 sum(0, 0, 0);
    for (Point& corner : corners) sum += at_vertex(up < 3 ? moved(corner, up) : corner);
    return Vec3(sum / 4);
  };
  if (lattice.directions == 2) {
    const Vec3 a = at_vertex(low[2]) - at_vertex(low[0]), b = at_vertex(low[3]) - at_vertex(low[1]);
    return a.x() * b.y() - a.y() * b.x();
  }
  const Vec3 i = mean(quadrilateral(p, 1, 2), 0) - mean(quadrilateral(p, 1, 2), 3);
  const Vec3 j = mean(quadrilateral(p, 0, 2), 1) - mean(quadrilateral(p, 0, 2), 3);
  const Vec3 k = mean(low, 2) - mean(low, 3);
  return i.cross(j).dot(k);
}

}  // namespace

void add_cells(const Lattice& lattice, const VertexPlaces& places, MeshData& mesh) {
  const Point first{1, 1, 1};
  double total = 0;
  for_each_cell(first, lattice.size, lattice.directions,
                [&](const Point& p) { total += measure(lattice, places, p); });
  for_each_cell(first, lattice.size, lattice.directions, [&](const Point& p) {
    std::array<Index, 8> corners{};
    const auto low = quadrilateral(p, 0, 1);
    for (std::size_t c = 0; c < 4; ++c) {
      corners[c] = lattice.node(low[c]);
      if (lattice.directions == 3) corners[c + 4] = lattice.node(moved(low[c], 2));
    }
    if (lattice.directions == 2) {
      if (total < 0) std::swap(corners[1], corners[3]);
      mesh.add_element(ElementType::quadrilateral, {corners.data(), 4});
      return;
    }
    if (total < 0) std::rotate(corners.begin(), corners.begin() + 4, corners.end());
    mesh.add_element(ElementType::hexahedron, corners);
  });
}

void StructuredBoundary::check(const PointSet& set, const Point& p) const {
  if (lattice_.has(p)) return;
  set.view.fail("index " + lattice_.shown(p),
                lattice_.shown({1, 1, 1}) + " to " + lattice_.shown(lattice_.size));
}

std::vector<Face> StructuredBoundary::edges_along(Point p, const Point& q) const {
  std::vector<Face> faces;
  while (p != q) {
    Point next = p;
    for (std::size_t k = 0; k < 2; ++k) next[k] += p[k] < q[k] ? 1 : p[k] > q[k] ? -1 : 0;
    faces.emplace_back(lattice_.node(p), lattice_.node(next));
    p = next;
  }
  return faces;
}

/// The quadrilaterals between the vertices p and q.
std::vector<Face> StructuredBoundary::faces_between(const Point& p, const Point& q,
                                                    std::size_t across) const {
  Point low, high;
  for (std::size_t d = 0; d < 3; ++d) {
    low[d] = std::min(p[d], q[d]);
    high[d] = std::max(p[d], q[d]);
  }
  high[across] = low[across] + 1;
  const std::size_t a = across == 0 ? 1 : 0, b = across == 2 ? 1 : 2;
  std::vector<Face> faces;
  for_each_cell(low, high, 3, [&](const Point& corner) {
    std::array<Index, 4> nodes{};
    const auto around = quadrilateral(corner, a, b);
    for (std::size_t c = 0; c < 4; ++c) nodes[c] = lattice_.node(around[c]);
    faces.emplace_back(nodes);
  });
  return faces;
}

std::size_t StructuredBoundary::across(const PointSet& set, const Point& p, const Point& q) const {
  for (std::size_t d = 0; d < lattice_.directions; ++d)
    if (set.location.size() > 1 && set.location.substr(1) == "FaceCenter" &&
        set.location[0] == "IJK"[d])
      return d;
  const bool vertices = set.of_vertices();
  std::size_t found = 3;
  for (std::size_t d = 0; d < lattice_.directions; ++d) {
    if (p[d] != q[d]) continue;
    // A single face has one index in every direction: the side of the zone on which it can be
    // decides.
    bool fits = vertices || p[d] == 1 || p[d] == lattice_.size[d];
    for (std::size_t e = 0; e < lattice_.directions; ++e) {
      if (e == d) continue;
      fits = fits && (vertices ? p[e] != q[e] : std::max(p[e], q[e]) < lattice_.size[e]);
    }
    if (fits) return d;
    if (!vertices) found = d;
  }
  return found;
}

/// Faces are numbered by their lowest vertex: face (i, j) of IFaceCenter lies between (i, j) and
/// (i, j + 1), of JFaceCenter between (i, j) and (i + 1, j).
std::vector<Face> StructuredBoundary::faces_in(const PointSet& set, Point p, Point q,
                                               std::vector<std::string>& warnings) const {
  const std::size_t d = across(set, p, q);
  const bool volume = lattice_.directions == 3;
  if (d == 3) {
    if (!volume && p == q) return {};  // a vertex
    warnings.push_back("\"" + set.view.path() + "\" is " +
                       (volume ? "no side of the zone" : "an area") + ", " + lattice_.shown(p) +
                       " to " + lattice_.shown(q) + (volume ? "" : ", no line") +
                       ": it is in no marker");
    return {};
  }
  if (!set.of_vertices()) {
    for (std::size_t e = 0; e < lattice_.directions; ++e) {
      if (p[e] > q[e]) std::swap(p[e], q[e]);
      if (e != d) ++q[e];
    }
    check(set, q);
  }
  return volume ? faces_between(p, q, d) : edges_along(p, q);
}

std::vector<Face> StructuredBoundary::faces_of(const PointSet& set,
                                               std::vector<std::string>& warnings) const {
  const bool vertices = set.of_vertices();
  const std::size_t n = lattice_.directions;
  if (set.elements || set.location == "CellCenter") {
    warnings.push_back("\"" + set.view.path() + "\" names cells of a structured zone, not " +
                       (n == 2 ? "edges" : "faces") + ": they are in no marker");
    return {};
  }
  const std::vector<std::int64_t>& v = set.values;
  if (set.range) {
    const Point p = point_of(v, 0, n), q = point_of(v, n, n);
    check(set, p);
    check(set, q);
    return faces_in(set, p, q, warnings);
  }
  std::vector<bool> nodes(at(lattice_.nodes), false);
  std::vector<Face> faces;
  for (std::size_t k = 0; k + n <= v.size(); k += n) {
    const Point p = point_of(v, k, n);
    check(set, p);
    if (vertices) {
      nodes[at(lattice_.node(p))] = true;
    } else {
      const auto one = faces_in(set, p, p, warnings);
      faces.insert(faces.end(), one.begin(), one.end());
    }
  }
  return vertices ? by_nodes_.faces_between(nodes) : faces;
}

}  // namespace winslow::io::cgns
