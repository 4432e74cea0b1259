#include "core/formulation/face_penalty.h"

#include <doctest/doctest.h>

#include "core/error.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

TEST_CASE("derivatives of faces and cells agree with finite differences") {
  const std::vector<Vec3> corners{
      {0, 0, 0}, {1.1, 0.1, 0.2}, {1.4, 0.9, -0.1}, {0.6, 1.3, 0.3}, {-0.2, 0.8, 0.1}};
  const FaceGeometry slopes{{0.3, -1.2, 0.7}, {-0.4, 0.9, 1.1}};
  for (const std::size_t n : {3U, 4U, 5U}) {
    const auto first = std::span(corners).first(n);
    std::vector<Vec3> face(first.begin(), first.end());
    std::vector<Vec3> found(n, Vec3(0, 0, 0));
    add_face_slopes(face, slopes, found);
    const auto value = [&] {
      const FaceGeometry geometry = face_geometry(face);
      return geometry.centre.dot(slopes.centre) + geometry.area.dot(slopes.area);
    };
    for (std::size_t k = 0; k < n; ++k) {
      for (int c = 0; c < 3; ++c) {
        constexpr double h = 1e-5;
        const double kept = face[k][c];
        face[k][c] = kept + h;
        const double above = value();
        face[k][c] = kept - h;
        const double below = value();
        face[k][c] = kept;
        CHECK(found[k][c] == doctest::Approx((above - below) / (2 * h)).epsilon(1e-7));
      }
    }
  }
}

TEST_CASE("the penalty on the angles of faces agrees with finite differences") {
  Mesh mesh = make_mesh(split_box_with_body(2));
  // A shear makes faces lean by 45 degrees, and a bend makes each angle another one.
  for (Index i = 0; i < mesh.coordinates.size(); ++i) {
    Vec3 p = mesh.coordinates.xyz(i);
    p.x() += p.y() + 0.1 * p.z() * p.z();
    p.z() += 0.07 * p.x() * p.y();
    mesh.coordinates.set_xyz(i, p);
  }
  const CellFaces faces = cell_faces(*mesh.topology);
  std::vector<Index> internal;
  for (Index f = 0; f < faces.face_count(); ++f)
    if (faces.internal(f)) internal.push_back(f);
  const FacePenalty penalty(faces, internal, {20, 40});
  std::vector<Vec3> slopes(at(mesh.coordinates.size()), Vec3(0, 0, 0));
  constexpr double factor = 0.7;
  CHECK(penalty.add(mesh.coordinates, factor, slopes) > 1);
  double largest = 0;
  for (Index i = 0; i < mesh.coordinates.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      constexpr double h = 1e-5;
      const Vec3 kept = mesh.coordinates.xyz(i);
      const auto value = [&](double by) {
        Vec3 p = kept;
        p[c] += by;
        mesh.coordinates.set_xyz(i, p);
        return factor * penalty.add(mesh.coordinates, factor, {});
      };
      const double found = (value(h) - value(-h)) / (2 * h);
      mesh.coordinates.set_xyz(i, kept);
      CHECK(slopes[at(i)][c] == doctest::Approx(found).epsilon(1e-5));
      largest = std::max(largest, std::abs(found));
    }
  }
  CHECK(largest > 0.1);
  const FiniteVolumes all(faces, mesh.coordinates);
  for (const Index f : internal)
    CHECK(penalty.cosine(mesh.coordinates, f) == doctest::Approx(all.orthogonality(f)));
}

TEST_CASE("no penalty below the first angle, and none on the boundary") {
  const Mesh mesh = make_mesh(split_box_with_body(2));
  const CellFaces faces = cell_faces(*mesh.topology);
  Index internal = 0;
  while (!faces.internal(internal)) ++internal;
  CHECK(FacePenalty(faces, {internal}, {60, 68}).add(mesh.coordinates, 1, {}) == 0);
  Index outside = 0;
  while (faces.internal(outside)) ++outside;
  CHECK_THROWS_AS(FacePenalty(faces, {outside}, {60, 68}), UsageError);
}
