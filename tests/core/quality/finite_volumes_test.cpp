#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/quality/mesh_change.h"
#include "core/quality/openfoam_measures.h"
#include "support/random.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

Mesh mapped(Mesh mesh, const std::function<Vec3(const Vec3&)>& map) {
  for (Index i = 0; i < mesh.coordinates.size(); ++i)
    mesh.coordinates.set_xyz(i, map(mesh.coordinates.xyz(i)));
  return mesh;
}

/// The cell of a grid of cubes whose centre is nearest to a point.
Index cell_at(const FiniteVolumes& cells, const Vec3& point) {
  Index nearest = 0;
  for (Index c = 1; c < cells.faces().cell_count(); ++c)
    if ((cells.cell_centre(c) - point).norm() < (cells.cell_centre(nearest) - point).norm())
      nearest = c;
  return nearest;
}

/// Volume and centre of an element with plane faces: tetrahedra from the origin to fans of its
/// faces.
struct Solid {
  double volume = 0;
  Vec3 centre{0, 0, 0};

  Solid(const Mesh& mesh, Index e) {
    const auto corners = mesh.topology->element(e);
    for (const Face& face : shape_of(mesh.topology->element_type(e)).faces) {
      const Face nodes = by_nodes(face, corners);
      const auto p = [&](std::size_t k) { return mesh.coordinates.xyz(nodes[k]); };
      for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
        const double part = p(0).dot(p(k).cross(p(k + 1))) / 6;
        volume += part;
        centre += part * (p(0) + p(k) + p(k + 1)) / 4;
      }
    }
    centre /= volume;
  }
};

/// Prisms over a polygon in the plane z = 0, one above the other, with these heights.
struct Stack {
  Coordinates x{3, 0};
  CellFaces faces;

  Stack(const std::vector<Vec2>& polygon, const std::vector<double>& heights) {
    const auto n = static_cast<Index>(polygon.size());
    const auto cells = static_cast<Index>(heights.size());
    double z = 0;
    for (Index level = 0; level <= cells; ++level) {
      for (const Vec2& p : polygon) x.push_xyz({p.x(), p.y(), z});
      if (level < cells) z += heights[at(level)];
    }
    CompressedRows nodes;
    std::vector<Index> owner, neighbour;
    for (Index level = 0; level <= cells; ++level) {
      const bool bottom = level == 0;  // the others are seen from below
      for (Index k = 0; k < n; ++k) nodes.values.push_back(level * n + (bottom ? n - 1 - k : k));
      nodes.end_row();
      owner.push_back(bottom ? 0 : level - 1);
      neighbour.push_back(bottom || level == cells ? -1 : level);
    }
    for (Index c = 0; c < cells; ++c) {
      for (Index k = 0; k < n; ++k) {
        const Index next = (k + 1) % n;
        for (const Index node : {c * n + k, c * n + next, (c + 1) * n + next, (c + 1) * n + k})
          nodes.values.push_back(node);
        nodes.end_row();
        owner.push_back(c);
        neighbour.push_back(-1);
      }
    }
    faces = make_cell_faces(std::move(nodes), std::move(owner), std::move(neighbour), cells);
  }
};

std::vector<Vec2> regular_polygon(int corners) {
  std::vector<Vec2> polygon;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * pi * k / corners;
    polygon.emplace_back(std::cos(angle), std::sin(angle));
  }
  return polygon;
}

double worst(const Mesh& mesh, Metric metric) {
  return element_value(mesh, worst_element(mesh, metric), metric);
}

}  // namespace

TEST_CASE("cubes have the best values of OpenFOAM's measures") {
  const Mesh mesh = make_mesh(cube(3, Volumes::hexahedra));
  const CellFaces faces = cell_faces(*mesh.topology);
  const FiniteVolumes cells(faces, mesh.coordinates);
  CHECK(faces.face_count() == mesh.topology->face_count());
  CHECK(faces.cell_count() == 27);
  for (Index c = 0; c < 27; ++c) {
    CHECK(faces.of_cell[c].size() == 6);
    CHECK(cells.volume(c) == doctest::Approx(1.0 / 27));
    CHECK(cells.non_orthogonality(c) == doctest::Approx(0).epsilon(1e-5));
    CHECK(cells.skewness(c) < 1e-12);
    CHECK(cells.aspect_ratio(c) == doctest::Approx(1));
    CHECK(cells.volume_ratio(c) == doctest::Approx(1));
    CHECK(cells.weight(c) == doctest::Approx(0.5));
    CHECK(cells.face_pyramid(c) == doctest::Approx(1));
    CHECK(cells.openness(c) < 1e-14);
    CHECK(!cells.concave(c));
  }
  // Three pairs of internal faces, and one face of each pair in a corner.
  CHECK(cells.determinant(cell_at(cells, Vec3(0.5, 0.5, 0.5))) == doctest::Approx(1));
  CHECK(cells.determinant(cell_at(cells, Vec3(0, 0, 0))) == doctest::Approx(1.0 / 8));
  const OpenFoamMeasures measures = openfoam_measures(mesh);
  CHECK(measures.failures().empty());
  CHECK(measures.further_failures().empty());
  CHECK(measures.total_volume == doctest::Approx(1));
  CHECK(measures.of("edge_length").values.max == doctest::Approx(1.0 / 3));
  CHECK(measures.of("face_area").values.min == doctest::Approx(1.0 / 9));
  CHECK(measures.of("face_area").count == 108);
  CHECK(measures.of("face_weight").count == 54);
  CHECK_THROWS_AS(measures.of("sharpness"), UsageError);
}

TEST_CASE("sheared cubes have the values of hand calculations") {
  for (const double slope : {0.2, 0.5, 1.0, 3.0}) {
    CAPTURE(slope);
    const Mesh mesh = mapped(make_mesh(cube(3, Volumes::hexahedra)), [&](const Vec3& p) {
      return Vec3(p.x() + slope * p.z(), p.y(), p.z());
    });
    const CellFaces faces = cell_faces(*mesh.topology);
    const FiniteVolumes cells(faces, mesh.coordinates);
    const Index middle = cell_at(cells, Vec3(0.5 + slope / 2, 0.5, 0.5));
    // The line of the centres of two cells one above the other leans by the angle of the shear, and
    // so do the faces between two cells side by side.
    CHECK(cells.non_orthogonality(middle) == doctest::Approx(degrees(std::atan(slope))));
    CHECK(cells.skewness(middle) < 1e-12);
    CHECK(worst(mesh, Metric::skewness) == doctest::Approx(slope));  // at the floor and the lid
    CHECK(cells.aspect_ratio(middle) == doctest::Approx(1 + slope));
    const double mean_area = (2 + std::sqrt(1 + slope * slope)) / 3;
    CHECK(cells.determinant(middle) == doctest::Approx(std::pow(mean_area, -6)));
    CHECK(cells.face_pyramid(middle) == doctest::Approx(1));
    const auto& angle = openfoam_measures(mesh).of("non_orthogonality");
    const double cosine = 1 / std::sqrt(1 + slope * slope);
    // Two of three internal faces lean.
    CHECK(angle.values.avg == doctest::Approx(degrees(std::acos((1 + 2 * cosine) / 3))));
    CHECK(angle.beyond == (slope > 2.8 ? 36 : 0));
  }
}

TEST_CASE("volumes and centres agree with the divergence theorem") {
  const auto affine = [](const Vec3& p) {
    return Vec3(2 * p.x() + 0.3 * p.y() + 5, p.y() - 0.7 * p.z(), 1.5 * p.z() + 0.2 * p.x());
  };
  std::vector<Mesh> meshes{shaken_box(3, 0.2, 1)};
  for (const Volumes volumes : all_volumes)
    meshes.push_back(mapped(make_mesh(cube(4, volumes)), affine));
  for (const Mesh& mesh : meshes) {
    const CellFaces faces = cell_faces(*mesh.topology);
    const FiniteVolumes cells(faces, mesh.coordinates);
    double total = 0;
    for (Index e = 0; e < mesh.topology->element_count(); ++e) {
      const Solid solid(mesh, e);
      CHECK(cells.volume(e) == doctest::Approx(solid.volume).epsilon(1e-9));
      CHECK((cells.cell_centre(e) - solid.centre).norm() < 1e-9);
      CHECK(cells.openness(e) < 1e-13);
      total += solid.volume;
    }
    CHECK(openfoam_measures(mesh).total_volume == doctest::Approx(total));
    CHECK(openfoam_measures(mesh).boundary_openness.norm() < 1e-13);
  }
}

TEST_CASE("faces with many nodes are measured as others are") {
  const double lower = 0.5, upper = 2;
  for (const int corners : {3, 5, 6, 12}) {
    const Stack stack(regular_polygon(corners), {lower, upper});
    const FiniteVolumes cells(stack.faces, stack.x);
    const double area = 0.5 * corners * std::sin(2 * pi / corners);
    CHECK(cells.volume(0) == doctest::Approx(area * lower));
    CHECK(cells.volume(1) == doctest::Approx(area * upper));
    CHECK((cells.cell_centre(1) - Vec3(0, 0, lower + upper / 2)).norm() < 1e-12);
    CHECK(cells.area(1) == doctest::Approx(area));
    CHECK(cells.orthogonality(1) == doctest::Approx(1));
    CHECK(cells.face_volume_ratio(1) == doctest::Approx(lower / upper));
    CHECK(cells.face_weight(1) == doctest::Approx(lower / (lower + upper)));
    CHECK(cells.owner_pyramid(1) == doctest::Approx(area * lower / 6));
    CHECK(cells.neighbour_pyramid(1) == doctest::Approx(area * upper / 6));
    CHECK(cells.poor_divisions(1) == 0);
    CHECK(cells.determinant(0) < 1e-15);  // neighbours on one side only
    CHECK(openfoam_measures(stack.faces, stack.x).failures().empty());
  }
}

TEST_CASE("flatness and re-entrant corners of faces") {
  for (const double height : {0.0, 0.1, 1.0, 4.0}) {
    Mesh mesh = make_mesh(cube(1, Volumes::hexahedra));
    for (Index i = 0; i < 8; ++i) {
      Vec3 p = mesh.coordinates.xyz(i);
      if (p.z() > 0.5 && (p.x() > 0.5) != (p.y() > 0.5)) p.z() += height;
      mesh.coordinates.set_xyz(i, p);
    }
    const auto& flatness = openfoam_measures(mesh).of("flatness");
    CHECK(flatness.values.min == doctest::Approx(1 / std::sqrt(1 + height * height)));
    CHECK(flatness.beyond == (height > 0.75 ? 1 : 0));
  }
  // An L: the edges at its re-entrant corner include 90 degrees.
  const Stack ell({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {1});
  const OpenFoamMeasures measures = openfoam_measures(ell.faces, ell.x);
  CHECK(measures.of("concave_angle").values.max == doctest::Approx(90));
  CHECK(measures.of("concave_angle").beyond == 2);
  CHECK(measures.total_volume == doctest::Approx(3));
  CHECK(measures.concave_cells == 1);
  // A corner that turns by less than ten degrees is none.
  const Stack nearly({{0, 0}, {2, 0}, {2, 2}, {1, 1.95}, {0, 2}}, {1});
  CHECK(openfoam_measures(nearly.faces, nearly.x).of("concave_angle").beyond == 0);
}

TEST_CASE("directions without solution are left out") {
  const Stack flat(regular_polygon(4), {0.001});
  const FiniteVolumes all(flat.faces, flat.x), plane(flat.faces, flat.x, 1, {true, true, false});
  CHECK(all.aspect_ratio(0) > 100);
  CHECK(plane.aspect_ratio(0) == doctest::Approx(1));
}

TEST_CASE("an element inside out shows in the measures and in what checkMesh fails for") {
  Mesh mesh = make_mesh(cube(3, Volumes::hexahedra));
  const Index node = mesh.topology->interior_nodes()[0];
  mesh.coordinates.set_xyz(node, mesh.coordinates.xyz(node) + Vec3(1, 0.1, 0.2));
  const OpenFoamMeasures measures = openfoam_measures(mesh);
  CHECK(measures.pyramid_errors > 0);
  CHECK(measures.poor_divisions > 0);
  CHECK(measures.concave_cells > 0);
  CHECK(measures.orthogonality_errors > 0);
  const auto failures = measures.failures();
  CHECK(std::ranges::any_of(failures, [](const std::string& text) {
    return text.find("pyramids of faces with negative volume") != std::string::npos;
  }));
  CHECK(worst(mesh, Metric::face_pyramid) < 0);
  CHECK(worst(mesh, Metric::non_orthogonality) > 90);
}

TEST_CASE("elements without volume give finite measures") {
  Mesh mesh = make_mesh(cube(2, Volumes::mixed));
  for (const bool points : {false, true}) {
    for (Index i = 0; i < mesh.coordinates.size(); ++i) {
      const Vec3 p = mesh.coordinates.xyz(i);
      mesh.coordinates.set_xyz(i, points ? Vec3(1, 1, 1) : Vec3(p.x(), p.y(), 0));
    }
    for (const Metric metric : rating_metrics(3)) {
      if (!metric_info(metric, 3).of_cell) continue;
      CAPTURE(metric_name(metric));
      for (const double value : element_values(mesh, metric)) CHECK(std::isfinite(value));
    }
    for (const CheckedMeasure& row : openfoam_measures(mesh).rows) {
      CAPTURE(row.name);
      CHECK(std::isfinite(row.values.avg));
    }
  }
}

TEST_CASE("one element is measured as among all, at any number of threads") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = shaken_box(5, 0.3, 3, volumes);
    const auto all = element_values(mesh, all_metrics(3), {}, 1);
    CHECK(all == element_values(mesh, all_metrics(3), {}, 4));
    for (std::size_t m = 0; m < all.size(); ++m) {
      const Metric metric = all_metrics(3)[m];
      CAPTURE(metric_name(metric));
      CHECK(all[m] == element_values(mesh, metric));
      for (Index e = 0; e < mesh.topology->element_count(); ++e)
        REQUIRE(element_value(mesh, e, metric) == all[m][at(e)]);
    }
  }
}

TEST_CASE("metrics of elements are the worst of OpenFOAM's measures, and can have limits") {
  const Mesh mesh = shaken_box(4, 0.3, 5, Volumes::hexahedra);
  const OpenFoamMeasures measures = openfoam_measures(mesh);
  const auto same = [&](Metric metric, const char* name) {
    const Statistics& all = measures.of(name).values;
    const bool larger = metric_info(metric, 3).field.larger_is_better;
    return worst(mesh, metric) == (larger ? all.min : all.max);
  };
  CHECK(same(Metric::non_orthogonality, "non_orthogonality"));
  CHECK(same(Metric::skewness, "skewness"));
  CHECK(same(Metric::cell_aspect_ratio, "aspect_ratio"));
  CHECK(same(Metric::determinant, "determinant"));
  CHECK(same(Metric::volume_ratio, "volume_ratio"));
  const double largest = worst(mesh, Metric::non_orthogonality);
  CHECK_THROWS_AS(measure_quality(mesh).of(Metric::non_orthogonality), UsageError);
  QualityFloor floor;
  floor.set(Metric::non_orthogonality, largest + 0.01);
  floor.set(Metric::volume_ratio, 0);
  floor.require_dimension(3);
  CHECK(floor.fault(mesh, mesh.coordinates).empty());
  floor.set(Metric::non_orthogonality, 10);
  CHECK(floor.fault(mesh, mesh.coordinates) == "Non-orthogonality would be more than 10");
  CHECK_THROWS_AS(floor.require_dimension(2), UsageError);
}

TEST_CASE("plane and surface meshes have no measures of OpenFOAM") {
  const Mesh plane = make_mesh(square(3, Cells::triangles));
  CHECK_THROWS_AS(cell_faces(*plane.topology), UsageError);
  CHECK_THROWS_AS(openfoam_measures(plane), UsageError);
  CHECK_THROWS_AS(element_values(plane, Metric::volume_ratio), UsageError);
}
