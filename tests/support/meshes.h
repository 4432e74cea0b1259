#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/mesh/mesh.h"
#include "core/quality/quality.h"
#include "support/random.h"

/// Named meshes for tests. Elements are counter-clockwise; marker edges have the elements on their
/// left.
namespace winslow::test {

enum class Cells { triangles, quads, mixed };

inline const char* name_of(Cells cells) {
  return cells == Cells::triangles ? "triangles" : cells == Cells::quads ? "quads" : "mixed";
}

inline void add_triangle(MeshData& data, Index a, Index b, Index c) {
  const std::array<Index, 3> corners{a, b, c};
  data.add_element(ElementType::triangle, corners);
}
inline void add_quad(MeshData& data, Index a, Index b, Index c, Index d) {
  const std::array<Index, 4> corners{a, b, c, d};
  data.add_element(ElementType::quadrilateral, corners);
}

/// Puts every boundary edge into the marker that `name` gives for the middle of the edge.
inline void mark_boundary(MeshData& data, const std::function<std::string(const Vec2&)>& name) {
  std::map<std::pair<Index, Index>, int> uses;
  const auto each_side = [&](const auto& body) {
    for (Index e = 0; e < data.element_count(); ++e) {
      const auto c = data.element(e);
      for (std::size_t k = 0; k < c.size(); ++k) body(c[k], c[(k + 1) % c.size()]);
    }
  };
  each_side([&](Index a, Index b) { ++uses[std::minmax(a, b)]; });
  each_side([&](Index a, Index b) {
    if (uses[std::minmax(a, b)] != 1) return;
    const std::string marker = name(0.5 * (data.coordinates.xy(a) + data.coordinates.xy(b)));
    auto it = std::find_if(data.markers.begin(), data.markers.end(),
                           [&](const Marker& m) { return m.name == marker; });
    if (it == data.markers.end()) {
      it = data.markers.insert(it, Marker{marker, static_cast<int>(data.markers.size()) + 1, {}});
    }
    it->faces.emplace_back(a, b);
  });
}

/// One cell of a structured grid: a quadrilateral or two triangles.
inline void add_cell(MeshData& data, Cells cells, Index i, Index j, std::array<Index, 4> c) {
  const bool whole = cells == Cells::quads || (cells == Cells::mixed && (i / 2 + j / 2) % 2 == 0);
  if (whole) {
    add_quad(data, c[0], c[1], c[2], c[3]);
  } else {
    add_triangle(data, c[0], c[1], c[2]);
    add_triangle(data, c[0], c[2], c[3]);
  }
}

/// Opens a plane or volume mesh along a sheet without thickness: nodes of the sheet, but for its
/// rim, get a copy in the same place, for the elements whose centres lie above it. No markers yet.
inline MeshData opened(const MeshData& closed, const std::function<bool(const Vec3&)>& on_sheet,
                       const std::function<bool(const Vec3&)>& above) {
  MeshData data = closed;
  std::map<Index, Index> copies;
  for (Index node = 0; node < closed.node_count(); ++node) {
    const Vec3 place = place_of(closed.coordinates, node);
    if (!on_sheet(place)) continue;
    copies[node] = data.node_count();
    if (closed.coordinates.dimension() == 2)
      data.coordinates.push_xy(place.head<2>());
    else
      data.coordinates.push_xyz(place);
  }
  for (Index e = 0; e < closed.element_count(); ++e) {
    const auto corners = closed.element(e);
    Vec3 centre(0, 0, 0);
    for (const Index node : corners) centre += place_of(closed.coordinates, node);
    if (!above(centre / static_cast<double>(corners.size()))) continue;
    for (std::size_t k = 0; k < corners.size(); ++k)
      if (const auto copy = copies.find(corners[k]); copy != copies.end())
        data.element_nodes[at(closed.element_offsets[at(e)]) + k] = copy->second;
  }
  return data;
}

/// The error with which make_mesh() refuses the data. Throws if it accepts them.
inline MeshError refusal(const MeshData& data) {
  try {
    make_mesh(data);
  } catch (const MeshError& error) {
    return error;
  }
  throw std::logic_error("the mesh was accepted");
}

/// n by n cells on the unit square, without those that `hole` names; nodes that are left over are
/// dropped. No markers.
inline MeshData grid_with_holes(Index n, Cells cells,
                                const std::function<bool(Index, Index)>& hole) {
  MeshData data;
  std::map<std::pair<Index, Index>, Index> ids;
  const auto id = [&](Index i, Index j) {
    const auto [it, fresh] = ids.try_emplace({i, j}, data.node_count());
    if (fresh) data.coordinates.push_xy(Vec2(i, j) / n);
    return it->second;
  };
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i) {
      if (hole(i, j)) continue;
      const Index a = id(i, j), b = id(i + 1, j), c = id(i + 1, j + 1), d = id(i, j + 1);
      add_cell(data, cells, i, j, {a, b, c, d});
    }
  }
  return data;
}

/// n by n cells on the unit square; markers bottom, right, top, left.
inline MeshData square(Index n, Cells cells) {
  MeshData data = grid_with_holes(n, cells, [](Index, Index) { return false; });
  mark_boundary(data, [](const Vec2& p) {
    if (p.y() < 1e-9) return "bottom";
    if (p.y() > 1 - 1e-9) return "top";
    return p.x() < 0.5 ? "left" : "right";
  });
  return data;
}

/// Unit square of n by n cells (n a multiple of 10) with two square holes; markers outer, hole_a,
/// hole_b.
inline MeshData square_with_two_holes(Index n, Cells cells) {
  MeshData data = grid_with_holes(n, cells, [&](Index i, Index j) {
    const Index u = 10 * i / n, v = 10 * j / n;
    return (v >= 4 && v < 6) && ((u >= 2 && u < 4) || (u >= 6 && u < 8));
  });
  mark_boundary(data, [](const Vec2& p) {
    const Vec2 q = (p - Vec2(0.5, 0.5)).cwiseAbs();
    if (q.maxCoeff() > 0.5 - 1e-9) return "outer";
    return p.x() < 0.5 ? "hole_a" : "hole_b";
  });
  return data;
}

/// Unit square of n by n cells (n a multiple of 5) with one square hole; markers outer, hole.
inline MeshData square_with_hole(Index n, Cells cells) {
  MeshData data =
      grid_with_holes(n, cells, [&](Index i, Index j) { return 5 * i / n == 2 && 5 * j / n == 2; });
  mark_boundary(data, [](const Vec2& p) {
    const Vec2 q = (p - Vec2(0.5, 0.5)).cwiseAbs();
    return q.maxCoeff() > 0.5 - 1e-9 ? "outer" : "hole";
  });
  return data;
}

/// Rings around the origin, each `growth` times the radius of the one before, the first of radius
/// 1; markers inner, outer. Triangles: neighbouring rings are turned by half a cell, so that
/// interior nodes have six neighbours.
inline MeshData annulus(Index sectors, Index rings, double growth, Cells cells) {
  MeshData data;
  const bool staggered = cells == Cells::triangles;
  const double step = 2 * pi / sectors;
  for (Index i = 0; i <= rings; ++i) {
    for (Index j = 0; j < sectors; ++j) {
      const double phi = step * (j + (staggered && i % 2 == 1 ? 0.5 : 0.0));
      data.coordinates.push_xy(std::pow(growth, i) * Vec2(std::cos(phi), std::sin(phi)));
    }
  }
  const auto id = [&](Index i, Index j) { return i * sectors + (j + sectors) % sectors; };
  for (Index i = 0; i < rings; ++i) {
    for (Index j = 0; j < sectors; ++j) {
      if (!staggered) {
        add_cell(data, cells, i, j, {id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
      } else if (i % 2 == 0) {
        add_triangle(data, id(i, j), id(i + 1, j), id(i, j + 1));
        add_triangle(data, id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
      } else {
        add_triangle(data, id(i, j), id(i + 1, j), id(i + 1, j + 1));
        add_triangle(data, id(i, j), id(i + 1, j + 1), id(i, j + 1));
      }
    }
  }
  const double middle = 0.5 * (1 + std::pow(growth, rings));
  mark_boundary(data, [&](const Vec2& p) { return p.norm() < middle ? "inner" : "outer"; });
  return data;
}

/// The annulus of triangles that is the image under exp of a lattice of equilateral triangles.
inline MeshData conformal_annulus(Index sectors, Index rings) {
  return annulus(sectors, rings, std::exp(std::sqrt(3.0) * pi / sectors), Cells::triangles);
}

/// Node 0 at the origin with n neighbours 1 .. n on the unit circle, node 1 on the x axis; marker
/// rim.
inline MeshData regular_star(Index n) {
  MeshData data;
  data.coordinates.push_xy({0, 0});
  for (Index k = 0; k < n; ++k) {
    const double phi = 2 * pi * k / n;
    data.coordinates.push_xy({std::cos(phi), std::sin(phi)});
  }
  for (Index k = 0; k < n; ++k) add_triangle(data, 0, 1 + k, 1 + (k + 1) % n);
  mark_boundary(data, [](const Vec2&) { return "rim"; });
  return data;
}

/// Moves every free node by up to `share` of its shortest edge in each direction, less where that
/// would invert an element.
inline void perturb(Mesh& mesh, Random& random, double share = 0.5) {
  for (const Index node : mesh.topology->interior_nodes()) {
    const Vec2 old = mesh.coordinates.xy(node);
    double shortest = (mesh.coordinates.xy(mesh.topology->neighbours(node)[0]) - old).norm();
    for (const Index k : mesh.topology->neighbours(node)) {
      shortest = std::min(shortest, (mesh.coordinates.xy(k) - old).norm());
    }
    const Vec2 move = share * shortest * random.vector();
    const Index before = check_validity(*mesh.topology, mesh.coordinates, 1).inverted;
    for (double part = 1; part > 0.01; part *= 0.5) {
      mesh.coordinates.set_xy(node, old + part * move);
      if (check_validity(*mesh.topology, mesh.coordinates, 1).inverted <= before) break;
      mesh.coordinates.set_xy(node, old);
    }
  }
}

/// Random interior within the bounding box: a tangled mesh.
inline void tangle(Mesh& mesh, Random& random) {
  const Bounds box = bounds(mesh);
  for (const Index node : mesh.topology->interior_nodes()) {
    mesh.coordinates.set_xy(node, box.min + box.size().cwiseProduct(random.vector(0, 1)));
  }
}

/// Largest distance between the places of one node in two meshes.
inline double largest_difference(const Coordinates& a, const Coordinates& b) {
  double largest = 0;
  const auto places = [](const Coordinates& x) {
    return Eigen::Map<const Eigen::MatrixXd>(x.values().data(), x.dimension(), x.size());
  };
  if (a.size() > 0) largest = (places(a) - places(b)).colwise().norm().maxCoeff();
  return largest;
}

}  // namespace winslow::test
