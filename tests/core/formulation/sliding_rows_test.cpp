#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_winslow.h"
#include "core/formulation/volume_targets.h"
#include "core/geometry/sliding_boundary.h"
#include "support/derivatives.h"
#include "support/meshes.h"
#include "support/periodic_meshes.h"
#include "support/space_meshes.h"

/// The variational form with nodes that slide: its derivatives are those of the energy along the
/// curves and planes, by differences.
namespace winslow::test {
namespace {

std::shared_ptr<const NodeClasses> sliding(const Mesh& mesh, std::vector<std::string> markers) {
  auto classes = std::make_shared<NodeClasses>(mesh.topology);
  const auto boundary =
      SlidingBoundary::find(*mesh.topology, mesh.coordinates, markers, {.angle = 40});
  for (const SlidingPart& part : boundary.parts)
    classes->set_sliding(part.nodes, boundary.geometry, mesh.coordinates);
  return classes;
}

}  // namespace

TEST_CASE("sliding in the plane: gradient and Hessian are the energy's along the boundary") {
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    Mesh mesh = make_mesh(annulus(12, 3, 1.4, cells));
    Random random(2);
    const auto classes = sliding(mesh, {"outer", "inner"});
    perturb(mesh, random, 0.2);
    const VirtualControlVolumes vcv(mesh.topology);
    const VariationalWinslow form(
        classes, TargetShapes::build(vcv, TargetBlend::regular(), nullptr, 1, {}, classes.get()),
        {}, 1);
    CHECK(form.unknowns() == 2 * static_cast<std::size_t>(mesh.coordinates.size()));
    // Off the nodes' own places, so that gradients across the circles count.
    Coordinates x = mesh.coordinates;
    form.advance(direction(form, *classes, x, random, 0.05), 1, x);
    check_derivatives(form, *classes, x, 0.1);
    for (const Index node : mesh.topology->markers().nodes(0))
      CHECK(x.xy(node).norm() == doctest::Approx(mesh.coordinates.xy(node).norm()).epsilon(1e-12));
  }
}

TEST_CASE("sliding in space: gradient and Hessian are the energy's in the planes") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::hexahedra}) {
    CAPTURE(name_of(volumes));
    const Mesh mesh = make_mesh(cube_with_cavity(6, volumes));
    std::vector<std::string> names;
    for (const Marker& marker : mesh.topology->markers()) names.push_back(marker.name);
    const auto classes = sliding(mesh, names);
    const VolumeWinslow form(classes,
                             volume_targets(*mesh.topology, nullptr, TargetBlend::regular(),
                                            nullptr, 1, {}, {.classes = classes.get()}),
                             {}, 1);
    Random random(3);
    Coordinates x = mesh.coordinates;
    form.advance(direction(form, *classes, x, random, 0.03), 1, x);
    check_derivatives(form, *classes, x, 0.05);
  }
}

TEST_CASE("periodic pairs: gradient and Hessian are the energy's where both sides move as one") {
  Random random(7);
  const auto check = [&](Mesh mesh, const char* first, const char* second, double edge) {
    auto classes = std::make_shared<NodeClasses>(mesh.topology);
    const auto pairs = PeriodicPairs::find(*mesh.topology, mesh.coordinates, first, second);
    classes->set_periodic(pairs);
    const VirtualControlVolumes vcv(mesh.topology);
    const VariationalWinslow form(
        classes, TargetShapes::build(vcv, TargetBlend::regular(), nullptr, 1, {}, classes.get()),
        {}, 1);
    CHECK(form.unknowns() == 2 * (mesh.topology->interior_nodes().size() + pairs.pairs.size()));
    Coordinates x = mesh.coordinates;
    form.advance(direction(form, *classes, x, random, 0.3 * edge), 1, x);
    for (const auto& [node, image] : pairs.pairs) {
      const Vec2 p = x.xy(node);
      CHECK((pairs.image.of({p.x(), p.y(), 0}).head<2>() - x.xy(image)).norm() < 1e-14);
      CHECK((p - mesh.coordinates.xy(node)).norm() > 0);
    }
    check_derivatives(form, *classes, x, edge);
  };
  check(make_mesh(square(5, Cells::triangles)), "left", "right", 0.05);
  check(make_mesh(square(4, Cells::mixed)), "top", "bottom", 0.05);
  check(make_mesh(sector(75, 5, 4, Vec2(0.5, 2))), "begin", "end", 0.05);
}

TEST_CASE("a triangle whose nodes all slide has a target, one whose nodes all stay has none") {
  const Mesh mesh = make_mesh(square(3, Cells::triangles));
  const VirtualControlVolumes vcv(mesh.topology);
  const auto all = sliding(mesh, {"bottom", "top", "left", "right"});
  const auto with = TargetShapes::build(vcv, TargetBlend::regular(), nullptr, 1, {}, all.get());
  const auto without = TargetShapes::build(vcv, TargetBlend::regular(), nullptr, 1);
  CHECK(with.cells.size() > without.cells.size());
  TargetBlend by_vcv{0, 0, 1, 0};
  CHECK(TargetShapes::build(vcv, by_vcv, nullptr, 1, {}, all.get()).cells.size() ==
        with.cells.size());
}

}  // namespace winslow::test
