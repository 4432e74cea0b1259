#include "io/format/matched_sides.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <set>

#include "core/mesh/place.h"
#include "core/search/box_tree.h"

namespace winslow::io {

RigidImage image_of(const Vec3& centre, const Vec3& angles, const Vec3& translation) {
  const Eigen::Matrix3d rotation =
      (Eigen::AngleAxisd(angles.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(angles.y(), Vec3::UnitY()) *
       Eigen::AngleAxisd(angles.x(), Vec3::UnitX()))
          .toRotationMatrix();
  return {rotation, centre + translation - rotation * centre};
}

RigidImage inverse_of(const RigidImage& image) {
  return {image.rotation.transpose(), -(image.rotation.transpose() * image.offset)};
}

std::vector<Index> nodes_of(std::span<const Face> faces) {
  std::set<Index> nodes;
  for (const Face& face : faces) nodes.insert(face.begin(), face.end());
  return {nodes.begin(), nodes.end()};
}

double shortest_edge(std::span<const Face> faces, const Coordinates& x) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Face& face : faces)
    for (std::size_t k = 0; k < face.size(); ++k)
      shortest = std::min(shortest,
                          (place_of(x, face[k]) - place_of(x, face[(k + 1) % face.size()])).norm());
  return shortest;
}

std::vector<PeriodicPair> matched(const RigidImage& image, std::span<const Index> first,
                                  std::span<const Index> second, const Coordinates& x,
                                  double near) {
  std::vector<Vec3> places;
  for (const Index node : second) places.push_back(place_of(x, node));
  if (places.empty()) return {};
  const BoxTree<3> tree{std::span<const Vec3>(places)};
  std::vector<PeriodicPair> pairs;
  std::set<Index> taken;
  for (const Index node : first) {
    const auto nearest = tree.nearest(image.of(place_of(x, node)), near);
    if (!nearest || nearest->distance > near) return {};
    const Index partner = second[at(nearest->item)];
    if (!taken.insert(partner).second) return {};
    pairs.push_back({node, partner});
  }
  return pairs;
}

}  // namespace winslow::io
