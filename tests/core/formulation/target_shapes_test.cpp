#include "core/formulation/target_shapes.h"

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/error.h"
#include "core/formulation/variational_winslow.h"
#include "core/mesh/element_type.h"
#include "support/formulations.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// |J|^2 / (2 det J) of a physical triangle against a term: 1 if it has the target's shape.
double distortion_of(const ShapeTerm& term, const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 u = b - a, v = c - a;
  const double area = 0.5 * (u.x() * v.y() - u.y() * v.x());
  return (term.ab * u.squaredNorm() + term.ac * v.squaredNorm() + term.bc * (c - b).squaredNorm()) /
         (4 * area);
}

/// All free nodes with right angles, long edges sideways (to the first and third neighbour of each
/// VCV, whichever way it lies): targets of an anisotropic grid.
VirtualControlVolumes stretched(const std::shared_ptr<const Topology>& topology,
                                const Coordinates& x, double ratio) {
  VirtualControlVolumes vcv(topology);
  for (const Index node : topology->interior_nodes()) {
    std::vector<double> lengths;
    for (const Index other : topology->neighbours(node)) {
      const Vec2 edge = x.xy(other) - x.xy(node);
      lengths.push_back(std::abs(edge.x()) > std::abs(edge.y()) ? ratio : 1);
    }
    vcv.set(node, std::vector<double>(lengths.size(), pi / 2), lengths);
  }
  return vcv;
}

}  // namespace

TEST_CASE("corners at the boundary take the parallelogram of the VCVs beside them") {
  const MeshData data = square(4, Cells::quads);
  const auto topology = Topology::build(data);
  const auto vcv = stretched(topology, data.coordinates, 5);
  const TargetShapes shapes = TargetShapes::build(vcv, TargetBlend::regular(), nullptr);
  // Every corner that can move, also those at walls, wants a rectangle of 5 by 1: on the mesh drawn
  // out sideways by 5 all distortions are 1.
  int at_boundary = 0;
  for (std::size_t t = 0; t < shapes.cells.size(); ++t) {
    const auto place = [&](Index node) {
      const Vec2 p = data.coordinates.xy(node);
      return Vec2(5 * p.x(), p.y());
    };
    const auto [a, b, c] = shapes.cells[t];
    at_boundary += topology->on_boundary(a) ? 1 : 0;
    for (Index k = shapes.offsets[t]; k < shapes.offsets[t + 1]; ++k) {
      CHECK(distortion_of(shapes.terms[static_cast<std::size_t>(k)], place(a), place(b),
                          place(c)) == doctest::Approx(1).epsilon(1e-12));
    }
  }
  CHECK(at_boundary > 0);
}

TEST_CASE("a parallelogram that leans: from the VCV opposite, before and after") {
  // One interior node of a 2 by 2 grid: its four elements are each opposite-corner cases.
  const MeshData data = square(2, Cells::quads);
  const auto topology = Topology::build(data);
  const Index centre = topology->interior_nodes()[0];
  VirtualControlVolumes vcv(topology);
  const std::vector<double> angles{radians(70), radians(110), radians(70), radians(110)};
  const std::vector<double> lengths{2, 1, 2, 1};
  vcv.set(centre, angles, lengths);
  const TargetShapes shapes = TargetShapes::build(vcv, TargetBlend::regular(), nullptr);
  // Place the grid as the lattice that this VCV spans.
  Coordinates x = data.coordinates;
  const auto row = topology->neighbours(centre);
  x.set_xy(centre, Vec2(0, 0));
  for (Index k = 0; k < 4; ++k) x.set_xy(row[static_cast<std::size_t>(k)], vcv.point(centre, k));
  const auto star = topology->star(centre);
  for (Index k = 0; k < 4; ++k) {
    for (const Index node : topology->element(star[static_cast<std::size_t>(k)])) {
      const bool known = node == centre || std::find(row.begin(), row.end(), node) != row.end();
      if (!known) x.set_xy(node, vcv.point(centre, k) + vcv.point(centre, (k + 1) % 4));
    }
  }
  REQUIRE(shapes.cells.size() > 4);
  for (std::size_t t = 0; t < shapes.cells.size(); ++t) {
    const auto [a, b, c] = shapes.cells[t];
    for (Index k = shapes.offsets[t]; k < shapes.offsets[t + 1]; ++k) {
      CHECK(distortion_of(shapes.terms[static_cast<std::size_t>(k)], x.xy(a), x.xy(b), x.xy(c)) ==
            doctest::Approx(1).epsilon(1e-12));
    }
  }
}

TEST_CASE("the role of an element: its weight, and whether it follows edited VCVs") {
  const auto topology = Topology::build(square(4, Cells::triangles));
  VirtualControlVolumes vcv(topology);
  const Index node = topology->interior_nodes()[4];
  const std::size_t count = topology->neighbours(node).size();
  std::vector<double> lengths(count, 1.0);
  lengths[0] = 3;
  vcv.set(node, std::vector<double>(count, 2 * pi / static_cast<double>(count)), lengths);
  ElementRoles roles(static_cast<std::size_t>(topology->element_count()));
  const Index follows = topology->star(node)[0], keeps = topology->star(node)[1];
  SUBCASE("inserted") { roles[static_cast<std::size_t>(follows)] = ElementRole::layer; }
  SUBCASE("found") { roles[static_cast<std::size_t>(follows)] = ElementRole::found_layer; }
  const double expected = role_weight(roles[static_cast<std::size_t>(follows)]);
  CHECK(expected >= 1e3);
  roles[static_cast<std::size_t>(keeps)] = ElementRole::beside_layers;
  const auto build = [&] {
    return TargetShapes::build(vcv, TargetBlend::regular(), nullptr, 1, {}, nullptr, {}, {&roles});
  };
  const TargetShapes shapes = build();
  for (std::size_t t = 0; t < shapes.cells.size(); ++t) {
    double weight = 0;
    bool equilateral = true;
    for (Index k = shapes.offsets[t]; k < shapes.offsets[t + 1]; ++k) {
      const ShapeTerm& term = shapes.terms[static_cast<std::size_t>(k)];
      weight += term.weight;
      equilateral = equilateral && std::abs(term.ab - term.ac) < 1e-12;
    }
    const auto is = [&](Index element) {
      const auto corners = topology->element(element);
      return std::is_permutation(corners.begin(), corners.end(), shapes.cells[t].begin());
    };
    CHECK(weight == doctest::Approx(is(follows) ? expected : 1));
    if (is(follows)) CHECK_FALSE(equilateral);
    if (is(keeps)) CHECK(equilateral);
  }
  roles.pop_back();
  CHECK_THROWS_AS(build(), UsageError);
}

namespace {

constexpr TargetBlend vcvs_alone{.automatic = 0, .vcv = 1};

/// Adjusted VCVs, some of them with other edge lengths.
VolumeVcvs various_vcvs(const Mesh& mesh) {
  VolumeVcvs vcvs(mesh.topology, mesh.coordinates, {.angles = VcvAngles::adjusted});
  Random random(17);
  for (const Index node : mesh.topology->interior_nodes()) {
    if (node % 3 != 0) continue;
    std::vector<Vec3> directions;
    std::vector<double> lengths;
    for (std::size_t k = 0; k < mesh.topology->neighbours(node).size(); ++k) {
      directions.push_back(vcvs.direction(node, static_cast<Index>(k)));
      lengths.push_back(random.uniform(0.7, 1.4));
    }
    vcvs.set(node, directions, lengths);
  }
  return vcvs;
}

using Columns = Eigen::Matrix3d;

/// |J|^2 / (3 det J^(2/3)) of the map that takes one set of edges to another.
double distortion_of(const Columns& physical, const Columns& target) {
  const Eigen::Matrix3d j = physical * target.inverse();
  return j.squaredNorm() / (3 * std::pow(j.determinant(), 2.0 / 3.0));
}

/// Energy of one element by definition, psi(f) = f: from a node of it to three others.
class ElementEnergy {
 public:
  ElementEnergy(const Mesh& mesh, const VolumeVcvs& vcvs, Index e)
      : mesh_(mesh),
        vcvs_(vcvs),
        element_(mesh.topology->element(e)),
        type_(mesh.topology->element_type(e)) {}

  double value() const {
    return type_ == ElementType::tetrahedron ? of_tetrahedron() : of_corners();
  }

 private:
  bool free(std::size_t k) const { return !mesh_.topology->on_boundary(element_[k]); }

  double of_tetrahedron() const {
    double sum = 0, count = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (!free(k)) continue;
      std::array<std::size_t, 3> others{};
      for (std::size_t j = 0, place = 0; j < 4; ++j) {
        if (j != k) others[place++] = j;
      }
      sum += distortion_of(physical(k, others), virtual_edges(k, others));
      count += 1;
    }
    return count > 0 ? sum / count : 0;
  }

  double of_corners() const {
    const auto places = regular_corners(type_);
    double sum = 0, count = 0;
    for (const auto& corner : corner_tetrahedra(type_)) {
      const auto k = at(corner[0]);
      const std::array<std::size_t, 3> others{at(corner[1]), at(corner[2]), at(corner[3])};
      if (!free(k) &&
          std::none_of(others.begin(), others.end(), [&](std::size_t j) { return free(j); }))
        continue;
      Columns target;
      for (int c = 0; c < 3; ++c)
        target.col(c) = Vec3(places[others[at(c)]].data()) - Vec3(places[k].data());
      if (free(k)) target = virtual_edges(k, others);
      sum += distortion_of(physical(k, others), target);
      count += 1;
    }
    return count > 0 ? sum / count : 0;
  }

  Columns physical(std::size_t k, const std::array<std::size_t, 3>& others) const {
    Columns edges;
    for (int c = 0; c < 3; ++c)
      edges.col(c) =
          mesh_.coordinates.xyz(element_[others[at(c)]]) - mesh_.coordinates.xyz(element_[k]);
    return edges;
  }
  Columns virtual_edges(std::size_t k, const std::array<std::size_t, 3>& others) const {
    const auto neighbours = mesh_.topology->neighbours(element_[k]);
    std::vector<Vec3> points;
    vcvs_.points(element_[k], points);
    Columns edges;
    for (int c = 0; c < 3; ++c) {
      const auto place = std::find(neighbours.begin(), neighbours.end(), element_[others[at(c)]]);
      REQUIRE(place != neighbours.end());
      edges.col(c) = points[static_cast<std::size_t>(place - neighbours.begin())];
    }
    return edges;
  }

  const Mesh& mesh_;
  const VolumeVcvs& vcvs_;
  std::span<const Index> element_;
  ElementType type_;
};

}  // namespace

TEST_CASE("the energy over VCVs of a volume mesh is that of its definition") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = shaken_box(4, 0.1, 5, volumes);
    const VolumeVcvs vcvs = various_vcvs(mesh);
    const VolumeWinslow form(free_interior(mesh.topology),
                             volume_targets(*mesh.topology, &vcvs, vcvs_alone, nullptr, 1), {1, 0},
                             1);
    double expected = 0;
    for (Index e = 0; e < mesh.topology->element_count(); ++e)
      expected += ElementEnergy(mesh, vcvs, e).value();
    CHECK(form.energy(mesh.coordinates) == doctest::Approx(expected).epsilon(1e-10));
  }
}

TEST_CASE("a volume mesh over the VCVs that are its own stars is the minimum") {
  const Mesh mesh = shaken_box(5, 0.2, 8);
  const VolumeVcvs vcvs = own_stars(mesh);
  const VolumeWinslow form(free_interior(mesh.topology),
                           volume_targets(*mesh.topology, &vcvs, vcvs_alone, nullptr, 1), {}, 1);
  CHECK(form.worst_distortion(mesh.coordinates) == doctest::Approx(1));
  CHECK(form.residual(mesh.coordinates, {}).max < 1e-10);
}

TEST_CASE("elements weigh alike, however many of their nodes have VCVs") {
  for (const Volumes volumes : all_volumes) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(cube(3, volumes));
    const VolumeVcvs vcvs(mesh.topology);
    for (const TargetBlend& blend : {vcvs_alone, TargetBlend{0, 0.5, 0.3, 0.2}}) {
      const auto targets = volume_targets(*mesh.topology, &vcvs, blend, &mesh.coordinates, 2);
      double sum = 0;
      for (const VolumeTerm& term : targets.terms) sum += term.weight;
      Index live = 0;
      for (Index e = 0; e < mesh.topology->element_count(); ++e) {
        const auto element = mesh.topology->element(e);
        live += std::any_of(element.begin(), element.end(),
                            [&](Index node) { return !mesh.topology->on_boundary(node); });
      }
      CHECK(sum == doctest::Approx(live));
      CHECK(targets.offsets.back() == static_cast<Index>(targets.terms.size()));
      CHECK(targets.offsets.size() == targets.cells.size() + 1);
      const auto one = volume_targets(*mesh.topology, &vcvs, blend, &mesh.coordinates, 1);
      CHECK(std::equal(one.terms.begin(), one.terms.end(), targets.terms.begin(),
                       [](const VolumeTerm& a, const VolumeTerm& b) {
                         return a.a11 == b.a11 && a.a23 == b.a23 && a.weight == b.weight;
                       }));
    }
  }
}

TEST_CASE("a share for VCVs needs VCVs") {
  const Mesh mesh = make_mesh(cube(2, Volumes::tetrahedra));
  CHECK_THROWS_AS(volume_targets(*mesh.topology, nullptr, vcvs_alone, nullptr, 1), UsageError);
  CHECK_NOTHROW(volume_targets(*mesh.topology, nullptr, TargetBlend::regular(), nullptr, 1));
}

TEST_CASE("several terms of a tetrahedron count as so many tetrahedra, projected or not") {
  const Mesh mesh = shaken_box(4, 0.3, 25);
  const VolumeVcvs vcvs = various_vcvs(mesh);
  const auto together = volume_targets(*mesh.topology, &vcvs, vcvs_alone, nullptr, 1);
  CellTargets<3> apart;
  for (std::size_t cell = 0; cell < together.cells.size(); ++cell) {
    for (Index k = together.offsets[cell]; k < together.offsets[cell + 1]; ++k) {
      apart.cells.push_back(together.cells[cell]);
      apart.terms.push_back(together.terms[at(k)]);
      apart.offsets.push_back(static_cast<Index>(apart.terms.size()));
    }
  }
  REQUIRE(apart.cells.size() > together.cells.size());
  const VolumeWinslow a(free_interior(mesh.topology), together, {}, 1),
      b(free_interior(mesh.topology), apart, {}, 1);
  for (const Curvature curvature : {Curvature::exact, Curvature::projected}) {
    SparseMatrix ha, hb;
    std::vector<double> ra(a.unknowns()), rb(ra);
    const double ea = a.linearise(mesh.coordinates, curvature, ha, ra).energy;
    CHECK(b.linearise(mesh.coordinates, curvature, hb, rb).energy == doctest::Approx(ea));
    REQUIRE(ha.pattern->columns == hb.pattern->columns);
    const auto difference = [](const std::vector<double>& u, const std::vector<double>& v) {
      const Eigen::Map<const Eigen::VectorXd> p(u.data(), static_cast<Index>(u.size())),
          q(v.data(), static_cast<Index>(v.size()));
      return (p - q).norm() / p.norm();
    };
    CHECK(difference(ra, rb) < 1e-12);
    CHECK(difference(ha.values, hb.values) < 1e-12);
  }
}

TEST_CASE("the role of a volume element: its weight, and whether it heeds VCVs given by hand") {
  const Mesh mesh = make_mesh(cube(3, Volumes::tetrahedra));
  const Topology& topology = *mesh.topology;
  const Index node = topology.interior_nodes().front();
  const VolumeVcvs equal(mesh.topology);
  SphereStencil stencil;
  for (std::size_t k = 0; k < topology.neighbours(node).size(); ++k) {
    stencil.directions.push_back(equal.direction(node, static_cast<Index>(k)));
    stencil.lengths.push_back(k == 0 ? 3 : 1);
  }
  const SphereStencils stencils{{node, stencil}};
  const Index stiff = topology.star(node)[0], keeps = topology.star(node)[1];
  ElementRoles roles(at(topology.element_count()), ElementRole::ordinary);
  roles[at(stiff)] = ElementRole::layer;
  roles[at(keeps)] = ElementRole::beside_layers;
  const auto build = [&](const ElementRoles* of, const SphereStencils* by_hand) {
    return volume_targets(topology, nullptr, TargetBlend::regular(), nullptr, 1, {},
                          {.stencils = by_hand, .roles = of});
  };
  const CellTargets<3> plain = build(nullptr, nullptr), edited = build(nullptr, &stencils),
                       with_roles = build(&roles, &stencils);
  REQUIRE(plain.cells == with_roles.cells);
  const auto is = [&](std::size_t cell, Index element) {
    const auto corners = topology.element(element);
    return std::is_permutation(corners.begin(), corners.end(), plain.cells[cell].begin());
  };
  const auto first = [](const CellTargets<3>& targets, std::size_t cell) {
    return targets.terms[at(targets.offsets[cell])];
  };
  int seen = 0;
  for (std::size_t cell = 0; cell < plain.cells.size(); ++cell) {
    const double weight = first(with_roles, cell).weight;
    CHECK(weight == doctest::Approx(is(cell, stiff) ? role_weight(ElementRole::layer) : 1));
    if (!is(cell, keeps)) continue;
    ++seen;
    CHECK(first(edited, cell).a11 != first(plain, cell).a11);
    CHECK(first(with_roles, cell).a11 == first(plain, cell).a11);
    CHECK(first(with_roles, cell).a23 == first(plain, cell).a23);
  }
  CHECK(seen == 1);
  roles.pop_back();
  CHECK_THROWS_AS(build(&roles, nullptr), UsageError);
}
