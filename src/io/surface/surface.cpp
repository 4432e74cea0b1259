#include "io/surface/surface.h"

#include <Eigen/Geometry>
#include <numeric>

namespace winslow::io::surface {

void Builder::add_vertex(double x, double y, double z, std::size_t offset) {
  xyz_.insert(xyz_.end(), {x, y, z});
  mesh_.where.nodes.push_back(offset);
}

void Builder::add_face(std::span<const Index> corners, std::size_t offset) {
  if (corners.size() != 3 && corners.size() != 4) {
    source_.fail(offset, "a face with " + std::to_string(corners.size()) + " corners",
                 "a triangle or a quadrilateral");
  }
  mesh_.data.add_element(corners.size() == 3 ? ElementType::triangle : ElementType::quadrilateral,
                         corners);
  mesh_.where.elements.push_back(offset);
}

ParsedMesh Builder::finish(bool binary) {
  if (mesh_.data.types.empty()) source_.fail(source_.text().size(), "no faces", "a mesh");
  set_nodes(source_, xyz_, mesh_);
  mesh_.details->binary = binary;
  for (const std::string& what : dropped_)
    mesh_.warnings.push_back(what + " of the file are not kept");
  return std::move(mesh_);
}

WrittenSurface::WrittenSurface(const Mesh& mesh, const FormatDetails* details)
    : space_(mesh, details), plane_(mesh.topology->space_dimension() == 2) {
  const Topology& topology = *mesh.topology;
  if (topology.cell_dimension() == 3) {
    add_boundary(topology);
    return;
  }
  nodes_.resize(static_cast<std::size_t>(topology.node_count()));
  std::iota(nodes_.begin(), nodes_.end(), 0);
  for (Index e = 0; e < topology.element_count(); ++e) faces_.push_back(space_.element(e));
  groups_.push_back({{}, 0, faces_.size()});
}

void WrittenSurface::add_boundary(const Topology& topology) {
  std::vector<bool> taken(static_cast<std::size_t>(topology.face_count()), false);
  std::vector<Index> number(static_cast<std::size_t>(topology.node_count()), -1);
  const auto add = [&](Index f) {
    const auto [face, elements] = topology.face(f);
    if (elements[1] >= 0 || taken[static_cast<std::size_t>(f)]) return;
    taken[static_cast<std::size_t>(f)] = true;
    FileCorners corners;
    for (const Index node : face) {
      Index& own = number[static_cast<std::size_t>(node)];
      if (own < 0) {
        own = node_count();
        nodes_.push_back(node);
      }
      corners.nodes[corners.count++] = own;
    }
    faces_.push_back(corners);
  };
  if (topology.markers().from_file()) {
    for (const Marker& marker : topology.markers()) {
      const std::size_t first = faces_.size();
      for (const Face& face : marker.faces) add(*topology.find_face(face));
      if (faces_.size() > first) groups_.push_back({marker.name, first, faces_.size() - first});
    }
  }
  const std::size_t first = faces_.size();
  for (Index f = 0; f < topology.face_count(); ++f) add(f);
  if (faces_.size() > first) groups_.push_back({"boundary", first, faces_.size() - first});
}

Vec3 WrittenSurface::normal(const FileCorners& corners) const {
  if (plane_) return space_.normal();
  // Of a quadrilateral by its diagonals, for it need not be plane.
  const Vec3 a = node(corners[2]) - node(corners[0]);
  const Vec3 b = node(corners[corners.size() - 1]) - node(corners[1]);
  const Vec3 n = corners.size() == 3 ? (node(corners[1]) - node(corners[0])).cross(a) : a.cross(b);
  const double length = n.norm();
  return length > 0 ? Vec3(n / length) : Vec3(Vec3::Zero());
}

std::string one_word(const std::string& name) {
  std::string word = name;
  for (char& c : word) c = static_cast<unsigned char>(c) <= ' ' ? '_' : c;
  return word;
}

std::vector<std::string> lost_in_surface(const Mesh& mesh, bool keeps_groups) {
  std::vector<std::string> warnings;
  const bool volume = mesh.topology->cell_dimension() == 3;
  if (volume) warnings.emplace_back("this format holds surfaces: only the boundary is written");
  const bool kept = volume && keeps_groups;
  if (!kept && mesh.topology->markers().from_file() && !mesh.topology->markers().empty()) {
    warnings.emplace_back("this format has no markers: they are lost");
  }
  if (!mesh.topology->regions().empty()) {
    warnings.emplace_back("this format has no regions: the names of element sets are lost");
  }
  return warnings;
}

}  // namespace winslow::io::surface
