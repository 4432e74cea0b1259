#include "io/surface/surface.h"

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
  set_planar_nodes(source_, xyz_, mesh_);
  mesh_.details->binary = binary;
  for (const std::string& what : dropped_)
    mesh_.warnings.push_back(what + " of the file are not kept");
  return std::move(mesh_);
}

std::vector<std::string> lost_in_surface(const Mesh& mesh) {
  std::vector<std::string> warnings;
  if (mesh.topology->markers().from_file() && !mesh.topology->markers().empty()) {
    warnings.emplace_back("this format has no markers: they are lost");
  }
  if (!mesh.topology->regions().empty()) {
    warnings.emplace_back("this format has no regions: the names of element sets are lost");
  }
  return warnings;
}

}  // namespace winslow::io::surface
