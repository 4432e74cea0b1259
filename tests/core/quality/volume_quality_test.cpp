#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "core/error.h"
#include "core/mesh/element_type.h"
#include "core/quality/quality.h"
#include "core/quality/validity.h"
#include "core/quality/volume_element.h"
#include "support/random.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

constexpr std::array volume_types{ElementType::tetrahedron, ElementType::pyramid,
                                  ElementType::prism, ElementType::hexahedron};

struct Single {
  Coordinates x{3, 0};
  std::vector<Index> corners;
  ElementType type;

  explicit Single(ElementType of) : type(of) {
    for (const auto& place : regular_corners(of)) {
      corners.push_back(x.size());
      x.push_xyz(Vec3(place.data()));
    }
  }
  VolumeElement element() const { return {x, shape_of(type), corners}; }
};

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); }

/// Jacobian of the map from the reference element at a point of it, by its shape functions.
double jacobian(const Single& s, const Vec3& at) {
  const double u = at.x(), v = at.y(), w = at.z();
  std::vector<Vec3> slopes;
  const auto p = [&](std::size_t k) { return s.x.xyz(s.corners[k]); };
  Vec3 du(0, 0, 0), dv(0, 0, 0), dw(0, 0, 0);
  if (s.type == ElementType::prism) {
    const auto side = [&](std::size_t k) { return Vec3((1 - w) * p(k) + w * p(k + 3)); };
    du = side(1) - side(0);
    dv = side(2) - side(0);
    dw = (1 - u - v) * (p(3) - p(0)) + u * (p(4) - p(1)) + v * (p(5) - p(2));
  } else {
    const auto level = [&](std::size_t k) { return Vec3((1 - w) * p(k) + w * p(k + 4)); };
    du = (1 - v) * (level(1) - level(0)) + v * (level(2) - level(3));
    dv = (1 - u) * (level(3) - level(0)) + u * (level(2) - level(1));
    dw = (1 - u) * (1 - v) * (p(4) - p(0)) + u * (1 - v) * (p(5) - p(1)) + u * v * (p(6) - p(2)) +
         (1 - u) * v * (p(7) - p(3));
  }
  return determinant(du, dv, dw);
}

double smallest_sampled(const Single& s) {
  constexpr int n = 24;
  double smallest = 1e300;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      for (int k = 0; k <= n; ++k) {
        if (s.type == ElementType::prism && i + j > n) continue;
        smallest = std::min(smallest, jacobian(s, Vec3(i, j, k) / n));
      }
    }
  }
  return smallest;
}

}  // namespace

TEST_CASE("regular volume elements have the best values, however they lie") {
  Random random(1);
  for (const ElementType type : volume_types) {
    Single s(type);
    CAPTURE(shape_of(type).name);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(random.uniform(0, 6), Vec3(1, 2, -1).normalized()).toRotationMatrix();
    for (Index i = 0; i < s.x.size(); ++i) s.x.set_xyz(i, 3 * turn * s.x.xyz(i) + Vec3(1, 2, 3));
    CHECK(!s.element().inverted());
    CHECK(s.element().scaled_jacobian() == doctest::Approx(1));
    CHECK(s.element().radius_ratio() == doctest::Approx(1));
    CHECK(s.element().condition_number() == doctest::Approx(1));
  }
  CHECK(Single(ElementType::tetrahedron).element().volume() ==
        doctest::Approx(1 / (6 * std::sqrt(2.0))));
  CHECK(Single(ElementType::hexahedron).element().smallest_solid_angle() ==
        doctest::Approx(pi / 2));
  CHECK(Single(ElementType::tetrahedron).element().largest_solid_angle() ==
        doctest::Approx(3 * std::acos(1.0 / 3) - pi));
}

TEST_CASE("radius ratio and solid angles of a tetrahedron agree with other formulas") {
  Random random(2);
  for (int sample = 0; sample < 50; ++sample) {
    Single s(ElementType::tetrahedron);
    for (Index i = 0; i < 4; ++i)
      s.x.set_xyz(i, Vec3(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)));
    const auto p = [&](Index i) { return s.x.xyz(i); };
    const double volume = determinant(p(1) - p(0), p(2) - p(0), p(3) - p(0)) / 6;
    CHECK(s.element().inverted() == (volume <= 0));
    CHECK(s.element().volume() == doctest::Approx(volume));
    if (volume < 1e-3) continue;
    // Circumcentre by its linear system; inradius by volume and areas.
    Eigen::Matrix3d a;
    Vec3 b;
    for (int k = 0; k < 3; ++k) {
      a.row(k) = 2 * (p(k + 1) - p(0)).transpose();
      b[k] = p(k + 1).squaredNorm() - p(0).squaredNorm();
    }
    const double outer = (a.partialPivLu().solve(b) - p(0)).norm();
    const auto area = [&](Index i, Index j, Index k) {
      return 0.5 * (p(j) - p(i)).cross(p(k) - p(i)).norm();
    };
    const double inner =
        3 * volume / (area(0, 1, 2) + area(0, 1, 3) + area(0, 2, 3) + area(1, 2, 3));
    CHECK(s.element().radius_ratio() == doctest::Approx(outer / (3 * inner)).epsilon(1e-8));
    // Dihedral angles at the edges of a corner less pi.
    const auto dihedral = [&](Index at, Index along, Index i, Index j) {
      const Vec3 edge = (p(along) - p(at)).normalized();
      const auto across = [&](Index k) {
        const Vec3 d = p(k) - p(at);
        return Vec3(d - edge * edge.dot(d));
      };
      return std::acos(across(i).normalized().dot(across(j).normalized()));
    };
    double least = 100, most = 0;
    for (Index k = 0; k < 4; ++k) {
      const Index i = (k + 1) % 4, j = (k + 2) % 4, l = (k + 3) % 4;
      const double angle = dihedral(k, i, j, l) + dihedral(k, j, i, l) + dihedral(k, l, i, j) - pi;
      least = std::min(least, angle);
      most = std::max(most, angle);
    }
    CHECK(s.element().smallest_solid_angle() == doctest::Approx(least).epsilon(1e-6));
    CHECK(s.element().largest_solid_angle() == doctest::Approx(most).epsilon(1e-6));
  }
}

TEST_CASE("hexahedra and prisms are inverted where their Jacobian is not positive anywhere") {
  Random random(3);
  int inside_only = 0;
  for (const ElementType type : {ElementType::hexahedron, ElementType::prism}) {
    for (int sample = 0; sample < 2400; ++sample) {
      Single s(type);
      const double by = sample % 2 == 0 ? 0.62 : 0.35;
      for (Index i = 0; i < s.x.size(); ++i) {
        // In braces, so that every compiler draws them in the same order.
        s.x.set_xyz(i, s.x.xyz(i) + Vec3{random.uniform(-by, by), random.uniform(-by, by),
                                         random.uniform(-by, by)});
      }
      const double smallest = smallest_sampled(s);
      // Samples come near the smallest value; those near zero decide nothing.
      if (std::abs(smallest) < 0.01) continue;
      CAPTURE(smallest);
      CHECK(s.element().inverted() == (smallest < 0));
      if (smallest < 0 && s.element().scaled_jacobian() > 0) ++inside_only;
    }
  }
  CHECK(inside_only > 5);  // corners alone would have missed these
}

TEST_CASE("the largest valid step of tetrahedra is where the first determinant vanishes") {
  Random random(4);
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(cube(2, volumes));
    Coordinates to = mesh.coordinates;
    for (const Index node : mesh.topology->interior_nodes())
      to.set_xyz(node, to.xyz(node) + Vec3(random.uniform(-2, 2), random.uniform(-2, 2),
                                           random.uniform(-2, 2)));
    const double step = largest_valid_step(*mesh.topology, mesh.coordinates, to,
                                           std::numeric_limits<double>::infinity(), 1);
    REQUIRE(std::isfinite(step));
    CHECK(largest_valid_step(*mesh.topology, mesh.coordinates, to, 0.5 * step, 1) == 0.5 * step);
    CHECK(largest_valid_step(*mesh.topology, mesh.coordinates, to, 2 * step, 1) == step);
    const auto smallest = [&](double t) {
      Coordinates x = mesh.coordinates;
      for (std::size_t i = 0; i < x.values().size(); ++i)
        x.values()[i] += t * (to.values()[i] - x.values()[i]);
      const SpacePoints points(x);
      double least = 1e300;
      for (Index e = 0; e < mesh.topology->element_count(); ++e) {
        for (const auto& corner : mesh.topology->shape(e).corner_tetrahedra) {
          const VolumeCorner at(points, by_nodes(corner, mesh.topology->element(e)));
          least = std::min(least, at.determinant);
        }
      }
      return least;
    };
    for (const double share : {0.0, 0.3, 0.7, 0.999}) CHECK(smallest(share * step) > 0);
    CHECK(smallest(1.0001 * step) < 0);
  }
}

TEST_CASE("a mesh of which no element can move is measured; what is infinite everywhere is not") {
  const Mesh mesh = make_mesh(cube(1, Volumes::tetrahedra));
  const QualityReport report = measure_quality(mesh);
  CHECK(report.all_on_boundary == report.elements);
  CHECK(report.of(Metric::normalized_jacobian).statistics.min > 0.3);
  CHECK(std::isnan(report.of(Metric::normalized_jacobian).movable.avg));
  Mesh flat = make_mesh(cube(1, Volumes::tetrahedra));
  for (Index i = 0; i < flat.coordinates.size(); ++i)
    flat.coordinates.set_xyz(i, {flat.coordinates.xyz(i).x(), flat.coordinates.xyz(i).y(), 0});
  const QualityReport of_flat = measure_quality(flat);
  CHECK(std::isnan(of_flat.of(Metric::aspect_ratio).statistics.max));
  CHECK(of_flat.of(Metric::aspect_ratio).histogram.counts.size() == 20);
}

TEST_CASE("a report of a volume mesh names its metrics and what no smoothing can change") {
  const Mesh mesh = make_mesh(cube(3, Volumes::tetrahedra));
  const QualityReport report = measure_quality(mesh);
  CHECK(report.cell_dimension == 3);
  CHECK(report.inverted == 0);
  CHECK(report.metrics.size() == reported_metrics(3).size());
  Index fixed = 0;
  for (Index e = 0; e < mesh.topology->element_count(); ++e) {
    bool all = true;
    for (const Index node : mesh.topology->element(e)) all &= mesh.topology->on_boundary(node);
    fixed += all ? 1 : 0;
  }
  CHECK(report.all_on_boundary == fixed);
  CHECK(fixed > 0);
  CHECK(fixed < report.elements);
  const auto sines = element_values(mesh, Metric::normalized_jacobian);
  double smallest = 1, smallest_movable = 1, sum_movable = 0;
  for (Index e = 0; e < report.elements; ++e) {
    smallest = std::min(smallest, sines[at(e)]);
    if (all_on_boundary(*mesh.topology, e)) continue;
    smallest_movable = std::min(smallest_movable, sines[at(e)]);
    sum_movable += sines[at(e)];
  }
  const QualityReport::PerMetric sine = report.of(Metric::normalized_jacobian);
  CHECK(sine.statistics.min == smallest);
  const Statistics movable = sine.movable;
  CHECK(movable.min == smallest_movable);
  CHECK(movable.avg == doctest::Approx(sum_movable / (report.elements - fixed)));
  const auto volumes = element_values(mesh, Metric::volume);
  double sum = 0;
  for (const double v : volumes) sum += v;
  CHECK(sum == doctest::Approx(1));
  CHECK_THROWS_AS(element_values(mesh, Metric::area), UsageError);
  CHECK(report.of(Metric::smallest_solid_angle).worst.front().centre.allFinite());
}
