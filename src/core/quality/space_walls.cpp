#include "core/quality/space_walls.h"

#include <map>

#include "core/mesh/enclosing_faces.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The boundary faces of bodies.
std::vector<SurfaceFace> body_faces(const Mesh& mesh) {
  const std::vector<SurfaceFace> faces = boundary_faces(*mesh.topology);
  const std::vector<unsigned char> enclosing = enclosing_faces(mesh, faces);
  std::vector<SurfaceFace> bodies;
  if (std::ranges::find(enclosing, 1) == enclosing.end()) return bodies;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (enclosing[f] == 0 && faces[f].neighbour < 0) bodies.push_back(faces[f]);
  return bodies;
}

}  // namespace

std::vector<Wall> find_space_walls(const Mesh& mesh) {
  const Topology& topology = *mesh.topology;
  const std::vector<SurfaceFace> faces = body_faces(mesh);
  JoinedSets bodies(faces.empty() ? 0 : at(topology.node_count()));
  for (const SurfaceFace& face : faces)
    for (const Index node : face.nodes) bodies.join(face.nodes[0], node);
  std::vector<Wall> walls;
  std::map<Index, std::size_t> wall_of_body;
  for (const SurfaceFace& face : faces) {
    const auto [place, is_new] = wall_of_body.try_emplace(bodies.find(face.nodes[0]), walls.size());
    if (is_new) walls.emplace_back();
    walls[place->second].faces.push_back(face);
  }
  for (Wall& wall : walls) {
    std::vector<Index> markers;
    for (const SurfaceFace& face : wall.faces) {
      wall.nodes.insert(wall.nodes.end(), face.nodes.begin(), face.nodes.end());
      if (face.marker >= 0) markers.push_back(face.marker);
    }
    sort_unique(wall.nodes);
    sort_unique(markers);
    for (const Index marker : markers) wall.markers.push_back(topology.markers()[at(marker)].name);
  }
  return walls;
}

Index number_on_wall(const Wall& wall, Index node) {
  const auto found = std::ranges::lower_bound(wall.nodes, node);
  if (found == wall.nodes.end() || *found != node) return -1;
  return static_cast<Index>(found - wall.nodes.begin());
}

namespace {

/// The faces around the nodes of a wall, by the numbers of these nodes on the wall.
class WallFaces {
 public:
  WallFaces(const Mesh& mesh, const Wall& wall) : x_(mesh.coordinates), wall_(wall) {
    for (const SurfaceFace& face : wall.faces) {
      for (const Index node : face.nodes) corners_.values.push_back(number_on_wall(wall, node));
      corners_.end_row();
    }
    at_nodes_ = rows_of(node_count(), [&](const auto& add) {
      for (Index f = 0; f < face_count(); ++f)
        for (const Index corner : corners_[f]) add(corner, f);
    });
  }

  Index node_count() const { return static_cast<Index>(wall_.nodes.size()); }
  Index face_count() const { return static_cast<Index>(wall_.faces.size()); }
  const SurfaceFace& face(Index f) const { return wall_.faces[at(f)]; }
  /// The corners of a face, in the order of its nodes.
  std::span<const Index> corners(Index f) const { return corners_[f]; }
  Index node(Index number) const { return wall_.nodes[at(number)]; }

  /// The faces that share a node with a face, and itself, ascending.
  std::vector<Index> around(Index f) const {
    std::vector<Index> faces;
    for (const Index corner : corners_[f])
      faces.insert(faces.end(), at_nodes_[corner].begin(), at_nodes_[corner].end());
    sort_unique(faces);
    return faces;
  }
  /// The nodes at the other ends of the wall's edges at a node, ascending.
  std::vector<Index> ring(Index number) const {
    std::vector<Index> nodes;
    for (const Index f : at_nodes_[number]) {
      const Face& of = face(f).nodes;
      const std::size_t n = of.size(), k = index_of(of, node(number));
      nodes.push_back(of[(k + 1) % n]);
      nodes.push_back(of[(k + n - 1) % n]);
    }
    sort_unique(nodes);
    return nodes;
  }
  /// Angle of a face at its corner k, in radians.
  double angle(Index f, std::size_t k) const {
    const Face& nodes = face(f).nodes;
    const std::size_t n = nodes.size();
    const Vec3 p = x_[nodes[k]];
    const Vec3 a = x_[nodes[(k + 1) % n]] - p, b = x_[nodes[(k + n - 1) % n]] - p;
    return std::atan2(a.cross(b).norm(), a.dot(b));
  }
  /// Normals at the nodes (#nodes), into the mesh, of any length: the mean of the unit normals of
  /// the faces, weighted by their angles there.
  std::vector<Vec3> normals() const {
    std::vector<Vec3> sums(wall_.nodes.size(), Vec3::Zero());
    for (Index f = 0; f < face_count(); ++f) {
      const Vec3 normal = -area_vector(x_, face(f).nodes).normalized();
      const auto numbers = corners(f);
      for (std::size_t k = 0; k < numbers.size(); ++k) sums[at(numbers[k])] += angle(f, k) * normal;
    }
    return sums;
  }

 private:
  SpacePoints x_;
  const Wall& wall_;
  CompressedRows corners_;   // #faces
  CompressedRows at_nodes_;  // #nodes: the faces there
};

/// A ball around a face, to find out quickly that it is far away.
struct Ball {
  Vec3 centre;
  double radius;
};

Ball ball_around(const SpacePoints& x, const Face& nodes) {
  Ball ball{centre_of(x, nodes), 0};
  for (const Index node : nodes)
    ball.radius = std::max(ball.radius, (x[node] - ball.centre).norm());
  return ball;
}

/// Squared distance from a triangle, by the part of it that is nearest: a corner, an edge or its
/// plane (C. Ericson, Real-Time Collision Detection, 2005, 5.1.5).
double squared_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double a1 = ab.dot(ap), a2 = ac.dot(ap);
  if (a1 <= 0 && a2 <= 0) return ap.squaredNorm();
  const double b1 = ab.dot(bp), b2 = ac.dot(bp);
  if (b1 >= 0 && b2 <= b1) return bp.squaredNorm();
  const double c1 = ab.dot(cp), c2 = ac.dot(cp);
  if (c2 >= 0 && c1 <= c2) return cp.squaredNorm();
  const auto edge = [](const Vec3& from, const Vec3& along, double here, double there) -> double {
    return here > 0 ? (from - here / (here + there) * along).squaredNorm() : from.squaredNorm();
  };
  if (a1 >= 0 && b1 <= 0 && a1 * b2 - b1 * a2 <= 0) return edge(ap, ab, a1, -b1);
  if (a2 >= 0 && c2 <= 0 && c1 * a2 - a1 * c2 <= 0) return edge(ap, ac, a2, -c2);
  if (b2 >= b1 && c1 >= c2 && b1 * c2 - c1 * b2 <= 0) return edge(bp, c - b, b2 - b1, c1 - c2);
  const Vec3 normal = ab.cross(ac);
  const double height = normal.dot(ap);
  return height * height / normal.squaredNorm();
}

/// Distance from a face: of more than three nodes, from the triangles of its edges with its middle.
double face_distance(const SpacePoints& x, const Vec3& p, const Face& nodes, const Vec3& middle) {
  const std::size_t n = nodes.size();
  if (n == 3) return std::sqrt(squared_distance(p, x[nodes[0]], x[nodes[1]], x[nodes[2]]));
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < n; ++k)
    least = std::min(least, squared_distance(p, x[nodes[k]], x[nodes[(k + 1) % n]], middle));
  return std::sqrt(least);
}

/// Measures the heights of the corners of elements at a wall.
class CornerHeights {
 public:
  CornerHeights(const Mesh& mesh, const Wall& wall, const WallFaces& faces)
      : topology_(*mesh.topology), x_(mesh.coordinates), faces_(faces) {
    for (const SurfaceFace& face : wall.faces) balls_.push_back(ball_around(x_, face.nodes));
  }

  /// Heights of the element of a face at the corners of the face; NaN: none.
  std::vector<double> at_face(Index f) {
    near_ = faces_.around(f);
    known_.clear();
    const Face& nodes = faces_.face(f).nodes;
    const std::vector<std::vector<Index>> ends = ends_off(nodes, faces_.face(f).element);
    std::vector<double> heights;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      std::vector<Index> facing = ends[k];
      if (facing.empty()) facing = nearest_of(ends, nodes[k]);
      double sum = 0;
      for (const Index end : facing) sum += height(f, end);
      heights.push_back(facing.empty() ? none : sum / static_cast<double>(facing.size()));
    }
    return heights;
  }

 private:
  /// For each corner of the face, the ends of the edges of the element that lead from there off
  /// the face, without those on the wall.
  std::vector<std::vector<Index>> ends_off(const Face& nodes, Index element) const {
    const auto corners = topology_.element(element);
    std::vector<std::size_t> places;  // of the corners in the face; #nodes: not in it
    for (const Index corner : corners) places.push_back(index_of(nodes, corner));
    std::vector<std::vector<Index>> ends(nodes.size());
    for (const auto& edge : topology_.shape(element).edges) {
      const bool starts = places[at(edge[0])] < nodes.size();
      if (starts == (places[at(edge[1])] < nodes.size())) continue;  // along the face, or off it
      const Index end = corners[at(edge[starts ? 1 : 0])];
      if (!on_wall(end)) ends[places[at(edge[starts ? 0 : 1])]].push_back(end);
    }
    return ends;
  }
  /// Whether a node is of one of the near faces.
  bool on_wall(Index node) const {
    return topology_.on_boundary(node) && std::ranges::any_of(near_, [&](Index f) {
             const Face& nodes = faces_.face(f).nodes;
             return index_of(nodes, node) < nodes.size();
           });
  }
  /// The end of all that is nearest to a node; empty if there are no ends.
  std::vector<Index> nearest_of(const std::vector<std::vector<Index>>& ends, Index node) const {
    Index nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& list : ends)
      for (const Index end : list) {
        const double way = (x_[end] - x_[node]).norm();
        if (way < least) {
          least = way;
          nearest = end;
        }
      }
    return nearest < 0 ? std::vector<Index>() : std::vector<Index>{nearest};
  }
  /// Distance of a node from the near faces. f: the first to look at, one of them.
  double height(Index f, Index node) {
    const auto known = std::ranges::find(known_, node, &std::pair<Index, double>::first);
    if (known != known_.end()) return known->second;
    const Vec3 p = x_[node];
    double least = distance(f, p);
    for (const Index other : near_) {
      const Ball& ball = balls_[at(other)];
      if (other == f || (p - ball.centre).norm() - ball.radius >= least) continue;
      least = std::min(least, distance(other, p));
    }
    known_.emplace_back(node, least);
    return least;
  }
  double distance(Index f, const Vec3& p) const {
    return face_distance(x_, p, faces_.face(f).nodes, balls_[at(f)].centre);
  }

  const Topology& topology_;
  SpacePoints x_;
  const WallFaces& faces_;
  std::vector<Ball> balls_;                      // #faces
  std::vector<Index> near_;                      // faces that share a node with the present one
  std::vector<std::pair<Index, double>> known_;  // heights of nodes at the present face
};

}  // namespace

std::vector<double> space_first_heights(const Mesh& mesh, const Wall& wall) {
  const WallFaces faces(mesh, wall);
  CornerHeights measure(mesh, wall, faces);
  std::vector<double> sums(wall.nodes.size(), 0.0), weights(wall.nodes.size(), 0.0);
  for (Index f = 0; f < faces.face_count(); ++f) {
    const std::vector<double> heights = measure.at_face(f);
    const auto corners = faces.corners(f);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if (std::isnan(heights[k])) continue;
      const double weight = faces.angle(f, k);
      sums[at(corners[k])] += weight * heights[k];
      weights[at(corners[k])] += weight;
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    sums[i] = weights[i] > 0 ? sums[i] / weights[i] : none;
  return sums;
}

std::vector<double> space_wall_spacings(const Mesh& mesh, const Wall& wall) {
  const SpacePoints x(mesh.coordinates);
  const WallFaces faces(mesh, wall);
  std::vector<double> spacings;
  for (Index i = 0; i < faces.node_count(); ++i) {
    const std::vector<Index> ring = faces.ring(i);
    double sum = 0;
    for (const Index other : ring) sum += (x[other] - x[faces.node(i)]).norm();
    spacings.push_back(sum / static_cast<double>(ring.size()));
  }
  return spacings;
}

std::vector<double> space_first_edge_tilts(const Mesh& mesh, const Wall& wall) {
  const SpacePoints x(mesh.coordinates);
  const WallFaces faces(mesh, wall);
  const std::vector<Vec3> normals = faces.normals();
  std::vector<double> tilts(wall.nodes.size(), none);
  for (Index i = 0; i < faces.node_count(); ++i) {
    const Vec3& normal = normals[at(i)];
    if (normal.squaredNorm() == 0) continue;
    const Index node = faces.node(i);
    const std::vector<Index> ring = faces.ring(i);
    for (const Index other : mesh.topology->neighbours(node)) {
      if (std::ranges::binary_search(ring, other)) continue;
      const Vec3 edge = x[other] - x[node];
      const double tilt = degrees(std::atan2(normal.cross(edge).norm(), normal.dot(edge)));
      tilts[at(i)] = std::isnan(tilts[at(i)]) ? tilt : std::min(tilts[at(i)], tilt);
    }
  }
  return tilts;
}

CompressedRows faces_of_elements(const Topology& topology) {
  require_kind(topology, MeshKind::volume, "faces of elements");
  return rows_of(topology.element_count(), [&](const auto& add) {
    for (Index f = 0; f < topology.face_count(); ++f)
      for (const Index element : topology.face(f).elements)
        if (element >= 0) add(element, f);
  });
}

namespace {

/// Walks along a column of elements between two faces with as many nodes, joined by quadrilaterals.
class SpaceColumn {
 public:
  SpaceColumn(const Mesh& mesh, const CompressedRows& faces, const SurfaceFace& wall)
      : topology_(*mesh.topology),
        x_(mesh.coordinates),
        faces_(faces),
        below_(wall.nodes),
        element_(wall.element) {}

  struct Cell {
    Index element;
    double height;
  };
  /// The next cell; none at the end of the column.
  std::optional<Cell> next() {
    if (element_ < 0) return {};
    const std::optional<Index> top = opposite_face();
    if (!top) return {};
    const auto [nodes, elements] = topology_.face(*top);
    const Cell cell{element_, (centre_of(x_, nodes) - centre_of(x_, below_)).norm()};
    element_ = elements[0] == element_ ? elements[1] : elements[0];
    below_ = nodes;
    return cell;
  }

 private:
  /// The only face that has no node of the face below, if all others are quadrilaterals.
  std::optional<Index> opposite_face() const {
    const auto faces = faces_[element_];
    const std::size_t n = below_.size();
    if (faces.size() != n + 2) return {};
    std::optional<Index> top;
    for (const Index f : faces) {
      const Face nodes = topology_.face(f).nodes;
      const auto shared = static_cast<std::size_t>(std::ranges::count_if(
          nodes, [&](Index node) { return index_of(below_, node) < below_.size(); }));
      if (shared == n && nodes.size() == n) continue;  // the face below
      if (shared == 0 && nodes.size() == n && !top)
        top = f;
      else if (shared != 2 || nodes.size() != 4)
        return {};
    }
    return top;
  }

  const Topology& topology_;
  SpacePoints x_;
  const CompressedRows& faces_;
  Face below_;  // the face of the element towards the wall
  Index element_;
};

double larger_over_smaller(double a, double b) { return std::max(a, b) / std::min(a, b); }

}  // namespace

std::vector<NeighbourRatio> space_column_growth(const Mesh& mesh, const Wall& wall,
                                                const CompressedRows& faces) {
  std::vector<NeighbourRatio> ratios;
  for (const SurfaceFace& face : wall.faces) {
    SpaceColumn column(mesh, faces, face);
    std::optional<SpaceColumn::Cell> last = column.next();
    while (const std::optional<SpaceColumn::Cell> cell = last ? column.next() : std::nullopt) {
      ratios.push_back(
          {{last->element, cell->element}, larger_over_smaller(cell->height, last->height)});
      last = cell;
    }
  }
  return ratios;
}

std::vector<NeighbourRatio> space_size_ratios(const Mesh& mesh, int threads) {
  const Topology& topology = *mesh.topology;
  std::vector<double> lengths(at(topology.element_count()));  // cube roots of volumes
  parallel_for(threads, topology.element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e) {
      const auto corners = topology.element(e);
      lengths[at(e)] = std::cbrt(signed_volume6(mesh.coordinates, topology.shape(e), corners,
                                                mesh.coordinates.xyz(corners[0])));
    }
  });
  std::vector<NeighbourRatio> ratios;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const std::array<Index, 2> pair = topology.face(f).elements;
    if (pair[1] < 0) continue;
    const double a = lengths[at(pair[0])], b = lengths[at(pair[1])];
    if (a > 0 && b > 0) ratios.push_back({pair, larger_over_smaller(a, b)});
  }
  return ratios;
}

}  // namespace winslow
