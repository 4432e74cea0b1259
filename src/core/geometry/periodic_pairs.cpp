#include "core/geometry/periodic_pairs.h"

#include <Eigen/Geometry>

#include "core/error.h"
#include "core/mesh/coordinates.h"
#include "core/options/option.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

/// Largest distance of a partner over the shortest edge. It allows for the rounding of files; other
/// nodes are an edge apart.
constexpr double tolerance = 0.05;

struct Side {
  std::string name;
  std::vector<Index> nodes;
  std::vector<Vec3> places;
  std::vector<bool> shared;  // nodes on another marker: ends of the side
};

/// Adds the nodes of boundary faces without a marker.
void add_unmarked(const Topology& topology, std::vector<bool>& nodes) {
  if (topology.markers().unmarked_faces() == 0) return;
  std::vector<bool> marked(at(topology.face_count()), false);
  for (const Marker& marker : topology.markers())
    for (const Face& face : marker.faces) marked[at(*topology.find_face(face))] = true;
  for_boundary_faces(topology, [&](Index f, const auto& face) {
    if (!marked[at(f)])
      for (const Index node : face.nodes) nodes[at(node)] = true;
  });
}

/// Whether each node is on a marker other than these.
std::vector<bool> on_markers(const Topology& topology, const std::vector<std::string>& names) {
  std::vector<bool> elsewhere(at(topology.node_count()), false);
  const auto& markers = topology.markers();
  for (Index m = 0; m < static_cast<Index>(markers.size()); ++m)
    if (std::ranges::find(names, markers[at(m)].name) == names.end())
      for (const Index node : markers.nodes(m)) elsewhere[at(node)] = true;
  return elsewhere;
}

Side side_of(const Topology& topology, const Coordinates& x, const std::string& name) {
  const std::vector<std::string> names{name};
  Side side{name, topology.markers().nodes_of(names), {}, {}};
  std::vector<bool> elsewhere = on_markers(topology, names);
  add_unmarked(topology, elsewhere);
  for (const Index node : side.nodes) {
    side.places.push_back(place_of(x, node));
    side.shared.push_back(elsewhere[at(node)]);
  }
  return side;
}

double shortest_edge(const Topology& topology, const Coordinates& x, const Side& side) {
  double shortest = std::numeric_limits<double>::infinity();
  const Index marker = *topology.markers().find(side.name);
  for (const Face& face : topology.markers()[at(marker)].faces)
    for (std::size_t k = 0; k < face.size(); ++k)
      shortest = std::min(shortest,
                          (place_of(x, face[k]) - place_of(x, face[(k + 1) % face.size()])).norm());
  return shortest;
}

/// Pairs of nodes of two sides, and the pair with the largest deviation from an image.
struct Match {
  std::vector<Index> partner;  ///< of each node of the first side, in the second
  std::size_t worst = 0;
  double distance = 0;  ///< of the worst pair
};

/// Sets the worst pair of an image.
void find_worst(const RigidImage& image, const Side& first, const Side& second, Match& pairs) {
  pairs.distance = 0;
  pairs.worst = 0;
  for (std::size_t i = 0; i < first.nodes.size(); ++i) {
    const double distance =
        (image.of(first.places[i]) - second.places[at(pairs.partner[i])]).norm();
    if (distance > pairs.distance) {
      pairs.distance = distance;
      pairs.worst = i;
    }
  }
}

/// Pairs each node of the first side with the node of the second nearest to its image.
Match match(const RigidImage& image, const Side& first, const Side& second,
            const BoxTree<3>& tree) {
  Match pairs;
  for (const Vec3& p : first.places)
    pairs.partner.push_back(
        tree.nearest(image.of(p), std::numeric_limits<double>::infinity())->item);
  find_worst(image, first, second, pairs);
  return pairs;
}

/// The rotation followed by the translation that moves a rotated point `from` to `to`.
RigidImage about(const Eigen::Matrix3d& rotation, const Vec3& from, const Vec3& to) {
  return {rotation, to - rotation * from};
}

Eigen::Matrix3d turn(double angle, const Vec3& axis) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// Rotations of the plane that move the ends of one side to those of the other, in both orders.
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

/// Rotations about the coordinate axes that move the mean of one side to that of the other.
std::vector<RigidImage> axis_rotations(const Side& first, const Side& second) {
  std::vector<RigidImage> images;
  const Vec3 a = mean_of<3>(first.places), b = mean_of<3>(second.places);
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = Vec3::Unit(k);
    const Vec3 u = a - axis.dot(a) * axis, v = b - axis.dot(b) * axis;
    if (!(u.norm() > 0) || !(v.norm() > 0)) continue;
    images.push_back({turn(std::atan2(axis.dot(u.cross(v)), u.dot(v)), axis), Vec3(0, 0, 0)});
  }
  return images;
}

/// The least squares fit of a rigid image to the pairs.
RigidImage fitted(const Side& first, const Side& second, const Match& pairs, bool rotates) {
  const auto count = static_cast<Eigen::Index>(first.nodes.size());
  Eigen::Matrix3Xd from(3, count), to(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    from.col(i) = first.places[static_cast<std::size_t>(i)];
    to.col(i) = second.places[at(pairs.partner[static_cast<std::size_t>(i)])];
  }
  if (!rotates) return {Eigen::Matrix3d::Identity(), (to - from).rowwise().mean()};
  const Vec3 a = from.rowwise().mean(), b = to.rowwise().mean();
  from.colwise() -= a;
  to.colwise() -= b;
  Eigen::Matrix3d covariance = to * from.transpose();
  if (from.row(2).isZero(0))
    covariance(2, 2) = covariance.norm();  // plane: a rotation about its normal
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
  constexpr double noise = 1e-9;  // components below this share are 0 up to rounding
  Vec3 offset = image.offset;
  for (double& component : offset)
    if (std::abs(component) < noise * image.offset.norm()) component = 0;
  if (image.rotation.isIdentity(0)) return "translation by " + place_text(offset, dimension);
  return "rotation by " + number_text(degrees(Eigen::AngleAxisd(image.rotation).angle())) +
         " degrees";
}

std::string place_of_node(const Side& side, std::size_t i, int dimension) {
  return "node " + std::to_string(side.nodes[i]) + " at " + place_text(side.places[i], dimension);
}

std::string not_periodic(const std::string& first, const std::string& second) {
  return (first == second
              ? "the marker \"" + first + "\" is not periodic: "
              : "the markers \"" + first + "\" and \"" + second + "\" are not periodic: ");
}

[[noreturn]] void refuse(const Side& first, const Side& second, const Match& best, int dimension) {
  throw UsageError(
      not_periodic(first.name, second.name) + place_of_node(first, best.worst, dimension) +
      " has no partner, the nearest node to its image is " + number_text(best.distance) + " away");
}

/// The pairs of a file as two sides.
std::array<Side, 2> sides_of(const Topology& topology, const Coordinates& x,
                             const GivenPairs& given) {
  std::array<Side, 2> sides{Side{given.first, {}, {}, {}}, Side{given.second, {}, {}, {}}};
  std::vector<bool> elsewhere = on_markers(topology, {given.first, given.second});
  // Halo elements end at a boundary without a marker.
  if (!given.halo) add_unmarked(topology, elsewhere);
  for (const PeriodicPair& pair : given.pairs) {
    for (const std::size_t k : {0U, 1U}) {
      const Index node = k == 0 ? pair.node : pair.image;
      if (node < 0 || node >= topology.node_count())
        throw UsageError(not_periodic(given.first, given.second) + "there is no node " +
                         std::to_string(node));
      sides[k].nodes.push_back(node);
      sides[k].places.push_back(place_of(x, node));
      sides[k].shared.push_back(elsewhere[at(node)] ||
                                std::ranges::binary_search(given.held, node));
    }
  }
  return sides;
}

}  // namespace

PeriodicPairs PeriodicPairs::find(const Topology& topology, const Coordinates& x,
                                  const std::string& first, const std::string& second) {
  const Side a = side_of(topology, x, first), b = side_of(topology, x, second);
  if (first == second)
    throw UsageError("periodic: found marker \"" + first + "\" twice, expected two sides");
  if (a.nodes.size() != b.nodes.size())
    throw UsageError(not_periodic(first, second) + "they have " + std::to_string(a.nodes.size()) +
                     " and " + std::to_string(b.nodes.size()) + " nodes");
  const BoxTree<3> tree{std::span<const Vec3>(b.places)};
  const int dimension = x.dimension();
  std::vector<RigidImage> candidates =
      topology.kind() == MeshKind::plane ? plane_rotations(a, b) : axis_rotations(a, b);
  candidates.insert(candidates.begin(), RigidImage{Eigen::Matrix3d::Identity(),
                                                   mean_of<3>(b.places) - mean_of<3>(a.places)});
  std::optional<Match> best;
  RigidImage chosen;
  const double near = tolerance * shortest_edge(topology, x, a);
  for (const RigidImage& candidate : candidates) {
    if (best && best->distance <= near) break;  // a translation is preferred
    const Match found = match(candidate, a, b, tree);
    if (best && found.distance >= best->distance) continue;
    best = found;
    chosen = candidate;
  }
  if (!(best->distance <= near) || !one_to_one(*best)) refuse(a, b, *best, dimension);
  PeriodicPairs out;
  out.first = first;
  out.second = second;
  out.image = fitted(a, b, *best, !chosen.rotation.isIdentity(0));
  out.description = text_of(out.image, dimension);
  find_worst(out.image, a, b, *best);
  out.deviation = best->distance;
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    const auto j = at(best->partner[i]);
    (a.shared[i] || b.shared[j] ? out.corners : out.pairs).push_back({a.nodes[i], b.nodes[j]});
  }
  return out;
}

PeriodicPairs PeriodicPairs::of(const Topology& topology, const Coordinates& x,
                                const GivenPairs& given) {
  if (!given.fault.empty()) throw UsageError(given.fault);
  const auto [a, b] = sides_of(topology, x, given);
  const int dimension = x.dimension();
  double near = std::numeric_limits<double>::infinity();
  for (const std::string& name : {given.first, given.second})
    near = std::min(near, tolerance * shortest_edge(topology, x, side_of(topology, x, name)));
  Match listed_pairs;
  listed_pairs.partner.resize(a.nodes.size());
  std::iota(listed_pairs.partner.begin(), listed_pairs.partner.end(), Index{0});
  PeriodicPairs out;
  out.first = given.first;
  out.second = given.second;
  out.halo = given.halo;
  if (a.nodes.empty()) return out;
  for (const bool rotates : {false, true}) {
    out.image = fitted(a, b, listed_pairs, rotates);
    find_worst(out.image, a, b, listed_pairs);
    if (listed_pairs.distance <= near) break;
  }
  if (!(listed_pairs.distance <= near))
    throw UsageError(not_periodic(given.first, given.second) +
                     place_of_node(a, listed_pairs.worst, dimension) + " is paired with " +
                     place_of_node(b, listed_pairs.worst, dimension) + ", which its image is " +
                     number_text(listed_pairs.distance) + " away from");
  out.deviation = listed_pairs.distance;
  out.description = text_of(out.image, dimension);
  for (std::size_t i = 0; i < a.nodes.size(); ++i)
    (a.shared[i] || b.shared[i] ? out.corners : out.pairs).push_back({a.nodes[i], b.nodes[i]});
  for (auto* list : {&out.pairs, &out.corners}) std::ranges::sort(*list, {}, &PeriodicPair::node);
  return out;
}

}  // namespace winslow
