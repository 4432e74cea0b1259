#include "core/strategy/layering.h"

#include <cstdio>

#include "core/error.h"
#include "core/layers/layer_control.h"
#include "core/layers/layer_detection.h"
#include "core/layers/layer_insertion.h"
#include "core/layers/layer_plan.h"
#include "core/layers/layer_stack.h"
#include "core/quality/quality.h"
#include "core/strategy/run_sequence.h"
#include "core/strategy/smooth_run.h"

namespace winslow {

namespace {

/// Motion of the rims of layers from the wall outwards.
class RimMotion final : public Motion {
 public:
  /// From the share `begin` of the wanted thickness to the whole thickness.
  RimMotion(const LayerStack& stack, double begin) : stack_(stack), begin_(begin) {
    for (const LayerColumn& column : stack_.columns) {
      if (column.count() > 0) rims_.push_back({column.rim(), &column});
    }
    std::sort(rims_.begin(), rims_.end());
    for (const auto& [node, column] : rims_) nodes_.push_back(node);
  }

  std::span<const Index> nodes() const override { return nodes_; }
  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    const double share = begin_ + (1 - begin_) * fraction;
    for (const auto& [node, column] : rims_) {
      const double length = share * column->thickness() * column->slant;
      out.set_xy(node, rest.xy(column->wall_node) + length * column->plane_direction());
    }
  }

 private:
  const LayerStack& stack_;
  double begin_;
  std::vector<std::pair<Index, const LayerColumn*>> rims_;
  std::vector<Index> nodes_;
};

/// The largest of a decreasing sequence of thickness shares at which the elements outside stay
/// valid without being moved; 0 if there is none.
double first_share(const LayerInsertion& layers, const Coordinates& rest, Coordinates& x) {
  constexpr double least = 1e-9;
  for (double share = 1; share > least; share *= 0.5) {
    x = rest;
    RimMotion(layers.stack, share).apply(rest, 0, x);
    if (check_validity(*layers.outside, x).inverted == 0) return share;
  }
  return 0;
}

/// Inserts layers and moves the elements outside to make room for them.
LayerInsertion make_room(const LayerRequest& request, const MeshState& state, RunSequence& runs) {
  const LayerOptions options = with_counts(options_of(request), state.mesh);
  LayerStack plan = sound_plan(state.mesh, options);
  require_layers_inside(request.smooth.keep_outside, plan, state.mesh, options.walls);
  SmoothOptions
      smooth;  // default options, ignoring the request: only valid intermediate meshes matter
  smooth.threads = request.smooth.threads;
  smooth.linear = request.smooth.linear;
  smooth.tolerance = 1e-3;
  smooth.targets = TargetBlend::automatically();
  smooth.slide.interfaces = interfaces_in(request.smooth.slide.interfaces, false);
  constexpr int most_attempts = 6;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    LayerInsertion layers = insert_layers(state.mesh, plan);
    runs.show(layers.mesh.topology);
    const Coordinates rest = layers.mesh.coordinates;
    Coordinates x;
    const double begin = first_share(layers, rest, x);
    if (begin == 0) break;
    double reached = 1;
    if (begin < 1) {
      const MeshState outside = make_state({layers.outside, x});
      reached = begin + (1 - begin) * runs.open(outside, layers.stack,
                                                RimMotion(layers.stack, begin), smooth, x);
    }
    if (reached >= 1) {
      lay_out(layers.stack, 1, x);
      layers.mesh.coordinates = std::move(x);
      return layers;
    }
    std::vector<std::size_t> all(plan.columns.size());
    for (std::size_t c = 0; c < all.size(); ++c) all[c] = c;
    reduce_room(plan, all, 0.95 * reached, LayerLimit::room, options, state.mesh.coordinates);
  }
  const bool held =
      smooth.slide.interfaces != Interfaces::free && !state.mesh.topology->interfaces().empty();
  throw NumericError(
      std::string("the elements outside cannot be pushed away to make room for the layers") +
      (held ? "; the nodes in which regions meet are held or slide: --free-interfaces lets them go"
            : ""));
}

/// Sets the VCVs and the roles of elements for these layers.
void control_by(const LayerStack& stack, MeshState& state) {
  state.vcvs = layer_vcvs(state.mesh.topology, stack, *state.vcvs.plane(), state.mesh.coordinates);
  state.roles = layer_roles(*state.mesh.topology, stack);
}

/// Smooths towards the wanted heights and corrects the VCVs until they are met. On return the state
/// is the best one; a correction that lowers the smallest sine below `least_sine` is rejected.
void control_spacing(MeshState& state, const SmoothOptions& smooth, double tolerance, int most,
                     RunSequence& runs, double least_sine = 0) {
  LayerStack stack = *state.layers;
  Coordinates x = state.mesh.coordinates;
  const auto base = state.vcvs.plane();
  const auto roles = layer_roles(*state.mesh.topology, stack);  // corrections do not change them
  SmoothResult outcome;                                         // result of the last run
  const auto reference = reference_of(state);
  const auto smooth_towards = [&] {
    MeshState target{
        {state.mesh.topology, x}, layer_vcvs(state.mesh.topology, stack, *base, x), roles};
    target.reference = reference;
    outcome = runs.smooth(target, smooth, x);
    return target.vcvs;
  };
  const auto good = [&] {
    return outcome.converged && outcome.inverted == 0 &&
           (least_sine <= 0 || check_validity(*state.mesh.topology, x).min_sine >= least_sine);
  };
  const auto keep = [&](const Vcvs& vcvs) {
    state.vcvs = vcvs;
    state.roles = roles;
    state.mesh.coordinates = x;
    state.layers = std::make_shared<const LayerStack>(stack);
  };
  keep(smooth_towards());
  if (!good()) return;
  LayerMeasures best = measure_movable_layers(stack, x, runs.kept());
  for (int k = 0; k < most && best.spacing_error.max > tolerance; ++k) {
    const SmoothResult before = std::exchange(outcome, {});
    const LayerStack uncorrected = stack;
    correct_layers(stack, x);
    restore_kept_columns(stack, uncorrected, runs.kept());
    const Vcvs vcvs = smooth_towards();
    LayerMeasures now = measure_movable_layers(stack, x, runs.kept());
    // If the elements outside compress a fan from the side, longer edges would turn its columns.
    const bool turned = now.orthogonality.max > std::max(3.0, 1.2 * best.orthogonality.max);
    if (!good() || turned || now.spacing_error.max >= best.spacing_error.max) {
      runs.fall_back_to(before);
      return;
    }
    keep(vcvs);
    const bool worthwhile = now.spacing_error.max < 0.9 * best.spacing_error.max;
    best = std::move(now);
    if (!worthwhile) return;
  }
}

/// Moves the nodes of columns along the columns to the wanted heights, scaled to the present
/// thickness. From this start only the thickness has to change.
void slide_along_columns(const LayerStack& stack, Coordinates& x) {
  for (const LayerColumn& column : stack.columns) {
    std::vector<Vec2> points;
    std::vector<double> reached{0};
    for (const Index node : column.nodes) {
      points.push_back(x.xy(node));
      if (points.size() > 1) {
        reached.push_back(reached.back() + (points.back() - points[points.size() - 2]).norm());
      }
    }
    const double scale = reached.back() / std::max(column.thickness(), 1e-300);
    double height = 0;
    std::size_t k = 1;
    for (std::size_t i = 0; i + 1 < column.count(); ++i) {
      height += column.heights[i] * scale;
      while (k + 1 < reached.size() && reached[k] < height) ++k;
      const double share = (height - reached[k - 1]) / (reached[k] - reached[k - 1]);
      x.set_xy(column.nodes[i + 1], points[k - 1] + share * (points[k] - points[k - 1]));
    }
  }
}

/// Combines layers at some walls with those that are already held at other walls.
LayerStack together_with_held(LayerStack stack, const LayerStack* before,
                              const Topology& topology) {
  if (!before || !before->held) return stack;
  return with_other_layers(std::move(stack), *before, topology);
}

/// Respaces or holds existing layers, with their wanted heights.
void hold_existing(const LayerRequest& request, MeshState& state) {
  if (!request.layers.overrides.empty()) {
    throw UsageError("single columns can be set when layers are inserted, not in layers there are");
  }
  LayerStack stack = detect_layers(
      state.mesh, request.layers,
      request.task == LayerTask::hold ? LayerExtent::stretched : LayerExtent::connected);
  if (request.task == LayerTask::respace) {
    LayerOptions options = request.layers;
    for (LayerWall& wall : options.walls) {
      if (wall.spacing.match_outside) {
        throw UsageError("layers that are there cannot match the elements outside by their number");
      }
    }
    require_layers_inside(request.smooth.keep_outside, stack, state.mesh, options.walls);
    respace_layers(stack, state.mesh, options);
    Coordinates x = state.mesh.coordinates;
    slide_along_columns(stack, x);
    // Columns of very different shapes may cross; then the present mesh is the start.
    if (check_validity(*state.mesh.topology, x).inverted == 0) {
      state.mesh.coordinates = std::move(x);
    }
  }
  stack = together_with_held(std::move(stack), state.layers.get(), *state.mesh.topology);
  stack.held = true;
  // Layers that are held with their present heights need no smoothing.
  if (request.task == LayerTask::hold) {
    control_by(stack, state);
  }
  state.layers = std::make_shared<const LayerStack>(std::move(stack));
}

/// Fits the layers of the state between the walls after the motion. Returns true if any column
/// changed. Columns with kept nodes stay unchanged.
bool fit_layers(MeshState& state, const Motion& motion, std::span<const Index> kept) {
  const Coordinates& x = state.mesh.coordinates;
  Coordinates moved = x;
  motion.apply(x, 1, moved);
  const LayerStack& before = *state.layers;
  LayerStack fitted = fitted_layers(before, *state.mesh.topology, x, moved);
  restore_kept_columns(fitted, before, kept);
  if (std::ranges::equal(before.columns, fitted.columns, {}, &LayerColumn::heights,
                         &LayerColumn::heights)) {
    return false;
  }
  // Columns keep their directions on the walls until the walls have moved.
  for (std::size_t c = 0; c < fitted.columns.size(); ++c) {
    fitted.columns[c].direction = before.columns[c].direction;
    fitted.columns[c].slant = before.columns[c].slant;
  }
  control_by(fitted, state);
  state.layers = std::make_shared<const LayerStack>(std::move(fitted));
  return true;
}

/// After a motion with the result `moved`, corrects the VCVs until the wanted heights are met
/// again. run: includes the kept nodes.
SmoothResult hold_spacing(MeshState& state, SmoothResult moved, const SmoothOptions& smooth,
                          const RunOptions& run) {
  constexpr int most = 5;
  if (moved.inverted > 0 || !moved.converged) return moved;
  LayerStack stack = *state.layers;
  // Found layers were not made with this precision.
  const bool found = std::ranges::any_of(
      stack.columns, [](const LayerColumn& column) { return !column.bends.empty(); });
  const double tolerance = found ? 1e-2 : 5e-3;
  // The walls may have turned and changed their shape.
  const auto stands = column_stands(stack, state.mesh.coordinates);
  for (std::size_t c = 0; c < stands.size(); ++c) set_stand(stack.columns[c], stands[c]);
  const double error =
      measure_movable_layers(stack, state.mesh.coordinates, *run.kept).spacing_error.max;
  state.layers = std::make_shared<const LayerStack>(std::move(stack));
  if (error <= tolerance) return moved;
  MeshState held_state = state;
  SmoothResult held = moved;
  RunSequence runs(run, held);
  // Better heights do not justify an invalid mesh, nor, for found layers, a worse one.
  const auto smallest_sine = [&](const Coordinates& x) {
    return check_validity(*state.mesh.topology, x).min_sine;
  };
  const double least_sine = found ? 0.9 * smallest_sine(state.mesh.coordinates) : 0;
  control_spacing(held_state, smooth, tolerance, most, runs, least_sine);
  if (!held.converged || held.inverted > 0) return moved;
  if (smallest_sine(held_state.mesh.coordinates) < least_sine) return moved;
  state = std::move(held_state);
  return held;
}

}  // namespace

LayerOptions options_of(const LayerRequest& request) {
  LayerOptions options = request.layers;
  // Without control of the heights, no layer is dropped for them: all heights are scaled.
  options.scale_all = options.scale_all || !request.control;
  return options;
}

SmoothResult run_layers(const LayerRequest& request, MeshState& state, const RunOptions& run) {
  if (check_validity(*state.mesh.topology, state.mesh.coordinates).inverted > 0) {
    throw UsageError("the mesh has inverted elements; smooth it before layers are inserted");
  }
  if (!(request.tolerance > 0)) throw UsageError("the tolerance of the heights must be positive");
  SmoothResult result;
  const std::vector<Index> kept =
      nodes_kept_by_layers(request.smooth.keep_outside, state.mesh, request.layers.walls);
  RunOptions keeping = run;
  keeping.kept = &kept;
  RunSequence runs(keeping, result);
  if (request.task != LayerTask::insert) {
    hold_existing(request, state);
    if (request.task == LayerTask::hold) {
      result.converged = true;
      result.kept_outside = static_cast<Index>(kept.size());
    } else {
      control_spacing(state, request.smooth, request.tolerance, request.most_corrections, runs);
    }
    return result;
  }
  LayerInsertion layers = make_room(request, state, runs);
  state.mesh = std::move(layers.mesh);
  if (request.control) {
    layers.stack =
        together_with_held(std::move(layers.stack), state.layers.get(), *state.mesh.topology);
  }
  layers.stack.held = request.control;
  state.layers = std::make_shared<const LayerStack>(std::move(layers.stack));
  if (request.control) {
    control_spacing(state, request.smooth, request.tolerance, request.most_corrections, runs);
  } else {
    state.vcvs = std::make_shared<const VirtualControlVolumes>(state.mesh.topology);
    state.roles = nullptr;
    runs.smooth(state, request.smooth, state.mesh.coordinates);
  }
  return result;
}

SmoothResult move_with_layers(MeshState& state, const Motion& motion, const MotionOptions& how,
                              const SmoothOptions& asked, const RunOptions& run) {
  SmoothResult result;
  SmoothOptions smooth = asked;
  smooth.targets = smooth.targets.or_else(TargetBlend::keeping());  // for corrections as well
  const Mesh& mesh = state.mesh;
  const std::vector<Index> kept =
      nodes_kept_outside(smooth.keep_outside, *mesh.topology, mesh.coordinates, motion.nodes());
  require_moved_layers_inside(smooth.keep_outside, *state.layers, mesh, motion.nodes());
  require_no_moved_layers(*state.layers, *mesh.topology, motion.nodes());
  RunOptions keeping = run;
  keeping.kept = &kept;
  RunSequence runs(keeping, result);
  const bool blocked = run.all_or_nothing && how.increments == 0 &&
                       find_contact(*mesh.topology, mesh.coordinates, motion).has_value();
  // A given start has the walls at their final positions.
  if (!blocked && fit_layers(state, motion, kept) && !run.start)
    runs.smooth(state, smooth, state.mesh.coordinates);
  Coordinates x = starting_point(state, run);
  runs.move(state, motion, how, smooth, run.start, x);
  state.mesh.coordinates = std::move(x);
  const MeshState moved = state;
  SmoothResult held = hold_spacing(state, result, smooth, keeping);
  // Better heights do not justify a mesh outside the limits: then the heights stay as the motion
  // left them.
  if (!how.floor.given() || how.floor.fault(state.mesh, moved.mesh.coordinates).empty()) {
    return held;
  }
  state = moved;
  return result;
}

namespace {

std::vector<std::string> names_of(std::span<const LayerWall> walls) {
  std::vector<std::string> names;
  for (const LayerWall& wall : walls)
    names.insert(names.end(), wall.markers.begin(), wall.markers.end());
  return names;
}

/// The first of the named markers on which a node lies; of all markers if none is named.
std::string marker_at(const Topology& topology, Index node, std::span<const std::string> names) {
  const Markers& markers = topology.markers();
  Index place = 0;
  for (const Marker& marker : markers) {
    const auto nodes = markers.nodes(place++);
    if (!names.empty() && std::ranges::find(names, marker.name) == names.end()) continue;
    if (std::ranges::binary_search(nodes, node)) return marker.name;
  }
  return "(unmarked)";
}

[[noreturn]] void refuse(const std::string& wall, const std::string& what, Index node,
                         const Vec2& where) {
  char place[96];
  std::snprintf(place, sizeof place, "node %lld at (%.6g, %.6g)", static_cast<long long>(node),
                where.x(), where.y());
  throw UsageError("keep-outside: " + what + " '" + wall + "' (" + place +
                   ") outside the region in which nodes may move; expected walls with all of their "
                   "layers inside");
}

/// The end of a column: its present or its wanted position.
Vec2 end_of(const LayerColumn& column, const Coordinates& x) {
  if (!column.nodes.empty()) return x.xy(column.rim());
  return x.xy(column.wall_node) + column.thickness() * column.slant * column.plane_direction();
}

void require_column_inside(const FreeRegion& region, const LayerColumn& column, const Mesh& mesh,
                           std::span<const std::string> names) {
  const Coordinates& x = mesh.coordinates;
  const auto wall = [&] { return marker_at(*mesh.topology, column.wall_node, names); };
  const Vec2 foot = x.xy(column.wall_node);
  if (!region.holds(foot)) refuse(wall(), "there is a part of the wall", column.wall_node, foot);
  for (const Index node : column.nodes)
    if (!region.holds(x.xy(node))) refuse(wall(), "there are layers of the wall", node, x.xy(node));
  // A region is convex: it contains a straight column if it contains both ends.
  if (!region.holds(end_of(column, x)))
    refuse(wall(), "there would be layers of the wall", column.wall_node, foot);
}

bool has_kept_node(const LayerColumn& column, std::span<const Index> kept) {
  return std::ranges::any_of(column.nodes,
                             [&](Index node) { return std::ranges::binary_search(kept, node); });
}

}  // namespace

std::vector<Index> nodes_kept_by_layers(const KeepOutside& keep, const Mesh& mesh,
                                        std::span<const LayerWall> walls) {
  if (!keep.given()) return {};
  const std::vector<Index> nodes = mesh.topology->markers().nodes_of(names_of(walls));
  return nodes_outside(FreeRegion(keep, mesh.coordinates, nodes), *mesh.topology, mesh.coordinates);
}

void require_layers_inside(const KeepOutside& keep, const LayerStack& stack, const Mesh& mesh,
                           std::span<const LayerWall> walls) {
  if (!keep.given()) return;
  const std::vector<std::string> names = names_of(walls);
  const FreeRegion region(keep, mesh.coordinates, mesh.topology->markers().nodes_of(names));
  for (const LayerColumn& column : stack.columns)
    require_column_inside(region, column, mesh, names);
}

void require_moved_layers_inside(const KeepOutside& keep, const LayerStack& stack, const Mesh& mesh,
                                 std::span<const Index> moving) {
  if (!keep.given()) return;
  const FreeRegion region(keep, mesh.coordinates, moving);
  std::vector<Index> moved(moving.begin(), moving.end());
  std::ranges::sort(moved);
  for (const LayerColumn& column : stack.columns)
    if (std::ranges::binary_search(moved, column.wall_node))
      require_column_inside(region, column, mesh, {});
}

void require_no_moved_layers(const LayerStack& stack, const Topology& topology,
                             std::span<const Index> moving) {
  for (const LayerColumn& column : stack.columns)
    for (const Index node : column.nodes)
      if (!topology.on_boundary(node) && std::ranges::binary_search(moving, node))
        throw UsageError("node " + std::to_string(node) +
                         " is prescribed and belongs to layers whose heights are to be held: "
                         "expected one of the two");
}

void restore_kept_columns(LayerStack& stack, const LayerStack& before,
                          std::span<const Index> kept) {
  if (kept.empty()) return;
  for (std::size_t c = 0; c < stack.columns.size(); ++c)
    if (has_kept_node(stack.columns[c], kept)) stack.columns[c] = before.columns[c];
}

LayerMeasures measure_movable_layers(LayerStack stack, const Coordinates& x,
                                     std::span<const Index> kept) {
  for (LayerColumn& column : stack.columns) {
    if (kept.empty() || !has_kept_node(column, kept)) continue;
    column.heights.clear();
    column.nodes.resize(1);
  }
  return measure_layers(stack, x);
}

}  // namespace winslow
