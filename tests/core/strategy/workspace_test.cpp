#include "core/strategy/workspace.h"

#include <doctest/doctest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/command/command.h"
#include "core/error.h"
#include "core/motion/rigid_motion.h"
#include "core/strategy/run.h"
#include "core/strategy/smooth_run.h"
#include "core/vcv/vcv_edit.h"
#include "support/formulations.h"
#include "support/layered_meshes.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

/// What a workspace keeps from one run to the next, and what it makes anew.
namespace winslow::test {
namespace {

/// What prepare() is told.
struct Inputs {
  MeshState state;
  std::shared_ptr<const NodeClasses> classes;
  SmoothOptions options;

  void prepare(SmoothingWorkspace& workspace) const { workspace.prepare(state, classes, options); }
  const Coordinates& given() const { return state.mesh.coordinates; }
};

Inputs inputs_of(const MeshState& state) {
  Inputs inputs{state, free_interior(state.mesh.topology), {}};
  inputs.options.threads = 1;
  inputs.options.targets = TargetBlend::automatically();
  return inputs;
}
Inputs plane_inputs() { return inputs_of(make_state(make_mesh(square(6, Cells::triangles)))); }
Inputs space_inputs() { return inputs_of(make_state(make_mesh(cube(3, Volumes::hexahedra)))); }

/// A change of one input.
struct Change {
  std::string what;
  std::function<void(Inputs&)> apply;
};

/// One node less moves.
void hold_a_node(Inputs& inputs) {
  auto classes = std::make_shared<NodeClasses>(inputs.classes->shared_topology());
  const Index node = classes->topology().interior_nodes().front();
  classes->set_fixed({&node, 1});
  inputs.classes = classes;
}
/// Equal classes, as the next run makes them.
void make_classes_anew(Inputs& inputs) {
  inputs.classes = free_interior(inputs.classes->shared_topology());
}
void move_a_node(Inputs& inputs) {
  const Index node = inputs.classes->topology().interior_nodes().front();
  Coordinates& given = inputs.state.mesh.coordinates;
  if (given.dimension() == 2)
    given.set_xy(node, given.xy(node) + Vec2(1e-3, 0));
  else
    given.set_xyz(node, given.xyz(node) + Vec3(1e-3, 0, 0));
}
/// The VCV of a node as it is, given by hand.
void give_a_stencil(Inputs& inputs) {
  const Topology& topology = inputs.classes->topology();
  const Index node = topology.interior_nodes().front();
  SphereStencil stencil;
  for (const Index k : topology.neighbours(node)) {
    stencil.directions.push_back((inputs.given().xyz(k) - inputs.given().xyz(node)).normalized());
    stencil.lengths.push_back(1);
  }
  auto stencils = std::make_shared<SphereStencils>();
  stencils->emplace(node, std::move(stencil));
  inputs.state.vcvs = std::shared_ptr<const SphereStencils>(stencils);
}
void give_roles(Inputs& inputs) {
  const auto count = at(inputs.classes->topology().element_count());
  inputs.state.roles = std::make_shared<const ElementRoles>(count, ElementRole::ordinary);
}

std::shared_ptr<const SparsityPattern> energy_pattern(SmoothingWorkspace& workspace,
                                                      const Coordinates& x) {
  const auto energy = workspace.energy();
  SparseMatrix matrix;
  std::vector<double> residual(energy->unknowns());
  energy->linearise(x, Curvature::projected, matrix, residual);
  return matrix.pattern;
}
std::shared_ptr<const SparsityPattern> pointwise_pattern(SmoothingWorkspace& workspace,
                                                         const Coordinates& x) {
  const auto form = workspace.pointwise().plain;
  SparseMatrix matrix;
  std::vector<double> residual(form->unknowns());
  form->linearise(x, matrix, residual);
  return matrix.pattern;
}

/// Which products are other objects after a change.
struct Changed {
  bool energy_pattern = false, energy = false;
  bool pointwise_pattern = false, pointwise = false;
  bool linear = false, symmetric_linear = false, newton_linear = false;
  bool operator==(const Changed&) const = default;
};

Changed changed_by(const Inputs& before, const Change& change) {
  SmoothingWorkspace workspace;
  before.prepare(workspace);
  const Coordinates x = before.given();
  const auto energy = workspace.energy();
  const auto pointwise = workspace.pointwise().plain;
  const auto of_energy = energy_pattern(workspace, x),
             of_pointwise = pointwise_pattern(workspace, x);
  const LinearSolver* linear = &workspace.linear();
  const LinearSolver* symmetric = &workspace.symmetric_linear();
  const LinearSolver* newton = &workspace.newton_linear();
  const auto made = workspace.times_made().linear_solvers;
  Inputs after = before;
  change.apply(after);
  after.prepare(workspace);
  Changed changed{energy_pattern(workspace, x) != of_energy,
                  workspace.energy() != energy,
                  pointwise_pattern(workspace, x) != of_pointwise,
                  workspace.pointwise().plain != pointwise,
                  &workspace.linear() != linear,
                  &workspace.symmetric_linear() != symmetric,
                  &workspace.newton_linear() != newton};
  // Another solver can lie where the one before lay.
  if (workspace.times_made().linear_solvers == made + 3)
    changed.linear = changed.symmetric_linear = changed.newton_linear = true;
  return changed;
}

constexpr Changed nothing{};
constexpr Changed everything{true, true, true, true, true, true, true};
constexpr Changed energy_alone{.energy = true};
constexpr Changed both_forms{.energy = true, .pointwise = true};
constexpr Changed pointwise_alone{.pointwise = true};
constexpr Changed solvers{.linear = true, .symmetric_linear = true, .newton_linear = true};

}  // namespace

TEST_CASE("a kept product is made anew when its key changes, and not before") {
  Keyed<int, std::string> kept;
  int made = 0;
  const auto of = [&](int key) {
    return kept.of(key, [&] {
      if (key < 0) throw std::runtime_error("none");
      ++made;
      return std::to_string(key);
    });
  };
  CHECK(of(1) == "1");
  CHECK(of(1) == "1");
  CHECK(made == 1);
  CHECK(of(2) == "2");
  CHECK(of(1) == "1");
  CHECK(made == 3);
  CHECK_THROWS(of(-1));
  CHECK(of(1) == "1");  // none was kept
  CHECK(made == 4);
  CHECK(kept.times_made() == 4);
}

TEST_CASE("of a plane mesh each product is the same object until one of its inputs changes") {
  const auto in_options = [](void (*edit)(SmoothOptions&)) {
    return [edit](Inputs& inputs) { edit(inputs.options); };
  };
  const std::vector<std::pair<Change, Changed>> cases{
      {{"nothing", [](Inputs&) {}}, nothing},
      {{"equal classes", make_classes_anew}, nothing},
      {{"nodes that move", hold_a_node}, everything},
      {{"threads", in_options([](SmoothOptions& o) { o.threads = 2; })}, everything},
      {{"mesh as given", move_a_node}, energy_alone},
      {{"targets", in_options([](SmoothOptions& o) {
          o.targets = {0, 0, 1, 1};
        })},
       energy_alone},
      {{"penalty", in_options([](SmoothOptions& o) { o.penalty.exponent += 1; })}, energy_alone},
      {{"VCVs",
        [](Inputs& inputs) {
          inputs.state.vcvs =
              std::make_shared<const VirtualControlVolumes>(*inputs.state.vcvs.plane());
        }},
       both_forms},
      {{"roles of elements", give_roles}, energy_alone},
      {{"linear solver", in_options([](SmoothOptions& o) { o.linear.solver = "direct"; })},
       solvers},
      {{"linear tolerance", in_options([](SmoothOptions& o) { o.linear.tolerance = 1e-5; })},
       solvers},
      {{"tolerance", in_options([](SmoothOptions& o) { o.tolerance = 1e-3; })}, nothing},
      {{"damping", in_options([](SmoothOptions& o) { o.damping = 0.1; })}, nothing}};
  for (const auto& of : cases) {
    CAPTURE(of.first.what);
    CHECK((changed_by(plane_inputs(), of.first) == of.second));
  }
}

TEST_CASE("regular targets of a plane mesh do not depend on the mesh as given") {
  Inputs inputs = plane_inputs();
  inputs.options.targets = TargetBlend::regular();
  CHECK((changed_by(inputs, {"mesh as given", move_a_node}) == nothing));
}

TEST_CASE("of a volume mesh each product is the same object until one of its inputs changes") {
  const auto kind = [](VcvKind of) { return [of](Inputs& inputs) { inputs.options.vcv = of; }; };
  const std::vector<std::pair<Change, Changed>> cases{
      {{"nothing", [](Inputs&) {}}, nothing},
      {{"equal classes", make_classes_anew}, nothing},
      {{"nodes that move", hold_a_node}, everything},
      {{"mesh as given", move_a_node}, both_forms},
      {{"kind of VCVs", kind(VcvKind::equal)}, pointwise_alone},
      {{"lengths of VCVs", [](Inputs& inputs) { inputs.options.vcv_lengths = 0.5; }},
       pointwise_alone},
      {{"roles of elements", give_roles}, energy_alone},
      {{"stencil by hand", give_a_stencil}, both_forms}};
  for (const auto& of : cases) {
    CAPTURE(of.first.what);
    CHECK((changed_by(space_inputs(), of.first) == of.second));
  }
  // Targets with a share for VCVs are others with other VCVs.
  Inputs over_vcvs = space_inputs();
  over_vcvs.options.targets = {0, 0, 1, 0};
  CHECK((changed_by(over_vcvs, {"kind of VCVs", kind(VcvKind::equal)}) == both_forms));
  // Equal VCVs and regular targets know nothing of the mesh as given.
  Inputs equal = space_inputs();
  equal.options.targets = TargetBlend::regular();
  equal.options.vcv = VcvKind::equal;
  CHECK((changed_by(equal, {"mesh as given", move_a_node}) == nothing));
}

TEST_CASE("elements that count more, or are guarded, make another energy up to the next run") {
  const Inputs inputs = space_inputs();
  SmoothingWorkspace workspace;
  inputs.prepare(workspace);
  const auto plain = workspace.energy();
  const auto pattern = energy_pattern(workspace, inputs.given());
  workspace.count_more({0});
  const auto weighed = workspace.energy();
  CHECK(weighed != plain);
  CHECK(workspace.energy() == weighed);
  CHECK(energy_pattern(workspace, inputs.given()) == pattern);
  workspace.count_more({0, 0});
  CHECK(workspace.energy() != weighed);
  const std::vector<Index> middle{13};
  workspace.guard(middle);
  CHECK(energy_pattern(workspace, inputs.given()) != pattern);
  const auto guarded = energy_pattern(workspace, inputs.given());
  workspace.count_more({1});
  CHECK(energy_pattern(workspace, inputs.given()) == guarded);
  inputs.prepare(workspace);
  CHECK(energy_pattern(workspace, inputs.given()) != guarded);
}

TEST_CASE("adjusted VCVs hold for one run, and those of the mesh as given are not made again") {
  const Inputs inputs = space_inputs();
  Inputs moved = inputs;
  move_a_node(moved);
  SmoothingWorkspace workspace;
  inputs.prepare(workspace);
  const auto of_given = workspace.volume_vcvs();
  const auto form = workspace.pointwise().plain;
  CHECK(workspace.adjust_vcvs(inputs.given()) == 0);
  CHECK(workspace.volume_vcvs() == of_given);
  CHECK(workspace.adjust_vcvs(moved.given()) > 0);
  CHECK(workspace.volume_vcvs() != of_given);
  CHECK(workspace.pointwise().plain != form);
  inputs.prepare(workspace);
  CHECK(workspace.volume_vcvs() == of_given);
  CHECK(workspace.times_made().vcvs == 1);
}

TEST_CASE("stencils given by hand are in the VCVs, and are taken out again") {
  Inputs inputs = space_inputs();
  SmoothingWorkspace workspace;
  inputs.prepare(workspace);
  const Index node = inputs.classes->topology().interior_nodes().front();
  const auto computed = workspace.volume_vcvs();
  CHECK(!computed->edited(node));
  give_a_stencil(inputs);
  inputs.prepare(workspace);
  CHECK(workspace.volume_vcvs()->edited(node));
  CHECK(workspace.volume_vcvs() == workspace.volume_vcvs());
  inputs.state.vcvs = {};
  inputs.prepare(workspace);
  CHECK(workspace.volume_vcvs() == computed);
  CHECK(workspace.times_made().vcvs == 1);
}

TEST_CASE("outer solvers are those of one run, and of one problem") {
  const Inputs inputs = plane_inputs();
  SmoothingWorkspace workspace;
  inputs.prepare(workspace);
  Coordinates x = inputs.given();
  EnergyNewton& newton = workspace.newton();
  newton.start(x);
  newton.step(x);
  CHECK(&workspace.newton() == &newton);
  CHECK(workspace.newton().linear_solves() > 0);
  CHECK(&workspace.steady_solver() == &newton);
  workspace.picard().start(x);
  workspace.picard().step(x);
  workspace.pointwise_newton().start(x);
  workspace.pointwise_newton().step(x);
  CHECK(workspace.picard().linear_solves() > 0);
  CHECK(workspace.pointwise_newton().linear_solves() > 0);
  workspace.count_more({0});
  CHECK(&workspace.newton().problem() == workspace.energy().get());
  CHECK(workspace.newton().linear_solves() == 0);
  CHECK(workspace.picard().linear_solves() > 0);  // it is not on the energy
  inputs.prepare(workspace);
  CHECK(workspace.picard().linear_solves() == 0);
  CHECK(workspace.pointwise_newton().linear_solves() == 0);
}

TEST_CASE("runs that follow one another make patterns, targets and linear solvers once") {
  SolverCache cache;
  const SmoothingWorkspace& workspace = cache.workspace();
  RunOptions run;
  run.cache = &cache;
  const MeshState state = make_state(make_mesh(annulus(24, 6, 1.2, Cells::mixed)));
  SmoothOptions options;
  options.threads = 1;
  options.targets = TargetBlend::automatically();  // also for the motions
  const auto smooth = [&] {
    Coordinates x = state.mesh.coordinates;
    CHECK(smooth_interior(state, options, x, run).converged);
  };
  smooth();
  const auto first = workspace.times_made();
  CHECK(first.energy_patterns == 1);
  CHECK(first.targets == 1);
  smooth();
  SUBCASE("another run") {}
  SUBCASE("a drag") {
    Coordinates x = state.mesh.coordinates;
    for (const double turn : {2.0, 4.0, 6.0}) {
      const auto motion = make_motion(*state.mesh.topology, state.mesh.coordinates, {"inner"},
                                      RigidMotion{turn, Vec2(0, 0), Vec2(0, 0)});
      const Coordinates start = x;
      run.start = &start;
      smooth_motion(state, *motion, {}, options, x, run);
    }
  }
  const auto last = workspace.times_made();
  CHECK(last.energy_patterns == 1);
  CHECK(last.targets == 1);
  CHECK(last.pointwise_patterns == 0);
  CHECK(last.linear_solvers == first.linear_solvers);
}

TEST_CASE("a mesh that runs lead on has other targets and the same pattern") {
  SolverCache cache;
  const SmoothingWorkspace& workspace = cache.workspace();
  RunOptions run;
  run.cache = &cache;
  MeshState state = make_state(make_mesh(annulus(24, 6, 1.2, Cells::mixed)));
  Random random(3);
  perturb(state.mesh, random);
  SmoothOptions options;
  options.threads = 1;
  for (int turn = 0; turn < 3; ++turn) {
    Coordinates x = state.mesh.coordinates;
    smooth_interior(state, options, x, run);
    CHECK(x != state.mesh.coordinates);
    state.mesh.coordinates = std::move(x);
  }
  CHECK(workspace.times_made().energy_patterns == 1);
  CHECK(workspace.times_made().targets == 3);
}

}  // namespace winslow::test

namespace {

MeshState plane_state(Cells cells = Cells::triangles) {
  return make_state(make_mesh(square_with_hole(15, cells)));
}

MeshState space_state() { return make_state(box_with_body(5, Volumes::tetrahedra)); }

MoveCommand turn(const MeshState& state, double degrees) {
  MoveCommand command;
  const bool space = state.mesh.topology->cell_dimension() == 3;
  command.bodies[0].markers = {space ? "body" : "hole"};
  command.bodies[0].motion.rotate = degrees;
  if (space) command.bodies[0].motion.axis = Vec3(0, 0, 1);
  return command;
}

RunOptions with(SolverCache& cache) {
  RunOptions options;
  options.cache = &cache;
  return options;
}

/// Cancels in its third iteration.
class Impatient final : public SolverMonitor {
 public:
  bool on_iteration(const IterationRecord&, const Coordinates&) override { return ++seen_ < 3; }

 private:
  int seen_ = 0;
};

}  // namespace

TEST_CASE("turn after turn a cache changes no bit of the meshes, in the plane and in space") {
  for (const MeshState& start : {plane_state(), space_state()}) {
    SolverCache cache;
    MeshState kept = start, fresh = start;
    for (const double degrees : {4.0, 6.0, -3.0}) {
      kept = execute(turn(start, degrees), kept, with(cache)).state;
      fresh = execute(turn(start, degrees), fresh).state;
      CHECK(kept.mesh.coordinates == fresh.mesh.coordinates);
    }
  }
}

TEST_CASE("one cache serves meshes in turn, of either dimension") {
  SolverCache cache;
  const MeshState states[] = {plane_state(), space_state(), plane_state(Cells::quads)};
  for (int round = 0; round < 2; ++round) {
    for (const MeshState& state : states) {
      const CommandResult kept = execute(turn(state, 5), state, with(cache));
      CHECK(kept.smooth.converged);
      CHECK(kept.state.mesh.coordinates == execute(turn(state, 5), state).state.mesh.coordinates);
    }
  }
}

TEST_CASE("a cache outlives a topology that is gone, and a command that makes another") {
  SolverCache cache;
  { execute(turn(plane_state(), 5), plane_state(), with(cache)); }
  MeshState state = plane_state();
  LayersCommand layers;
  layers.layers.walls = {{{"hole"}, {.count = 3, .first = 0.005}}};
  const CommandResult kept = execute(layers, state, with(cache));
  CHECK(kept.state.mesh.topology->element_count() > state.mesh.topology->element_count());
  CHECK(kept.state.mesh.coordinates == execute(layers, state).state.mesh.coordinates);
  const CommandResult turned = execute(turn(kept.state, 3), kept.state, with(cache));
  CHECK(turned.state.mesh.coordinates ==
        execute(turn(kept.state, 3), kept.state).state.mesh.coordinates);
}

namespace {

/// A mesh with layers over walls that stretch.
struct Stretchable {
  std::string name;
  Inputs inputs;
  std::shared_ptr<const Coordinates> reference;

  Stretchable(std::string name_of_mesh, const Mesh& mesh)
      : name(std::move(name_of_mesh)),
        inputs(inputs_of(make_state(mesh))),
        reference(std::make_shared<const Coordinates>(mesh.coordinates)) {
    inputs.options.targets = TargetBlend::keeping();
  }
  Coordinates moved(double stretch) const {
    Coordinates x = *reference;
    for (Index node = 0; node < x.size(); ++node)
      set_place(x, node, place_of(x, node).cwiseProduct(Vec3(1 + stretch, 1, 1)));
    return x;
  }
  std::shared_ptr<const WallStretch> stretch(SmoothingWorkspace& workspace, double by) const {
    return workspace.walls(inputs.classes, reference).stretched(moved(by));
  }
  std::shared_ptr<const VariationalForm> prepare(SmoothingWorkspace& workspace, double by) const {
    workspace.prepare(inputs.state, inputs.classes, inputs.options, reference,
                      stretch(workspace, by));
    return workspace.energy();
  }
};

std::vector<Stretchable> stretchable_meshes() {
  std::vector<Stretchable> meshes;
  for (const Volumes volumes : all_volumes)
    meshes.emplace_back(name_of(volumes), layered_cube(volumes));
  for (const Cut cut : {Cut::none, Cut::alternating})
    meshes.emplace_back(name_of(cut), make_mesh(o_grid(32, distances(9, 0.02, 1.4, 9), cut)));
  return meshes;
}

}  // namespace

TEST_CASE("targets over walls that stretch further are those that a new run makes, bit for bit") {
  for (const Stretchable& mesh : stretchable_meshes()) {
    CAPTURE(mesh.name);
    SmoothingWorkspace kept;
    std::vector<double> energies;
    for (const double stretch : {0.0, 0.2, -0.1, 0.0, 0.3}) {
      SmoothingWorkspace anew;
      energies.push_back(mesh.prepare(kept, stretch)->energy(mesh.moved(stretch)));
      CHECK(energies.back() == mesh.prepare(anew, stretch)->energy(mesh.moved(stretch)));
    }
    CHECK(energies[1] != energies[4]);
  }
}

TEST_CASE("targets of some elements are those that all elements have") {
  for (const Stretchable& mesh : stretchable_meshes()) {
    CAPTURE(mesh.name);
    const auto check = [&]<int D>() {
      SmoothingWorkspace workspace;
      mesh.prepare(workspace, 0.2);
      const auto stretch = mesh.stretch(workspace, -0.1);
      const TargetsOfSome<D> some = workspace.targets_with<D>(stretch, stretch->elements());
      SmoothingWorkspace other;
      const auto form = mesh.prepare(other, -0.1);
      const auto& all = dynamic_cast<const SimplexWinslow<D>&>(*form).shapes();
      REQUIRE(some.cells.size() == some.targets.cells.size());
      REQUIRE(some.elements.size() == some.cells.size());
      CHECK(some.cells.size() < all.cells.size());
      std::map<std::array<Index, D + 1>, std::size_t> place;
      for (std::size_t t = 0; t < all.cells.size(); ++t) place[all.cells[t]] = t;
      for (std::size_t t = 0; t < some.cells.size(); ++t) {
        const auto nodes = mesh.inputs.state.mesh.topology->element(some.elements[t]);
        for (const Index node : some.targets.cells[t])
          CHECK(std::ranges::find(nodes, node) != nodes.end());
        const auto terms = some.targets.terms_of(t);
        const auto expected = all.terms_of(place.at(some.targets.cells[t]));
        REQUIRE(terms.size() == expected.size());
        CHECK(std::memcmp(terms.data(), expected.data(), terms.size_bytes()) == 0);
      }
    };
    mesh.inputs.state.mesh.coordinates.dimension() == 2 ? check.operator()<2>()
                                                        : check.operator()<3>();
  }
}

TEST_CASE("a fork of a workspace has its products, and changes none of them") {
  for (const Stretchable& mesh : stretchable_meshes()) {
    CAPTURE(mesh.name);
    SmoothingWorkspace workspace;
    const double before = mesh.prepare(workspace, 0.2)->energy(mesh.moved(0.2));
    workspace.newton();
    const auto fork = workspace.fork();
    const auto form = mesh.prepare(*fork, 0.2);
    CHECK(form->energy(mesh.moved(0.2)) == before);
    CHECK(fork->times_made().energy_patterns == workspace.times_made().energy_patterns);
    CHECK(&fork->symmetric_linear() != &workspace.symmetric_linear());
    CHECK(mesh.prepare(*fork, 0.3)->energy(mesh.moved(0.2)) != before);
    CHECK(workspace.energy()->energy(mesh.moved(0.2)) == before);
    CHECK(form->energy(mesh.moved(0.2)) == before);
  }
}

TEST_CASE("a call that is cancelled or refused leaves a cache that can be used again") {
  for (const MeshState& state : {plane_state(), space_state()}) {
    SolverCache cache;
    Impatient monitor;
    RunOptions options = with(cache);
    options.monitor = &monitor;
    CHECK_THROWS_AS(execute(turn(state, 40), state, options), Cancelled);
    MoveCommand unknown = turn(state, 5);
    unknown.bodies[0].markers = {"nowhere"};
    CHECK_THROWS_AS(execute(unknown, state, with(cache)), UsageError);
    CHECK(execute(turn(state, 5), state, with(cache)).state.mesh.coordinates ==
          execute(turn(state, 5), state).state.mesh.coordinates);
  }
}

TEST_CASE("a cache keeps what it has where it is moved to; clear() gives up all that it holds") {
  const MeshState state = plane_state();
  SolverCache cache;
  const long before = state.mesh.topology.use_count();
  execute(turn(state, 5), state, with(cache));
  CHECK(state.mesh.topology.use_count() > before);
  SmoothingWorkspace* const inside = &cache.workspace();
  SolverCache other = std::move(cache);
  CHECK(&other.workspace() == inside);
  other.clear();
  CHECK(state.mesh.topology.use_count() == before);
  CHECK(execute(turn(state, 5), state, with(other)).smooth.converged);
  CHECK(execute(turn(state, 5), state, with(cache)).smooth.converged);
}
