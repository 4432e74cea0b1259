#include "core/motion/body_ways.h"

#include <Eigen/Geometry>

namespace winslow {

namespace {

constexpr double round_off = 1e-12;  // relative

std::vector<std::string> sorted(std::vector<std::string> names) {
  std::ranges::sort(names);
  return names;
}

bool same_markers(const MovingBody& a, const MovingBody& b) {
  return a.markers == b.markers || sorted(a.markers) == sorted(b.markers);
}

bool share_marker(const MovingBody& a, const MovingBody& b) {
  return std::ranges::any_of(a.markers, [&](const std::string& name) {
    return std::ranges::find(b.markers, name) != b.markers.end();
  });
}

/// The body of the same markers; null if none has one of them.
const MovingBody* find_body(std::span<const MovingBody> bodies, const MovingBody& like) {
  const auto found = std::ranges::find_if(
      bodies, [&](const MovingBody& body) { return same_markers(body, like); });
  return found == bodies.end() ? nullptr : &*found;
}

/// Whether a body has markers of another body without being the same.
bool cut_otherwise(std::span<const MovingBody> bodies, const MovingBody& like) {
  return std::ranges::any_of(bodies, [&](const MovingBody& body) {
    return share_marker(body, like) && !same_markers(body, like);
  });
}

bool parallel(const RigidMotion& a, const RigidMotion& b) {
  return axis_of(a).normalized().cross(axis_of(b).normalized()).norm() < round_off;
}

bool same_pivot(const RigidMotion& a, const RigidMotion& b) {
  const Vec3 here = pivot_of(a), there = pivot_of(b);
  return (here - there).norm() <= round_off * (here.norm() + there.norm());
}

Eigen::Quaterniond turned_by(const RigidMotion& motion) {
  return Eigen::Quaterniond(
      Eigen::AngleAxisd(radians(motion.rotate), axis_of(motion).normalized()));
}

/// Whether rotations about different axes are so small and so near to each other that the shortest
/// rotation from one to the other is the difference of both.
bool near_each_other(const RigidMotion& a, const RigidMotion& b) {
  constexpr double far = 120, apart = 60;  // degrees
  if (std::abs(a.rotate) > far || std::abs(b.rotate) > far) return false;
  const double half = (turned_by(b) * turned_by(a).conjugate()).w();  // cosine of half the angle
  return half >= std::cos(radians(apart / 2));
}

std::optional<RigidMotion> between(const RigidMotion& from, const RigidMotion& to) {
  if (from.rotate != 0 && to.rotate != 0) {
    if (!same_pivot(from, to)) return std::nullopt;
    if (!parallel(from, to) && !near_each_other(from, to)) return std::nullopt;
  }
  return compose(inverse(from), to);
}

/// The share of a motion at which another one ends; none if it ends elsewhere.
std::optional<double> share_at(const RigidMotion& whole, const RigidMotion& part) {
  if (part.rotate != 0 && !(whole.rotate != 0 && same_pivot(whole, part) && parallel(whole, part)))
    return std::nullopt;
  const double sign = axis_of(whole).dot(axis_of(part)) < 0 ? -1 : 1;
  const double length2 = whole.translate.squaredNorm();
  const double share = whole.rotate != 0
                           ? sign * part.rotate / whole.rotate
                           : (length2 > 0 ? whole.translate.dot(part.translate) / length2 : 0);
  const double off = (part.translate - share * whole.translate).norm();
  constexpr double rounding = 1e-9;
  if (off > rounding * (part.translate.norm() + whole.translate.norm())) return std::nullopt;
  return share;
}

}  // namespace

RigidMotion at_rest(const RigidMotion& motion) {
  RigidMotion rest = motion;
  rest.rotate = 0;
  rest.translate = Vec3(0, 0, 0);
  return rest;
}

std::optional<std::vector<MovingBody>> ways_between(std::span<const MovingBody> from,
                                                    std::span<const MovingBody> to) {
  std::vector<MovingBody> way;
  const auto add = [&](const MovingBody& body, const RigidMotion& start, const RigidMotion& end) {
    const std::optional<RigidMotion> motion = between(start, end);
    if (motion) way.push_back({body.markers, *motion});
    return motion.has_value();
  };
  for (const MovingBody& body : to) {
    if (cut_otherwise(from, body)) return std::nullopt;
    const MovingBody* before = find_body(from, body);
    if (!add(body, before ? before->motion : at_rest(body.motion), body.motion))
      return std::nullopt;
  }
  for (const MovingBody& body : from)
    if (!find_body(to, body) && !add(body, body.motion, at_rest(body.motion))) return std::nullopt;
  return way;
}

std::vector<MovingBody> part_of_way(std::span<const MovingBody> from,
                                    std::span<const MovingBody> way, double share) {
  std::vector<MovingBody> bodies(way.begin(), way.end());
  for (MovingBody& body : bodies) {
    body.motion.rotate *= share;
    body.motion.translate *= share;
    if (const MovingBody* before = find_body(from, body))
      body.motion = compose(before->motion, body.motion);
  }
  return bodies;
}

bool on_one_way(std::span<const MovingBody> a, std::span<const MovingBody> b) {
  std::optional<double> common;
  const auto agrees = [&](const MovingBody& whole) {
    const MovingBody* part = find_body(b, whole);
    if (!moves(whole.motion)) return !part || !moves(part->motion);
    const auto share = share_at(whole.motion, part ? part->motion : at_rest(whole.motion));
    constexpr double rounding = 1e-9;
    if (!share || (common && std::abs(*common - *share) > rounding * (1 + std::abs(*share))))
      return false;
    common = share;
    return true;
  };
  return std::ranges::all_of(a, agrees) && std::ranges::all_of(b, [&](const MovingBody& body) {
           return find_body(a, body) || !moves(body.motion);
         });
}

double longest_way(std::span<const MovingBody> way, std::span<const MovingBody> from,
                   const std::function<Box<3>(const MovingBody&)>& box_of) {
  double longest = 0;
  for (const MovingBody& body : way) {
    const Box<3> box = box_of(body);
    const MovingBody* before = find_body(from, body);
    const Vec3 pivot = pivot_of(body.motion), axis = axis_of(body.motion).normalized();
    for (int corner = 0; corner < 8; ++corner) {
      Vec3 place;
      for (int k = 0; k < 3; ++k) place[k] = ((corner >> k) & 1) != 0 ? box.max[k] : box.min[k];
      if (before) place = transform(before->motion, place);
      const double arc = std::abs(radians(body.motion.rotate)) * axis.cross(place - pivot).norm();
      longest = std::max(longest, arc + body.motion.translate.norm());
    }
  }
  return longest;
}

double largest_turn(std::span<const MovingBody> way) {
  double largest = 0;
  for (const MovingBody& body : way) largest = std::max(largest, std::abs(body.motion.rotate));
  return largest;
}

}  // namespace winslow
