#include "core/vcv/vcv_edit.h"

#include <Eigen/Geometry>

#include "core/error.h"
#include "core/mesh/surface_faces.h"

namespace winslow {

namespace {

std::string who(Index node) { return "VCV of node " + std::to_string(node); }

/// Position of the edit's first neighbour in Topology::neighbours().
std::size_t first_place(const Topology& topology, const VcvEdit& edit) {
  if (edit.neighbours.empty()) return 0;
  const auto ring = topology.neighbours(edit.node);
  const auto first = std::find(ring.begin(), ring.end(), edit.neighbours.front());
  const auto place = static_cast<std::size_t>(first - ring.begin());
  bool same = first != ring.end() && edit.neighbours.size() == ring.size();
  for (std::size_t k = 0; same && k < ring.size(); ++k) {
    same = edit.neighbours[k] == ring[(place + k) % ring.size()];
  }
  if (!same) {
    std::string list;
    for (const Index node : ring) list += (list.empty() ? "" : ", ") + std::to_string(node);
    throw UsageError(who(edit.node) + ": the neighbours are not those of the mesh, which are " +
                     list + " (counter-clockwise, from any one on)");
  }
  return place;
}

/// Reorders values from the edit's neighbours to those of the topology.
std::vector<double> turned(std::vector<double> values, std::size_t place) {
  std::rotate(values.begin(), values.end() - static_cast<std::ptrdiff_t>(place), values.end());
  return values;
}

void apply(const VcvEdit& edit, VirtualControlVolumes& vcv) {
  if (edit.resets()) return vcv.reset(edit.node);
  if (!edit.directions.empty()) {
    throw UsageError(who(edit.node) +
                     ": directions are for volume meshes; that of a plane mesh has angles");
  }
  const Topology& topology = vcv.topology();
  // Throws if the node has no VCV, before its numbers are read.
  if (edit.node < 0 || edit.node >= topology.node_count() || vcv.angles(edit.node).empty()) {
    return vcv.reset(edit.node);
  }
  const std::size_t n = topology.neighbours(edit.node).size();
  std::vector<double> angles = edit.angles, lengths = edit.lengths;
  if (angles.empty() && vcv.hangs(edit.node)) {
    const std::size_t place = first_place(topology, edit);
    for (std::size_t k = 0; k < n; ++k)
      angles.push_back(degrees(vcv.equal_angles(edit.node)[(k + place) % n]));
  } else if (angles.empty()) {
    angles.assign(n, 360.0 / static_cast<double>(n));
  }
  if (lengths.empty()) lengths.assign(n, 1.0);
  if (angles.size() != n || lengths.size() != n) {
    throw UsageError(who(edit.node) + ": expected " + std::to_string(n) + " angles and lengths");
  }
  const double sum = std::accumulate(angles.begin(), angles.end(), 0.0);
  constexpr double slack = 0.01;
  if (!(std::abs(sum - 360) <= slack)) {
    throw UsageError(who(edit.node) + ": the angles do not sum to 360 degrees");
  }
  for (double& angle : angles) angle *= 2 * pi / sum;
  const std::size_t place = first_place(topology, edit);
  vcv.set(edit.node, turned(std::move(angles), place), turned(std::move(lengths), place));
}

}  // namespace

std::shared_ptr<const VirtualControlVolumes> edit_vcvs(const VirtualControlVolumes& vcv,
                                                       std::span<const VcvEdit> edits) {
  auto edited = std::make_shared<VirtualControlVolumes>(vcv);
  for (const VcvEdit& edit : edits) apply(edit, *edited);
  return edited;
}

VcvEdit edit_of(const VirtualControlVolumes& vcv, Index node) {
  const auto neighbours = vcv.topology().neighbours(node);
  VcvEdit edit{node, {neighbours.begin(), neighbours.end()}, {}, {}};
  if (!vcv.edited(node)) return edit;
  for (const double angle : vcv.angles(node)) edit.angles.push_back(degrees(angle));
  edit.lengths.assign(vcv.lengths(node).begin(), vcv.lengths(node).end());
  return edit;
}

namespace {

/// The neighbours of a surface node, with its tangent plane rotated to the given normal.
std::vector<Vec2> around_in_plane_of(const Topology& topology, const Coordinates& x, Index node,
                                     const Vec3& normal) {
  const SpacePoints points(x);
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(star_normal(topology, points, node), normal);
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
  std::vector<Vec2> flat;
  for (const Index k : topology.neighbours(node)) {
    const Vec3 arm = turn * (points[k] - points[node]);
    flat.emplace_back(u.dot(arm), v.dot(arm));
  }
  return flat;
}

}  // namespace

std::vector<VcvEdit> spread_vcv(const VirtualControlVolumes& vcv, const Coordinates& x,
                                Index source, std::span<const Index> targets) {
  const Topology& topology = vcv.topology();
  const Vec3 normal =
      is_surface(topology) ? star_normal(topology, SpacePoints(x), source) : Vec3(Vec3::UnitZ());
  const auto around = [&](Index node) {
    std::vector<Vec2> points;
    if (is_surface(topology)) return around_in_plane_of(topology, x, node, normal);
    for (const Index k : topology.neighbours(node)) points.push_back(x.xy(k) - x.xy(node));
    return points;
  };
  const std::vector<Vec2> from = around(source);
  const VcvEdit numbers = edit_of(vcv, source);
  std::vector<VcvEdit> edits;
  for (const Index node : targets) {
    const auto ring = topology.neighbours(node);
    if (ring.size() != from.size() || vcv.angles(node).empty()) {
      throw UsageError(who(node) + ": expected a free node with " + std::to_string(from.size()) +
                       " neighbours");
    }
    VcvEdit edit{node, {}, numbers.angles, numbers.lengths};
    const std::size_t shift = matching_shift(from, around(node));
    for (std::size_t k = 0; k < ring.size(); ++k) {
      edit.neighbours.push_back(ring[(k + shift) % ring.size()]);
    }
    edits.push_back(std::move(edit));
  }
  return edits;
}

std::size_t matching_shift(std::span<const Vec2> from, std::span<const Vec2> to) {
  const std::size_t n = from.size();
  std::size_t best = 0;
  double best_score = -static_cast<double>(n) - 1;
  for (std::size_t shift = 0; shift < n; ++shift) {
    double score = 0;
    for (std::size_t k = 0; k < n; ++k) {
      score += from[k].normalized().dot(to[(k + shift) % n].normalized());
    }
    if (score <= best_score) continue;
    best = shift;
    best_score = score;
  }
  return best;
}

}  // namespace winslow
