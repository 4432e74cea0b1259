#include "core/strategy/layering.h"

#include <doctest/doctest.h>

#include <string>

#include "core/command/command.h"
#include "core/error.h"
#include "core/layers/layer_stack.h"
#include "core/quality/quality.h"
#include "support/meshes.h"

using namespace winslow;
using namespace winslow::test;

namespace {

MeshState ring() { return make_state(make_mesh(annulus(32, 12, 1.2, Cells::triangles))); }

LayersCommand layers_at(const std::string& marker, const LayerSpacing& spacing) {
  LayersCommand command;
  command.layers.walls.push_back({{marker}, spacing});
  return command;
}

LayerSpacing thin() { return {6, 0.002, 1.3, 1.0, {}, false}; }

/// Interior nodes of `before` farther than this from a centre; all of them are where they were.
Index require_unmoved(const MeshState& before, const MeshState& after, const Vec2& centre,
                      double radius) {
  Index outside = 0, moved = 0;
  for (const Index node : before.mesh.topology->interior_nodes()) {
    const Vec2 at = before.mesh.coordinates.xy(node);
    if ((at - centre).norm() <= radius) continue;
    ++outside;
    moved += after.mesh.coordinates.xy(node) != at;
  }
  CHECK(moved == 0);
  CHECK(outside > 20);
  return outside;
}

void require_valid(const MeshState& state) {
  CHECK(check_validity(*state.mesh.topology, state.mesh.coordinates).inverted == 0);
}

double worst_height(const MeshState& state) {
  return measure_layers(*state.layers, state.mesh.coordinates).spacing_error.max;
}

std::string refusal(const Command& command, const MeshState& state) {
  try {
    execute(command, state);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

bool names(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("layers are inserted and spaced, and nothing moves outside a circle about the wall") {
  const MeshState before = ring();
  const Bounds body =
      bounds(before.mesh.coordinates,
             before.mesh.topology->markers().nodes_of(std::vector<std::string>{"inner"}));
  const double radius = 0.8 * body.size().norm();
  LayersCommand command = layers_at("inner", thin());
  command.smooth.keep_outside.radius = radius;  // the centre is the wall's
  const CommandResult inserted = execute(command, before);
  const Index outside = require_unmoved(before, inserted.state, Vec2(0, 0), radius);
  CHECK(inserted.smooth.kept_outside == outside);
  require_valid(inserted.state);
  CHECK(worst_height(inserted.state) < 0.01);

  const MeshState read = make_state(inserted.state.mesh);  // as from a file: no VCVs
  LayersCommand respace = layers_at("inner", {6, 0.001, 1.4, 1.0, {}, false});
  respace.task = LayerTask::respace;
  respace.smooth.keep_outside.radius = radius;
  const CommandResult spaced = execute(respace, read);
  CHECK(spaced.smooth.kept_outside == require_unmoved(read, spaced.state, Vec2(0, 0), radius));
  require_valid(spaced.state);
  CHECK(worst_height(spaced.state) < 0.01);
  CHECK(largest_difference(spaced.state.mesh.coordinates, read.mesh.coordinates) > 1e-4);

  SUBCASE("far from the origin, too") {
    MeshData data = annulus(32, 12, 1.2, Cells::triangles);
    const Vec2 away(1e7, -3e7);
    for (Index i = 0; i < data.node_count(); ++i)
      data.coordinates.set_xy(i, data.coordinates.xy(i) + away);
    const MeshState far = make_state(make_mesh(data));
    const CommandResult there = execute(command, far);
    require_unmoved(far, there.state, away, radius);
    require_valid(there.state);
  }
}

TEST_CASE("layers that are not held afterwards leave what is outside alone as well") {
  const MeshState before = ring();
  LayersCommand command = layers_at("inner", thin());
  command.control = false;
  command.smooth.keep_outside.radius = 2.0;
  command.smooth.keep_outside.centre = Vec2(0, 0);
  const CommandResult result = execute(command, before);
  require_unmoved(before, result.state, Vec2(0, 0), 2.0);
  require_valid(result.state);
}

TEST_CASE("held layers go with their wall inside the region, those outside stay") {
  const MeshState before = make_state(make_mesh(square_with_two_holes(20, Cells::mixed)));
  LayersCommand both;
  both.layers.walls.push_back({{"hole_a"}, {3, 0.004, 1.2, 1.0, {}, false}});
  both.layers.walls.push_back({{"hole_b"}, {3, 0.004, 1.2, 1.0, {}, false}});
  const MeshState layered = execute(both, before).state;
  MoveCommand move;
  move.bodies[0].markers = {"hole_a"};
  move.bodies[0].motion.rotate = 10;
  const Bounds body = bounds(layered.mesh.coordinates,
                             layered.mesh.topology->markers().nodes_of(move.bodies[0].markers));
  const Vec2 centre = 0.5 * (body.min + body.max);
  const double radius = 0.5 * body.size().norm() + 0.12;
  move.smooth.keep_outside.radius = radius;
  const CommandResult moved = execute(move, layered);
  CHECK(moved.smooth.kept_outside == require_unmoved(layered, moved.state, centre, radius));
  CHECK(moved.smooth.fraction_reached == 1);
  require_valid(moved.state);
  const LayerStack& stack = *moved.state.layers;
  const LayerMeasures measures = measure_layers(stack, moved.state.mesh.coordinates);
  for (std::size_t c = 0; c < stack.columns.size(); ++c)
    CHECK(measures.columns[c].spacing_error < 0.02);

  SUBCASE("smoothing in place keeps them, too") {
    SmoothCommand smooth;
    smooth.smooth.keep_outside.radius = radius;
    smooth.smooth.keep_outside.centre = centre;
    const CommandResult smoothed = execute(smooth, moved.state);
    require_unmoved(moved.state, smoothed.state, centre, radius);
    require_valid(smoothed.state);
  }
  SUBCASE("a region that ends within the layers of the wall that moves is refused") {
    move.smooth.keep_outside.radius = 0.5 * body.size().norm() + 0.001;
    const std::string said = refusal(move, layered);
    CHECK(names(said, "layers of the wall 'hole_a'"));
    CHECK(names(said, "node "));
  }
}

TEST_CASE("columns with a node that is kept neither count nor are corrected") {
  const MeshState state = execute(layers_at("inner", thin()), ring()).state;
  const LayerStack& stack = *state.layers;
  Coordinates x = state.mesh.coordinates;
  const Index node = stack.columns[3].nodes[2];
  x.set_xy(node, x.xy(node) + 0.001 * stack.columns[3].plane_direction());
  const std::vector<Index> kept{node};
  CHECK(measure_movable_layers(stack, x, {}).spacing_error.max > 0.1);
  CHECK(measure_movable_layers(stack, x, kept).spacing_error.max < 0.01);
  LayerStack changed = stack;
  changed.columns[3].heights[0] = 7;
  changed.columns[4].heights[0] = 8;
  restore_kept_columns(changed, stack, kept);
  CHECK(changed.columns[3].heights == stack.columns[3].heights);
  CHECK(changed.columns[4].heights[0] == 8);
}

TEST_CASE("layers whose wall or whose thickness the region does not hold are refused by name") {
  const MeshState before = ring();
  LayersCommand command = layers_at("inner", thin());
  KeepOutside& keep = command.smooth.keep_outside;
  // Half of the wall.
  keep.corner = Vec2(0, -10);
  keep.opposite = Vec2(10, 10);
  CHECK(names(refusal(command, before), "a part of the wall 'inner'"));
  // None of it.
  keep.corner = Vec2(1.2, -10);
  CHECK(names(refusal(command, before), "wall 'inner'"));
  // The wall, but not its layers.
  const Bounds body =
      bounds(before.mesh.coordinates,
             before.mesh.topology->markers().nodes_of(std::vector<std::string>{"inner"}));
  keep = {.radius = 0.5 * body.size().x() + 0.21, .centre = Vec2(0, 0)};
  command.layers.walls[0].spacing = {12, 0.02, 1.0, 1.0, {}, false};
  CHECK(names(refusal(command, before), "there would be layers of the wall 'inner'"));
  keep.radius = 0.5 * body.size().x() + 0.005;
  const MeshState layered = make_state(execute(layers_at("inner", thin()), before).state.mesh);
  LayersCommand respace = layers_at("inner", thin());
  respace.task = LayerTask::respace;
  respace.smooth.keep_outside = keep;
  CHECK(names(refusal(respace, layered), "there are layers of the wall 'inner'"));
  // Holding moves nothing, wherever the region is.
  LayersCommand hold = layers_at("inner", thin());
  hold.task = LayerTask::hold;
  hold.smooth.keep_outside = keep;
  CHECK(largest_difference(execute(hold, layered).state.mesh.coordinates,
                           layered.mesh.coordinates) == 0);
}
