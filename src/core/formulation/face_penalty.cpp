#include "core/formulation/face_penalty.h"

#include <Eigen/Geometry>

#include "core/error.h"

namespace winslow {

namespace {

std::vector<Vec3> corners_of(const CellFaces& faces, const SpacePoints& x, Index face) {
  std::vector<Vec3> corners;
  for (const Index node : faces.nodes[face]) corners.emplace_back(x[node]);
  return corners;
}

/// The faces of a cell, with area vectors that point out of it.
std::vector<FaceGeometry> geometry_of(const CellFaces& faces, const SpacePoints& x, Index cell) {
  std::vector<FaceGeometry> list;
  for (const Index f : faces.of_cell[cell]) {
    FaceGeometry face = face_geometry(corners_of(faces, x, f));
    if (faces.owner[at(f)] != cell) face.area = -face.area;
    list.push_back(face);
  }
  return list;
}

}  // namespace

FacePenalty::FacePenalty(const CellFaces& faces, std::vector<Index> penalised, const Angles& angles)
    : faces_(faces), penalised_(std::move(penalised)), angles_(angles) {
  if (!std::ranges::all_of(penalised_, [&](Index f) { return faces_.internal(f); }))
    throw UsageError("a face on the boundary has one cell: it has no angle to be penalised");
}

void FacePenalty::add_slopes_of_cell(const SpacePoints& x, Index cell, const Vec3& slope,
                                     std::span<Vec3> slopes) const {
  const std::vector<FaceGeometry> geometry = geometry_of(faces_, x, cell);
  std::vector<FaceGeometry> of_faces(geometry.size(), {Vec3(0, 0, 0), Vec3(0, 0, 0)});
  add_centre_slopes(geometry, slope, of_faces);
  std::vector<Vec3> of_corners;
  std::size_t k = 0;
  for (const Index f : faces_.of_cell[cell]) {
    FaceGeometry of_face = of_faces[k++];
    if (faces_.owner[at(f)] != cell) of_face.area = -of_face.area;
    const std::vector<Vec3> corners = corners_of(faces_, x, f);
    of_corners.assign(corners.size(), Vec3(0, 0, 0));
    add_face_slopes(corners, of_face, of_corners);
    for (std::size_t c = 0; c < of_corners.size(); ++c)
      slopes[at(faces_.nodes[f][c])] += of_corners[c];
  }
}

/// The area vector of a face, the way from its owner's centre to its neighbour's, and what follows.
struct FacePenalty::Lean {
  Vec3 s, d;
  double size, cosine;
};

FacePenalty::Lean FacePenalty::lean_of(const SpacePoints& x, Index face) const {
  const Vec3 s = face_geometry(corners_of(faces_, x, face)).area;
  const auto centre = [&](Index cell) {
    return cell_geometry(geometry_of(faces_, x, cell)).centre;
  };
  const Vec3 d = centre(faces_.neighbour[at(face)]) - centre(faces_.owner[at(face)]);
  const double size = d.norm() * s.norm();
  return {s, d, size, size > 0 ? std::clamp(d.dot(s) / size, -1.0, 1.0) : 1};
}

double FacePenalty::cosine(const Coordinates& x, Index face) const {
  return lean_of(SpacePoints(x), face).cosine;
}

double FacePenalty::add(const Coordinates& x, double factor, std::span<Vec3> slopes) const {
  const SpacePoints points(x);
  const double first = radians(angles_.first), range = radians(angles_.full) - first;
  double sum = 0;
  for (const Index f : penalised_) {
    const auto [s, d, size, cosine] = lean_of(points, f);
    const double share = (std::acos(cosine) - first) / range;
    if (!(share > 0)) continue;
    sum += share * share * share;
    const double sine = std::sqrt(1 - cosine * cosine);
    if (slopes.empty() || !(sine > 0)) continue;
    const double of_cosine = -factor * 3 * share * share / (range * sine);
    const Vec3 of_s = of_cosine * (d / size - cosine / s.squaredNorm() * s);
    const Vec3 of_d = of_cosine * (s / size - cosine / d.squaredNorm() * d);
    const std::vector<Vec3> corners = corners_of(faces_, points, f);
    std::vector<Vec3> of_corners(corners.size(), Vec3(0, 0, 0));
    add_face_slopes(corners, {Vec3(0, 0, 0), of_s}, of_corners);
    for (std::size_t c = 0; c < of_corners.size(); ++c)
      slopes[at(faces_.nodes[f][c])] += of_corners[c];
    add_slopes_of_cell(points, faces_.neighbour[at(f)], of_d, slopes);
    add_slopes_of_cell(points, faces_.owner[at(f)], -of_d, slopes);
  }
  return sum;
}

}  // namespace winslow
