#include "core/mesh/polyhedron.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "core/mesh/index_sets.h"

namespace winslow {

namespace {

/// Sine of a corner, its volume over that of a cube with its edges, below which it is flat. Cells
/// along curved walls have nodes in faces that are nearly plane.
constexpr double flat_sine = 0.2;

double sine_of(const std::array<Index, 4>& nodes, std::span<const Vec3> places) {
  const Vec3& p = places[at(nodes[0])];
  const Vec3 a = places[at(nodes[1])] - p, b = places[at(nodes[2])] - p,
             c = places[at(nodes[3])] - p;
  const double lengths = a.norm() * b.norm() * c.norm();
  return lengths > 0 ? a.dot(b.cross(c)) / lengths : 0;
}

/// Whether a corner is much flatter than half of them, or inverted (has_flat_corner).
bool flat_among(std::span<const std::array<Index, 4>> corners, std::span<const Vec3> places) {
  constexpr double flat = 0.1, of_median = 0.25;
  std::vector<double> sines;
  for (const std::array<Index, 4>& corner : corners) sines.push_back(sine_of(corner, places));
  if (sines.empty()) return false;
  std::ranges::sort(sines);
  const double least = sines.front();
  return !(least > 0) || (least < flat && least < of_median * sines[sines.size() / 2]);
}

/// The type with so many triangles and quadrilaterals; each has one closed arrangement of them.
ElementType type_like(std::span<const Face> faces, std::size_t corners) {
  const auto triangles = std::ranges::count(faces, 3U, &Face::size);
  const auto squares = std::ranges::count(faces, 4U, &Face::size);
  if (triangles + squares != std::ssize(faces)) return ElementType::polyhedron;
  if (corners == 4 && triangles == 4 && squares == 0) return ElementType::tetrahedron;
  if (corners == 5 && triangles == 4 && squares == 1) return ElementType::pyramid;
  if (corners == 6 && triangles == 2 && squares == 3) return ElementType::prism;
  if (corners == 8 && triangles == 0 && squares == 6) return ElementType::hexahedron;
  return ElementType::polyhedron;
}

std::string corners_text(Index a, Index b) {
  return "corners " + std::to_string(a) + " and " + std::to_string(b);
}

}  // namespace

PolyhedronShape::PolyhedronShape(std::span<const Face> faces, std::span<const Vec3> places)
    : faces_(faces.begin(), faces.end()) {
  find_edges(places.size());
  find_links(places.size());
  find_tetrahedra(places);
  shape_ = {.type = ElementType::polyhedron,
            .name = "polyhedron",
            .dimension = 3,
            .corners = {},
            .edges = edges_,
            .faces = faces_,
            .links = links_,
            .mirrored = {},
            .corner_tetrahedra = at_corners_,
            .edge_tetrahedra = at_edges_,
            .face_tetrahedra = at_faces_,
            .face_sizes = face_sizes_,
            .like = like_,
            .real_corners = count_real(places)};
}

std::size_t PolyhedronShape::bytes() const {
  return sizeof(*this) +
         bytes_of(faces_, links_, edges_, at_corners_, at_edges_, at_faces_, face_sizes_);
}

/// Lists each edge once, in the direction of the first face that has it.
void PolyhedronShape::find_edges(std::size_t corners) {
  if (faces_.size() < 4)
    throw PolyhedronFault{"has " + std::to_string(faces_.size()) + " faces, expected 4 or more"};
  std::map<std::array<Index, 2>, int> directed;
  for (const Face& face : faces_)
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::array<Index, 2> edge{face[k], face[(k + 1) % face.size()]};
      if (edge[0] < 0 || at(edge[0]) >= corners || edge[0] == edge[1] || ++directed[edge] > 1)
        throw PolyhedronFault{"has two faces in the same direction at the edge between " +
                              corners_text(edge[0], edge[1]) + ", expected opposite ones"};
    }
  for (const auto& [edge, count] : directed) {
    if (!directed.contains({edge[1], edge[0]}))
      throw PolyhedronFault{"has one face at the edge between " + corners_text(edge[0], edge[1]) +
                            ", expected two: its faces are not closed"};
    if (edge[0] < edge[1]) edges_.push_back(edge);
  }
}

/// The link of a corner is clockwise seen from it: each face at the corner leads from the corner
/// before it to the corner behind it, as ElementShape::links.
void PolyhedronShape::find_links(std::size_t corners) {
  std::vector<std::map<Index, Index>> next(corners);
  for (const Face& face : faces_)
    for (std::size_t k = 0, n = face.size(); k < n; ++k)
      next[at(face[k])][face[(k + n - 1) % n]] = face[(k + 1) % n];
  for (std::size_t corner = 0; corner < corners; ++corner) {
    const auto& around = next[corner];
    if (around.size() < 2)
      throw PolyhedronFault{"has a corner with fewer than two faces: corner " +
                            std::to_string(corner)};
    std::vector<Index> link;
    Index k = around.begin()->first;
    do {
      link.push_back(k);
      k = around.at(k);
    } while (k != link.front() && link.size() <= around.size());
    if (link.size() != around.size())
      throw PolyhedronFault{"meets itself in corner " + std::to_string(corner) +
                            ", expected one fan of faces there"};
    links_.emplace_back(std::span<const Index>(link));
  }
}

void PolyhedronShape::find_tetrahedra(std::span<const Vec3> places) {
  like_ = type_like(faces_, places.size());
  std::vector<std::array<Index, 4>> corners;
  for (std::size_t k = 0; k < places.size(); ++k)
    if (const Face& link = links_[k]; link.size() == 3)
      corners.push_back({static_cast<Index>(k), link[0], link[1], link[2]});
  // A hexahedron with a corner in a flat part of a wall is none.
  if (flat_among(corners, places)) like_ = ElementType::polyhedron;
  const bool known = like_ != ElementType::polyhedron;
  flat_.assign(places.size(), false);
  const auto is_flat = [&](const Face& link, std::size_t corner) {
    const auto n = link.size();
    for (std::size_t k = 0; k < (n > 3 ? n : n - 2); ++k)
      if (std::abs(
              sine_of({static_cast<Index>(corner), link[k], link[(k + 1) % n], link[(k + 2) % n]},
                      places)) >= flat_sine)
        return false;
    return true;
  };
  for (std::size_t k = 0; k < places.size() && !known; ++k) flat_[k] = is_flat(links_[k], k);
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Face& link = links_[k];
    const auto corner = static_cast<Index>(k);
    if (known && places.size() == 4 && k > 0) break;  // the same tetrahedron again
    if (link.size() == 3) {
      const std::array<Index, 4> nodes{corner, link[0], link[1], link[2]};
      if (!known && sine_of(nodes, places) < flat_sine) continue;
      at_corners_.push_back(nodes);
      face_sizes_.push_back({sides_of_face(corner, link[1], link[0]),
                             sides_of_face(corner, link[2], link[1]),
                             sides_of_face(corner, link[0], link[2])});
    } else if (link.size() > 3 && !known) {
      add_fan(corner, places);
    }
  }
  add_edge_tetrahedra(places);
  add_face_tetrahedra(places);
}

/// The tetrahedra at a corner with more than three edges.
void PolyhedronShape::add_fan(Index corner, std::span<const Vec3> places) {
  const Face& link = links_[at(corner)];
  const std::size_t n = link.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Index a = link[k], b = link[(k + 1) % n], c = link[(k + 2) % n];
    const std::array<Index, 4> nodes{corner, a, b, c};
    if (sine_of(nodes, places) < flat_sine) continue;
    at_corners_.push_back(nodes);
    face_sizes_.push_back({0, 0, 0});
  }
}

/// As edge_tetrahedra() of prisms and hexahedra: for each edge between two faces that are no
/// triangles, an edge at one end and an edge at the other that lies in the other face.
void PolyhedronShape::add_edge_tetrahedra(std::span<const Vec3> places) {
  const auto after = [&](Index from, Index to) {  // the corner behind the edge in its face
    const Face& link = links_[at(to)];
    return link[(index_of(link, from) + 1) % link.size()];
  };
  const auto before = [&](Index from, Index to) {  // the corner before the edge in its face
    const Face& link = links_[at(from)];
    return link[(index_of(link, to) + link.size() - 1) % link.size()];
  };
  for (const auto& [a, b] : edges_) {
    if (flat_[at(a)] || flat_[at(b)] || links_[at(a)].size() != 3 || links_[at(b)].size() != 3)
      continue;
    // The face with the edge from a to b is ..., y, a, b, p, ...; the other one ..., q, b, a, z.
    const Index y = before(a, b), p = after(a, b), q = before(b, a), z = after(b, a);
    if (y == p || q == z) continue;  // of a triangle
    for (const std::array<Index, 4>& nodes : {std::array<Index, 4>{a, b, q, y}, {a, b, z, p}})
      if (sine_of(nodes, places) >= flat_sine) at_edges_.push_back(nodes);
  }
}

void PolyhedronShape::add_face_tetrahedra(std::span<const Vec3> places) {
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (!flat_[k]) continue;
    const Face& link = links_[k];
    for (std::size_t i = 0; i < link.size(); ++i) {
      std::array<Index, 4> best{static_cast<Index>(k), link[i], link[(i + 1) % link.size()], -1};
      double largest = flat_sine;
      for (std::size_t p = 0; p < places.size(); ++p) {
        if (flat_[p]) continue;
        const std::array<Index, 4> nodes{best[0], best[1], best[2], static_cast<Index>(p)};
        const double sine = sine_of(nodes, places);
        if (sine <= largest) continue;
        largest = sine;
        best[3] = nodes[3];
      }
      if (best[3] >= 0) at_faces_.push_back(best);
    }
  }
}

/// Number of corners that are not flat of the face with the edges to these at a corner; 0 if there
/// is no such face.
std::uint8_t PolyhedronShape::sides_of_face(Index corner, Index next, Index previous) const {
  for (const Face& face : faces_) {
    const std::size_t n = face.size(), k = index_of(face, corner);
    if (k == n || face[(k + 1) % n] != next || face[(k + n - 1) % n] != previous) continue;
    const auto count = std::ranges::count_if(face, [&](Index other) { return !flat_[at(other)]; });
    return static_cast<std::uint8_t>(std::clamp<std::ptrdiff_t>(count, 3, 255));
  }
  return 0;
}

/// Number of corners that are neither flat nor inside a straight edge.
Index PolyhedronShape::count_real(std::span<const Vec3> places) const {
  constexpr double straight = -0.94;  // cosine of 160 degrees
  Index count = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    std::vector<Vec3> directions;
    for (const Index other : links_[k])
      directions.push_back((places[at(other)] - places[k]).normalized());
    bool inside_edge = false;
    for (std::size_t a = 0; a < directions.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        inside_edge |= directions[a].dot(directions[b]) < straight;
    if (!flat_[k] && !inside_edge) ++count;
  }
  return std::max<Index>(count, 4);
}

bool has_flat_corner(const ElementShape& type, std::span<const Vec3> places) {
  return flat_among(type.corner_tetrahedra, places);
}

double regular_volume(const ElementShape& shape) {
  constexpr double root_2 = 1.41421356237309505, root_3 = 1.73205080756887729, cube = 6 * root_2;
  switch (shape.like) {
    case ElementType::pyramid:
      return 2;
    case ElementType::prism:
      return 1.5 * root_2 * root_3;
    case ElementType::hexahedron:
      return cube;
    case ElementType::polyhedron:
      break;
    default:
      return 1;
  }
  const double n = shape.real_corners;
  return n <= 8 ? std::pow(n / 4, std::log2(cube)) : cube * std::pow(n / 8, 2.21);
}

std::array<Vec3, 3> regular_corner(const std::array<std::uint8_t, 3>& face_sizes) {
  constexpr double widest = 5.76;  // sum of the angles: 330 degrees
  std::array<double, 3> angles{};
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (face_sizes[k] == 0) return {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    angles[k] = pi * (1 - 2.0 / face_sizes[k]);
    sum += angles[k];
  }
  // Two small angles must together be wider than the third.
  for (std::size_t k = 0; k < 3; ++k) angles[k] = std::min(angles[k], 0.9 * (sum - angles[k]));
  sum = angles[0] + angles[1] + angles[2];
  if (sum > widest)
    for (double& angle : angles) angle *= widest / sum;
  // Gram matrix of unit vectors, by Cholesky.
  const double c01 = std::cos(angles[0]), c12 = std::cos(angles[1]), c20 = std::cos(angles[2]);
  const double s01 = std::sin(angles[0]), y = (c12 - c20 * c01) / s01;
  return {Vec3(1, 0, 0), Vec3(c01, s01, 0),
          Vec3(c20, y, std::sqrt(std::max(0.0, 1 - c20 * c20 - y * y)))};
}

}  // namespace winslow
