#include "core/mesh/element_type.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/error.h"
#include "core/mesh/index_sets.h"

namespace winslow {

Face::Face(std::span<const Index> nodes) : count_(static_cast<Index>(nodes.size())) {
  if (nodes.size() < 2)
    throw UsageError("a face of " + std::to_string(nodes.size()) + " nodes, expected 2 or more");
  if (is_long()) {
    auto list = std::make_unique<Index[]>(nodes.size());
    std::copy(nodes.begin(), nodes.end(), list.get());
    put_list(std::move(list));
  } else {
    std::copy(nodes.begin(), nodes.end(), nodes_.begin());
  }
}

const Index* Face::list() const {
  const Index* address = nullptr;
  std::memcpy(&address, nodes_.data(), sizeof address);
  return address;
}

void Face::put_list(std::unique_ptr<Index[]> nodes) {
  const Index* address = nodes.release();
  std::memcpy(nodes_.data(), &address, sizeof address);
}

void Face::own_list() {
  auto copy = std::make_unique<Index[]>(size());
  std::copy_n(list(), size(), copy.get());
  put_list(std::move(copy));
}

void Face::free_list() const { delete[] list(); }

Face Face::long_reversed() const {
  Face out = *this;
  auto nodes = std::make_unique<Index[]>(size());
  nodes[0] = (*this)[0];
  std::reverse_copy(begin() + 1, end(), nodes.get() + 1);
  out.free_list();
  out.put_list(std::move(nodes));
  return out;
}

void Face::refuse_edge() const {
  throw UsageError("a face with " + nodes_text(*this) +
                   " where an edge of a plane or surface mesh is expected");
}

Face Face::sorted() const {
  Face all = *this;
  if (is_long()) {
    auto list = std::make_unique<Index[]>(size());
    std::copy(begin(), end(), list.get());
    std::sort(list.get(), list.get() + size());
    all.free_list();
    all.put_list(std::move(list));
    return all;
  }
  // As unsigned numbers, -1 comes last.
  const auto order = [&](std::size_t a, std::size_t b) {
    if (static_cast<std::uint32_t>(all.nodes_[b]) < static_cast<std::uint32_t>(all.nodes_[a]))
      std::swap(all.nodes_[a], all.nodes_[b]);
  };
  order(0, 1);
  order(2, 3);
  order(0, 2);
  order(1, 3);
  order(1, 2);
  return all;
}

std::string nodes_text(const Face& face) {
  std::string text = "nodes";
  for (std::size_t k = 0; k < face.size(); ++k) {
    text += k == 0 ? " " : k + 1 < face.size() ? ", " : " and ";
    text += std::to_string(face[k]);
  }
  return text;
}

namespace {

using Point = std::array<double, 3>;
using Edge = std::array<Index, 2>;
constexpr Edge edge(Index a, Index b) { return {a, b}; }

/// The shape of one type without its links, which follow from the faces.
template <std::size_t Corners, std::size_t Edges, std::size_t Faces>
struct Table {
  std::string_view name;
  int dimension;
  std::array<Point, Corners> corners;
  std::array<Edge, Edges> edges;
  std::array<Face, Faces> faces;
  std::array<Index, Corners> mirrored;
};

/// The corner after `from` in the link of a corner. Each face at the corner gives one side of the
/// link, from the previous corner of the face to the next one.
template <std::size_t Faces>
constexpr Index next_in_link(const std::array<Face, Faces>& faces, Index corner, Index from) {
  for (const Face& face : faces) {
    const std::size_t n = face.size(), k = index_of(face, corner);
    if (k < n && face[(k + n - 1) % n] == from) return face[(k + 1) % n];
  }
  return -1;
}

template <std::size_t Corners, std::size_t Edges, std::size_t Faces>
constexpr Face link_of(const Table<Corners, Edges, Faces>& table, Index corner) {
  constexpr auto n = static_cast<Index>(Corners);
  if (table.dimension == 2) return {(corner + 1) % n, (corner + n - 1) % n};
  Index first = -1;
  for (const Face& face : table.faces) {
    const std::size_t k = index_of(face, corner);
    if (first < 0 && k < face.size()) first = face[(k + 1) % face.size()];
  }
  const Index second = next_in_link(table.faces, corner, first);
  const Index third = next_in_link(table.faces, corner, second);
  const Index fourth = next_in_link(table.faces, corner, third);
  return fourth == first ? Face(first, second, third) : Face(first, second, third, fourth);
}

template <std::size_t Corners, std::size_t Edges, std::size_t Faces>
constexpr std::array<Face, Corners> links_of(const Table<Corners, Edges, Faces>& table) {
  std::array<Face, Corners> links;
  if constexpr (Corners > 0)
    for (std::size_t k = 0; k < Corners; ++k) links[k] = link_of(table, static_cast<Index>(k));
  return links;
}

constexpr Table<3, 3, 3> triangle{.name = "triangle",
                                  .dimension = 2,
                                  .corners = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                                  .edges = {{{0, 1}, {1, 2}, {2, 0}}},
                                  .faces = {Face(0, 1), Face(1, 2), Face(2, 0)},
                                  .mirrored = {0, 2, 1}};
constexpr Table<4, 4, 4> quadrilateral{.name = "quadrilateral",
                                       .dimension = 2,
                                       .corners = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}},
                                       .edges = {{{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
                                       .faces = {Face(0, 1), Face(1, 2), Face(2, 3), Face(3, 0)},
                                       .mirrored = {0, 3, 2, 1}};
constexpr Table<4, 6, 4> tetrahedron{
    .name = "tetrahedron",
    .dimension = 3,
    .corners = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
    .edges = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}},
    .faces = {Face(0, 2, 1), Face(0, 1, 3), Face(1, 2, 3), Face(2, 0, 3)},
    .mirrored = {0, 2, 1, 3}};
constexpr Table<5, 8, 5> pyramid{
    .name = "pyramid",
    .dimension = 3,
    .corners = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}}},
    .edges = {{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}},
    .faces = {Face(0, 3, 2, 1), Face(0, 1, 4), Face(1, 2, 4), Face(2, 3, 4), Face(3, 0, 4)},
    .mirrored = {0, 3, 2, 1, 4}};
constexpr Table<6, 9, 5> prism{
    .name = "prism",
    .dimension = 3,
    .corners = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}},
    .edges = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 4}, {2, 5}, {3, 4}, {4, 5}, {5, 3}}},
    .faces = {Face(0, 1, 4, 3), Face(1, 2, 5, 4), Face(2, 0, 3, 5), Face(0, 2, 1), Face(3, 4, 5)},
    .mirrored = {0, 2, 1, 3, 5, 4}};
constexpr Table<8, 12, 6> hexahedron{
    .name = "hexahedron",
    .dimension = 3,
    .corners =
        {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}},
    .edges = {edge(0, 1), edge(1, 2), edge(2, 3), edge(3, 0), edge(0, 4), edge(1, 5), edge(2, 6),
              edge(3, 7), edge(4, 5), edge(5, 6), edge(6, 7), edge(7, 4)},
    .faces = {Face(0, 3, 2, 1), Face(0, 1, 5, 4), Face(1, 2, 6, 5), Face(2, 3, 7, 6),
              Face(0, 4, 7, 3), Face(4, 5, 6, 7)},
    .mirrored = {0, 3, 2, 1, 4, 7, 6, 5}};

constexpr Table<0, 0, 0> polyhedron{
    .name = "polyhedron", .dimension = 3, .corners = {}, .edges = {}, .faces = {}, .mirrored = {}};
constexpr Table<0, 0, 0> polygon{
    .name = "polygon", .dimension = 2, .corners = {}, .edges = {}, .faces = {}, .mirrored = {}};

template <const auto& table>
constexpr auto links = links_of(table);

std::vector<std::array<Index, 3>> make_triangles(const ElementShape& shape) {
  std::vector<std::array<Index, 3>> list;
  for (std::size_t k = 0; k < shape.links.size(); ++k)
    list.push_back({static_cast<Index>(k), shape.links[k][0], shape.links[k][1]});
  return list;
}

std::vector<std::array<Index, 4>> make_at_corners(const ElementShape& shape) {
  std::vector<std::array<Index, 4>> list;
  const auto links = shape.links;
  const std::size_t corners = shape.type == ElementType::tetrahedron ? 1 : links.size();
  for (std::size_t k = 0; k < corners; ++k) {
    if (links[k].size() == 3)
      list.push_back({static_cast<Index>(k), links[k][0], links[k][1], links[k][2]});
  }
  return list;
}

bool are_linked(const ElementShape& shape, Index a, Index b) {
  const Face& link = shape.links[at(a)];
  return std::find(link.begin(), link.end(), b) != link.end();
}

/// The corner opposite to a in the quadrilateral with the edges (a, b) and (a, y); -1 if that face
/// is a triangle.
Index across(const ElementShape& shape, Index a, Index b, Index y) {
  for (const Index corner : shape.links[at(b)])
    if (corner != a && corner != y && are_linked(shape, corner, y)) return corner;
  return -1;
}

std::vector<std::array<Index, 4>> make_at_edges(const ElementShape& shape) {
  std::vector<std::array<Index, 4>> list;
  if (shape.type != ElementType::hexahedron && shape.type != ElementType::prism) return list;
  for (const auto& [a, b] : shape.edges) {
    const Face& link = shape.links[at(a)];
    const std::size_t place = index_of(link, b);
    const Index y = link[(place + 1) % 3], z = link[(place + 2) % 3];
    if (are_linked(shape, b, y) || are_linked(shape, b, z)) continue;  // of a triangle
    list.push_back({a, b, y, across(shape, a, b, z)});
    list.push_back({a, b, across(shape, a, b, y), z});
  }
  return list;
}

/// The shape of a type with the triangles or tetrahedra, which follow from the links.
struct FixedShape {
  template <const auto& table>
  static FixedShape of(ElementType type) {
    FixedShape made{{.type = type,
                     .name = table.name,
                     .dimension = table.dimension,
                     .corners = table.corners,
                     .edges = table.edges,
                     .faces = table.faces,
                     .links = links<table>,
                     .mirrored = table.mirrored}};
    if (table.dimension == 2) {
      made.triangles = make_triangles(made.shape);
      made.shape.corner_triangles = made.triangles;
      made.shape.real_corners = static_cast<Index>(made.triangles.size());
      return made;
    }
    made.at_corners = make_at_corners(made.shape);
    made.at_edges = make_at_edges(made.shape);
    made.shape.corner_tetrahedra = made.at_corners;
    made.shape.edge_tetrahedra = made.at_edges;
    return made;
  }

  ElementShape shape;
  std::vector<std::array<Index, 3>> triangles = {};
  std::vector<std::array<Index, 4>> at_corners = {}, at_edges = {};
};

}  // namespace

const ElementShape& shape_of(ElementType type) {
  static const std::array<FixedShape, element_type_count> shapes{
      FixedShape::of<triangle>(ElementType::triangle),
      FixedShape::of<quadrilateral>(ElementType::quadrilateral),
      FixedShape::of<tetrahedron>(ElementType::tetrahedron),
      FixedShape::of<pyramid>(ElementType::pyramid),
      FixedShape::of<prism>(ElementType::prism),
      FixedShape::of<hexahedron>(ElementType::hexahedron),
      FixedShape::of<polyhedron>(ElementType::polyhedron),
      FixedShape::of<polygon>(ElementType::polygon)};
  return shapes[static_cast<std::size_t>(type)].shape;
}

std::span<const std::array<Index, 4>> corner_tetrahedra(ElementType type) {
  return shape_of(type).corner_tetrahedra;
}

std::span<const std::array<Index, 4>> edge_tetrahedra(ElementType type) {
  return shape_of(type).edge_tetrahedra;
}

std::span<const std::array<double, 3>> regular_corners(ElementType type) {
  using Corners = std::vector<std::array<double, 3>>;
  static const double half = 0.5, third = std::sqrt(3.0) / 6, high = std::sqrt(3.0) / 2;
  static const Corners tetrahedron{
      {0, 0, 0}, {1, 0, 0}, {half, high, 0}, {half, third, std::sqrt(2.0 / 3.0)}};
  static const Corners pyramid{
      {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {half, half, std::sqrt(0.5)}};
  static const Corners prism{{0, 0, 0}, {1, 0, 0}, {half, high, 0},
                             {0, 0, 1}, {1, 0, 1}, {half, high, 1}};
  switch (type) {
    case ElementType::tetrahedron:
      return tetrahedron;
    case ElementType::pyramid:
      return pyramid;
    case ElementType::prism:
      return prism;
    default:
      return shape_of(type).corners;  // the unit cube
  }
}

namespace {

double triple(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); }

}  // namespace

double signed_area2(const Coordinates& x, std::span<const Index> corners) {
  const Vec2 o = x.xy(corners[0]);
  double sum = 0;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    sum += cross(x.xy(corners[k]) - o, x.xy(corners[k + 1]) - o);
  return sum;
}

double signed_volume6(const Coordinates& x, const Face& nodes, const Vec3& origin) {
  const auto place = [&](std::size_t k) { return Vec3(x.xyz(nodes[k]) - origin); };
  const Vec3 a = place(0), b = place(1), c = place(2);
  if (nodes.size() == 3) return triple(a, b, c);
  if (nodes.size() == 4) {  // the mean over both ways to cut the quadrilateral into triangles
    const Vec3 d = place(3);
    return 0.5 * (triple(a, b, c) + triple(a, c, d) + triple(a, b, d) + triple(b, c, d));
  }
  const std::size_t n = nodes.size();
  Vec3 middle = Vec3::Zero();
  for (std::size_t k = 0; k < n; ++k) middle += place(k);
  middle /= static_cast<double>(n);
  double sum = 0;
  for (std::size_t k = 0; k < n; ++k) sum += triple(middle, place(k), place((k + 1) % n));
  return sum;
}

double signed_volume6(const Coordinates& x, const ElementShape& shape,
                      std::span<const Index> corners, const Vec3& origin) {
  double sum = 0;
  for (const Face& face : shape.faces) sum += signed_volume6(x, by_nodes(face, corners), origin);
  return sum;
}

}  // namespace winslow
