#include "core/geometry/surface_shapes.h"

#include <algorithm>

#include "core/geometry/surface/recognised_surface.h"

namespace winslow {

FeatureCurves curves_along(const SpacePoints& x, const SurfaceFeatures& features) {
  FeatureCurves out;
  out.tangents.assign(features.nodes.size(), Vec3(0, 0, 0));
  for (const Chain& line : features.lines) {
    std::vector<Vec3> points;
    for (const Index node : line.nodes) points.push_back(x[node]);
    constexpr std::size_t least_of_a_loop = 4;
    if (points.size() < 2 || (line.loop() && points.size() < least_of_a_loop)) {
      out.curves.push_back(nullptr);
      continue;
    }
    out.curves.push_back(curve_through(points, line.closed));
    for (const Index node : line.nodes)
      if (features.nodes[at(node)] == SurfaceNode::line)
        out.tangents[at(node)] = out.curves.back()->nearest(x[node]).tangent;
  }
  return out;
}

std::vector<std::vector<Index>> faces_of_regions(const SurfaceFeatures& features) {
  std::vector<std::vector<Index>> regions(at(features.regions));
  for (std::size_t f = 0; f < features.region.size(); ++f)
    regions[at(features.region[f])].push_back(static_cast<Index>(f));
  return regions;
}

std::vector<Index> nodes_of_faces(std::span<const SurfaceFace> faces,
                                  std::span<const Index> chosen) {
  std::vector<Index> nodes;
  for (const Index f : chosen)
    nodes.insert(nodes.end(), faces[at(f)].nodes.begin(), faces[at(f)].nodes.end());
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

Triangulation triangulated(const SpacePoints& x, std::span<const SurfaceFace> faces,
                           std::span<const Index> chosen, std::span<const Index> nodes) {
  Triangulation surface;
  for (const Index node : nodes) surface.points.push_back(x[node]);
  for (const Index f : chosen) {
    const Face& face = faces[at(f)].nodes;
    const auto corner = [&](std::size_t k) {
      return static_cast<Index>(std::ranges::lower_bound(nodes, face[k]) - nodes.begin());
    };
    if (face.size() == 3) {
      surface.triangles.push_back({corner(0), corner(1), corner(2)});
      continue;
    }
    for (const auto& [a, b, c] : halves_of(x, std::span(face.begin(), face.end())))
      surface.triangles.push_back({corner(a), corner(b), corner(c)});
  }
  return surface;
}

std::shared_ptr<const Surface> surface_over(const SpacePoints& x,
                                            std::span<const SurfaceFace> faces,
                                            std::span<const Index> chosen,
                                            const FeatureCurves& curves) {
  const std::vector<Index> nodes = nodes_of_faces(faces, chosen);
  std::vector<Vec3> tangents;
  for (const Index node : nodes) tangents.push_back(curves.tangents[at(node)]);
  return surface_through(triangulated(x, faces, chosen, nodes), tangents);
}

}  // namespace winslow
