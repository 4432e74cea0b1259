#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/layers/space/volume_insertion.h"
#include "core/mesh/mesh_data.h"
#include "support/space_meshes.h"

/// Layers extruded from walls of a volume mesh, for tests of what comes after the insertion: one
/// column at each wall node, without limits.
namespace winslow::test {

struct Extrusion {
  std::vector<std::string> walls;
  std::vector<double> heights;
  std::vector<std::string> planes;  ///< flat markers on which columns stay
  double share = 0.02;              ///< of the heights in the start
};

/// Extrudes layers from the walls of a mesh without polyhedra.
class Extruder {
 public:
  Extruder(const Mesh& mesh, const Extrusion& how) : mesh_(mesh), how_(how) {
    const Topology& topology = *mesh.topology;
    for (const Marker& marker : topology.markers()) {
      const bool wall = is(how.walls, marker.name);
      if (!wall && !is(how.planes, marker.name)) continue;
      for (const Face& face : marker.faces) {
        const Face inward = topology.face(*topology.find_face(face)).nodes.reversed();
        (wall ? faces_ : planes_).push_back(inward);
      }
    }
    for (const Face& face : faces_)
      for (const Index node : face) columns_.try_emplace(node, 0);
    for (auto& [node, column] : columns_) {
      column = out_.stack.columns.size();
      out_.stack.columns.push_back(column_at(node));
    }
  }

  VolumeLayerInsertion extrude() {
    data_.coordinates = mesh_.coordinates;
    std::vector<Vec3> ideal;
    for (LayerColumn& column : out_.stack.columns) {
      column.nodes = {column.wall_node};
      double length = 0;
      for (const double height : column.heights) {
        length += height * column.slant;
        const Vec3 foot = mesh_.coordinates.xyz(column.wall_node);
        column.nodes.push_back(data_.node_count());
        data_.coordinates.push_xyz(foot + how_.share * length * column.direction);
        ideal.push_back(foot + length * column.direction);
      }
    }
    add_elements();
    add_markers();
    out_.mesh = make_mesh(data_);
    out_.ideal = data_.coordinates;
    for (std::size_t k = 0; k < ideal.size(); ++k)
      out_.ideal.set_xyz(mesh_.topology->node_count() + static_cast<Index>(k), ideal[k]);
    return std::move(out_);
  }

 private:
  static bool is(const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
  }
  std::vector<Vec3> normals_at(const std::vector<Face>& faces, Index node) const {
    std::vector<Vec3> normals;
    const auto x = [&](Index k) { return mesh_.coordinates.xyz(k); };
    for (const Face& face : faces)
      if (std::find(face.begin(), face.end(), node) != face.end())
        normals.push_back((x(face[1]) - x(face[0])).cross(x(face[2]) - x(face[0])).normalized());
    return normals;
  }
  LayerColumn column_at(Index node) const {
    LayerColumn column;
    column.wall_node = node;
    column.heights = how_.heights;
    const std::vector<Vec3> normals = normals_at(faces_, node), planes = normals_at(planes_, node);
    Vec3 d = Vec3::Zero();
    for (const Vec3& n : normals) d += n;
    const auto worst = [&] {
      return *std::ranges::min_element(normals, {}, [&](const Vec3& n) { return n.dot(d); });
    };
    // Towards the direction whose smallest product with the normals is largest.
    for (int step = 0; step < 400; ++step) {
      d = (d.normalized() + worst() / (step + 2)).normalized();
      for (int k = 0; k < 3; ++k)
        for (const Vec3& s : planes) d = (d - d.dot(s) * s).normalized();
    }
    column.direction = d;
    column.slant = 1 / worst().dot(d);
    column.along_boundary = !planes.empty();
    column.asked = column.room = column.thickness();
    column.first = column.heights[0];
    return column;
  }

  Index rim(Index node) const {
    const auto found = columns_.find(node);
    return found == columns_.end() ? node : out_.stack.columns[found->second].rim();
  }
  Index level(Index wall_node, std::size_t k) const {
    return out_.stack.columns[columns_.at(wall_node)].nodes[k];
  }
  void add_elements() {
    const Topology& topology = *mesh_.topology;
    const auto add = [&](ElementType type, const std::vector<Index>& corners, int layer) {
      data_.add_element(type, corners);
      out_.stack.layer_of_element.push_back(layer);
    };
    for (Index e = 0; e < topology.element_count(); ++e) {
      std::vector<Index> corners;
      for (const Index node : topology.element(e)) corners.push_back(rim(node));
      add(topology.element_type(e), corners, -1);
    }
    for (const Face& face : faces_) {
      ColumnFace columns;
      for (const Index node : face) columns.columns[at(columns.count++)] = columns_.at(node);
      out_.stack.faces.push_back(columns);
      for (std::size_t k = 0; k < how_.heights.size(); ++k) {
        std::vector<Index> corners;
        for (const std::size_t upper : {k, k + 1})
          for (const Index node : face) corners.push_back(level(node, upper));
        add(face.size() == 3 ? ElementType::prism : ElementType::hexahedron, corners,
            static_cast<int>(k));
      }
    }
  }
  void add_markers() {
    std::map<std::pair<Index, Index>, int> uses;  // of edges by faces of the walls
    for (const Face& face : faces_)
      for (std::size_t k = 0; k < face.size(); ++k)
        ++uses[std::minmax(face[k], face[(k + 1) % face.size()])];
    for (const Marker& marker : mesh_.topology->markers()) {
      Marker out{marker.name, marker.tag, {}};
      if (is(how_.walls, marker.name)) {
        data_.markers.push_back(marker);
        continue;
      }
      for (const Face& face : marker.faces) {
        std::vector<Index> nodes;
        for (const Index node : face) nodes.push_back(rim(node));
        out.faces.emplace_back(std::span<const Index>(nodes));
        for (std::size_t k = 0; k < face.size(); ++k) {
          const Index a = face[k], b = face[(k + 1) % face.size()];
          const auto found = uses.find(std::minmax(a, b));
          if (found == uses.end() || found->second != 1) continue;
          for (std::size_t h = 0; h < how_.heights.size(); ++h)
            out.faces.emplace_back(level(a, h), level(b, h), level(b, h + 1), level(a, h + 1));
        }
      }
      data_.markers.push_back(std::move(out));
    }
  }

  const Mesh& mesh_;
  const Extrusion& how_;
  std::vector<Face> faces_, planes_;      // seen from the layers
  std::map<Index, std::size_t> columns_;  // by the wall node
  MeshData data_;
  VolumeLayerInsertion out_;
};

inline VolumeLayerInsertion extruded(const Mesh& mesh, const Extrusion& how) {
  return Extruder(mesh, how).extrude();
}

/// `count` heights, each `ratio` times the one below.
inline std::vector<double> growing_heights(int count, double first, double ratio) {
  std::vector<double> heights;
  for (int k = 0; k < count; ++k) heights.push_back(first * std::pow(ratio, k));
  return heights;
}

/// A ball in the middle of the unit cube: cube_with_cavity(), its cavity made round. n: a multiple
/// of 3. Markers outer, cavity.
inline Mesh box_with_ball(Index n, Volumes volumes, double radius = 0.2) {
  MeshData data = cube_with_cavity(n, volumes);
  for (Index node = 0; node < data.node_count(); ++node) {
    const Vec3 q = data.coordinates.xyz(node) - Vec3::Constant(0.5);
    const double m = q.cwiseAbs().maxCoeff(), t = std::max(0.0, (m - 1.0 / 6) * 3);
    const double round = 6 * m * radius / q.norm();
    data.coordinates.set_xyz(node, Vec3::Constant(0.5) + (t + (1 - t) * round) * q);
  }
  return make_mesh(data);
}

}  // namespace winslow::test
