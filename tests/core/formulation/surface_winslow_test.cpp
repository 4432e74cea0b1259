#include "core/formulation/surface_winslow.h"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "core/error.h"
#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_winslow.h"
#include "core/problem/node_unknowns.h"
#include "support/surface_meshes.h"

/// The variational form on surface meshes: its derivatives are those of the energy along the
/// surface, by differences, and on a plane surface it is the form of the plane.
namespace winslow::test {
namespace {

struct OnShape {
  MeshState state;
  std::shared_ptr<const NodeClasses> classes;
  std::shared_ptr<const SurfaceWinslow> form;
};

OnShape form_on(const Mesh& mesh, const Shape& shape, const TargetBlend& blend) {
  OnShape out{on_shape(mesh, shape), nullptr, nullptr};
  out.classes = classes_on(out.state);
  const auto normals = element_normals(*out.classes, mesh.coordinates, 1);
  out.form = std::make_shared<SurfaceWinslow>(
      out.classes,
      std::make_shared<const TargetShapes>(TargetShapes::build(
          *out.state.vcvs.plane(), blend, &mesh.coordinates, 1, {}, out.classes.get(), normals)),
      PenaltyOptions{}, 1);
  return out;
}

double product(const SparseMatrix& a, const std::vector<double>& u, const std::vector<double>& v) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < a.pattern->offsets.size(); ++i)
    for (auto e = at(a.pattern->offsets[i]); e < at(a.pattern->offsets[i + 1]); ++e)
      for (std::size_t r = 0; r < 2; ++r)
        for (std::size_t c = 0; c < 2; ++c)
          sum += u[2 * i + r] * a.values[4 * e + 2 * r + c] * v[2 * at(a.pattern->columns[e]) + c];
  return sum;
}

std::vector<double> direction(const SurfaceWinslow& form, Random& random, double size) {
  std::vector<double> u(form.unknowns());
  for (double& value : u) value = size * random.uniform(-1, 1);
  return u;
}

std::vector<std::pair<MeshData, Shape>> curved_meshes(Cells cells) {
  const auto saddle = [](const Vec2& p) {
    return on_torus({0.3 * p.x(), 0.4 + 0.3 * p.y()}, 2, .8);
  };
  const auto ring = [](const Vec2& p) { return on_torus(p, 2, 0.8); };
  const auto roll = [](const Vec2& p) -> Vec3 {
    return {std::cos(2 * p.x()), std::sin(2 * p.x()), p.y()};
  };
  return {{lifted(square(5, cells), saddle), torus_shape(2, 0.8)},
          {torus_grid(12, 6, cells, ring), torus_shape(2, 0.8)},
          {lifted(square(5, cells), roll), cylinder_shape(1)}};
}

}  // namespace

TEST_CASE("surface form: gradient and Hessian are the energy's along the surface") {
  Random random(4);
  auto meshes = curved_meshes(Cells::mixed);
  for (const Cells cells : {Cells::triangles, Cells::quads})
    for (auto& mesh : curved_meshes(cells)) meshes.push_back(std::move(mesh));
  meshes.emplace_back(octasphere(4), sphere_shape(1));
  for (const auto& [data, shape] : meshes) {
    const Mesh mesh = make_mesh(data);
    const auto [state, classes, form] = form_on(mesh, shape, TargetBlend::regular());
    Coordinates x = mesh.coordinates;
    form->advance(direction(*form, random, 0.03), 1, x);
    REQUIRE(std::isfinite(form->energy(x)));
    SparseMatrix hessian;
    std::vector<double> residual(form->unknowns());
    const Linearisation found = form->linearise(x, Curvature::exact, hessian, residual);
    CHECK(found.energy == doctest::Approx(form->energy(x)).epsilon(1e-12));
    std::vector<double> again(form->unknowns());
    CHECK(form->residual(x, again).max == doctest::Approx(found.norms.max).epsilon(1e-12));
    CHECK(again == residual);
    for (int run = 0; run < 4; ++run) {
      const auto u = direction(*form, random, 0.1);
      const auto energy = [&, &form = form](double t) {
        Coordinates y = x;
        form->advance(u, t, y);
        return form->energy(y);
      };
      double slope = 0;
      for (std::size_t i = 0; i < u.size(); ++i) slope -= residual[i] * u[i];
      constexpr double h = 1e-4, step = 2e-3;
      CHECK((energy(h) - energy(-h)) / (2 * h) == doctest::Approx(slope).epsilon(1e-5));
      CHECK((energy(step) - 2 * energy(0) + energy(-step)) / (step * step) ==
            doctest::Approx(product(hessian, u, u)).epsilon(5e-4));
      const auto v = direction(*form, random, 0.1);
      CHECK(product(hessian, u, v) == doctest::Approx(product(hessian, v, u)).epsilon(1e-10));
    }
  }
}

TEST_CASE("surface form: the projected Hessian is never concave, the regularised one nor") {
  Random random(5);
  for (const auto& [data, shape] : curved_meshes(Cells::mixed)) {
    const Mesh mesh = make_mesh(data);
    const auto [state, classes, form] = form_on(mesh, shape, TargetBlend::regular());
    SparseMatrix hessian;
    std::vector<double> residual(form->unknowns());
    Coordinates x = mesh.coordinates;
    form->linearise(x, Curvature::projected, hessian, residual);
    for (int run = 0; run < 20; ++run) {
      const auto u = direction(*form, random, 1);
      CHECK(product(hessian, u, u) >= 0);
    }
    form->advance(direction(*form, random, 0.5), 1, x);  // tangled
    REQUIRE(form->validity(x).inverted > 0);
    CHECK(std::isinf(form->energy(x)));
    const auto regularisation = form->regularisation(x, form->cell_sizes(x), {});
    form->linearise_regularised(x, regularisation, hessian, residual);
    for (int run = 0; run < 10; ++run) {
      const auto u = direction(*form, random, 0.1);
      CHECK(product(hessian, u, u) >= 0);
      const auto energy = [&, &form = form](double t) {
        Coordinates y = x;
        form->advance(u, t, y);
        return form->regularised_energy(y, regularisation);
      };
      double slope = 0;
      for (std::size_t i = 0; i < u.size(); ++i) slope -= residual[i] * u[i];
      constexpr double h = 1e-5;
      CHECK((energy(h) - energy(-h)) / (2 * h) == doctest::Approx(slope).epsilon(1e-4));
    }
  }
}

TEST_CASE("surface form: on a plane surface it is the form of the plane") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    Random random(6);
    Mesh plane = make_mesh(annulus(14, 4, 1.3, cells));
    perturb(plane, random, 0.3);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const Vec3 shift(3, -2, 5);
    const auto embed = [&](const Vec2& p) -> Vec3 { return turn * Vec3(p.x(), p.y(), 0) + shift; };
    MeshData data = annulus(14, 4, 1.3, cells);
    data.coordinates = plane.coordinates;
    const Mesh mesh = make_mesh(lifted(data, embed));
    for (const TargetBlend blend :
         {TargetBlend::automatically(), TargetBlend::keeping(), TargetBlend::regular(),
          TargetBlend{0, 0, 1, 0}, TargetBlend{0, 1, 0, 1}}) {
      const auto [state, classes, form] = form_on(mesh, plane_shape(shift, turn.col(2)), blend);
      const auto flat_classes = std::make_shared<const NodeClasses>(plane.topology);
      const VirtualControlVolumes vcv(plane.topology);
      const VariationalWinslow flat(flat_classes,
                                    TargetShapes::build(vcv, blend, &plane.coordinates, 1), {}, 1);
      CHECK(form->unknowns() == flat.unknowns());
      CHECK(form->energy(mesh.coordinates) ==
            doctest::Approx(flat.energy(plane.coordinates)).epsilon(1e-12));
      CHECK(form->worst_distortion(mesh.coordinates) ==
            doctest::Approx(flat.worst_distortion(plane.coordinates)).epsilon(1e-12));
      std::vector<double> r(form->unknowns()), s(r.size());
      const ResidualNorms norms = form->residual(mesh.coordinates, r);
      CHECK(norms.max ==
            doctest::Approx(flat.residual(plane.coordinates, s).max).epsilon(1e-10).scale(1));
      double largest = form->energy(mesh.coordinates);
      for (const double value : s) largest = std::max(largest, std::abs(value));
      const NodeUnknowns nodes(classes, 1, NodeUnknowns::Layout::blocks);
      for (std::size_t i = 0; i < nodes.nodes().size(); ++i) {
        const Foot foot = classes->foot(nodes.nodes()[i], mesh.coordinates.xyz(nodes.nodes()[i]));
        const Vec3 force = r[2 * i] * foot.frame[0] + r[2 * i + 1] * foot.frame[1];
        const Vec3 expected = turn * Vec3(s[2 * i], s[2 * i + 1], 0);
        CHECK((force - expected).norm() < 1e-11 * largest);
      }
    }
  }
}

TEST_CASE("surface form: nodes that leave the surface are refused") {
  const Mesh mesh = make_mesh(octasphere(2));
  const MeshState state = on_shape(mesh, sphere_shape(1));
  const auto targets = std::make_shared<const TargetShapes>(
      TargetShapes::build(*state.vcvs.plane(), TargetBlend::regular(), nullptr));
  auto classes = std::make_shared<NodeClasses>(mesh.topology);
  classes->set_element_normals(state.surface->normals);
  CHECK_THROWS_WITH_AS(SurfaceWinslow(classes, targets, {}, 1),
                       "the variational form: node 0 of a surface mesh has nothing to slide on",
                       UsageError);
}

}  // namespace winslow::test
