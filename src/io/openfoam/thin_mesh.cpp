#include "io/openfoam/thin_mesh.h"

#include <Eigen/Geometry>
#include <set>

#include "core/options/option.h"

namespace winslow::io::openfoam {
namespace {

constexpr double match_share = 0.05;  // of the shortest edge, as of periodic pairs
constexpr double aligned = 1e-6;      // components of a unit vector that count as 0
constexpr std::array<const char*, 3> axis_names{"x", "y", "z"};

Vec3 area_of(const PolyMesh& mesh, std::span<const Index> face) {
  Vec3 sum(0, 0, 0);
  const Vec3 origin = mesh.point(face[0]);
  for (std::size_t k = 1; k + 1 < face.size(); ++k)
    sum += (mesh.point(face[k]) - origin).cross(mesh.point(face[k + 1]) - origin) / 2;
  return sum;
}

/// The only axis along which a vector lies; nothing if it is tilted.
std::optional<int> axis_of(const Vec3& vector) {
  int largest = 0;
  const double length = vector.cwiseAbs().maxCoeff(&largest);
  for (const int k : {0, 1, 2})
    if (k != largest && std::abs(vector[k]) > aligned * length) return std::nullopt;
  return length > 0 ? std::optional(largest) : std::nullopt;
}

std::string names_of(const PolyMesh& mesh, const std::vector<bool>& chosen) {
  std::string text;
  for (std::size_t p = 0; p < mesh.patches.size(); ++p)
    if (chosen[p]) text += (text.empty() ? "" : ", ") + mesh.patches[p].name;
  return text;
}

/// Calls visit(face) for the faces of the chosen patches.
template <class Visit>
void for_faces_of(const PolyMesh& mesh, const std::vector<bool>& chosen, const Visit& visit) {
  for (std::size_t p = 0; p < mesh.patches.size(); ++p)
    for (std::int64_t f = 0; chosen[p] && f < mesh.patches[p].count; ++f)
      visit(static_cast<Index>(mesh.patches[p].first + f), p);
}

}  // namespace

ThinMesh::Found ThinMesh::find(const PolyMesh& mesh) {
  auto thin = std::make_shared<ThinMesh>();
  std::set<std::string> types;
  for (const Patch& patch : mesh.patches)
    if (patch.has_faces() && (patch.type == "empty" || patch.type == "wedge"))
      types.insert(patch.type);
  if (types.empty()) return {};
  thin->wedge_ = !types.contains("empty");
  for (const Patch& patch : mesh.patches)
    thin->is_side_.push_back(patch.has_faces() && types.contains(patch.type));
  std::string why;
  if (types.size() > 1) {
    why = "patches of type empty and of type wedge";
  } else if ((thin->wedge_ ? thin->set_wedge_axes(mesh, why) : thin->set_axes(mesh, why)) &&
             thin->sort_faces(mesh, why) && thin->pair_points(mesh, why) &&
             thin->check_copies(mesh, why)) {
    thin->xyz_ = mesh.xyz;
    thin->set_places();
    return {thin, {}};
  }
  return {nullptr, names_of(mesh, thin->is_side_) + " of type " + *types.begin() + ": " + why};
}

bool ThinMesh::set_axes(const PolyMesh& mesh, std::string& why) {
  Vec3 sum(0, 0, 0);
  low_ = std::numeric_limits<double>::infinity();
  high_ = -low_;
  for_faces_of(mesh, is_side_,
               [&](Index f, std::size_t) { sum += area_of(mesh, mesh.faces[f]).cwiseAbs(); });
  const auto axis = axis_of(sum);
  if (!axis) {
    why = "they are not all at right angles to one of the axes x, y and z";
    return false;
  }
  across_ = *axis;
  axes_ = {across_ == 0 ? 1 : 0, across_ == 2 ? 1 : 2};
  for_faces_of(mesh, is_side_, [&](Index f, std::size_t) {
    for (const Index point : mesh.faces[f]) {
      low_ = std::min(low_, across(mesh.point(point)));
      high_ = std::max(high_, across(mesh.point(point)));
    }
  });
  return true;
}

namespace {

/// The two planes of a wedge: unit normals and mean places.
struct WedgePlanes {
  std::array<Vec3, 2> normal{Vec3(0, 0, 0), Vec3(0, 0, 0)}, place = normal;
  bool found = false;

  WedgePlanes(const PolyMesh& mesh, const std::vector<bool>& sides) {
    std::array<double, 2> points{0, 0};
    std::optional<Vec3> first;
    for_faces_of(mesh, sides, [&](Index f, std::size_t) {
      const Vec3 area = area_of(mesh, mesh.faces[f]);
      if (!first && area.norm() > 0) first = area.normalized();
      const std::size_t side = first && area.dot(*first) < 0 ? 1 : 0;
      normal[side] += area;
      for (const Index point : mesh.faces[f]) place[side] += mesh.point(point);
      points[side] += static_cast<double>(mesh.faces[f].size());
    });
    found = std::ranges::all_of(std::array{0U, 1U}, [&](std::size_t side) {
      return points[side] > 0 && normal[side].norm() > 0;
    });
    for (const std::size_t side : {0U, 1U}) {
      normal[side].normalize();
      place[side] /= points[side];
    }
  }

  /// Where the planes meet, in the coordinates of two axes.
  Eigen::Vector2d meeting(int radial, int across) const {
    Eigen::Matrix2d lines;
    Eigen::Vector2d offsets;
    for (const int side : {0, 1}) {
      const auto k = static_cast<std::size_t>(side);
      lines.row(side) << normal[k][radial], normal[k][across];
      offsets[side] = lines.row(side).dot(Eigen::Vector2d(place[k][radial], place[k][across]));
    }
    return lines.partialPivLu().solve(offsets);
  }
};

constexpr double rounding = 1e-4;  // of normals and places in files with six digits

/// The axis near which a vector lies.
std::optional<int> near_axis(const Vec3& vector) {
  int largest = 0;
  const Vec3 unit = vector.normalized();
  const double component = unit.cwiseAbs().maxCoeff(&largest);
  return std::abs(component - 1) < rounding ? std::optional(largest) : std::nullopt;
}

}  // namespace

bool ThinMesh::set_wedge_axes(const PolyMesh& mesh, std::string& why) {
  const WedgePlanes planes(mesh, is_side_);
  const auto& [first, second] = planes.normal;
  const Vec3 cross = first.cross(second);
  const auto middle = planes.found ? near_axis(first - second) : std::nullopt;
  const auto along = planes.found && cross.norm() > rounding ? near_axis(cross) : std::nullopt;
  if (!middle || !along || *middle == *along) {
    why =
        "expected two planes that meet in a line along x, y or z and have a plane of two of these "
        "axes in the middle";
    return false;
  }
  across_ = *middle;
  along_ = *along;
  radial_ = 3 - across_ - along_;
  axes_ = {std::min(along_, radial_), std::max(along_, radial_)};
  const Eigen::Vector2d axis = planes.meeting(radial_, across_);
  const double size =
      std::max((planes.place[0] - planes.place[1]).norm(), std::abs(planes.place[0][radial_]));
  const auto settled = [&](double value) { return std::abs(value) < rounding * size ? 0 : value; };
  axis_radial_ = settled(axis[0]);
  axis_across_ = settled(axis[1]);
  direction_ = planes.place[0][radial_] < axis_radial_ ? -1 : 1;
  double sum_across = 0, sum_radial = 0;
  for_faces_of(mesh, is_side_, [&](Index f, std::size_t) {
    for (const Index point : mesh.faces[f]) {
      sum_across += std::abs(across(mesh.point(point)) - axis_across_);
      sum_radial += direction_ * (mesh.point(point)[radial_] - axis_radial_);
    }
  });
  half_angle_ = std::atan2(sum_across, sum_radial);
  return true;
}

bool ThinMesh::sort_faces(const PolyMesh& mesh, std::string& why) {
  std::vector<std::array<Index, 2>> sides(at(mesh.cells), {-1, -1});
  bool two_each = true;
  const double middle = wedge_ ? axis_across_ : (low_ + high_) / 2;
  for_faces_of(mesh, is_side_, [&](Index f, std::size_t) {
    double sum = 0;
    for (const Index point : mesh.faces[f]) sum += across(mesh.point(point)) - middle;
    Index& place = sides[at(mesh.owner[at(f)])][sum < 0 ? 0 : 1];
    two_each = two_each && place < 0;
    place = f;
  });
  for (const auto& side : sides) two_each = two_each && side[0] >= 0 && side[1] >= 0;
  if (!two_each) {
    why = "expected one cell between them, with one face on each side";
    return false;
  }
  // The base has the point of the lowest number, so that nodes keep their numbers where all points
  // of one side come first.
  std::array<Index, 2> lowest{mesh.point_count(), mesh.point_count()};
  std::vector<unsigned char> on(at(mesh.point_count()), 0);
  for (const auto& side : sides)
    for (const std::size_t k : {0U, 1U})
      for (const Index point : mesh.faces[side[k]]) on[at(point)] |= k == 0 ? 1 : 2;
  for (Index point = 0; point < mesh.point_count(); ++point)
    for (const std::size_t k : {0U, 1U})
      if (on[at(point)] == (k == 0 ? 1 : 2)) lowest[k] = std::min(lowest[k], point);
  base_is_low_ = lowest[0] < lowest[1];
  for (const auto& side : sides) {
    base_faces_.push_back(side[base_is_low_ ? 0 : 1]);
    copy_faces_.push_back(side[base_is_low_ ? 1 : 0]);
  }
  const std::set<Index> base(base_faces_.begin(), base_faces_.end());
  sides_of_.assign(mesh.patches.size(), {false, false});
  for_faces_of(mesh, is_side_, [&](Index f, std::size_t patch) {
    (base.contains(f) ? sides_of_[patch].first : sides_of_[patch].second) = true;
  });
  return true;
}

bool ThinMesh::pair_points(const PolyMesh& mesh, std::string& why) {
  std::vector<unsigned char> on(at(mesh.point_count()), 0);
  for (const Index f : base_faces_)
    for (const Index point : mesh.faces[f]) on[at(point)] |= 1;
  for (const Index f : copy_faces_)
    for (const Index point : mesh.faces[f]) on[at(point)] |= 2;
  node_of_.assign(at(mesh.point_count()), -1);
  for (Index point = 0; point < mesh.point_count(); ++point) {
    if ((on[at(point)] & 1) == 0) continue;
    node_of_[at(point)] = static_cast<Index>(base_.size());
    base_.push_back(point);
  }
  copy_.assign(base_.size(), -1);
  bool matches = true;
  const auto pair = [&](Index a, Index b) {
    if (on[at(a)] == 2) std::swap(a, b);
    if (on[at(a)] != 1 || on[at(b)] != 2) return;
    Index& copy = copy_[at(node_of_[at(a)])];
    matches = matches && (copy < 0 || copy == b);
    copy = b;
  };
  std::vector<bool> is_side(at(mesh.faces.size()), false);
  for (const auto* faces : {&base_faces_, &copy_faces_})
    for (const Index f : *faces) is_side[at(f)] = true;
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    for (std::size_t k = 0; !is_side[at(f)] && k < face.size(); ++k)
      pair(face[k], face[(k + 1) % face.size()]);
  }
  for (std::size_t node = 0; node < base_.size(); ++node) {
    if (on[at(base_[node])] == 3) copy_[node] = base_[node];
    matches = matches && copy_[node] >= 0 && (wedge_ || copy_[node] != base_[node]);
    if (copy_[node] >= 0) node_of_[at(copy_[node])] = static_cast<Index>(node);
  }
  std::size_t paired = 0;
  for (Index point = 0; point < mesh.point_count(); ++point)
    paired += on[at(point)] != 0 && node_of_[at(point)] >= 0 ? 1 : 0;
  const auto touched = static_cast<std::size_t>(
      std::ranges::count_if(on, [](unsigned char sides) { return sides != 0; }));
  if (!matches || paired != touched)
    why = "expected each point of one side joined to one point of the other";
  return why.empty();
}

bool ThinMesh::check_copies(const PolyMesh& mesh, std::string& why) {
  const double thickness = high_ - low_;
  for (const Index f : base_faces_) {
    const auto face = mesh.faces[f];
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < face.size(); ++k)
      shortest = std::min(shortest,
                          (mesh.point(face[k]) - mesh.point(face[(k + 1) % face.size()])).norm());
    for (const Index point : face) {
      const Index copy = copy_[at(node_of_[at(point)])];
      const double apart = (in_plane(mesh.point(point)) - in_plane(mesh.point(copy))).norm();
      const double off =
          wedge_ ? 0
                 : std::max(std::abs(across(mesh.point(point)) - (base_is_low_ ? low_ : high_)),
                            std::abs(across(mesh.point(copy)) - (base_is_low_ ? high_ : low_)));
      if (!(apart <= match_share * shortest) || off > 1e-3 * thickness) {
        why = "they are no copies of one plane: points " + std::to_string(point) + " and " +
              std::to_string(copy) + " are " + number_text(std::max(apart, off)) + " out of place";
        return false;
      }
    }
  }
  return true;
}

Vec2 ThinMesh::in_plane(const Vec3& point) const {
  if (!wedge_) return {point[axes_[0]], point[axes_[1]]};
  const double r = direction_ * (point[radial_] - axis_radial_) * std::cos(half_angle_) +
                   std::abs(point[across_] - axis_across_) * std::sin(half_angle_);
  const double radial = axis_radial_ + direction_ * r;
  return along_ < radial_ ? Vec2(point[along_], radial) : Vec2(radial, point[along_]);
}

void ThinMesh::set_places() {
  places_.assign(3 * base_.size(), 0);
  for (std::size_t node = 0; node < base_.size(); ++node) {
    Vec3 p(xyz_.data() + 3 * at(base_[node]));
    if (wedge_) {
      Vec2 q = in_plane(p);
      if (base_[node] == copy_[node]) q[along_ < radial_ ? 1 : 0] = axis_radial_;
      places_[3 * node] = q.x();
      places_[3 * node + 1] = q.y();
      continue;
    }
    p[across_] = xyz_[3 * at(base_[0]) + static_cast<std::size_t>(across_)];
    for (std::size_t k = 0; k < 3; ++k) places_[3 * node + k] = p[static_cast<int>(k)];
  }
}

std::optional<Face> ThinMesh::edge_of(std::span<const Index> face) const {
  std::vector<Index> nodes;
  for (const Index point : face)
    if (const Index node = node_of_[at(point)]; std::ranges::find(nodes, node) == nodes.end())
      nodes.push_back(node);
  if (nodes.size() != 2) return std::nullopt;
  return Face(nodes[0], nodes[1]);
}

std::string ThinMesh::description() const {
  const auto name = [](int axis) {
    return std::string(axis_names[static_cast<std::size_t>(axis)]);
  };
  if (!wedge_) return "one cell thick along " + name(across_);
  const std::string r = direction_ < 0 ? "-r" : "r";
  return "a wedge of " + number_text(degrees(2 * half_angle_)) + " degrees about the " +
         name(along_) + "-axis: its coordinates are (" +
         (along_ < radial_ ? name(along_) + ", " + r : r + ", " + name(along_)) + "), r along " +
         name(radial_);
}

Vec3 ThinMesh::point_of(const Vec2& place, int side) const {
  Vec3 p(0, 0, 0);
  const bool low = (side < 0) == base_is_low_;
  if (!wedge_) {
    p[axes_[0]] = place[0];
    p[axes_[1]] = place[1];
    p[across_] = low ? low_ : high_;
    return p;
  }
  const double r = direction_ * (place[along_ < radial_ ? 1 : 0] - axis_radial_);
  p[along_] = place[along_ < radial_ ? 0 : 1];
  p[radial_] = axis_radial_ + direction_ * r * std::cos(half_angle_);
  p[across_] = axis_across_ + (low ? -1 : 1) * r * std::sin(half_angle_);
  return p;
}

std::vector<double> ThinMesh::points(const Coordinates& nodes) const {
  std::vector<double> xyz = xyz_;
  for (Index node = 0; node < node_count(); ++node) {
    const Vec2 now = nodes.xy(node);
    const double* place = places_.data() + 3 * at(node);
    const Vec2 before = wedge_ ? Vec2(place[0], place[1]) : Vec2(place[axes_[0]], place[axes_[1]]);
    if (now == before) continue;
    const Index base = base_[at(node)], copy = copy_[at(node)];
    for (const Index point : {base, copy}) {
      const Vec3 old(xyz_.data() + 3 * at(point));
      Vec3 p = point_of(now, point == base ? -1 : 1);
      if (on_axis(node)) {
        p[radial_] = old[radial_];
        p[across_] = old[across_];
      } else if (!wedge_) {
        // The copy keeps what rounding of the file has put between it and the base.
        const Vec3 from(xyz_.data() + 3 * at(base));
        for (const int k : axes_) p[k] += old[k] - from[k];
        p[across_] = old[across_];
      }
      for (std::size_t k = 0; k < 3; ++k) xyz[3 * at(point) + k] = p[static_cast<int>(k)];
    }
  }
  return xyz;
}

}  // namespace winslow::io::openfoam
