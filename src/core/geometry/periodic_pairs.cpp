#include "core/geometry/periodic_pairs.h"

#include <Eigen/Geometry>

#include "core/error.h"
#include "core/mesh/coordinates.h"
#include "core/options/option.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

Vec3 mean_of(const std::vector<Vec3>& points) {
  Vec3 sum(0, 0, 0);
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// Of the shortest edge. Files round coordinates; nodes that are no partners lie an edge apart.
constexpr double tolerance = 0.05;

struct Side {
  std::string name;
  std::vector<Index> nodes;
  std::vector<Vec3> places;
  std::vector<bool> shared;  // with another marker: an end of the side
};

/// Boundary faces in no marker: their nodes stay.
void add_unmarked(const Topology& topology, std::vector<bool>& nodes) {
  if (topology.markers().unmarked_faces() == 0) return;
  std::vector<bool> marked(static_cast<std::size_t>(topology.face_count()), false);
  for (const Marker& marker : topology.markers())
    for (const Face& face : marker.faces)
      marked[static_cast<std::size_t>(*topology.find_face(face))] = true;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    if (face.elements[1] >= 0 || marked[static_cast<std::size_t>(f)]) continue;
    for (const Index node : face.nodes) nodes[static_cast<std::size_t>(node)] = true;
  }
}

/// By node: whether it is on another marker than these.
std::vector<bool> on_markers(const Topology& topology, const std::vector<std::string>& names) {
  std::vector<bool> elsewhere(static_cast<std::size_t>(topology.node_count()), false);
  const auto& markers = topology.markers();
  for (Index m = 0; m < static_cast<Index>(markers.size()); ++m)
    if (std::ranges::find(names, markers[static_cast<std::size_t>(m)].name) == names.end())
      for (const Index node : markers.nodes(m)) elsewhere[static_cast<std::size_t>(node)] = true;
  return elsewhere;
}

/// The same, and on parts of the boundary in no marker.
std::vector<bool> on_others(const Topology& topology, const std::vector<std::string>& names) {
  std::vector<bool> elsewhere = on_markers(topology, names);
  add_unmarked(topology, elsewhere);
  return elsewhere;
}

Side side_of(const Topology& topology, const Coordinates& x, const std::string& name) {
  const std::vector<std::string> names{name};
  Side side{name, topology.markers().nodes_of(names), {}, {}};
  const std::vector<bool> elsewhere = on_others(topology, names);
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

/// The pair that an image fits worst.
Match worst_pair(const RigidImage& image, const Side& first, const Side& second,
                 const Match& pairs) {
  Match found{pairs.partner, 0, 0};
  for (std::size_t i = 0; i < first.nodes.size(); ++i) {
    const Vec3& to = second.places[static_cast<std::size_t>(pairs.partner[i])];
    const double distance = (image.of(first.places[i]) - to).norm();
    if (distance > found.distance) {
      found.distance = distance;
      found.worst = i;
    }
  }
  return found;
}

bool one_to_one(const Match& found) {
  std::vector<Index> partners = found.partner;
  std::ranges::sort(partners);
  return std::ranges::adjacent_find(partners) == partners.end();
}

std::string text_of(const RigidImage& image, int dimension) {
  constexpr double noise = 1e-9;  // of a component that is 0 but for the rounding of files
  Vec3 offset = image.offset;
  for (double& component : offset)
    if (std::abs(component) < noise * image.offset.norm()) component = 0;
  if (image.rotation.isIdentity(0))
    return "translation by " +
           (dimension == 2 ? place_text(Vec2(offset.head<2>())) : place_text(offset));
  return "rotation by " + number_text(degrees(Eigen::AngleAxisd(image.rotation).angle())) +
         " degrees";
}

std::string place_of_node(const Side& side, std::size_t i, int dimension) {
  const Vec3& p = side.places[i];
  return "node " + std::to_string(side.nodes[i]) + " at " +
         (dimension == 2 ? place_text(Vec2(p.head<2>())) : place_text(p));
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

/// Nodes that a file pairs, as two sides.
std::array<Side, 2> sides_of(const Topology& topology, const Coordinates& x,
                             const GivenPairs& given) {
  std::array<Side, 2> sides{Side{given.first, {}, {}, {}}, Side{given.second, {}, {}, {}}};
  // Halo elements end at a boundary in no marker.
  const std::vector<bool> elsewhere = given.halo ? on_markers(topology, {given.first, given.second})
                                                 : on_others(topology, {given.first, given.second});
  for (const PeriodicPair& pair : given.pairs) {
    for (const std::size_t k : {0U, 1U}) {
      const Index node = k == 0 ? pair.node : pair.image;
      if (node < 0 || node >= topology.node_count())
        throw UsageError(not_periodic(given.first, given.second) + "there is no node " +
                         std::to_string(node));
      sides[k].nodes.push_back(node);
      sides[k].places.push_back(place_of(x, node));
      sides[k].shared.push_back(elsewhere[static_cast<std::size_t>(node)] ||
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
  std::vector<RigidImage> candidates{
      {Eigen::Matrix3d::Identity(), mean_of(b.places) - mean_of(a.places)}};
  for (const RigidImage& image : dimension == 2 ? plane_rotations(a, b) : axis_rotations(a, b))
    candidates.push_back(image);
  std::optional<Match> best;
  RigidImage chosen;
  const double near = tolerance * shortest_edge(topology, x, a);
  for (const RigidImage& candidate : candidates) {
    if (best && best->distance <= near) break;  // a translation, if it is one
    const Match found = match(candidate, a, tree);
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
  out.deviation = worst_pair(out.image, a, b, *best).distance;
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    const auto j = static_cast<std::size_t>(best->partner[i]);
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
  Match listed;
  for (std::size_t i = 0; i < a.nodes.size(); ++i) listed.partner.push_back(static_cast<Index>(i));
  PeriodicPairs out;
  out.first = given.first;
  out.second = given.second;
  out.halo = given.halo;
  if (a.nodes.empty()) return out;
  Match worst;
  for (const bool rotates : {false, true}) {
    out.image = fitted(a, b, listed, rotates);
    worst = worst_pair(out.image, a, b, listed);
    if (worst.distance <= near) break;
  }
  if (!(worst.distance <= near))
    throw UsageError(not_periodic(given.first, given.second) +
                     place_of_node(a, worst.worst, dimension) + " is paired with " +
                     place_of_node(b, worst.worst, dimension) + ", which its image is " +
                     number_text(worst.distance) + " away from");
  out.deviation = worst.distance;
  out.description = text_of(out.image, dimension);
  for (std::size_t i = 0; i < a.nodes.size(); ++i)
    (a.shared[i] || b.shared[i] ? out.corners : out.pairs).push_back({a.nodes[i], b.nodes[i]});
  for (auto* list : {&out.pairs, &out.corners}) std::ranges::sort(*list, {}, &PeriodicPair::node);
  return out;
}

}  // namespace winslow
