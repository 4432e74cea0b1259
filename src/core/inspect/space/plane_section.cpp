#include "core/inspect/space/plane_section.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

constexpr double nearness = 1e-10;  // of the mesh's extent

/// Signed distance of each node, 0 for those that count as on the plane.
std::vector<double> distances(const Mesh& mesh, const Plane& plane) {
  if (mesh.topology->cell_dimension() != 3)
    throw UsageError("cuts by a plane: only for a volume mesh, and this is a " +
                     std::string(mesh_kind(*mesh.topology)));
  const double least = nearness * space_bounds(mesh).size().norm();
  const SpacePoints x(mesh.coordinates);
  std::vector<double> d(at(mesh.coordinates.size()));
  parallel_for(0, mesh.coordinates.size(), [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const double distance = plane.distance(x[i]);
      d[at(i)] = std::abs(distance) > least ? distance : 0;
    }
  });
  return d;
}

/// Numbers by keys, in one array: a section asks for a point four times over.
class KeyTable {
 public:
  struct Found {
    Index value;
    bool fresh;
  };
  /// For so many keys there will be room without moving any.
  void reserve(std::size_t keys) {
    while (slots_.size() < 2 * (keys + 1)) grow();
  }
  Found find_or_add(std::uint64_t key, Index value) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    Slot& slot = slot_of(key);
    const bool fresh = slot.value < 0;
    if (fresh) {
      slot = {key, value};
      ++count_;
    }
    return {slot.value, fresh};
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    Index value = -1;  // -1: empty
  };

  Slot& slot_of(std::uint64_t key) {
    // Fibonacci hashing: the upper bits of the product are spread well.
    std::size_t k = (key * 0x9E3779B97F4A7C15U) >> shift_;
    while (slots_[k].value >= 0 && slots_[k].key != key) k = (k + 1) & (slots_.size() - 1);
    return slots_[k];
  }
  void grow() {
    std::vector<Slot> old = std::move(slots_);
    --shift_;
    slots_.assign(std::size_t{1} << (64U - shift_), {});
    for (const Slot& slot : old)
      if (slot.value >= 0) slot_of(slot.key) = slot;
  }

  std::vector<Slot> slots_ = std::vector<Slot>(1024);
  unsigned shift_ = 54;  // 64 less the bits of a place
  std::size_t count_ = 0;
};

/// Cuts one element after the other.
class Cutter {
 public:
  /// front_on_plane: nodes on the plane count with what lies in front of it.
  Cutter(const Mesh& mesh, std::vector<double> distance, bool front_on_plane)
      : topology_(*mesh.topology),
        x_(mesh.coordinates),
        distance_(std::move(distance)),
        front_on_plane_(front_on_plane) {}

  PlaneSection cut() {
    const std::vector<unsigned char> met = met_elements();
    // A plane tiling of n triangles has about n / 2 corners.
    point_of_.reserve(static_cast<std::size_t>(std::ranges::count(met, 1)) * 2 / 3);
    for (Index e = 0; e < topology_.element_count(); ++e)
      if (met[at(e)] != 0) cut_element(e, topology_.element(e));
    return std::move(section_);
  }

 private:
  /// Elements with corners on both sides: found first, by all threads, as most have none.
  std::vector<unsigned char> met_elements() const {
    std::vector<unsigned char> front(distance_.size());
    for (std::size_t i = 0; i < front.size(); ++i)
      front[i] = in_front(static_cast<Index>(i)) ? 1 : 0;
    std::vector<unsigned char> met(at(topology_.element_count()));
    parallel_for(0, topology_.element_count(), [&](Index begin, Index end) {
      for (Index e = begin; e < end; ++e) {
        const auto corners = topology_.element(e);
        unsigned sum = 0;
        for (const Index node : corners) sum += front[at(node)];
        met[at(e)] = sum != 0 && sum != corners.size() ? 1 : 0;
      }
    });
    return met;
  }

  static constexpr std::size_t most_edges = 12;

  /// An edge of an element from one side of the plane to the other.
  struct Crossing {
    Index behind, front;  // nodes
    std::size_t next;     // crossing that follows around the section
    bool done;
  };

  bool in_front(Index node) const {
    const double d = distance_[at(node)];
    return front_on_plane_ ? d >= 0 : d > 0;
  }

  std::size_t find_crossing(Index behind, Index front) {
    std::size_t k = 0;
    while (k < count_ && (crossings_[k].behind != behind || crossings_[k].front != front)) ++k;
    if (k == count_) crossings_[count_++] = {behind, front, 0, false};
    return k;
  }

  void cut_element(Index e, std::span<const Index> corners) {
    count_ = 0;
    for (const Face& face : shape_of(topology_.element_type(e)).faces)
      cut_face(by_nodes(face, corners));
    for (std::size_t k = 0; k < count_; ++k)
      if (!crossings_[k].done) add_polygon(e, k);
  }

  /// Seen from the plane's front, the section lies on the left of a side that leads from where the
  /// face's outline, counter-clockwise from outside, comes out of the front to where it enters it.
  void cut_face(const Face& face) {
    std::array<std::size_t, 4> at_crossing{};
    std::array<bool, 4> enters{};
    std::size_t n = 0;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index a = face[k], b = face[(k + 1) % face.size()];
      if (in_front(a) == in_front(b)) continue;
      enters[n] = in_front(b);
      at_crossing[n] = enters[n] ? find_crossing(a, b) : find_crossing(b, a);
      ++n;
    }
    const bool around_behind = n == 4 && front_joined(face);
    for (std::size_t k = 0; k < n; ++k) {
      if (enters[k]) continue;
      const std::size_t to = around_behind || n == 2 ? (k + 1) % n : (k + n - 1) % n;
      crossings_[at_crossing[k]].next = at_crossing[to];
    }
  }

  /// The saddle of the distance in a quadrilateral with two corners in front, opposite to each
  /// other, lies in front, too. Products of two numbers, so that the answer is the same for both
  /// elements.
  bool front_joined(const Face& face) const {
    const std::size_t first = in_front(face[0]) ? 0 : 1;
    const auto d = [&](std::size_t k) { return distance_[at(face[(first + k) % 4])]; };
    return d(0) * d(2) > d(1) * d(3);
  }

  Index point_at(const Crossing& crossing) {
    // A node on the plane is one point, whichever edges lead to it.
    const double front = distance_[at(crossing.front)], behind = distance_[at(crossing.behind)];
    const Index a = front == 0 ? crossing.front : crossing.behind;
    const Index b = behind == 0 ? crossing.behind : crossing.front;
    const auto key = (std::uint64_t{static_cast<std::uint32_t>(a)} << 32U) |
                     std::uint64_t{static_cast<std::uint32_t>(b)};
    const auto [point, fresh] =
        point_of_.find_or_add(key, static_cast<Index>(section_.points.size()));
    if (fresh) {
      const Vec3 p = x_[a], q = x_[b];
      section_.points.emplace_back(a == b ? p : Vec3(p + (q - p) * (behind / (behind - front))));
    }
    return point;
  }

  void add_polygon(Index e, std::size_t first) {
    auto& polygons = section_.polygons;
    const std::size_t begin = polygons.values.size();
    std::size_t k = first;
    do {
      crossings_[k].done = true;
      const Index point = point_at(crossings_[k]);
      if (polygons.values.size() == begin || polygons.values.back() != point)
        polygons.values.push_back(point);
      k = crossings_[k].next;
    } while (k != first);
    while (polygons.values.size() > begin + 1 && polygons.values.back() == polygons.values[begin])
      polygons.values.pop_back();
    if (polygons.values.size() < begin + 3) return polygons.values.resize(begin);
    polygons.end_row();
    section_.elements.push_back(e);
  }

  const Topology& topology_;
  SpacePoints x_;
  std::vector<double> distance_;
  bool front_on_plane_;
  std::array<Crossing, most_edges> crossings_{};
  std::size_t count_ = 0;
  KeyTable point_of_;
  PlaneSection section_;
};

/// Twice the area of a triangle, positive if it is counter-clockwise.
double doubled_area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// The corner can be cut off: no other corner lies in its triangle.
bool is_ear(const std::vector<Vec2>& p, const std::vector<Index>& left, std::size_t k) {
  const std::size_t n = left.size();
  const Index a = left[(k + n - 1) % n], b = left[k], c = left[(k + 1) % n];
  if (doubled_area(p[at(a)], p[at(b)], p[at(c)]) <= 0) return false;
  return std::ranges::none_of(left, [&](Index other) {
    if (other == a || other == b || other == c) return false;
    const Vec2& q = p[at(other)];
    return doubled_area(p[at(a)], p[at(b)], q) >= 0 && doubled_area(p[at(b)], p[at(c)], q) >= 0 &&
           doubled_area(p[at(c)], p[at(a)], q) >= 0;
  });
}

}  // namespace

PlaneSection plane_section(const Mesh& mesh, const Plane& plane) {
  std::vector<double> d = distances(mesh, plane);
  PlaneSection section = Cutter(mesh, d, true).cut();
  if (section.elements.empty()) section = Cutter(mesh, std::move(d), false).cut();
  return section;
}

std::vector<unsigned char> elements_behind(const Mesh& mesh, std::span<const Plane> planes) {
  std::vector<unsigned char> left(at(mesh.topology->element_count()), 1);
  for (const Plane& plane : planes) {
    const std::vector<double> d = distances(mesh, plane);
    parallel_for(0, mesh.topology->element_count(), [&](Index begin, Index end) {
      for (Index e = begin; e < end; ++e) {
        const auto corners = mesh.topology->element(e);
        if (std::ranges::none_of(corners, [&](Index node) { return d[at(node)] < 0; }))
          left[at(e)] = 0;
      }
    });
  }
  return left;
}

std::vector<Index> cut_polygon(std::span<const Vec3> corners, const Vec3& normal) {
  if (corners.size() == 3) return {0, 1, 2};
  const auto [u, v] = directions_in(normal);
  std::vector<Vec2> p;
  std::vector<Index> left;
  for (const Vec3& corner : corners) {
    const Vec3 r = corner - corners[0];
    left.push_back(static_cast<Index>(p.size()));
    p.emplace_back(u.dot(r), v.dot(r));
  }
  std::vector<Index> triangles;
  while (left.size() > 2) {
    const std::size_t n = left.size();
    std::size_t ear = 1;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t candidate = (k + 1) % n;
      if (!is_ear(p, left, candidate)) continue;
      ear = candidate;
      break;
    }
    for (const std::size_t k : {ear + n - 1, ear, ear + 1}) triangles.push_back(left[k % n]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

}  // namespace winslow
