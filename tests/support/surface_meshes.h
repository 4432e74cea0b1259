#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <utility>

#include "core/geometry/element_normals.h"
#include "core/geometry/sliding_boundary.h"
#include "core/strategy/surface_shape.h"
#include "support/space_meshes.h"

/// Surface meshes, and the shapes that their nodes stay on, by formulas.
namespace winslow::test {

/// A plane grid with opposite sides joined: n by m cells of the torus (p, q) in [0, 1)^2. Diagonals
/// of triangles alternate from row to row, so that the triangles can be equilateral.
inline MeshData torus_grid(Index n, Index m, Cells cells,
                           const std::function<Vec3(const Vec2&)>& surface) {
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < n; ++i)
      data.coordinates.push_xyz(surface(Vec2(1.0 * i / n, 1.0 * j / m)));
  const auto id = [&](Index i, Index j) { return (j % m) * n + i % n; };
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < n; ++i)
      if (cells == Cells::triangles && j % 2 == 1) {
        add_triangle(data, id(i, j), id(i + 1, j), id(i, j + 1));
        add_triangle(data, id(i + 1, j), id(i + 1, j + 1), id(i, j + 1));
      } else {
        add_cell(data, cells, i, j, {id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
      }
  return data;
}

/// An octahedron each of whose faces is cut into n by n triangles, on the unit sphere.
inline MeshData octasphere(Index n) {
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  std::map<std::array<Index, 3>, Index> ids;
  const auto id = [&](const std::array<Index, 3>& p) {
    const auto [it, fresh] = ids.try_emplace(p, data.node_count());
    if (fresh) data.coordinates.push_xyz(Vec3(p[0], p[1], p[2]).normalized());
    return it->second;
  };
  for (int octant = 0; octant < 8; ++octant) {
    const std::array<Index, 3> sign{octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1};
    const bool mirrored = sign[0] * sign[1] * sign[2] < 0;
    const auto node = [&](Index i, Index j) {
      return id({sign[0] * i, sign[1] * j, sign[2] * (n - i - j)});
    };
    const auto add = [&](Index a, Index b, Index c) {
      mirrored ? add_triangle(data, a, c, b) : add_triangle(data, a, b, c);
    };
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; i + j < n; ++j) {
        add(node(i, j), node(i + 1, j), node(i, j + 1));
        if (i + j + 1 < n) add(node(i + 1, j), node(i + 1, j + 1), node(i, j + 1));
      }
    }
  }
  return data;
}

/// A surface by its nearest point, normal and second fundamental form along two directions.
struct ShapePoint {
  Vec3 point, normal;
  Eigen::Matrix3d form = Eigen::Matrix3d::Zero();  ///< v . form v: curvature towards the normal
};
using Shape = std::function<ShapePoint(const Vec3&)>;

inline Shape plane_shape(const Vec3& origin, const Vec3& normal) {
  return [=](const Vec3& p) { return ShapePoint{p - normal.dot(p - origin) * normal, normal}; };
}
inline Shape sphere_shape(double radius) {
  return [=](const Vec3& p) {
    const Vec3 n = p.normalized();
    return ShapePoint{radius * n, n, -(Eigen::Matrix3d::Identity() - n * n.transpose()) / radius};
  };
}
/// About the z axis.
inline Shape cylinder_shape(double radius) {
  return [=](const Vec3& p) {
    const Vec3 n = Vec3(p.x(), p.y(), 0).normalized();
    const Vec3 round = Vec3::UnitZ().cross(n);
    return ShapePoint{radius * n + Vec3(0, 0, p.z()), n, -round * round.transpose() / radius};
  };
}
/// About the z axis.
inline Shape torus_shape(double ring, double tube) {
  return [=](const Vec3& p) {
    const Vec3 out = Vec3(p.x(), p.y(), 0).normalized();
    const Vec3 n = (p - ring * out).normalized();
    const Vec3 round = Vec3::UnitZ().cross(out), along = round.cross(n);
    const double from_axis = ring + tube * n.dot(out);
    return ShapePoint{
        ring * out + tube * n, n,
        -along * along.transpose() / tube - n.dot(out) / from_axis * round * round.transpose()};
  };
}

inline Vec3 on_torus(const Vec2& p, double ring, double tube) {
  const double round = 2 * pi * p.x(), along = 2 * pi * p.y();
  const double from_axis = ring + tube * std::cos(along);
  return {from_axis * std::cos(round), from_axis * std::sin(round), tube * std::sin(along)};
}

class ShapeGeometry final : public SlidingGeometry {
 public:
  explicit ShapeGeometry(Shape shape) : shape_(std::move(shape)) {}
  Foot foot(Index, const Vec3& point) const override {
    const ShapePoint place = shape_(point);
    const Vec3 first = place.normal.unitOrthogonal(), second = place.normal.cross(first);
    Foot foot;
    foot.point = place.point;
    foot.frame.add(first);
    foot.frame.add(second);
    const auto bend = [&](const Vec3& a, const Vec3& b) {
      return Vec3(a.dot(place.form * b) * place.normal);
    };
    foot.bend = {bend(first, first), bend(first, second), bend(second, second)};
    return foot;
  }

 private:
  Shape shape_;
};

/// A state whose inner nodes stay on the shape.
inline MeshState on_shape(const Mesh& mesh, const Shape& shape) {
  MeshState state = make_state(mesh);
  auto surface = std::make_shared<SurfaceShape>();
  surface->given = mesh.coordinates;
  surface->rules = feature_rules({});
  SlidingPart part{"surface", "shape", {}};
  const auto inner = mesh.topology->interior_nodes();
  part.nodes.assign(inner.begin(), inner.end());
  surface->boundary.parts = {part};
  surface->boundary.geometry = std::make_shared<const ShapeGeometry>(shape);
  surface->normals =
      std::make_shared<const ElementNormals>(mesh.topology, mesh.coordinates, surface->boundary);
  state.surface = surface;
  return state;
}

inline std::shared_ptr<const NodeClasses> classes_on(const MeshState& state) {
  auto classes = std::make_shared<NodeClasses>(state.mesh.topology);
  slide_on_surface(*state.surface, state.mesh.coordinates, *classes);
  return classes;
}

}  // namespace winslow::test
