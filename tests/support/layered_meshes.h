#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "support/meshes.h"

/// Structured grids with layers at a wall, as a mesh generator gives them: without VCVs.
namespace winslow::test {

/// How the quadrilaterals of a structured grid are cut.
enum class Cut { none, forward, backward, alternating };

inline const char* name_of(Cut cut) {
  constexpr std::array names{"quadrilaterals", "cut forward", "cut backward", "cut alternately"};
  return names[static_cast<std::size_t>(cut)];
}

inline void add_cut_cell(MeshData& data, Cut cut, Index number, std::array<Index, 4> c) {
  const bool forward = cut == Cut::forward || (cut == Cut::alternating && number % 2 == 0);
  if (cut == Cut::none) {
    add_quad(data, c[0], c[1], c[2], c[3]);
  } else if (forward) {
    add_triangle(data, c[0], c[1], c[2]);
    add_triangle(data, c[0], c[2], c[3]);
  } else {
    add_triangle(data, c[0], c[1], c[3]);
    add_triangle(data, c[1], c[2], c[3]);
  }
}

/// Distances from the wall after each row: the first is `first` high, each next one `ratio` times
/// the one before, from row `growing` on all of one height.
inline std::vector<double> distances(Index rows, double first, double ratio, Index growing) {
  std::vector<double> result{0};
  double height = first;
  for (Index k = 0; k < rows; ++k) {
    result.push_back(result.back() + height);
    if (k + 1 < growing) height *= ratio;
  }
  return result;
}

/// An O-grid around an ellipse of half axes 1 and `slenderness`: rays normal to it. Markers "wall"
/// and "farfield". Rows of nodes from the wall outwards, `sectors` each.
inline MeshData o_grid(Index sectors, const std::vector<double>& distance, Cut cut,
                       double slenderness = 1) {
  MeshData data;
  for (const double d : distance) {
    for (Index i = 0; i < sectors; ++i) {
      const double phi = 2 * pi * i / sectors;
      const Vec2 normal = Vec2(slenderness * std::cos(phi), std::sin(phi)).normalized();
      data.coordinates.push_xy(Vec2(std::cos(phi), slenderness * std::sin(phi)) + d * normal);
    }
  }
  const auto rows = static_cast<Index>(distance.size()) - 1;
  const auto id = [&](Index k, Index i) { return k * sectors + i % sectors; };
  for (Index k = 0; k < rows; ++k) {
    for (Index i = 0; i < sectors; ++i) {
      add_cut_cell(data, cut, i + k, {id(k, i + 1), id(k, i), id(k + 1, i), id(k + 1, i + 1)});
    }
  }
  mark_boundary(data, [&](const Vec2& p) {
    return Vec2(p.x(), p.y() / slenderness).norm() < 1 ? "wall" : "farfield";
  });
  return data;
}

/// A C-grid around a symmetrical section of 2 chords with a sharp trailing edge at (1, 0) and a
/// wake of one chord behind it, along which its two ends are joined. Markers "wall" and "farfield".
/// sectors: cells on the section, even; as many again on the two sides of the wake together.
inline MeshData c_grid(Index sectors, const std::vector<double>& distance, Cut cut) {
  MeshData data;
  const Index wake = sectors / 2, columns = sectors + 2 * wake + 1;
  const auto section = [](double phi) {
    return Vec2(std::cos(phi), -0.1 * (1 - std::cos(phi)) * std::cos(0.5 * phi));
  };
  const auto base = [&](Index i) -> std::pair<Vec2, Vec2> {  // place and ray, clockwise
    if (i < wake) return {{1 + 2.0 * (wake - i) / wake, 0}, {0, -1}};
    if (i > wake + sectors) return {{1 + 2.0 * (i - wake - sectors) / wake, 0}, {0, 1}};
    if (i == wake) return {{1, 0}, {0, -1}};
    if (i == wake + sectors) return {{1, 0}, {0, 1}};
    const double phi = 2 * pi * (i - wake) / sectors;  // from the trailing edge, lower side first
    const double half = std::sin(0.5 * phi);           // rays turn evenly, so that none cross
    return {section(phi), Vec2(-half * half, -std::cos(0.5 * phi)).normalized()};
  };
  std::vector<std::vector<Index>> id(distance.size(), std::vector<Index>(at(columns)));
  for (std::size_t k = 0; k < distance.size(); ++k) {
    for (Index i = 0; i < columns; ++i) {
      const Index mirrored = columns - 1 - i;
      if (k == 0 && i > mirrored && (i >= wake + sectors)) {  // the other side of the wake
        id[k][at(i)] = id[k][at(mirrored)];
        continue;
      }
      const auto [p, normal] = base(i);
      id[k][at(i)] = data.coordinates.size();
      data.coordinates.push_xy(p + distance[k] * normal);
    }
  }
  for (std::size_t k = 0; k + 1 < distance.size(); ++k) {
    for (Index i = 0; i + 1 < columns; ++i) {
      const auto at_k = [&](std::size_t row, Index c) { return id[row][at(c)]; };
      add_cut_cell(data, cut, i + static_cast<Index>(k),
                   {at_k(k, i), at_k(k, i + 1), at_k(k + 1, i + 1), at_k(k + 1, i)});
    }
  }
  mark_boundary(data, [&](const Vec2& p) {
    return std::abs(p.x()) <= 1 && std::abs(p.y()) < 0.15 ? "wall" : "farfield";
  });
  return data;
}

/// Quadrilaterals inside a circle and outside another, stretched towards the inner one: each ring
/// `growth` times as high as the one before, the first of height `first`. turn: radians by which
/// lines off the wall lean, per unit of the radius. Markers "body" and "far".
inline MeshData ring_grid(Index sectors, Index rings, double first, double growth,
                          double turn = 0) {
  MeshData data;
  double radius = 1;
  for (Index i = 0; i <= rings; ++i) {
    for (Index j = 0; j < sectors; ++j) {
      const double phi = 2 * pi * j / sectors + turn * (radius - 1);
      data.coordinates.push_xy(radius * Vec2(std::cos(phi), std::sin(phi)));
    }
    radius += first * std::pow(growth, i);
  }
  const auto id = [&](Index i, Index j) { return i * sectors + j % sectors; };
  for (Index i = 0; i < rings; ++i)
    for (Index j = 0; j < sectors; ++j)
      add_quad(data, id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
  mark_boundary(data, [](const Vec2& p) { return p.norm() < 1 + 1e-9 ? "body" : "far"; });
  return data;
}

}  // namespace winslow::test
