#include "core/quality/finite_volumes.h"

#include <Eigen/Geometry>

#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

// OpenFOAM's SMALL, VSMALL, ROOTVSMALL, VGREAT and GREAT, which keep its quotients finite.
constexpr double foam_small = 1e-15, foam_vsmall = 1e-300, foam_root_vsmall = 1e-150;
constexpr double foam_vgreat = 1e300, foam_great = 1e15;

// Eigen sums in another order. Where a sum is round-off alone, the order shows.
double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vec3& a) { return std::sqrt(dot(a, a)); }

struct Tetrahedron {
  Vec3 a, b, c, d;

  double volume() const { return 1.0 / 6 * dot((b - a).cross(c - a), d - a); }

  double circumradius() const {
    const Vec3 e = b - a, f = c - a, g = d - a;
    const double lambda = dot(g, g) - dot(e, g), mu = dot(f, f) - dot(e, f);
    const Vec3 fe = f.cross(e), ge = g.cross(e);
    const double size = dot(g, fe);
    if (std::abs(size) < foam_root_vsmall) return foam_great;
    return length(0.5 * (e + (lambda * fe - mu * ge) / size));
  }

  /// Volume over that of the regular tetrahedron in the same sphere: 1 is best.
  double quality() const {
    const double radius = std::min(circumradius(), foam_great);
    return volume() /
           (8.0 / (9.0 * std::sqrt(3.0)) * (radius * radius * radius) + foam_root_vsmall);
  }
};

/// Tetrahedra with less quality than this count as poor.
constexpr double least_quality = foam_small * foam_small;

}  // namespace

FaceGeometry face_geometry(std::span<const Vec3> corners) {
  const std::size_t n = corners.size();
  if (n == 3) {
    const Vec3 &a = corners[0], &b = corners[1], &c = corners[2];
    return {1.0 / 3 * (a + b + c), 0.5 * (b - a).cross(c - a)};
  }
  Vec3 mean = corners[0];
  for (std::size_t k = 1; k < n; ++k) mean += corners[k];
  mean /= static_cast<double>(n);
  Vec3 doubled_area(0, 0, 0), weighted(0, 0, 0);
  double weight = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 &here = corners[k], &next = corners[k + 1 < n ? k + 1 : 0];
    const Vec3 triangle = (next - here).cross(mean - here);
    const double size = length(triangle);
    doubled_area += triangle;
    weight += size;
    weighted += size * (here + next + mean);
  }
  if (weight < foam_root_vsmall) return {mean, Vec3(0, 0, 0)};
  return {1.0 / 3 * weighted / weight, 0.5 * doubled_area};
}

CellGeometry cell_geometry(std::span<const FaceGeometry> faces) {
  Vec3 mean(0, 0, 0), weighted(0, 0, 0);
  for (const FaceGeometry& face : faces) mean += face.centre;
  mean /= static_cast<double>(faces.size());
  double tripled = 0;
  for (const FaceGeometry& face : faces) {
    const double pyramid = dot(face.area, face.centre - mean);
    weighted += pyramid * (0.75 * face.centre + 0.25 * mean);
    tripled += pyramid;
  }
  return {std::abs(tripled) > foam_vsmall ? Vec3(weighted / tripled) : mean, tripled * (1.0 / 3)};
}

void add_face_slopes(std::span<const Vec3> corners, const FaceGeometry& slopes,
                     std::span<Vec3> out) {
  const std::size_t n = corners.size();
  const FaceGeometry face = face_geometry(corners);
  Vec3 mean(0, 0, 0);
  for (const Vec3& corner : corners) mean += corner;
  mean /= static_cast<double>(n);
  double weight = 0;
  const auto triangle = [&](std::size_t k) -> Vec3 {
    return (corners[(k + 1) % n] - corners[k]).cross(mean - corners[k]);
  };
  for (std::size_t k = 0; k < n; ++k) weight += length(triangle(k));
  Vec3 of_mean(0, 0, 0);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 &here = corners[k], &next = corners[(k + 1) % n];
    const Vec3 doubled = triangle(k);
    const double size = length(doubled);
    Vec3 of_triangle = 0.5 * slopes.area;
    if (weight >= foam_root_vsmall && size > 0) {
      const Vec3 middle = (here + next + mean) / 3;
      of_triangle += dot(slopes.centre, middle - face.centre) / (weight * size) * doubled;
      const Vec3 of_middle = size / (3 * weight) * slopes.centre;
      out[k] += of_middle;
      out[(k + 1) % n] += of_middle;
      of_mean += of_middle;
    }
    // The triangle is (next - here) x (mean - here).
    const Vec3 of_next = (mean - here).cross(of_triangle);
    const Vec3 of_last = of_triangle.cross(next - here);
    out[(k + 1) % n] += of_next;
    out[k] -= of_next + of_last;
    of_mean += of_last;
  }
  for (std::size_t k = 0; k < n; ++k) out[k] += of_mean / static_cast<double>(n);
}

void add_centre_slopes(std::span<const FaceGeometry> faces, const Vec3& slope,
                       std::span<FaceGeometry> out) {
  const auto n = static_cast<double>(faces.size());
  const CellGeometry cell = cell_geometry(faces);
  Vec3 mean(0, 0, 0);
  for (const FaceGeometry& face : faces) mean += face.centre;
  mean /= n;
  const double tripled = 3 * cell.volume;
  Vec3 of_mean(0, 0, 0);
  if (!(std::abs(tripled) > foam_vsmall)) {
    of_mean = slope;
  } else {
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const double pyramid = dot(faces[k].area, faces[k].centre - mean);
      const Vec3 middle = 0.75 * faces[k].centre + 0.25 * mean;
      const double of_pyramid = dot(slope, middle - cell.centre) / tripled;
      out[k].centre += 0.75 * pyramid / tripled * slope + of_pyramid * faces[k].area;
      out[k].area += of_pyramid * (faces[k].centre - mean);
      of_mean += 0.25 * pyramid / tripled * slope - of_pyramid * faces[k].area;
    }
  }
  for (FaceGeometry& face : out.first(faces.size())) face.centre += of_mean / n;
}

CellFaces make_cell_faces(CompressedRows nodes, std::vector<Index> owner,
                          std::vector<Index> neighbour, Index cell_count) {
  CellFaces faces{std::move(nodes), std::move(owner), std::move(neighbour), {}};
  faces.of_cell = rows_of(cell_count, [&](const auto& add) {
    for (const auto* side : {&faces.owner, &faces.neighbour}) {
      for (Index f = 0; f < faces.face_count(); ++f)
        if ((*side)[at(f)] >= 0) add((*side)[at(f)], f);
    }
  });
  return faces;
}

CellFaces cell_faces(const Topology& topology) {
  require_volume(topology, "OpenFOAM's measures of quality: found ");
  CompressedRows nodes;
  std::vector<Index> owner, neighbour;
  const Index count = topology.face_count();
  nodes.offsets.reserve(at(count) + 1);
  nodes.values.reserve(4 * at(count));
  owner.reserve(at(count));
  neighbour.reserve(at(count));
  for (Index f = 0; f < count; ++f) {
    const Topology::SharedFace face = topology.face(f);
    nodes.values.insert(nodes.values.end(), face.nodes.begin(), face.nodes.end());
    nodes.end_row();
    owner.push_back(face.elements[0]);
    neighbour.push_back(face.elements[1]);
  }
  return make_cell_faces(std::move(nodes), std::move(owner), std::move(neighbour),
                         topology.element_count());
}

namespace {

/// Adds the faces of an element by their numbers in the topology.
void add_faces_of(const Topology& topology, Index e, std::vector<Index>& list) {
  const auto corners = topology.element(e);
  for (const Face& face : topology.shape(e).faces)
    list.push_back(*topology.find_face(by_nodes(face, corners)));
}

}  // namespace

CellSurroundings cell_surroundings(const Topology& topology, Index element) {
  require_volume(topology, "OpenFOAM's measures of quality: found ");
  std::vector<Index> own, cells, list;
  add_faces_of(topology, element, own);
  for (const Index f : own)
    for (const Index e : topology.face(f).elements)
      if (e >= 0) cells.push_back(e);
  sort_unique(cells);
  for (const Index e : cells) add_faces_of(topology, e, list);
  sort_unique(list);
  const auto others = static_cast<Index>(cells.size());
  const auto number_of = [&](Index e) {
    const auto place = std::ranges::lower_bound(cells, e);
    if (e < 0 || place == cells.end() || *place != e) return e < 0 ? e : others;
    return static_cast<Index>(place - cells.begin());
  };
  CompressedRows nodes;
  std::vector<Index> owner, neighbour;
  for (const Index f : list) {
    const Topology::SharedFace face = topology.face(f);
    nodes.values.insert(nodes.values.end(), face.nodes.begin(), face.nodes.end());
    nodes.end_row();
    owner.push_back(number_of(face.elements[0]));
    neighbour.push_back(number_of(face.elements[1]));
  }
  return {make_cell_faces(std::move(nodes), std::move(owner), std::move(neighbour), others + 1),
          number_of(element)};
}

FiniteVolumes::FiniteVolumes(const CellFaces& faces, const Coordinates& x, int threads,
                             SolvedDirections directions)
    : faces_(faces),
      x_(x),
      directions_(directions),
      face_centres_(at(faces.face_count())),
      areas_(at(faces.face_count())),
      cell_centres_(at(faces.cell_count())),
      volumes_(at(faces.cell_count())) {
  parallel_for(threads, faces_.face_count(), [&](Index begin, Index end) {
    for (Index f = begin; f < end; ++f) measure_face(f);
  });
  parallel_for(threads, faces_.cell_count(), [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) measure_cell(c);
  });
}

Vec3 FiniteVolumes::node(Index face, std::size_t k) const {
  const auto nodes = faces_.nodes[face];
  return x_[nodes[k < nodes.size() ? k : k - nodes.size()]];
}

void FiniteVolumes::measure_face(Index face) {
  std::vector<Vec3> corners;
  for (const Index node : faces_.nodes[face]) corners.emplace_back(x_[node]);
  const FaceGeometry found = face_geometry(corners);
  face_centres_[at(face)] = found.centre;
  areas_[at(face)] = found.area;
}

void FiniteVolumes::measure_cell(Index cell) {
  std::vector<FaceGeometry> faces;
  for (const Index f : faces_.of_cell[cell]) {
    const bool owner = faces_.owner[at(f)] == cell;
    faces.push_back({face_centres_[at(f)], owner ? areas_[at(f)] : Vec3(-areas_[at(f)])});
  }
  const CellGeometry found = cell_geometry(faces);
  cell_centres_[at(cell)] = found.centre;
  volumes_[at(cell)] = found.volume;
}

double FiniteVolumes::area(Index face) const { return length(areas_[at(face)]); }

double FiniteVolumes::orthogonality(Index face) const {
  const Vec3 d = cell_centre(faces_.neighbour[at(face)]) - cell_centre(faces_.owner[at(face)]);
  const Vec3& s = area_vector(face);
  return dot(d, s) / (length(d) * length(s) + foam_root_vsmall);
}

double FiniteVolumes::face_skewness(Index face) const {
  const bool internal = faces_.internal(face);
  const Vec3 &own = cell_centre(faces_.owner[at(face)]), &s = area_vector(face);
  const Vec3 to_face = face_centre(face) - own;
  Vec3 d;
  if (internal) {
    d = cell_centre(faces_.neighbour[at(face)]) - own;
  } else {
    const double size = length(s);
    const Vec3 normal = size < foam_vsmall ? Vec3(0, 0, 0) : Vec3(s / size);
    d = normal * dot(normal, to_face);
  }
  const Vec3 off = to_face - dot(s, to_face) / (dot(s, d) + foam_root_vsmall) * d;
  const Vec3 direction = off / (length(off) + foam_root_vsmall);
  double reach = (internal ? 0.2 : 0.4) * length(d) + foam_root_vsmall;
  for (const Index node : faces_.nodes[face])
    reach = std::max(reach, std::abs(dot(direction, x_[node] - face_centre(face))));
  return length(off) / reach;
}

double FiniteVolumes::pyramid(Index face, Index cell, int sign) const {
  return sign * (1.0 / 3 * dot(area_vector(face), face_centre(face) - cell_centre(cell)));
}

double FiniteVolumes::face_weight(Index face) const {
  const Vec3 &s = area_vector(face), &centre = face_centre(face);
  const double own = std::abs(dot(s, centre - cell_centre(faces_.owner[at(face)])));
  const double other = std::abs(dot(s, cell_centre(faces_.neighbour[at(face)]) - centre));
  return std::min(own, other) / (own + other + foam_vsmall);
}

double FiniteVolumes::face_volume_ratio(Index face) const {
  const auto [low, high] =
      std::minmax({volume(faces_.owner[at(face)]), volume(faces_.neighbour[at(face)])});
  return low / (high + foam_vsmall);
}

double FiniteVolumes::flatness(Index face) const {
  const std::size_t n = faces_.nodes[face].size();
  const double whole = area(face);
  if (n <= 3 || !(whole > foam_root_vsmall)) return 1;
  double sum = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 here = node(face, k), next = node(face, k + 1);
    sum += length(0.5 * (next - here).cross(face_centre(face) - here));
  }
  return whole / (sum + foam_root_vsmall);
}

double FiniteVolumes::concavity(Index face, double angle) const {
  const std::size_t n = faces_.nodes[face].size();
  const Vec3 normal = area_vector(face) / (area(face) + foam_root_vsmall);
  const double least = std::sin(angle);
  Vec3 before = node(face, 0) - node(face, n - 1);
  double length_before = length(before), largest = 0;
  before /= length_before + foam_root_vsmall;
  for (std::size_t k = 0; k < n; ++k) {
    Vec3 edge = node(face, k + 1) - node(face, k);
    const double size = length(edge);
    edge /= size + foam_root_vsmall;
    if (length_before > foam_small && size > foam_small) {
      const Vec3 turn = before.cross(edge);
      const double sine = length(turn);
      if (sine >= least && dot(turn / sine, normal) < foam_small) largest = std::max(largest, sine);
    }
    before = edge;
    length_before = size;
  }
  return largest;
}

double FiniteVolumes::smallest_quality(Index face, Index cell, bool owner, std::size_t base) const {
  const std::size_t n = faces_.nodes[face].size();
  double smallest = foam_vgreat;
  for (std::size_t k = 1; k + 1 < n; ++k) {
    Vec3 a = node(face, (base + k) % n), b = node(face, (base + k) % n + 1);
    if (!owner) std::swap(a, b);
    const Tetrahedron part{cell_centre(cell), node(face, base), a, b};
    smallest = std::min(smallest, part.quality());
  }
  return smallest;
}

bool FiniteVolumes::divides_from_a_node(Index face) const {
  for (std::size_t base = 0; base < faces_.nodes[face].size(); ++base) {
    double smallest = smallest_quality(face, faces_.owner[at(face)], true, base);
    if (faces_.internal(face))
      smallest =
          std::min(smallest, smallest_quality(face, faces_.neighbour[at(face)], false, base));
    if (smallest > least_quality) return true;
  }
  return false;
}

int FiniteVolumes::poor_divisions(Index face) const {
  const auto poor = [&](Index cell, int sign) {
    for (std::size_t k = 0; k < faces_.nodes[face].size(); ++k) {
      const Tetrahedron part{node(face, k), node(face, k + 1), face_centre(face),
                             cell_centre(cell)};
      if (sign * part.quality() < least_quality) return 1;
    }
    return 0;
  };
  int count = poor(faces_.owner[at(face)], -1);
  if (faces_.internal(face)) count += poor(faces_.neighbour[at(face)], 1);
  return count + (divides_from_a_node(face) ? 0 : 1);
}

double FiniteVolumes::openness(Index cell) const {
  Vec3 sum(0, 0, 0), sizes(0, 0, 0);
  for (const Index f : faces_.of_cell[cell]) {
    const Vec3& s = area_vector(f);
    sum += faces_.owner[at(f)] == cell ? s : Vec3(-s);
    sizes += s.cwiseAbs();
  }
  double largest = 0;
  for (Index k = 0; k < 3; ++k)
    largest = std::max(largest, std::abs(sum[k]) / (sizes[k] + foam_root_vsmall));
  return largest;
}

double FiniteVolumes::aspect_ratio(Index cell) const {
  Vec3 sizes(0, 0, 0);
  for (const Index f : faces_.of_cell[cell]) sizes += area_vector(f).cwiseAbs();
  double smallest = foam_vgreat, largest = -foam_vgreat;
  for (Index k = 0; k < 3; ++k) {
    if (!directions_[at(k)]) continue;
    smallest = std::min(smallest, sizes[k]);
    largest = std::max(largest, sizes[k]);
  }
  const double ratio = largest / (smallest + foam_root_vsmall);
  if (std::ranges::count(directions_, true) < 3) return ratio;
  const double size = std::pow(std::max(foam_root_vsmall, volume(cell)), 2.0 / 3);
  return std::max(ratio, 1.0 / 6 * (sizes[0] + sizes[1] + sizes[2]) / size);
}

double FiniteVolumes::determinant(Index cell) const {
  const auto solved = std::ranges::count(directions_, true);
  if (solved == 1) return 1;
  double mean = 0;
  int count = 0;
  for (const Index f : faces_.of_cell[cell]) {
    if (!faces_.internal(f)) continue;
    mean += area(f);
    ++count;
  }
  if (count == 0 || mean < foam_root_vsmall) return 0;
  mean /= count;
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  for (const Index f : faces_.of_cell[cell]) {
    if (!faces_.internal(f)) continue;
    const Vec3 s = area_vector(f) / mean;
    xx += s[0] * s[0];
    xy += s[0] * s[1];
    xz += s[0] * s[2];
    yy += s[1] * s[1];
    yz += s[1] * s[2];
    zz += s[2] * s[2];
  }
  if (solved == 2) (!directions_[0] ? xx : !directions_[1] ? yy : zz) = 1;
  const double value =
      xx * yy * zz + xy * yz * xz + xz * xy * yz - xx * yz * yz - xy * xy * zz - xz * yy * xz;
  return std::abs(value) / 8;
}

bool FiniteVolumes::concave(Index cell) const {
  constexpr double plane =
      1e-6;  // cosine of the angle between a plane and the way to a point on it
  const auto faces = faces_.of_cell[cell];
  for (const Index f : faces) {
    Vec3 normal = area_vector(f) / std::max(area(f), foam_vsmall);
    if (faces_.owner[at(f)] != cell) normal = -normal;
    for (const Index other : faces) {
      if (other == f) continue;
      const Vec3 way = face_centre(other) - face_centre(f);
      if (dot(way / std::max(length(way), foam_vsmall), normal) > -plane) return true;
    }
  }
  return false;
}

double FiniteVolumes::non_orthogonality(Index cell) const {
  double least = 1;
  for (const Index f : faces_.of_cell[cell])
    if (faces_.internal(f)) least = std::min(least, orthogonality(f));
  return degrees(std::acos(std::clamp(least, -1.0, 1.0)));
}

double FiniteVolumes::skewness(Index cell) const {
  double largest = 0;
  for (const Index f : faces_.of_cell[cell]) largest = std::max(largest, face_skewness(f));
  return largest;
}

double FiniteVolumes::volume_ratio(Index cell) const {
  double smallest = 1;
  for (const Index f : faces_.of_cell[cell])
    if (faces_.internal(f)) smallest = std::min(smallest, face_volume_ratio(f));
  return smallest;
}

double FiniteVolumes::weight(Index cell) const {
  double smallest = 0.5;
  for (const Index f : faces_.of_cell[cell])
    if (faces_.internal(f)) smallest = std::min(smallest, face_weight(f));
  return smallest;
}

double FiniteVolumes::face_pyramid(Index cell) const {
  double smallest = foam_vgreat;
  for (const Index f : faces_.of_cell[cell])
    smallest =
        std::min(smallest, faces_.owner[at(f)] == cell ? owner_pyramid(f) : neighbour_pyramid(f));
  const double mean = std::abs(volume(cell)) / static_cast<double>(faces_.of_cell[cell].size());
  return smallest / std::max(mean, foam_vsmall);
}

}  // namespace winslow
