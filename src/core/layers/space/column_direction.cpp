#include "core/layers/space/column_direction.h"

#include <Eigen/Geometry>

#include "core/error.h"

namespace winslow {

namespace {

/// Smallest cosine to a direction.
double least_cosine(const Vec3& direction, std::span<const Vec3> normals) {
  double least = 1;
  for (const Vec3& n : normals) least = std::min(least, direction.dot(n));
  return least;
}

constexpr double round_off = 1e-13;
bool holds(const Cone& cone, const Vec3& n) { return cone.axis.dot(n) >= cone.cosine - round_off; }

/// The cone with two vectors on opposite sides.
Cone cone_through(const Vec3& a, const Vec3& b) {
  const Vec3 sum = a + b;
  const double length = sum.norm();
  if (!(length > 1e-12)) return {a, -1};
  const Vec3 axis = sum / length;
  return {axis, std::min(axis.dot(a), axis.dot(b))};
}

/// The cone through three vectors.
Cone cone_through(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 across = (b - a).cross(c - a);
  const double length = across.norm();
  if (!(length > 1e-14)) return cone_through(a, b);
  Vec3 axis = across / length;
  if (axis.dot(a) < 0) axis = -axis;
  return {axis, least_cosine(axis, std::array<Vec3, 3>{a, b, c})};
}

/// The narrowest cone around the first vectors, of which one or two are on it.
Cone cone_with(std::span<const Vec3> inside, const Vec3& a, const Vec3& b) {
  Cone cone = cone_through(a, b);
  for (const Vec3& c : inside)
    if (!holds(cone, c)) cone = cone_through(a, b, c);
  return cone;
}
Cone cone_with(std::span<const Vec3> inside, const Vec3& a) {
  Cone cone{a, 1};
  for (std::size_t k = 0; k < inside.size(); ++k)
    if (!holds(cone, inside[k])) cone = cone_with(inside.first(k), a, inside[k]);
  return cone;
}

}  // namespace

Cone narrowest_cone(std::span<const Vec3> normals) {
  Cone cone{normals.front(), 1};
  for (std::size_t k = 1; k < normals.size(); ++k)
    if (!holds(cone, normals[k])) cone = cone_with(normals.first(k), normals[k]);
  cone.cosine = least_cosine(cone.axis, normals);
  return cone;
}

namespace {

/// Finds the directions at the nodes of a wall.
class DirectionFinder {
 public:
  DirectionFinder(const Mesh& mesh, const WallSurface& surface)
      : mesh_(mesh), surface_(surface), x_(mesh.coordinates) {}

  std::vector<ColumnDirection> find() {
    const auto count = static_cast<Index>(surface_.nodes.size());
    for (Index i = 0; i < count; ++i) {
      find_normals(i);
      directions_.push_back(surface_.rim_faces_at[i].empty() ? inner() : at_rim(i));
      require_good(i);
    }
    smooth();
    return std::move(directions_);
  }

 private:
  /// The unit normals of the wall around a node.
  void find_normals(Index i) {
    normals_.clear();
    for (const Index f : surface_.faces_at[i]) normals_.push_back(surface_.faces[at(f)].normal);
  }

  ColumnDirection inner() const { return {narrowest_cone(normals_).axis}; }

  ColumnDirection at_rim(Index i) const {
    const std::vector<Vec3> planes = planes_at(i);
    if (planes.size() == 1) return in_plane(planes[0]);
    if (planes.size() == 2 && planes[0].dot(planes[1]) < std::cos(radians(least_corner)))
      return along_both(planes[0], planes[1]);
    return along_edge(i);
  }

  /// The normals of the boundary without layers at a node, those of one plane once.
  std::vector<Vec3> planes_at(Index i) const {
    std::vector<Vec3> planes;
    for (const Index f : surface_.rim_faces_at[i]) {
      const Vec3& n = surface_.rim_faces[at(f)].normal;
      const auto same = [&](const Vec3& s) { return s.cross(n).norm() < flat && s.dot(n) > 0; };
      if (std::ranges::none_of(planes, same)) planes.push_back(n);
    }
    return planes;
  }

  /// The cone around the normals and their mirror images has its axis in the mirror.
  ColumnDirection in_plane(const Vec3& plane) const {
    std::vector<Vec3> both = normals_;
    for (const Vec3& n : normals_) both.push_back(n - 2 * n.dot(plane) * plane);
    const Vec3 axis = narrowest_cone(both).axis;
    const Vec3 in_it = axis - axis.dot(plane) * plane;
    const double length = in_it.norm();
    return {length > 0 ? Vec3(in_it / length) : axis, 1, true};
  }

  ColumnDirection along_both(const Vec3& a, const Vec3& b) const {
    Vec3 line = a.cross(b).normalized();
    if (least_cosine(line, normals_) < least_cosine(-line, normals_)) line = -line;
    return {line, 1, true};
  }

  /// Along the edge of the boundary without layers that sees the wall best.
  ColumnDirection along_edge(Index i) const {
    const Index node = surface_.nodes[at(i)];
    ColumnDirection best{Vec3(0, 0, 0), 1, true};
    double most = -2;
    for (const Index f : surface_.rim_faces_at[i]) {
      const Face& face = surface_.rim_faces[at(f)].nodes;
      const std::size_t k = index_of(face, node), n = face.size();
      for (const Index other : {face[(k + 1) % n], face[(k + n - 1) % n]}) {
        if (surface_.number(other) >= 0) continue;
        const Vec3 edge = x_[other] - x_[node];
        const double cosine = least_cosine(edge.normalized(), normals_);
        if (cosine <= most) continue;
        most = cosine;
        best.direction = edge.normalized();
        best.edge = edge.norm();
      }
    }
    return best;
  }

  void require_good(Index i) {
    constexpr double blind = 0.1;
    ColumnDirection& column = directions_.back();
    const double cosine = least_cosine(column.direction, normals_);
    const std::string place = node_text(mesh_, surface_.nodes[at(i)]);
    const bool blunt = narrowest_cone(normals_).cosine >= 1 / most_slant;
    if (column.along_boundary && blunt && cosine < 1 / most_slant) {
      throw UsageError(
          "the wall ends at " + place +
          ", where it goes on almost straight into a boundary without layers; layers "
          "can end only at a boundary across the wall: give that boundary layers, too");
    }
    if (cosine <= blind) {
      throw UsageError("no direction sees all faces of the wall around " + place +
                       "; layers cannot stand there: mesh the wall anew around it, or give layers "
                       "to other markers only");
    }
    if (cosine < 1 / most_slant) {
      throw UsageError("the wall turns too sharply at " + place + ", by " + turning_text(i) +
                       ": a column of layers would lean by " + degrees_text(std::acos(cosine)) +
                       "; such ridges cannot have layers yet");
    }
    column.slant = 1 / cosine;
  }

  static std::string degrees_text(double angle) {
    return std::to_string(std::lround(degrees(angle))) + " degrees";
  }
  std::string turning_text(Index i) const {
    double most = 0;
    for (const Index e : surface_.edges_at[i])
      most = std::max(most, std::abs(surface_.edges[at(e)].turning));
    return degrees_text(most);
  }

  /// Moves directions towards the mean of those around them.
  void smooth() {
    constexpr int passes = 5;
    constexpr double worth = 1.02;  // of the least slant
    const std::vector<unsigned char> free = smooth_nodes();
    const std::vector<ColumnDirection> first = directions_;
    for (int pass = 0; pass < passes; ++pass) {
      const std::vector<ColumnDirection> old = directions_;
      for (Index i = 0; i < static_cast<Index>(old.size()); ++i) {
        if (free[at(i)] == 0) continue;
        Vec3 sum(0, 0, 0);
        for (const Index e : surface_.edges_at[i]) {
          const Index j = other_end(e, i);
          if (free[at(j)] != 0) sum += old[at(j)].direction;
        }
        if (!(sum.norm() > 0)) continue;
        const Vec3 next = (old[at(i)].direction + sum.normalized()).normalized();
        find_normals(i);
        const double cosine = least_cosine(next, normals_);
        if (!(cosine * worth * first[at(i)].slant >= 1) || cosine < 1 / most_slant) continue;
        directions_[at(i)].direction = next;
        directions_[at(i)].slant = 1 / cosine;
      }
    }
  }

  /// The nodes at which the wall neither ends nor turns sharply (#nodes).
  std::vector<unsigned char> smooth_nodes() const {
    constexpr double ridge = 30;  // degrees
    std::vector<unsigned char> free(surface_.nodes.size(), 1);
    for (const WallEdge& edge : surface_.edges) {
      if (!edge.at_rim() && std::abs(edge.turning) < radians(ridge)) continue;
      for (const Index node : edge.nodes) free[at(surface_.number(node))] = 0;
    }
    return free;
  }

  Index other_end(Index e, Index i) const {
    const auto& ends = surface_.edges[at(e)].nodes;
    return surface_.number(ends[0] == surface_.nodes[at(i)] ? ends[1] : ends[0]);
  }

  /// Faces of one plane differ by less than that (radians), also in files with six digits.
  static constexpr double flat = 2e-3;
  static constexpr double least_corner = 20;  // degrees between planes that meet in a corner

  const Mesh& mesh_;
  const WallSurface& surface_;
  const SpacePoints x_;
  std::vector<Vec3> normals_;
  std::vector<ColumnDirection> directions_;
};

}  // namespace

std::vector<ColumnDirection> column_directions(const Mesh& mesh, const WallSurface& surface) {
  return DirectionFinder(mesh, surface).find();
}

}  // namespace winslow
