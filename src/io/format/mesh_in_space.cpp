#include "io/format/mesh_in_space.h"

#include <algorithm>

#include "io/format/plane_placement.h"

namespace winslow::io {
namespace {

bool from_behind(const Mesh& mesh, const FormatDetails* details) {
  return mesh.coordinates.dimension() == 2 && details != nullptr && details->plane &&
         details->plane->from_behind;
}

/// z of a node as the source of the mesh had it (0 without details).
double plane_z(const FormatDetails* details, Index node) {
  if (details == nullptr || details->plane_z.empty()) return 0.0;
  const auto& z = details->plane_z;
  const auto i = static_cast<std::size_t>(node);
  return z.size() == 1 || i >= z.size() ? z.front() : z[i];
}

}  // namespace

Vec3 place_in_space(const FormatDetails* details, const Coordinates& x, Index node) {
  if (x.dimension() == 3) return x.xyz(node);
  const Vec2 p = x.xy(node);
  if (details != nullptr && details->plane) return details->plane->in_space(node, p);
  return {p.x(), p.y(), plane_z(details, node)};
}

Vec3 MeshInSpace::node(Index i) const { return place_in_space(details_, mesh_.coordinates, i); }

FileCorners MeshInSpace::element(Index e) const {
  const auto corners = mesh_.topology->element(e);
  FileCorners file;
  file.count = corners.size();
  std::ranges::copy(corners, file.nodes.begin());
  // The first corner stays the first.
  if (from_behind(mesh_, details_))
    std::reverse(file.nodes.begin() + 1, file.nodes.begin() + file.count);
  return file;
}

Vec3 MeshInSpace::normal() const {
  if (details_ == nullptr || !details_->plane) return Vec3::UnitZ();
  const Vec3 n = details_->plane->normal();
  return details_->plane->from_behind ? Vec3(-n) : n;
}

}  // namespace winslow::io
