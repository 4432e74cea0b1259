#include "core/memory.h"

#include <doctest/doctest.h>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include "core/command/command.h"
#include "support/meshes.h"
#include "support/space_meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

std::size_t of(const MemoryUse& use, std::string_view name) {
  for (const auto& [part, bytes] : use.parts())
    if (part == name) return bytes;
  return 0;
}

MemoryUse memory_of(const Mesh& mesh, const Command& command, RunOptions options = {}) {
  return execute(command, make_state(mesh), options).smooth.memory;
}

SmoothCommand smooth_by(const std::string& solver) {
  SmoothCommand command;
  command.smooth.linear.solver = solver;
  return command;
}

}  // namespace

TEST_CASE("bytes of arrays are those of their capacity, of a sum those of its parts") {
  std::vector<double> numbers(3);
  numbers.reserve(10);
  CHECK(bytes_of(numbers) == 80);
  CHECK(bytes_of(numbers, std::vector<Index>(4)) == 96);
  MemoryUse use;
  std::size_t expected = 0;
  for (auto* part : {&use.mesh, &use.targets, &use.structure, &use.matrix, &use.preconditioner,
                     &use.factors, &use.vectors})
    expected += * part = 1 + expected;
  CHECK(use.total() == expected);
  CHECK(of(use, "mesh") == 1);
  CHECK(of(use, "vectors") == use.vectors);
}

TEST_CASE("a run says what its mesh, targets and matrices take, counted from their arrays") {
  const Mesh mesh = shaken_box(8, 0.2, 1);
  const MemoryUse use = memory_of(mesh, smooth_by("direct"));
  CHECK(use.mesh == mesh.topology->bytes() + 2 * mesh.coordinates.bytes());
  // Four corners of four bytes each, and at least one target of eight numbers.
  const auto cells = at(mesh.topology->element_count());
  CHECK(use.targets >= cells * (4 * sizeof(Index) + 8 * sizeof(double)));
  // 3 by 3 blocks: one for each node inside, and two for each edge inside.
  std::size_t blocks = 0;
  for (const Index node : mesh.topology->interior_nodes()) {
    ++blocks;
    for (const Index other : mesh.topology->neighbours(node))
      blocks += mesh.topology->on_boundary(other) ? 0 : 1;
  }
  CHECK(use.matrix == 9 * sizeof(double) * blocks);
  CHECK(use.factors > use.matrix / 2);
  CHECK(use.preconditioner == 0);
  CHECK(use.structure > 0);
  CHECK(use.vectors > 0);
}

TEST_CASE("each kind of linear solver counts what it keeps") {
  const Mesh mesh = shaken_box(8, 0.2, 1);
  for (const char* solver : {"multigrid", "cg"}) {
    CAPTURE(solver);
    const MemoryUse use = memory_of(mesh, smooth_by(solver));
    CHECK(use.preconditioner > use.matrix);  // the matrix in another order, and more
    CHECK(use.factors == 0);
  }
  SmoothCommand pointwise;
  pointwise.smooth.formulation = Formulation::pointwise;
  CHECK(memory_of(mesh, pointwise).structure > 0);
  const MeshState square_mesh = make_state(make_mesh(square(12, Cells::triangles)));
  const MeshState tangled = execute(Command(ScrambleCommand{}), square_mesh).state;
  const MemoryUse plane = execute(Command(smooth_by("direct")), tangled).smooth.memory;
  CHECK(plane.factors > 0);
  CHECK(plane.targets > 0);
}

TEST_CASE("a run that solves nothing counts nothing") {
  CHECK(memory_of(shaken_box(4, 0.2, 1), ScrambleCommand{}).total() == 0);
}

#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
TEST_CASE("what is counted is what the allocator handed out, within a fifth") {
  const auto in_use = [] {
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
  };
  const std::size_t at_first = in_use();
  const std::vector<double> probe(100'000);
  if (in_use() < at_first + bytes_of(probe)) return;  // sanitizers have an allocator of their own
  for (const char* solver : {"multigrid", "cg"}) {
    CAPTURE(solver);
    const MeshState state = make_state(shaken_box(16, 0.2, 1));
    SolverCache cache;
    RunOptions options;
    options.cache = &cache;
    const std::size_t before = in_use();
    const CommandResult result = execute(smooth_by(solver), state, options);
    const auto held = static_cast<double>(in_use() - before);
    // The cache keeps all that was counted; of the mesh only its new coordinates are new.
    const MemoryUse& use = result.smooth.memory;
    const auto counted = static_cast<double>(use.total() - use.mesh);
    CAPTURE(held);
    CAPTURE(counted);
    CHECK(counted > 0.8 * held);
    CHECK(counted < 1.2 * held);
  }
}
#endif
