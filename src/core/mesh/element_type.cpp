#include "core/mesh/element_type.h"

#include <algorithm>
#include <utility>

#include "core/error.h"

namespace winslow {

Face::Face(std::span<const Index> nodes) : count_(static_cast<Index>(nodes.size())) {
  if (nodes.size() < 2 || nodes.size() > 4) {
    throw UsageError("a face of " + std::to_string(nodes.size()) + " nodes, expected 2 to 4");
  }
  std::copy(nodes.begin(), nodes.end(), nodes_.begin());
}

void Face::refuse_edge() const {
  throw UsageError("a face with " + nodes_text(*this) +
                   " where an edge of a plane or surface mesh is expected");
}

std::array<Index, 4> Face::sorted() const {
  std::array<Index, 4> all = nodes_;
  // As unsigned numbers, -1 comes last.
  const auto order = [&](std::size_t a, std::size_t b) {
    if (static_cast<std::uint32_t>(all[b]) < static_cast<std::uint32_t>(all[a]))
      std::swap(all[a], all[b]);
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

/// Everything about one type but its links, which follow from the faces.
template <std::size_t Corners, std::size_t Edges, std::size_t Faces>
struct Table {
  std::string_view name;
  int dimension;
  std::array<Point, Corners> corners;
  std::array<Edge, Edges> edges;
  std::array<Face, Faces> faces;
  std::array<Index, Corners> mirrored;
};

/// Place of a corner in a face; the size of the face if it is not there.
constexpr std::size_t place_in(const Face& face, Index corner) {
  std::size_t k = 0;
  while (k < face.size() && face[k] != corner) ++k;
  return k;
}

/// The corner that follows `from` in the polygon that cuts a corner off: each face at the corner
/// gives one side of it, from the face's previous corner to its next one.
template <std::size_t Faces>
constexpr Index next_in_link(const std::array<Face, Faces>& faces, Index corner, Index from) {
  for (const Face& face : faces) {
    const std::size_t n = face.size(), k = place_in(face, corner);
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
    const std::size_t k = place_in(face, corner);
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
    .edges = {{{0, 1},
               {1, 2},
               {2, 3},
               {3, 0},
               {0, 4},
               {1, 5},
               {2, 6},
               {3, 7},
               {4, 5},
               {5, 6},
               {6, 7},
               {7, 4}}},
    .faces = {Face(0, 3, 2, 1), Face(0, 1, 5, 4), Face(1, 2, 6, 5), Face(2, 3, 7, 6),
              Face(0, 4, 7, 3), Face(4, 5, 6, 7)},
    .mirrored = {0, 3, 2, 1, 4, 7, 6, 5}};

template <const auto& table>
constexpr auto links = links_of(table);

template <const auto& table>
constexpr ElementShape shape{table.name,  table.dimension, table.corners, table.edges,
                             table.faces, links<table>,    table.mirrored};

}  // namespace

const ElementShape& shape_of(ElementType type) {
  static constexpr std::array<ElementShape, 6> shapes{shape<triangle>,    shape<quadrilateral>,
                                                      shape<tetrahedron>, shape<pyramid>,
                                                      shape<prism>,       shape<hexahedron>};
  return shapes[static_cast<std::size_t>(type)];
}

}  // namespace winslow
