#include <doctest/doctest.h>

#include <array>
#include <memory>
#include <set>
#include <vector>

#include "core/error.h"
#include "core/formulation/target_shapes.h"
#include "core/formulation/variational_winslow.h"
#include "support/formulations.h"
#include "support/samples.h"

using namespace winslow;
using namespace winslow::test;

/// Formulations ask which nodes move: interior nodes that are held have no equations, and what
/// they do to the others is the answer to a moving boundary.
namespace {

/// Every third interior node is held.
std::shared_ptr<const NodeClasses> some_held(const std::shared_ptr<const Topology>& topology) {
  auto classes = std::make_shared<NodeClasses>(topology);
  const auto interior = topology->interior_nodes();
  for (std::size_t i = 0; i < interior.size(); i += 3) {
    classes->set_prescribed(std::array<Index, 1>{interior[i]});
  }
  return classes;
}

/// The entries of a vector over all interior nodes that belong to nodes with unknowns.
std::vector<double> of_unknowns(const NodeUnknowns& nodes, const std::vector<double>& all) {
  std::vector<double> out;
  const auto interior = nodes.topology().interior_nodes();
  for (std::size_t i = 0; i < interior.size(); ++i) {
    if (nodes.classes().unknowns(interior[i]) == 0) continue;
    out.push_back(all[2 * i]);
    out.push_back(all[2 * i + 1]);
  }
  return out;
}

/// Residual and answer to a moving boundary of a problem in which some interior nodes are held are
/// those of the problem in which all are free, as far as the nodes are the same.
void check_against_all_free(const SmoothingProblem& held, const SmoothingProblem& free,
                            const NodeUnknowns& nodes, const Coordinates& x, Random& random) {
  REQUIRE(held.unknowns() == nodes.unknowns());
  REQUIRE(held.unknowns() < free.unknowns());
  std::vector<double> some(held.unknowns()), all(free.unknowns());
  held.residual(x, some);
  free.residual(x, all);
  const std::vector<double> expected = of_unknowns(nodes, all);
  for (std::size_t i = 0; i < some.size(); ++i) {
    CHECK(some[i] == doctest::Approx(expected[i]).epsilon(1e-12));
  }
  // d R / d held . m, by finite differences of the residual.
  Coordinates displacement(2, x.size());
  for (Index node = 0; node < x.size(); ++node) {
    if (nodes.classes().unknowns(node) == 0) displacement.set_xy(node, random.vector());
  }
  std::vector<double> answer(held.unknowns());
  held.boundary_response(x, displacement, answer);
  constexpr double h = 1e-6;
  std::vector<double> plus(held.unknowns()), minus(held.unknowns());
  Coordinates y = x;
  for (std::size_t i = 0; i < y.values().size(); ++i) {
    y.values()[i] = x.values()[i] + h * displacement.values()[i];
  }
  held.residual(y, plus);
  for (std::size_t i = 0; i < y.values().size(); ++i) {
    y.values()[i] = x.values()[i] - h * displacement.values()[i];
  }
  held.residual(y, minus);
  double largest = 0;
  for (const double a : answer) largest = std::max(largest, std::abs(a));
  CHECK(largest > 0);
  for (std::size_t i = 0; i < answer.size(); ++i) {
    CHECK(std::abs((plus[i] - minus[i]) / (2 * h) - answer[i]) < 1e-5 * largest);
  }
}

}  // namespace

TEST_CASE("variational form: held interior nodes have no equations, and move the others") {
  for (const Cells cells : all_cells) {
    CAPTURE(name_of(cells));
    Random random(5);
    const Sample s = make_sample(21, cells, false);
    const TargetShapes shapes = TargetShapes::build(s.vcv, TargetBlend::regular(), nullptr);
    const auto classes = some_held(s.mesh.topology);
    const VariationalWinslow held(classes, shapes, {}, 1);
    const VariationalWinslow free(free_interior(s.mesh.topology), shapes, {}, 1);
    check_against_all_free(held, free, NodeUnknowns(classes, 1), s.mesh.coordinates, random);
    // Triangles whose nodes are all held count in neither energy's differences.
    Coordinates y = s.mesh.coordinates;
    std::vector<double> direction(held.unknowns());
    for (double& d : direction) d = random.uniform(-1e-3, 1e-3);
    held.advance(direction, 1, y);
    const double change = free.energy(y) - free.energy(s.mesh.coordinates);
    CHECK(held.energy(y) - held.energy(s.mesh.coordinates) ==
          doctest::Approx(change).epsilon(1e-6));
  }
}

TEST_CASE("pointwise form: held interior nodes have no equations") {
  for (const Cells cells : all_cells) {
    CAPTURE(name_of(cells));
    const Sample s = make_sample(22, cells, false);
    const auto classes = some_held(s.mesh.topology);
    const NodeUnknowns nodes(classes, 1);
    const PointwiseWinslow held(s.vcv, classes, 1);
    const PointwiseWinslow free = pointwise(s.vcv);
    std::vector<double> some(held.unknowns()), all(free.unknowns());
    SparseMatrix part, whole;
    held.linearise(s.mesh.coordinates, part, some);
    free.linearise(s.mesh.coordinates, whole, all);
    CHECK(some == of_unknowns(nodes, all));
    // The Jacobian is a submatrix of that of all interior nodes.
    std::vector<Index> row_of(whole.pattern->offsets.size() - 1, -1);
    const auto interior = s.mesh.topology->interior_nodes();
    Index next = 0;
    for (std::size_t i = 0; i < interior.size(); ++i) {
      if (classes->unknowns(interior[i]) > 0) row_of[i] = next++;
    }
    std::vector<double> values;
    for (std::size_t i = 0; i < interior.size(); ++i) {
      if (row_of[i] < 0) continue;
      for (Index e = whole.pattern->offsets[i]; e < whole.pattern->offsets[i + 1]; ++e) {
        if (row_of[at(whole.pattern->columns[at(e)])] < 0) continue;
        const auto* block = whole.values.data() + 4 * at(e);
        values.insert(values.end(), block, block + 4);
      }
    }
    CHECK(part.values == values);
  }
}

TEST_CASE("nodes of the boundary that are free, or slide where nothing can, are refused") {
  const Sample s = make_sample(23, Cells::triangles, false);
  auto classes = std::make_shared<NodeClasses>(s.mesh.topology);
  const Index corner = s.mesh.topology->boundary_loops()[0][0];
  classes->set_on_curve(corner, {1, 0, 0});
  CHECK_THROWS_WITH_AS(PointwiseWinslow(s.vcv, classes, 1),
                       doctest::Contains("the pointwise form: node"), UsageError);
  classes->set_free(std::array<Index, 1>{corner});
  CHECK_THROWS_AS(PointwiseWinslow(s.vcv, classes, 1), UsageError);
  CHECK_THROWS_WITH_AS(
      VariationalWinslow(classes, TargetShapes::build(s.vcv, TargetBlend::regular(), nullptr), {},
                         1),
      doctest::Contains("the variational form: node"), UsageError);
}
