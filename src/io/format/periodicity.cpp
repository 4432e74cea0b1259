#include "io/format/periodicity.h"

#include <Eigen/Geometry>
#include <set>

#include "core/error.h"
#include "core/mesh/coordinates.h"
#include "core/options/option.h"
#include "core/search/box_tree.h"

namespace winslow::io {

namespace {

std::string names_of(const GivenPairs& given) {
  return "\"" + given.first + "\"" +
         (given.second == given.first ? "" : " and \"" + given.second + "\"");
}

/// Distance between matching nodes that rounding can cause.
double rounding(const Coordinates& x) {
  double largest = 0;
  for (const double value : x.values()) largest = std::max(largest, std::abs(value));
  return 1e-14 * largest;
}

}  // namespace

void settle_periodicity(FormatDetails& details, const Mesh& mesh, const std::string& file) {
  if (!details.periodic) details.periodic = std::make_shared<GivenPeriodicity>();
  GivenPeriodicity& periodic = *details.periodic;
  periodic.source = file;
  periodic.nodes = mesh.topology->node_count();
  periodic.elements = mesh.topology->element_count();
  for (GivenPairs& given : periodic.pairs) {
    if (!given.fault.empty()) continue;
    try {
      given.deviation = PeriodicPairs::of(*mesh.topology, mesh.coordinates, given).deviation;
    } catch (const UsageError& error) {
      given.fault = file + ": " + error.what();
    }
  }
}

std::string named_pairs(const GivenPeriodicity& periodicity) {
  std::string text;
  std::set<std::string> seen;
  for (const GivenPairs& given : periodicity.pairs) {
    const std::string names = names_of(given);
    if (given.halo || !seen.insert(names).second) continue;
    text += (text.empty() ? "" : ", ") + names;
  }
  return text;
}

std::vector<std::string> stale_pairs(const FormatDetails& details, const Mesh& mesh) {
  std::vector<std::string> stale;
  if (!details.periodic || !details.periodic->fits(*mesh.topology)) return stale;
  const double noise = rounding(mesh.coordinates);
  for (const GivenPairs& given : details.periodic->pairs) {
    if (!given.fault.empty()) continue;
    std::string how_far;
    try {
      const double now = PeriodicPairs::of(*mesh.topology, mesh.coordinates, given).deviation;
      if (now <= 2 * given.deviation + noise) continue;
      how_far = "they are up to " + number_text(now) + " apart from one another's images";
    } catch (const UsageError& error) {
      how_far = error.what();
    }
    stale.push_back((given.halo ? "the halo nodes beyond " : "the periodic nodes of ") +
                    names_of(given) + " no longer match, and the file still pairs them: " +
                    how_far + "; --periodic-from-file keeps them together");
  }
  return stale;
}

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
