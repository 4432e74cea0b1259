#include "core/layers/space/column_direction.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "core/error.h"
#include "support/walled_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// The largest smallest cosine over a grid on the sphere, refined around its best point.
double best_of_grid(const std::vector<Vec3>& normals) {
  const auto least = [&](double turn, double rise) {
    const Vec3 d(std::cos(turn) * std::cos(rise), std::sin(turn) * std::cos(rise), std::sin(rise));
    double least = 1;
    for (const Vec3& n : normals) least = std::min(least, n.dot(d));
    return least;
  };
  double best = -2, turn = 0, rise = 0, width = pi;
  for (int level = 0; level < 14; ++level) {
    constexpr int steps = 40;
    const double around = turn, up = rise;
    for (int i = -steps; i <= steps; ++i) {
      for (int j = -steps; j <= steps; ++j) {
        const double a = around + width * i / steps;
        const double b = std::clamp(up + 0.5 * width * j / steps, -pi / 2, pi / 2);
        if (least(a, b) <= best) continue;
        best = least(a, b);
        turn = a;
        rise = b;
      }
    }
    width *= 0.3;
  }
  return best;
}

/// The best of the middles of all pairs and the circles through all triples.
double best_of_candidates(const std::vector<Vec3>& normals) {
  double best = -2;
  const auto consider = [&](const Vec3& d) {
    if (!(d.norm() > 1e-9)) return;
    double least = 1;
    for (const Vec3& n : normals) least = std::min(least, n.dot(d.normalized()));
    best = std::max(best, least);
  };
  for (const Vec3& a : normals) {
    for (const Vec3& b : normals) {
      consider(a + b);
      for (const Vec3& c : normals) consider((b - a).cross(c - a));
    }
  }
  return best;
}

std::vector<LayerWall> walls_at(const std::string& marker) {
  return {{{marker}, {.count = 3, .first = 0.01}}};
}

std::string refusal(const Mesh& mesh, const std::string& marker) {
  try {
    column_directions(mesh, find_wall_surface(mesh, walls_at(marker)));
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("the narrowest cone around normals is that of a search over the sphere") {
  Random random(11);
  for (int trial = 0; trial < 60; ++trial) {
    CAPTURE(trial);
    const Vec3 middle = random_vector(random).normalized();
    const double spread = random.uniform(0.05, 1.5);
    std::vector<Vec3> normals;
    const int count = 1 + static_cast<int>(random.index(9));
    for (int k = 0; k < count; ++k)
      normals.push_back((middle + spread * random_vector(random)).normalized());
    const double best = best_of_grid(normals);
    if (best <= 0.02) continue;  // no half of the sphere holds them all
    const Cone cone = narrowest_cone(normals);
    CHECK(cone.axis.norm() == doctest::Approx(1));
    CHECK(cone.cosine >= best - 1e-9);
    CHECK(cone.cosine <= best + 1e-3);  // the search stops on ridges
    CHECK(cone.cosine == doctest::Approx(best_of_candidates(normals)).epsilon(1e-9));
  }
}

TEST_CASE("cones of few normals are known") {
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  CHECK(narrowest_cone(std::vector<Vec3>{x}).cosine == 1);
  CHECK(narrowest_cone(std::vector<Vec3>{x, x, x}).axis == x);
  CHECK(narrowest_cone(std::vector<Vec3>{x, y, x}).cosine == doctest::Approx(std::sqrt(0.5)));
  CHECK(narrowest_cone(std::vector<Vec3>{x, y, z}).cosine == doctest::Approx(std::sqrt(1.0 / 3)));
  CHECK(narrowest_cone(std::vector<Vec3>{x, -x}).cosine <= 0);
  CHECK(narrowest_cone(std::vector<Vec3>{x, -x, y}).cosine <= 1e-9);
}

TEST_CASE("columns stand along the radius of a ball, and along the diagonals of a cube's corners") {
  const Mesh ball = ball_in_box(12, Volumes::tetrahedra);
  const WallSurface round = find_wall_surface(ball, walls_at("cavity"));
  const auto directions = column_directions(ball, round);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vec3 radius = (ball.coordinates.xyz(round.nodes[i]) - Vec3::Constant(0.5)).normalized();
    CHECK(directions[i].direction.dot(radius) > std::cos(radians(8)));
    CHECK(directions[i].slant < 1.1);
    CHECK_FALSE(directions[i].along_boundary);
  }
  const Mesh cube = make_mesh(cube_with_cavity(6, Volumes::mixed));
  const WallSurface flat = find_wall_surface(cube, walls_at("cavity"));
  const auto mitred = column_directions(cube, flat);
  for (std::size_t i = 0; i < mitred.size(); ++i) {
    const Vec3 q = cube.coordinates.xyz(flat.nodes[i]) - Vec3::Constant(0.5);
    const Vec3 sides = (6 * q.array().abs() > 1 - 1e-9).select(q.array().sign(), 0);
    CHECK((mitred[i].direction - sides.normalized()).norm() < 1e-9);
    CHECK(mitred[i].slant == doctest::Approx(sides.norm()));
  }
}

TEST_CASE("columns at the rim lie in the planes that the wall ends at") {
  const Mesh ball = half_ball_on_floor(12, Volumes::tetrahedra);
  const WallSurface surface = find_wall_surface(ball, walls_at("body"));
  const auto directions = column_directions(ball, surface);
  std::size_t rim = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vec3 p = ball.coordinates.xyz(surface.nodes[i]);
    CHECK(directions[i].along_boundary == (p.z() == 0));
    if (p.z() != 0) continue;
    ++rim;
    CHECK(std::abs(directions[i].direction.z()) < 1e-12);
    CHECK(directions[i].direction.dot((p - Vec3(0.5, 0.5, 0)).normalized()) > std::cos(radians(8)));
    CHECK(std::isinf(directions[i].edge));
  }
  CHECK(rim == 16);

  // Where two planes meet, along both.
  const Mesh corner = make_mesh(box_with_body_on_two_planes(6, Volumes::hexahedra));
  const WallSurface block = find_wall_surface(corner, walls_at("body"));
  const auto columns = column_directions(corner, block);
  int along_both = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Vec3 p = corner.coordinates.xyz(block.nodes[i]);
    if (p.y() == 0) CHECK(std::abs(columns[i].direction.y()) < 1e-12);
    if (p.z() == 0) CHECK(std::abs(columns[i].direction.z()) < 1e-12);
    if (p.y() != 0 || p.z() != 0) continue;
    ++along_both;
    CHECK(std::abs(columns[i].direction.x()) == doctest::Approx(1));
  }
  CHECK(along_both == 2);
}

TEST_CASE("along a curved boundary columns follow its edges") {
  MeshData data = cube(6, Volumes::hexahedra);
  // The sides bulge with the square of the height above the floor.
  for (Index node = 0; node < data.node_count(); ++node) {
    Vec3 p = data.coordinates.xyz(node);
    p.x() = 0.5 + (p.x() - 0.5) * (1 + 0.4 * p.z() * p.z() + 0.3 * p.y() * (1 - p.y()));
    data.coordinates.set_xyz(node, p);
  }
  const Mesh mesh = make_mesh(data);
  const WallSurface surface = find_wall_surface(mesh, walls_at("floor"));
  const auto columns = column_directions(mesh, surface);
  int followed = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (std::isinf(columns[i].edge)) continue;
    ++followed;
    const Index node = surface.nodes[i];
    bool is_edge = false;
    for (const Index other : mesh.topology->neighbours(node)) {
      const Vec3 edge = mesh.coordinates.xyz(other) - mesh.coordinates.xyz(node);
      is_edge |= mesh.topology->on_boundary(other) &&
                 (edge.normalized() - columns[i].direction).norm() < 1e-12 &&
                 std::abs(edge.norm() - columns[i].edge) < 1e-12;
    }
    CHECK(is_edge);
  }
  CHECK(followed >= 10);
}

TEST_CASE("places where no column can stand are named") {
  CHECK(refusal(box_with_spike(0.35), "body") == "");
  const std::string sharp = refusal(box_with_spike(0.9), "body");
  CHECK(sharp.find("turns too sharply at node") != std::string::npos);
  CHECK(sharp.find("(0.5, 0.5, 0.9)") != std::string::npos);
  CHECK(sharp.find("such ridges cannot have layers yet") != std::string::npos);
  CHECK(refusal(box_with_spike(3), "body").find("no direction sees all faces") !=
        std::string::npos);

  // Half of a flat wall: the other half goes straight on.
  const Mesh flat = make_mesh(cube(4, Volumes::tetrahedra));
  std::vector<LayerWall> half = walls_at("floor");
  half[0].part.xmax = 0.5;
  CHECK_THROWS_WITH_AS(column_directions(flat, find_wall_surface(flat, half)),
                       doctest::Contains("goes on almost straight"), UsageError);
}
