#include "core/drag/drag_grip.h"

#include <queue>

#include "core/error.h"
#include "core/mesh/index_sets.h"
#include "core/strategy/sliding.h"

namespace winslow {

namespace {

/// dimension: of the mesh.
DisplacementTable displacements(const DragGrip& grip, const Vec3& translate, int dimension) {
  DisplacementTable table;
  table.source = "drag";
  table.entries.reserve(grip.nodes.size());
  for (std::size_t i = 0; i < grip.nodes.size(); ++i) {
    DisplacementEntry& entry = table.entries.emplace_back();
    entry.node = grip.nodes[i];
    entry.displacement = GivenVector::of(dimension, grip.shares[i] * translate);
  }
  return table;
}

void check_shares(const DragGrip& grip, double rotate) {
  if (grip.shares.size() != grip.nodes.size())
    throw UsageError("a part of a boundary needs a share of the motion for each of its nodes");
  if (rotate != 0) throw UsageError("a part of a boundary can be moved, but not turned");
}

/// Visits distances along a loop from a position, in one direction, up to `radius`.
template <class Visit>
void walk(const std::vector<Index>& loop, const Coordinates& x, std::size_t from, bool forward,
          double radius, const Visit& visit) {
  const std::size_t n = loop.size();
  double distance = 0;
  std::size_t here = from;
  for (std::size_t step = 1; step < n; ++step) {
    const std::size_t next = forward ? (here + 1) % n : (here + n - 1) % n;
    distance += (x.xy(loop[next]) - x.xy(loop[here])).norm();
    if (distance >= radius) return;
    visit(next, distance);
    here = next;
  }
}

}  // namespace

std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const DragGrip& grip, const RigidMotion& motion) {
  if (grip.rigid()) return make_motion(topology, rest, grip.markers, motion);
  check_shares(grip, motion.rotate);
  return make_motion(topology, rest, grip.markers,
                     displacements(grip, motion.translate, rest.dimension()));
}

Command drag_command(const DragGrip& grip, const RigidMotion& motion, const MotionOptions& how,
                     const SmoothOptions& smooth) {
  if (grip.rigid()) return MoveCommand{{{grip.markers, motion}}, how, smooth};
  check_shares(grip, motion.rotate);
  return DeformCommand{grip.markers, displacements(grip, motion.translate, motion.axis ? 3 : 2),
                       how, smooth};
}

RigidMotion motion_between(const DragGrip& grip, const RigidMotion& from, const RigidMotion& to) {
  if (grip.rigid()) return compose(inverse(from), to);
  return {.translate = Vec3(to.translate - from.translate), .axis = to.axis};
}

BodyNodes body_nodes(const Topology& topology, const DragGrip& grip) {
  BodyNodes nodes{moving_nodes(topology, grip.markers), {}};
  if (grip.rigid()) {
    nodes.standing = nodes.all;
    return nodes;
  }
  for (std::size_t i = 0; i < grip.nodes.size(); ++i)
    if (grip.shares[i] > 0) nodes.standing.push_back(grip.nodes[i]);
  sort_unique(nodes.standing);
  return nodes;
}

namespace {

bool keeps_on(const Mesh& mesh, const DragGrip& grip, std::span<const Foothold> footholds,
              const RigidMotion& motion) {
  try {
    const auto of_grip = make_motion(*mesh.topology, mesh.coordinates, grip, motion);
    require_on_footholds(mesh, *of_grip, footholds);
    return true;
  } catch (const UsageError&) {
    return false;
  }
}

/// The translation that brings one node of each foothold back onto it, by projections in turn.
RigidMotion put_back(const Mesh& mesh, const DragGrip& grip, std::span<const Foothold> footholds,
                     RigidMotion motion) {
  constexpr int rounds = 100;
  for (int round = 0; round < rounds; ++round) {
    double corrected = 0;
    for (const Foothold& foothold : footholds) {
      const Index node = foothold.nodes.front();
      const double share = grip.rigid() ? 1 : grip.shares[index_of(grip.nodes, node)];
      const Vec3 rest = place_of(mesh.coordinates, node);
      const Vec3 place = grip.rigid() ? transform(motion, rest) : rest + share * motion.translate;
      const Vec3 back = (foothold.nearest(place) - place - (foothold.nearest(rest) - rest)) / share;
      motion.translate += back;
      corrected = std::max(corrected, back.norm());
    }
    if (corrected == 0) break;
  }
  return motion;
}

}  // namespace

RigidMotion along_footholds(const Mesh& mesh, const DragGrip& grip,
                            std::span<const Foothold> footholds, const RigidMotion& motion) {
  if (footholds.empty() || keeps_on(mesh, grip, footholds, motion)) return motion;
  RigidMotion shifted = motion;
  shifted.rotate = 0;
  for (const RigidMotion& start : {motion, shifted}) {
    RigidMotion along = put_back(mesh, grip, footholds, start);
    if (keeps_on(mesh, grip, footholds, along)) return along;
  }
  shifted.translate = Vec3(0, 0, 0);
  return shifted;
}

RigidMotion fit_motion(std::span<const Index> nodes, std::span<const double> shares,
                       const Coordinates& rest, const Coordinates& x) {
  if (shares.empty()) return fit_rigid_motion(nodes, rest, x);
  Vec3 sum(0, 0, 0);
  double weight = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    sum += shares[i] * (place_of(x, nodes[i]) - place_of(rest, nodes[i]));
    weight += shares[i] * shares[i];
  }
  RigidMotion motion = fit_rigid_motion({}, rest, x);  // the identity, in space with an axis
  if (weight > 0) motion.translate = sum / weight;
  return motion;
}

double faded_share(double distance, double radius) {
  if (!(distance < radius)) return 0;
  const double t = distance / radius;
  return 1 - t * t * (3 - 2 * t);
}

FadedArc faded_arc(const std::vector<Index>& loop, const Coordinates& x, std::size_t first,
                   std::size_t last, double radius) {
  const std::size_t n = loop.size();
  std::vector<double> share(n, 0.0);
  for (std::size_t place = first;; place = (place + 1) % n) {
    share[place] = 1;
    if (place == last) break;
  }
  const auto fade = [&](std::size_t place, double distance) {
    share[place] = std::max(share[place], faded_share(distance, radius));
  };
  walk(loop, x, last, true, radius, fade);
  walk(loop, x, first, false, radius, fade);
  FadedArc arc;
  for (std::size_t place = 0; place < n; ++place) {
    if (share[place] <= 0) continue;
    arc.nodes.push_back(loop[place]);
    arc.shares.push_back(share[place]);
  }
  return arc;
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The distance of c in a triangle a, b, c with known distances of a and b: from the virtual source
/// in its plane, beyond the edge a b, with these distances. If the straight line from there does
/// not cross the triangle, the distance along an edge.
double distance_across(const Vec3& a, double to_a, const Vec3& b, double to_b, const Vec3& c) {
  const double along_edges = std::min(to_a + (c - a).norm(), to_b + (c - b).norm());
  const double length = (b - a).norm();
  if (!(length > 0)) return along_edges;
  const Vec3 unit = (b - a) / length;
  const double x = (c - a).dot(unit);
  const double y = (c - a - x * unit).norm();
  // Both nodes are held, so the edge between them is the source.
  if (to_a == 0 && to_b == 0) return x >= 0 && x <= length ? y : along_edges;
  const double from_x = (to_a * to_a - to_b * to_b + length * length) / (2 * length);
  const double from_y2 = to_a * to_a - from_x * from_x;
  if (from_y2 < 0) return along_edges;
  const double from_y = std::sqrt(from_y2);
  if (!(y + from_y > 0)) return along_edges;
  const double crossing = from_x + (x - from_x) * from_y / (y + from_y);
  if (crossing < 0 || crossing > length) return along_edges;
  return std::hypot(x - from_x, y + from_y);
}

/// The triangles of a surface, with nodes renumbered from 0.
struct Triangles {
  std::vector<Index> nodes;                ///< of the mesh, ascending
  std::vector<std::array<Index, 3>> all;   ///< numbers of nodes
  std::vector<std::vector<Index>> around;  ///< of a node: triangles

  Triangles(std::span<const Face> faces, const Coordinates& x) {
    for (const Face& face : faces) nodes.insert(nodes.end(), face.begin(), face.end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    around.resize(nodes.size());
    for (const Face& face : faces) {
      const std::size_t n = face.size();
      if (n > most_in_all_cuts) {
        std::vector<Vec3> places;
        for (const Index node : face) places.push_back(x.xyz(node));
        for (const auto& [a, b, c] : cut_face(places)) add({face[at(a)], face[at(b)], face[at(c)]});
        continue;
      }
      // The triangles about every corner: the halves of a quadrilateral for both diagonals.
      for (std::size_t k = 0; k < (n == 3 ? 1 : n); ++k)
        for (std::size_t step = 1; step + 1 < n; ++step) {
          if (n == 4 && step == 2) continue;  // of the corner before
          add({face[k], face[(k + step) % n], face[(k + step + 1) % n]});
        }
    }
  }
  std::optional<Index> number(Index node) const {
    const auto it = std::lower_bound(nodes.begin(), nodes.end(), node);
    if (it == nodes.end() || *it != node) return std::nullopt;
    return static_cast<Index>(it - nodes.begin());
  }

 private:
  static constexpr std::size_t most_in_all_cuts = 12;  // their number grows with the square

  void add(const std::array<Index, 3>& corners) {
    std::array<Index, 3> numbers{};
    for (std::size_t k = 0; k < 3; ++k) {
      numbers[k] = *number(corners[k]);
      around[at(numbers[k])].push_back(static_cast<Index>(all.size()));
    }
    all.push_back(numbers);
  }
};

/// Fast marching: finalises the nearest node that is not final and updates the nodes of its
/// triangles.
class Marching {
 public:
  Marching(const Triangles& triangles, const Coordinates& x)
      : triangles_(triangles),
        x_(x),
        distance_(triangles.nodes.size(), infinity),
        final_(triangles.nodes.size(), 0) {}

  std::vector<double> run(std::span<const Index> held, double radius) {
    for (const Index node : held)
      if (const auto number = triangles_.number(node)) offer(*number, 0);
    while (!waiting_.empty()) {
      const auto [distance, node] = waiting_.top();
      waiting_.pop();
      if (distance > radius) break;
      if (final_[at(node)] != 0) continue;
      final_[at(node)] = 1;
      for (const Index t : triangles_.around[at(node)]) spread(node, triangles_.all[at(t)]);
    }
    return std::move(distance_);
  }

 private:
  void offer(Index node, double distance) {
    if (!(distance < distance_[at(node)])) return;
    distance_[at(node)] = distance;
    waiting_.emplace(distance, node);
  }
  Vec3 position(Index node) const { return x_.xyz(triangles_.nodes[at(node)]); }

  void spread(Index from, const std::array<Index, 3>& triangle) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index to = triangle[k];
      if (to == from || final_[at(to)] != 0) continue;
      const Index other =
          triangle[(k + 1) % 3] == from ? triangle[(k + 2) % 3] : triangle[(k + 1) % 3];
      const double so_far = distance_[at(from)];
      if (final_[at(other)] != 0)
        offer(to, distance_across(position(from), so_far, position(other), distance_[at(other)],
                                  position(to)));
      else
        offer(to, so_far + (position(to) - position(from)).norm());
    }
  }

  const Triangles& triangles_;
  const Coordinates& x_;
  std::vector<double> distance_;
  std::vector<unsigned char> final_;
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> waiting_;
};

}  // namespace

FadedPatch faded_patch(std::span<const Face> faces, const Coordinates& x,
                       std::span<const Index> held, double radius) {
  const Triangles triangles(faces, x);
  const std::vector<double> distance = Marching(triangles, x).run(held, radius);
  FadedPatch patch;
  for (std::size_t k = 0; k < distance.size(); ++k) {
    const double share = distance[k] == 0 ? 1 : faded_share(distance[k], radius);
    if (share <= 0) continue;
    patch.nodes.push_back(triangles.nodes[k]);
    patch.shares.push_back(share);
  }
  return patch;
}

}  // namespace winslow
