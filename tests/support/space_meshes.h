#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/mesh/mesh_data.h"
#include "core/vcv/sphere/volume_vcvs.h"
#include "support/meshes.h"
#include "support/random.h"

/// Named volume and surface meshes for tests. Volume elements are numbered as ElementShape says;
/// faces of markers are seen from outside counter-clockwise.
namespace winslow::test {

enum class Volumes { tetrahedra, pyramids, prisms, hexahedra, mixed };
inline constexpr std::array<Volumes, 5> all_volumes{
    Volumes::tetrahedra, Volumes::pyramids, Volumes::prisms, Volumes::hexahedra, Volumes::mixed};

inline const char* name_of(Volumes volumes) {
  constexpr std::array<const char*, 5> names{"tetrahedra", "pyramids", "prisms", "hexahedra",
                                             "mixed"};
  return names[static_cast<std::size_t>(volumes)];
}

inline void add_cell(MeshData& data, ElementType type, std::vector<Index> corners) {
  data.add_element(type, corners);
}

/// The faces of an element by the nodes of the mesh.
inline std::vector<Face> faces_of(const MeshData& data, Index e) {
  std::vector<Face> faces(data.polyhedron(e).begin(), data.polyhedron(e).end());
  for (const Face& face : shape_of(data.types[at(e)]).faces) {
    faces.push_back(by_nodes(face, data.element(e)));
  }
  return faces;
}

/// Puts every boundary face into the marker that `name` gives for its middle.
inline void mark_volume(MeshData& data, const std::function<std::string(const Vec3&)>& name) {
  std::map<Face, int> uses;
  for (Index e = 0; e < data.element_count(); ++e) {
    for (const Face& face : faces_of(data, e)) ++uses[face.sorted()];
  }
  for (Index e = 0; e < data.element_count(); ++e) {
    for (const Face& face : faces_of(data, e)) {
      if (uses[face.sorted()] != 1) continue;
      Vec3 middle(0, 0, 0);
      for (const Index node : face) middle += data.coordinates.xyz(node);
      const std::string marker = name(middle / static_cast<double>(face.size()));
      auto it = std::find_if(data.markers.begin(), data.markers.end(),
                             [&](const Marker& m) { return m.name == marker; });
      if (it == data.markers.end()) {
        it = data.markers.insert(it, Marker{marker, static_cast<int>(data.markers.size()) + 1, {}});
      }
      it->faces.push_back(face);
    }
  }
}

/// One cube of a grid with corners c, numbered as a hexahedron's: whole, or cut.
class CubeCutter {
 public:
  CubeCutter(MeshData& data, const std::array<Index, 8>& c) : data_(data), c_(c) {}

  void hexahedron() { add_cell(data_, ElementType::hexahedron, {c_.begin(), c_.end()}); }
  /// Six around the diagonal from corner 0 to corner 6.
  void tetrahedra() {
    constexpr std::array<Index, 7> around{1, 2, 3, 7, 4, 5, 1};
    for (std::size_t k = 0; k < 6; ++k) {
      add_cell(data_, ElementType::tetrahedron,
               {c_[0], c_[at(around[k])], c_[at(around[k + 1])], c_[6]});
    }
  }
  /// Two, whose triangles lie in the faces y = const; the cut runs from edge 0 3 to edge 5 6.
  void prisms() {
    add_cell(data_, ElementType::prism, {c_[0], c_[5], c_[1], c_[3], c_[6], c_[2]});
    add_cell(data_, ElementType::prism, {c_[0], c_[4], c_[5], c_[3], c_[7], c_[6]});
  }
  /// Six that meet in a new node in the middle; on the top, if asked, two tetrahedra instead, cut
  /// as tetrahedra() cuts the bottom of the cube above.
  void pyramids(bool split_top) {
    Vec3 middle(0, 0, 0);
    for (const Index node : c_) middle += data_.coordinates.xyz(node) / 8;
    const Index centre = data_.node_count();
    data_.coordinates.push_xyz(middle);
    const auto faces = shape_of(ElementType::hexahedron).faces;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (split_top && f == 5) {
        add_cell(data_, ElementType::tetrahedron, {c_[4], c_[6], c_[5], centre});
        add_cell(data_, ElementType::tetrahedron, {c_[4], c_[7], c_[6], centre});
        continue;
      }
      const Face base = by_nodes(faces[f], c_).reversed();  // seen from the centre
      add_cell(data_, ElementType::pyramid, {base[0], base[1], base[2], base[3], centre});
    }
  }

 private:
  MeshData& data_;
  std::array<Index, 8> c_;
};

/// n by n by n cubes on the unit cube, without those that `hole` names. Mixed: layers of
/// hexahedra, prisms, pyramids with tetrahedra on top, and tetrahedra from there on (n at least 4
/// for all of them). No markers.
inline MeshData cubes_with_holes(Index n, Volumes volumes,
                                 const std::function<bool(Index, Index, Index)>& hole) {
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  std::map<std::tuple<Index, Index, Index>, Index> ids;
  const auto id = [&](Index i, Index j, Index k) {
    const auto [it, fresh] = ids.try_emplace({i, j, k}, data.node_count());
    if (fresh) data.coordinates.push_xyz(Vec3(i, j, k) / n);
    return it->second;
  };
  for (Index k = 0; k < n; ++k) {
    for (Index j = 0; j < n; ++j) {
      for (Index i = 0; i < n; ++i) {
        if (hole(i, j, k)) continue;
        CubeCutter cube(data, {id(i, j, k), id(i + 1, j, k), id(i + 1, j + 1, k), id(i, j + 1, k),
                               id(i, j, k + 1), id(i + 1, j, k + 1), id(i + 1, j + 1, k + 1),
                               id(i, j + 1, k + 1)});
        const bool mixed = volumes == Volumes::mixed;
        if (volumes == Volumes::hexahedra || (mixed && k == 0)) {
          cube.hexahedron();
        } else if (volumes == Volumes::prisms || (mixed && k == 1)) {
          cube.prisms();
        } else if (volumes == Volumes::pyramids || (mixed && k == 2)) {
          cube.pyramids(mixed);
        } else {
          cube.tetrahedra();
        }
      }
    }
  }
  return data;
}

/// The unit cube; markers floor, lid, walls.
inline MeshData cube(Index n, Volumes volumes) {
  MeshData data = cubes_with_holes(n, volumes, [](Index, Index, Index) { return false; });
  mark_volume(data, [](const Vec3& p) {
    return p.z() < 1e-9 ? "floor" : p.z() > 1 - 1e-9 ? "lid" : "walls";
  });
  return data;
}

/// The unit cube of 8 cubes a side with layers on its floor: the first row `first` high, each next
/// one `ratio` times as high, .7 high in all by default.
inline Mesh layered_cube(Volumes volumes, double first = 0.01, double ratio = 1.6) {
  MeshData data = cube(8, volumes);
  std::array<double, 9> height{};
  for (std::size_t k = 0; k < 8; ++k)
    height[k + 1] = height[k] + first * std::pow(ratio, static_cast<double>(k));
  for (Index node = 0; node < data.node_count(); ++node) {
    Vec3 p = data.coordinates.xyz(node);
    const auto row = std::min<std::size_t>(7, static_cast<std::size_t>(8 * p.z()));
    p.z() = height[row] + (8 * p.z() - static_cast<double>(row)) * (height[row + 1] - height[row]);
    data.coordinates.set_xyz(node, p);
  }
  return make_mesh(data);
}

inline Vec3 random_vector(Random& random) {
  const Vec2 a = random.vector();
  return {a.x(), a.y(), random.uniform(-1, 1)};
}

/// The unit cube, its interior nodes moved by up to `reach` of a cube in each direction.
inline Mesh shaken_box(Index n, double reach, std::uint64_t seed,
                       Volumes volumes = Volumes::tetrahedra) {
  Mesh mesh = make_mesh(cube(n, volumes));
  Random random(seed);
  for (const Index node : mesh.topology->interior_nodes()) {
    mesh.coordinates.set_xyz(node, mesh.coordinates.xyz(node) + reach / n * random_vector(random));
  }
  return mesh;
}

/// The VCVs of a valid mesh that are its physical stars, lengths and all.
inline VolumeVcvs own_stars(const Mesh& mesh) {
  VolumeVcvs vcvs(mesh.topology);
  for (const Index node : mesh.topology->interior_nodes()) {
    std::vector<Vec3> edges;
    std::vector<double> lengths;
    for (const Index k : mesh.topology->neighbours(node)) {
      edges.emplace_back(mesh.coordinates.xyz(k) - mesh.coordinates.xyz(node));
      lengths.push_back(edges.back().norm());
    }
    vcvs.set(node, edges, lengths);
  }
  return vcvs;
}

/// The unit cube of n = 3 m cubes a side with a cubic cavity in the middle; markers outer, cavity.
inline MeshData cube_with_cavity(Index n, Volumes volumes) {
  MeshData data = cubes_with_holes(n, volumes, [&](Index i, Index j, Index k) {
    return 3 * i / n == 1 && 3 * j / n == 1 && 3 * k / n == 1;
  });
  mark_volume(data, [](const Vec3& p) {
    const Vec3 q = (p - Vec3::Constant(0.5)).cwiseAbs();
    return q.maxCoeff() > 0.5 - 1e-9 ? "outer" : "cavity";
  });
  return data;
}

/// A plane mesh laid over a surface.
inline MeshData lifted(const MeshData& plane, const std::function<Vec3(const Vec2&)>& surface) {
  MeshData data = plane;
  data.coordinates = Coordinates(3, plane.node_count());
  for (Index i = 0; i < plane.node_count(); ++i) {
    data.coordinates.set_xyz(i, surface(plane.coordinates.xy(i)));
  }
  return data;
}

/// The whole boundary of a volume mesh as a surface mesh, seen from outside; closed.
inline MeshData skin(const MeshData& volume) {
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  std::map<Index, Index> ids;
  for (const Marker& marker : volume.markers) {
    for (const Face& face : marker.faces) {
      std::vector<Index> corners;
      for (const Index node : face) {
        const auto [it, fresh] = ids.try_emplace(node, data.node_count());
        if (fresh) data.coordinates.push_xyz(volume.coordinates.xyz(node));
        corners.push_back(it->second);
      }
      data.add_element(face.size() == 3 ? ElementType::triangle : ElementType::quadrilateral,
                       corners);
    }
  }
  return data;
}

/// The same mesh with nodes and elements in random order and, if asked, a random half of the
/// elements turned inside out.
inline MeshData shuffled_volume(const MeshData& data, Random& random, bool turn) {
  MeshData out;
  const auto node_at = random.permutation(data.node_count());
  out.coordinates = Coordinates(3, data.node_count());
  for (Index i = 0; i < data.node_count(); ++i) {
    out.coordinates.set_xyz(node_at[at(i)], data.coordinates.xyz(i));
  }
  for (const Index e : random.permutation(data.element_count())) {
    const ElementType type = data.types[at(e)];
    const auto given = data.element(e);
    const bool mirror = turn && random.index(2) == 0;
    std::vector<Index> corners;
    for (std::size_t k = 0; k < given.size(); ++k) {
      const std::size_t from = mirror ? at(shape_of(type).mirrored[k]) : k;
      corners.push_back(node_at[at(given[from])]);
    }
    out.add_element(type, corners);
  }
  out.markers = data.markers;
  for (Marker& marker : out.markers) {
    for (Face& face : marker.faces) face = by_nodes(face, node_at);
  }
  return out;
}

/// A unit cube of n^3 cubes, cut up, without a block of a third of its length in the middle of the
/// edge y = z = 0; markers body, side (y = 0), floor (z = 0), far.
inline MeshData box_with_body_on_two_planes(Index n, Volumes volumes) {
  MeshData data = cubes_with_holes(n, volumes, [&](Index i, Index j, Index k) {
    return 3 * i / n == 1 && 3 * j < n && 3 * k < n;
  });
  mark_volume(data, [](const Vec3& p) {
    const bool far = (p.array() > 1 - 1e-9).any() || p.x() < 1e-9;
    return far ? "far" : p.y() < 1e-9 ? "side" : p.z() < 1e-9 ? "floor" : "body";
  });
  return data;
}

/// The same mesh with all elements given by their faces.
inline MeshData as_polyhedra(const MeshData& data) {
  MeshData out = data;
  out.types.clear();
  out.element_nodes.clear();
  out.element_offsets = {0};
  for (Index e = 0; e < data.element_count(); ++e)
    out.add_polyhedron(data.element(e), faces_of(data, e));
  return out;
}

/// The unit cube of n^3 cubes with the body of box_with_body(), of which each cube with all three
/// numbers below n / 2 is split into eight. The cubes beside them are polyhedra with hanging nodes.
inline MeshData split_box_with_body(Index n) {
  const Index m = 2 * n, low = n / 2;
  MeshData data;
  data.coordinates = Coordinates(3, 0);
  std::map<std::array<Index, 3>, Index> nodes;  // by places in half cubes
  const auto fine = [&](const std::array<Index, 3>& c) {
    return std::ranges::all_of(c, [&](Index i) { return i >= 0 && i < low; });
  };
  const auto node = [&](const std::array<Index, 3>& at_place) {
    const auto [it, added] = nodes.try_emplace(at_place, data.node_count());
    if (added)
      data.coordinates.push_xyz(Vec3(at_place[0], at_place[1], at_place[2]) /
                                static_cast<double>(m));
    return it->second;
  };
  // A square of a cube: corner, size and the two axes along it, counter-clockwise from outside.
  const auto square = [&](std::array<Index, 3> corner, Index size, std::size_t u, std::size_t v,
                          std::vector<Face>& faces) {
    // All fine nodes along the outline that touches fine cubes.
    std::vector<Index> outline;
    std::array<Index, 3> place = corner;
    const auto go = [&](std::size_t axis, Index step) {
      outline.push_back(node(place));
      for (Index k = 0; k + 1 < size; ++k) {
        place[axis] += step;
        bool touches = false;  // a fine cube around the middle of this edge
        for (const Index i : {-1, 0})
          for (const Index j : {-1, 0}) {
            std::array<Index, 3> half = place;
            half[(axis + 1) % 3] += i;
            half[(axis + 2) % 3] += j;
            touches |= std::ranges::all_of(half, [](Index h) { return h >= 0; }) &&
                       fine({half[0] / 2, half[1] / 2, half[2] / 2});
          }
        if (touches) outline.push_back(node(place));
      }
      place[axis] += step;
    };
    go(u, 1);
    go(v, 1);
    go(u, -1);
    go(v, -1);
    faces.emplace_back(std::span<const Index>(outline));
  };
  const auto cell = [&](const std::array<Index, 3>& corner, Index size, bool split_beside) {
    std::vector<Face> faces;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const bool far : {false, true}) {
        std::array<Index, 3> start = corner, beside = corner;
        start[axis] += far ? size : 0;
        beside[axis] += far ? size : -1;
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        const bool split = split_beside && size == 2 &&
                           std::ranges::all_of(beside, [](Index h) { return h >= 0; }) &&
                           fine({beside[0] / 2, beside[1] / 2, beside[2] / 2});
        const Index step = split ? 1 : size;
        for (Index i = 0; i < size; i += step)
          for (Index j = 0; j < size; j += step) {
            std::array<Index, 3> part = start;
            part[u] += i;
            part[v] += j;
            far ? square(part, step, u, v, faces) : square(part, step, v, u, faces);
          }
      }
    data.add_polyhedron(faces);
  };
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      for (Index k = 0; k < n; ++k) {
        if (i == low && j == low && k == low) continue;  // the body
        if (!fine({i, j, k})) {
          cell({2 * i, 2 * j, 2 * k}, 2, true);
          continue;
        }
        for (const Index p : {0, 1})
          for (const Index q : {0, 1})
            for (const Index r : {0, 1}) cell({2 * i + p, 2 * j + q, 2 * k + r}, 1, false);
      }
  mark_volume(data, [](const Vec3& p) {
    const bool outside = (p.array() < 1e-9).any() || (p.array() > 1 - 1e-9).any();
    return outside ? "far" : "body";
  });
  return data;
}

/// A unit cube of n^3 cubes, cut up, without the one in the middle: markers "far" and "body".
inline Mesh box_with_body(Index n, Volumes volumes) {
  const Index low = n / 2;
  MeshData data = cubes_with_holes(
      n, volumes, [&](Index i, Index j, Index k) { return i == low && j == low && k == low; });
  mark_volume(data, [](const Vec3& p) {
    const bool outside = (p.array() < 1e-9).any() || (p.array() > 1 - 1e-9).any();
    return outside ? "far" : "body";
  });
  return make_mesh(data);
}

}  // namespace winslow::test
