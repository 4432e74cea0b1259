#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/formulation/variational_winslow.h"
#include "core/formulation/volume_targets.h"
#include "support/space_meshes.h"

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

}  // namespace winslow::test
