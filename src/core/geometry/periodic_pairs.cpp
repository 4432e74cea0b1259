#include "core/geometry/periodic_pairs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.h"
#include "core/mesh/place_text.h"
#include "core/options/option.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

Vec3 place_of(const Coordinates& x, Index node) {
  if (x.dimension() == 3) return x.xyz(node);
  const Vec2 p = x.xy(node);
  return {p.x(), p.y(), 0};
}

Vec3 mean_of(const std::vector<Vec3>& points) {
  Vec3 sum(0, 0, 0);
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

struct Side {
  std::string name;
  std::vector<Index> nodes;
  std::vector<Vec3> places;
  std::vector<bool> shared;  // with another marker: an end of the side
};

Side side_of(const Topology& topology, const Coordinates& x, const std::string& name) {
  const std::vector<std::string> names{name};
  Side side{name, topology.markers().nodes_of(names), {}, {}};
  const Index own = *topology.markers().find(name);
  std::vector<bool> elsewhere(static_cast<std::size_t>(topology.node_count()), false);
  for (Index m = 0; m < static_cast<Index>(topology.markers().size()); ++m)
    if (m != own)
      for (const Index node : topology.markers().nodes(m))
        elsewhere[static_cast<std::size_t>(node)] = true;
  for (const Index node : side.nodes) {
    side.places.push_back(place_of(x, node));
    side.shared.push_back(elsewhere[static_cast<std::size_t>(node)]);
  }
  return side;
}

double shortest_edge(const Topology& topology, const Coordinates& x, const Side& side) {
  double shortest = std::numeric_limits<double>::infinity();
  const Index marker = *topology.markers().find(side.name);
  for (const Face& face : topology.markers()[static_cast<std::size_t>(marker)].faces)
    for (std::size_t k = 0; k < face.size(); ++k)
      shortest = std::min(shortest,
                          (place_of(x, face[k]) - place_of(x, face[(k + 1) % face.size()])).norm());
  return shortest;
}

/// How a side lies under an image of another.
struct Match {
  std::vector<Index> partner;  ///< of each node of the first side, in the second
  std::size_t worst = 0;
  double distance = 0;  ///< of the worst pair
};

Match match(const RigidImage& image, const Side& first, const BoxTree<3>& second) {
  Match found;
  for (std::size_t i = 0; i < first.nodes.size(); ++i) {
    const auto nearest =
        second.nearest(image.of(first.places[i]), std::numeric_limits<double>::infinity());
    found.partner.push_back(nearest->item);
    if (nearest->distance > found.distance) {
      found.distance = nearest->distance;
      found.worst = i;
    }
  }
  return found;
}

RigidImage about(const Eigen::Matrix3d& rotation, const Vec3& from, const Vec3& to) {
  return {rotation, to - rotation * from};
}

Eigen::Matrix3d turn(double angle, const Vec3& axis) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// Rotations of the plane that take the ends of one side to those of the other, either way round.
std::vector<RigidImage> plane_rotations(const Side& first, const Side& second) {
  const auto ends_of = [](const Side& side) {
    std::vector<Vec3> ends;
    for (std::size_t i = 0; i < side.nodes.size(); ++i)
      if (side.shared[i]) ends.push_back(side.places[i]);
    return ends;
  };
  const std::vector<Vec3> a = ends_of(first), b = ends_of(second);
  std::vector<RigidImage> images;
  if (a.size() != 2 || b.size() != 2) return images;
  const Vec3 along = a[1] - a[0];
  for (const bool swapped : {false, true}) {
    const Vec3 to = swapped ? Vec3(b[0] - b[1]) : Vec3(b[1] - b[0]);
    const double angle = std::atan2(along.x() * to.y() - along.y() * to.x(), along.dot(to));
    images.push_back(about(turn(angle, Vec3::UnitZ()), a[0], swapped ? b[1] : b[0]));
  }
  return images;
}

/// Rotations about the coordinate axes that take the middle of one side to that of the other.
std::vector<RigidImage> axis_rotations(const Side& first, const Side& second) {
  std::vector<RigidImage> images;
  const Vec3 a = mean_of(first.places), b = mean_of(second.places);
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = Vec3::Unit(k);
    const Vec3 u = a - axis.dot(a) * axis, v = b - axis.dot(b) * axis;
    if (!(u.norm() > 0) || !(v.norm() > 0)) continue;
    images.push_back({turn(std::atan2(axis.dot(u.cross(v)), u.dot(v)), axis), Vec3(0, 0, 0)});
  }
  return images;
}

/// The rigid image nearest to the pairs, by least squares.
RigidImage fitted(const Side& first, const Side& second, const Match& pairs, bool rotates) {
  const auto count = static_cast<Eigen::Index>(first.nodes.size());
  Eigen::Matrix3Xd from(3, count), to(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    from.col(i) = first.places[static_cast<std::size_t>(i)];
    to.col(i) = second.places[static_cast<std::size_t>(pairs.partner[static_cast<std::size_t>(i)])];
  }
  if (!rotates) return {Eigen::Matrix3d::Identity(), (to - from).rowwise().mean()};
  const Vec3 a = from.rowwise().mean(), b = to.rowwise().mean();
  from.colwise() -= a;
  to.colwise() -= b;
  Eigen::Matrix3d covariance = to * from.transpose();
  if (from.row(2).isZero(0))
    covariance(2, 2) = covariance.norm();  // of the plane: about its normal
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vec3 sign(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant());
  const Eigen::Matrix3d rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  return about(rotation, a, b);
}

bool one_to_one(const Match& found) {
  std::vector<Index> partners = found.partner;
  std::ranges::sort(partners);
  return std::ranges::adjacent_find(partners) == partners.end();
}

std::string text_of(const RigidImage& image, int dimension) {
  if (image.rotation.isIdentity(0))
    return "translation by " +
           (dimension == 2 ? place_text(Vec2(image.offset.head<2>())) : place_text(image.offset));
  return "rotation by " + number_text(degrees(Eigen::AngleAxisd(image.rotation).angle())) +
         " degrees";
}

[[noreturn]] void refuse(const Side& first, const Side& second, const Match& best, int dimension) {
  const std::size_t i = best.worst;
  const Vec3& p = first.places[i];
  throw UsageError("the markers \"" + first.name + "\" and \"" + second.name +
                   "\" are not periodic: node " + std::to_string(first.nodes[i]) + " at " +
                   (dimension == 2 ? place_text(Vec2(p.head<2>())) : place_text(p)) +
                   " has no partner, the nearest node to its image is " +
                   number_text(best.distance) + " away");
}

}  // namespace

PeriodicPairs PeriodicPairs::find(const Topology& topology, const Coordinates& x,
                                  const std::string& first, const std::string& second) {
  const Side a = side_of(topology, x, first), b = side_of(topology, x, second);
  if (first == second)
    throw UsageError("periodic: found marker \"" + first + "\" twice, expected two sides");
  if (a.nodes.size() != b.nodes.size())
    throw UsageError("the markers \"" + first + "\" and \"" + second +
                     "\" are not periodic: they have " + std::to_string(a.nodes.size()) + " and " +
                     std::to_string(b.nodes.size()) + " nodes");
  const BoxTree<3> tree{std::span<const Vec3>(b.places)};
  const int dimension = x.dimension();
  std::vector<RigidImage> candidates{
      {Eigen::Matrix3d::Identity(), mean_of(b.places) - mean_of(a.places)}};
  for (const RigidImage& image : dimension == 2 ? plane_rotations(a, b) : axis_rotations(a, b))
    candidates.push_back(image);
  std::optional<Match> best;
  RigidImage chosen;
  // Files round coordinates; nodes that are no partners lie an edge apart.
  constexpr double share = 0.05;
  const double near = share * shortest_edge(topology, x, a);
  for (const RigidImage& candidate : candidates) {
    if (best && best->distance <= near) break;  // a translation, if it is one
    const Match found = match(candidate, a, tree);
    if (best && found.distance >= best->distance) continue;
    best = found;
    chosen = candidate;
  }
  if (!(best->distance <= near) || !one_to_one(*best)) refuse(a, b, *best, dimension);
  PeriodicPairs out{first, second, {}, {}, {}};
  out.image = fitted(a, b, *best, !chosen.rotation.isIdentity(0));
  out.description = text_of(out.image, dimension);
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    const auto j = static_cast<std::size_t>(best->partner[i]);
    if (!a.shared[i] && !b.shared[j]) out.pairs.push_back({a.nodes[i], b.nodes[j]});
  }
  return out;
}

}  // namespace winslow
