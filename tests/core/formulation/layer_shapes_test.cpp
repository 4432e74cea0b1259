#include <doctest/doctest.h>

#include "core/error.h"
#include "core/formulation/target_metric.h"
#include "core/formulation/target_shapes.h"
#include "core/strategy/workspace.h"
#include "support/formulations.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

/// A cube whose lowest row of elements is a layer, and the coordinates in which that row is a tenth
/// as high.
struct Layered {
  explicit Layered(Volumes volumes)
      : mesh(make_mesh(cube(3, volumes))),
        roles(at(mesh.topology->element_count()), ElementRole::ordinary),
        shapes(mesh.coordinates) {
    for (Index e = 0; e < mesh.topology->element_count(); ++e)
      if (is_layer(e)) roles[at(e)] = ElementRole::layer;
    for (Index node = 0; node < mesh.topology->node_count(); ++node) {
      const Vec3 p = shapes.xyz(node);
      if (std::abs(p.z() - 1.0 / 3) < 1e-9) shapes.set_xyz(node, {p.x(), p.y(), p.z() / 10});
    }
  }

  bool is_layer(Index e) const {
    double height = 0;
    const auto nodes = mesh.topology->element(e);
    for (const Index node : nodes) height += mesh.coordinates.xyz(node).z();
    return height / static_cast<double>(nodes.size()) < 1.0 / 3;
  }
  CellTargets<3> targets(const TargetBlend& blend, bool with_shapes) const {
    VolumeTargetDetails details;
    details.roles = &roles;
    if (with_shapes) details.layer_shapes = &shapes;
    return volume_targets(*mesh.topology, nullptr, blend, &mesh.coordinates, 1, {}, details);
  }

  Mesh mesh;
  ElementRoles roles;
  Coordinates shapes;
};

Eigen::Matrix3d metric_in(const Coordinates& x, const std::array<Index, 4>& nodes) {
  Edges3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = x.xyz(nodes[at(k + 1)]) - x.xyz(nodes[0]);
  return volume_metric(edges);
}

}  // namespace

TEST_CASE("Elements in layers have their wanted shapes as targets, and others do not notice") {
  for (const Volumes volumes : {Volumes::tetrahedra, Volumes::prisms, Volumes::hexahedra}) {
    CAPTURE(std::string(name_of(volumes)));
    const Layered layered(volumes);
    for (const TargetBlend& blend :
         {TargetBlend::automatically(), TargetBlend::regular(), TargetBlend{.rest = 1}}) {
      const auto with = layered.targets(blend, true), without = layered.targets(blend, false);
      REQUIRE(with.cells == without.cells);
      REQUIRE(with.offsets == without.offsets);
      std::size_t changed = 0;
      for (std::size_t cell = 0; cell < with.cells.size(); ++cell) {
        const auto& nodes = with.cells[cell];
        const bool in_layer = std::ranges::all_of(nodes, [&](Index node) {
          return layered.mesh.coordinates.xyz(node).z() < 1.0 / 3 + 1e-9;
        });
        const VolumeTerm& a = with.terms_of(cell).front();
        const VolumeTerm& b = without.terms_of(cell).front();
        CHECK(a.weight == b.weight);
        if (in_layer) {
          ++changed;
          CHECK(metric_of(a).isApprox(metric_in(layered.shapes, nodes), 1e-12));
        } else {
          CHECK(metric_of(a) == metric_of(b));
        }
      }
      CHECK(changed > 0);
    }
  }
}

TEST_CASE("An element of layers that is inverted in the wanted shape is refused by its number") {
  Layered layered(Volumes::prisms);
  for (Index node = 0; node < layered.mesh.topology->node_count(); ++node) {
    Vec3 p = layered.shapes.xyz(node);
    if (p.z() > 0 && p.z() < 0.1) p.z() = -p.z();
    layered.shapes.set_xyz(node, p);
  }
  CHECK_THROWS_WITH_AS(layered.targets(TargetBlend::regular(), true),
                       doctest::Contains("is inverted or flat in the shape"), UsageError);
}

TEST_CASE("A workspace makes the energy anew for other shapes of layers, and only then") {
  const Layered layered(Volumes::prisms);
  MeshState state = make_state(layered.mesh);
  state.roles = std::make_shared<const ElementRoles>(layered.roles);
  SmoothOptions options;
  options.threads = 1;
  options.targets = TargetBlend::automatically();
  const auto classes = free_interior(state.mesh.topology);
  const auto shapes = std::make_shared<const Coordinates>(layered.shapes);
  SmoothingWorkspace workspace;
  const auto prepared = [&](const std::shared_ptr<const Coordinates>& layers) {
    workspace.prepare(state, classes, options, nullptr, nullptr, layers);
    return workspace.energy();
  };
  const auto plain = prepared(nullptr), first = prepared(shapes);
  CHECK(plain != first);
  CHECK(first->energy(layered.mesh.coordinates) > plain->energy(layered.mesh.coordinates));
  CHECK(prepared(shapes) == first);
  CHECK(prepared(std::make_shared<const Coordinates>(layered.mesh.coordinates)) != first);
  CHECK(workspace.times_made().energy_patterns == 1);
}
