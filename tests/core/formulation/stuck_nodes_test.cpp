
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/formulation/surface_winslow.h"
#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_winslow.h"
#include "core/problem/node_unknowns.h"
#include "support/random.h"
#include "support/space_meshes.h"
#include "support/surface_meshes.h"

/// Boundary nodes of a volume mesh that slide on a surface with a fold.
namespace winslow::test {
namespace {

/// z = 1 - slope |x - fold|, nearest places: two half planes.
class Roof final : public SlidingGeometry {
 public:
  Roof(double fold, double slope) : fold_(fold), slope_(slope) {}

  Foot foot(Index /*node*/, const Vec3& point) const override {
    const Vec3 left = on_side(-1, point), right = on_side(1, point);
    const bool is_left = (left - point).norm() < (right - point).norm();
    Foot foot;
    foot.point = is_left ? left : right;
    foot.frame.add(along(is_left ? -1 : 1));
    foot.frame.add(Vec3::UnitY());
    return foot;
  }

 private:
  Vec3 along(double sign) const { return Vec3(sign, 0, -slope_).normalized(); }
  Vec3 on_side(double sign, const Vec3& point) const {
    const Vec3 from(fold_, point.y(), 1), step = along(sign);
    return from + std::max(0.0, (point - from).dot(step)) * step;
  }

  double fold_, slope_;
};

}  // namespace

TEST_CASE("a node of a volume mesh that a step leads over a fold is held, others are not") {
  constexpr double fold = 0.55;
  Mesh mesh = make_mesh(cube(4, Volumes::hexahedra));
  auto roof = std::make_shared<const Roof>(fold, 0.5);
  std::vector<Index> lid;
  for (Index node = 0; node < mesh.coordinates.size(); ++node) {
    const Vec3 p = mesh.coordinates.xyz(node);
    mesh.coordinates.set_xyz(node, {p.x(), p.y(), p.z() * (1 - 0.5 * std::abs(p.x() - fold))});
    const auto within = [](double c) { return c > 1e-9 && c < 1 - 1e-9; };
    if (p.z() > 1 - 1e-9 && within(p.x()) && within(p.y())) lid.push_back(node);
  }
  auto classes = std::make_shared<NodeClasses>(mesh.topology);
  classes->set_sliding(lid, roof, mesh.coordinates);
  const VolumeWinslow form(classes,
                           volume_targets(*mesh.topology, nullptr, TargetBlend::regular(), nullptr,
                                          1, {}, {.classes = classes.get()}),
                           {}, 1);
  const NodeUnknowns unknowns(classes, 1, NodeUnknowns::Layout::blocks);
  const auto& nodes = unknowns.nodes();
  // All nodes of the lid by the same way towards larger x: over the fold for those at x = 0.5.
  std::vector<double> direction(form.unknowns(), 0.0);
  std::vector<std::size_t> over;
  for (std::size_t row = 0; row < nodes.size(); ++row) {
    if (!classes->slides(nodes[row])) continue;
    const Vec3 p = mesh.coordinates.xyz(nodes[row]);
    const Foot foot = classes->foot(nodes[row], p);
    direction[3 * row] = 0.1 * foot.frame[0].x();
    if (std::abs(p.x() - 0.5) < 1e-9) over.push_back(row);
  }
  REQUIRE(over.size() == 3);
  CHECK(form.stuck_nodes() == 0);
  CHECK(form.holding_stuck_nodes(mesh.coordinates, direction, 0.3) == nullptr);
  const auto held = form.holding_stuck_nodes(mesh.coordinates, direction, 1);
  REQUIRE(held);
  CHECK(held->stuck_nodes() == 3);
  std::vector<double> free_residual(form.unknowns()), residual(form.unknowns());
  form.residual(mesh.coordinates, free_residual);
  SparseMatrix hessian;
  held->linearise(mesh.coordinates, Curvature::exact, hessian, residual);
  for (std::size_t row = 0; row < nodes.size(); ++row) {
    const bool is_held = std::ranges::find(over, row) != over.end();
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(std::abs(residual[3 * row + k] - (is_held ? 0 : free_residual[3 * row + k])) < 1e-12);
      if (!is_held) continue;
      // Nothing of the system belongs to a held node but an equation of its own.
      const SparsityPattern& pattern = *hessian.pattern;
      for (Index e = pattern.offsets[row]; e < pattern.offsets[row + 1]; ++e)
        for (std::size_t c = 0; c < 3; ++c) {
          const bool own = pattern.columns[at(e)] == static_cast<Index>(row) && c == k;
          const double entry = hessian.values[9 * at(e) + 3 * k + c];
          CHECK((own ? entry > 0 : entry == 0));
        }
    }
  }
  CHECK(held->holding_stuck_nodes(mesh.coordinates, direction, 1) == nullptr);
}

/// Nodes of a surface mesh that turn over an element on their way.
namespace {

/// The form on a mesh whose inner nodes stay on a shape, and what it is made of.
struct Surface {
  Surface(const Mesh& of, const Shape& shape)
      : state(on_shape(of, shape)),
        classes(classes_on(state)),
        targets(std::make_shared<const CellTargets<2>>(TargetShapes::build(
            *state.vcvs.plane(), TargetBlend::regular(), nullptr, 1, {}, classes.get(),
            element_normals(*classes, state.mesh.coordinates, 1)))),
        form(std::make_shared<const SurfaceWinslow>(classes, targets, PenaltyOptions{}, 1)),
        nodes(classes, 1, NodeUnknowns::Layout::blocks),
        structure(nodes, targets->cells) {}

  std::vector<bool> turned_over(const Coordinates& x) const {
    const FlatCells cells =
        FlatCells::in_own_planes(structure, x, element_normals(*classes, x, 1), 1);
    std::vector<bool> turned;
    for (std::size_t t = 0; t < cells.planes.size(); ++t)
      turned.push_back(!(cells.determinant(t) > 0));
    return turned;
  }
  /// By the whole mesh, in which one node after the other moves alone.
  std::vector<bool> stuck(const std::vector<double>& direction) const {
    const Coordinates& x = state.mesh.coordinates;
    Coordinates there = x;
    form->advance(direction, 1, there);
    std::vector<bool> list(nodes.nodes().size(), false);
    add_nodes_led_astray(nodes, x, there, direction, 2, 1, list);
    const std::vector<bool> before = turned_over(x), after = turned_over(there);
    for (std::size_t t = 0; t < after.size(); ++t) {
      if (!after[t] || before[t]) continue;
      std::vector<std::size_t> moved;
      bool found = false;
      for (const Index node : structure.cells[t]) {
        const Index row = structure.row_of_node[at(node)];
        if (row < 0) continue;
        moved.push_back(at(row));
        std::vector<double> alone(direction.size(), 0.0);
        for (const std::size_t k : {2 * at(row), 2 * at(row) + 1}) alone[k] = direction[k];
        Coordinates y = x;
        form->advance(alone, 1, y);
        if (turned_over(y)[t]) list[at(row)] = found = true;
      }
      if (!found)
        for (const std::size_t row : moved) list[row] = true;
    }
    return list;
  }

  MeshState state;
  std::shared_ptr<const NodeClasses> classes;
  std::shared_ptr<const CellTargets<2>> targets;
  std::shared_ptr<const SurfaceWinslow> form;
  NodeUnknowns nodes;
  SurfaceStructure structure;
};

void check_stuck_nodes(const Surface& surface, double reach, std::uint64_t seed) {
  CAPTURE(seed);
  CAPTURE(reach);
  Random random(seed);
  std::vector<double> direction(surface.form->unknowns());
  for (double& d : direction) d = random.uniform(-reach, reach);
  const Coordinates& x = surface.state.mesh.coordinates;
  const std::vector<bool> expected = surface.stuck(direction);
  const auto count = std::ranges::count(expected, true);
  REQUIRE(count > 0);
  REQUIRE(count < std::ssize(expected));
  const auto held = std::dynamic_pointer_cast<const SurfaceWinslow>(
      surface.form->holding_stuck_nodes(x, direction, 1));
  REQUIRE(held);
  CHECK(held->stuck_nodes() == count);
  // Nothing is left of the equations of a node that is held.
  std::vector<double> residual(held->unknowns());
  held->residual(x, residual);
  for (std::size_t row = 0; row < expected.size(); ++row) {
    CAPTURE(row);
    const bool none = residual[2 * row] == 0 && residual[2 * row + 1] == 0;
    CHECK(none == expected[row]);
  }
}

}  // namespace

TEST_CASE("nodes that turn an element over are those that moving them one by one shows") {
  Random random(5);
  const auto in_grid = [](const Vec2& p) -> Vec3 { return {p.x(), p.y(), 0}; };
  for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
    CAPTURE(name_of(cells));
    Mesh mesh = make_mesh(lifted(square(10, cells), in_grid));
    for (const Index node : mesh.topology->interior_nodes()) {
      const Vec2 by = random.vector(-0.02, 0.02);
      mesh.coordinates.set_xyz(node, mesh.coordinates.xyz(node) + Vec3(by.x(), by.y(), 0));
    }
    const Surface surface(mesh, plane_shape(Vec3(0, 0, 0), Vec3(0, 0, 1)));
    for (const std::uint64_t seed : {1U, 2U, 3U})
      for (const double reach : {0.1, 0.14}) check_stuck_nodes(surface, reach, seed);
  }
  Mesh mesh = make_mesh(octasphere(6));
  for (Index node = 0; node < mesh.coordinates.size(); ++node) {
    const Vec3 moved = mesh.coordinates.xyz(node) + 0.03 * random_vector(random);
    mesh.coordinates.set_xyz(node, moved.normalized());
  }
  const Surface sphere(mesh, sphere_shape(1));
  for (const std::uint64_t seed : {1U, 2U, 3U}) check_stuck_nodes(sphere, 0.25, seed);
}

}  // namespace winslow::test
