#include "core/strategy/volume_layering.h"

#include <cstdio>

#include "core/error.h"
#include "core/formulation/target_metric.h"
#include "core/formulation/wall_stretch.h"
#include "core/layers/space/volume_plan.h"
#include "core/layers/volume_measures.h"
#include "core/quality/quality.h"
#include "core/quality/volume_element.h"
#include "core/strategy/held_walls.h"
#include "core/strategy/run_sequence.h"

namespace winslow {

namespace {

std::string place_text(Index node, const Vec3& p) {
  char text[128];
  std::snprintf(text, sizeof text, "node %lld at (%.6g, %.6g, %.6g)", static_cast<long long>(node),
                p.x(), p.y(), p.z());
  return text;
}

/// A wall node with a column through an element of layers.
Index wall_node_under(const VolumeLayerInsertion& layers, Index element) {
  const auto nodes = layers.mesh.topology->element(element);
  for (const LayerColumn& column : layers.stack.columns)
    for (const Index node : column.nodes)
      if (std::ranges::find(nodes, node) != nodes.end()) return column.wall_node;
  return nodes.front();
}

/// An element of layers without the shape that it is to have; none if all have one.
std::optional<Index> element_without_shape(const VolumeLayerInsertion& layers,
                                           const Coordinates& shapes) {
  const Topology& topology = *layers.mesh.topology;
  const SpacePoints x(shapes);
  for (Index e = 0; e < topology.element_count(); ++e) {
    if (layers.stack.layer_of_element[at(e)] < 0) continue;
    for (const auto& corner : topology.shape(e).corner_tetrahedra) {
      const auto nodes = by_nodes(corner, topology.element(e));
      Edges3 edges;
      for (int k = 0; k < 3; ++k) edges.col(k) = x[nodes[at(k + 1)]] - x[nodes[0]];
      if (!has_metric(edges)) return e;
    }
  }
  return std::nullopt;
}

void require_sound(const VolumeLayerInsertion& layers) {
  const Coordinates& x = layers.mesh.coordinates;
  if (const auto e = element_without_shape(layers, layers.ideal)) {
    const Index node = wall_node_under(layers, *e);
    throw NumericError("the layers cross one another above " + place_text(node, x.xyz(node)) +
                       ": they have to be thinner there");
  }
  const Topology& topology = *layers.mesh.topology;
  for (Index e = 0; e < topology.element_count(); ++e) {
    if (!VolumeElement(x, topology.shape(e), topology.element(e)).inverted()) continue;
    const Index node = topology.element(e)[0];
    throw NumericError("element " + std::to_string(e) +
                       " of the collapsed layers is inverted: " + place_text(node, x.xyz(node)) +
                       "; a mesh with inverted elements has to be smoothed before");
  }
}

/// Lets the parts of the boundary slide on which columns stand.
class ColumnFootholds {
 public:
  explicit ColumnFootholds(const VolumeLayerInsertion& layers)
      : topology_(*layers.mesh.topology), x_(layers.mesh.coordinates) {
    for (const LayerColumn& column : layers.stack.columns)
      for (std::size_t k = 1; k < column.nodes.size(); ++k)
        if (topology_.on_boundary(column.nodes[k])) add(column.nodes[k]);
  }

  void let_slide(SlideOptions& slide) const {
    for (const std::string& marker : markers_) {
      if (std::ranges::find(slide.fixed, marker) != slide.fixed.end())
        throw UsageError("layers stand on '" + marker +
                         "', which is to stay: expected a marker that may slide, or walls with "
                         "layers that end before it");
      const auto is = [&](const std::vector<std::string>& names) {
        return std::ranges::find(names, marker) != names.end();
      };
      if (!is(slide.markers) && !is(slide.periodic)) slide.markers.push_back(marker);
    }
    // Some columns stand on the edges of these markers.
    slide.features = slide.features || !markers_.empty();
    slide.surface_first = false;
  }

 private:
  void add(Index node) {
    const Markers& markers = topology_.markers();
    Index place = 0;
    bool found = false;
    for (const Marker& marker : markers) {
      if (!std::ranges::binary_search(markers.nodes(place++), node)) continue;
      found = true;
      if (std::ranges::find(markers_, marker.name) == markers_.end())
        markers_.push_back(marker.name);
    }
    if (!found)
      throw UsageError("layers stand on a part of the boundary without a marker (" +
                       place_text(node, x_.xyz(node)) +
                       "): expected markers, which say along what the layers may slide");
  }

  const Topology& topology_;
  const Coordinates& x_;
  std::vector<std::string> markers_;
};

/// The options of all runs.
SmoothOptions options_for_opening(const VolumeLayerInsertion& layers, const SmoothOptions& asked) {
  if (asked.formulation != Formulation::variational)
    throw UsageError("layers of a volume mesh need the variational form");
  SmoothOptions options = asked;
  options.targets = options.targets.or_else(TargetBlend::automatically());
  // First-order steps do not see how stiff layers are.
  if (options.outer == OuterMethod::automatic) options.outer = OuterMethod::newton;
  if (options.outer != OuterMethod::newton)
    throw UsageError("layers of a volume mesh need Newton's method: expected no outer method");
  options.raise_worst = false;  // it would do so at the expense of the heights
  // At the default of volume meshes, all heights may still be off by some thousandths.
  constexpr double tight = 1e-6;
  if (!options.tolerance) options.tolerance = tight;
  ColumnFootholds(layers).let_slide(options.slide);
  return options;
}

std::shared_ptr<const ElementRoles> roles_of(const LayerStack& stack) {
  auto roles = std::make_shared<ElementRoles>();
  for (const int layer : stack.layer_of_element)
    roles->push_back(layer >= 0 ? ElementRole::layer : ElementRole::ordinary);
  return roles;
}

/// The ideal coordinates with the corrections of the heights.
Coordinates corrected(const Coordinates& ideal, const LayerStack& stack) {
  Coordinates shapes = ideal;
  for (const LayerColumn& column : stack.columns) {
    if (column.corrections.empty()) continue;
    Vec3 tip = ideal.xyz(column.wall_node);
    for (std::size_t k = 0; k < column.count(); ++k) {
      const Vec3 edge = ideal.xyz(column.nodes[k + 1]) - ideal.xyz(column.nodes[k]);
      tip += column.corrections[k] * edge;
      shapes.set_xyz(column.nodes[k + 1], tip);
    }
  }
  return shapes;
}

/// The runs that open layers: each towards the heights with the corrections so far.
class Opening {
 public:
  Opening(const VolumeLayerInsertion& layers, const LayerRequest& request, const RunOptions& run)
      : layers_(layers),
        request_(request),
        options_(options_for_opening(layers, request.smooth)),
        run_(run),
        stack_(layers.stack),
        start_{layers.mesh, {}, roles_of(layers.stack)},
        x_(layers.mesh.coordinates) {
    if (!run_.cache) run_.cache = &own_cache_;
    if (!run_.kept) {
      const KeepOutside& region = request.smooth.keep_outside;
      require_layers_inside(region, stack_, {layers.mesh.topology, layers.ideal},
                            request.layers.walls);
      kept_ = nodes_kept_by_layers(region, layers.mesh, request.layers.walls);
      run_.kept = &kept_;
    }
    if (run_.monitor) run_.monitor->on_topology(layers.mesh.topology);
  }

  /// Throws NumericError unless the layers are open afterwards.
  void open() {
    solve();
    require_open(measure_volume_layers(stack_, x_));
  }
  void correct() {
    constexpr int most = 3;
    LayerMeasures best = measure_volume_layers(stack_, x_);
    for (int k = 0; k < std::min(most, request_.most_corrections); ++k) {
      if (!good() || best.spacing_error.max <= request_.tolerance) return;
      const Kept before{stack_, x_, result_};
      correct_volume_layers(stack_, x_);
      if (element_without_shape(layers_, corrected(layers_.ideal, stack_))) {
        stack_ = before.stack;
        return;
      }
      solve();
      LayerMeasures now = measure_volume_layers(stack_, x_);
      const bool turned = now.orthogonality.max > std::max(3.0, 1.2 * best.orthogonality.max);
      if (!good() || turned || now.spacing_error.max >= best.spacing_error.max) {
        go_back_to(before);
        return;
      }
      best = std::move(now);
    }
  }
  /// Smooths without control of the heights.
  void let_go() {
    RunOptions run = run_;
    run.layer_shapes = nullptr;
    MeshState free = start_;
    free.mesh.coordinates = x_;
    free.roles = nullptr;
    stack_ = layers_.stack;
    RunSequence(run, result_).smooth(free, options_, x_);
  }

  const LayerStack& stack() const { return stack_; }
  const Coordinates& mesh() const { return x_; }
  const SmoothResult& result() const { return result_; }

 private:
  struct Kept {
    LayerStack stack;
    Coordinates x;
    SmoothResult result;
  };

  void solve() {
    run_.layer_shapes = std::make_shared<const Coordinates>(corrected(layers_.ideal, stack_));
    RunSequence(run_, result_).smooth(start_, options_, x_);
  }
  bool good() const { return result_.converged && result_.inverted == 0; }
  void go_back_to(const Kept& kept) {
    stack_ = kept.stack;
    x_ = kept.x;
    RunSequence(run_, result_).fall_back_to(kept.result);
  }

  void require_open(const LayerMeasures& measures) const {
    constexpr double most = 0.5;  // of a height
    if (result_.inverted == 0 && (result_.converged || measures.spacing_error.max <= most)) return;
    std::size_t worst = 0;
    for (std::size_t c = 0; c < measures.columns.size(); ++c)
      if (measures.columns[c].spacing_error > measures.columns[worst].spacing_error) worst = c;
    const Index node = stack_.columns[worst].wall_node;
    throw NumericError(
        "the elements outside cannot be moved to make room for the layers: heights "
        "are off by up to " +
        std::to_string(std::lround(100 * measures.spacing_error.max)) + " % above " +
        place_text(node, x_.xyz(node)) + "; ask for thinner layers there");
  }

  const VolumeLayerInsertion& layers_;
  const LayerRequest& request_;
  const SmoothOptions options_;
  SolverCache own_cache_;
  std::vector<Index> kept_;
  RunOptions run_;
  LayerStack stack_;
  const MeshState start_;
  Coordinates x_;
  SmoothResult result_;
};

/// Lets motions hold the heights at walls that have layers.
void hold_heights(std::span<const LayerWall> walls, MeshState& state) {
  for (const LayerWall& wall : walls)
    if (!layer_edges(state.mesh, state.mesh.topology->markers().nodes_of(wall.markers)).empty())
      hold_walls(std::span(&wall, 1), state);
}

}  // namespace

SmoothResult open_volume_layers(const VolumeLayerInsertion& layers, const LayerRequest& request,
                                MeshState& state, const RunOptions& run) {
  require_volume(*layers.mesh.topology, "layers in space: the mesh is a ");
  if (!(request.tolerance > 0)) throw UsageError("the tolerance of the heights must be positive");
  require_sound(layers);
  Opening opening(layers, request, run);
  opening.open();
  if (request.control)
    opening.correct();
  else
    opening.let_go();
  MeshState open{{layers.mesh.topology, opening.mesh()}};
  open.layers = std::make_shared<const LayerStack>(opening.stack());
  open.held_walls = state.held_walls;
  if (request.control) hold_heights(request.layers.walls, open);
  state = std::move(open);
  return opening.result();
}

SmoothResult insert_layers_in_space(const LayerRequest& request, MeshState& state,
                                    const RunOptions& run) {
  if (check_validity(*state.mesh.topology, state.mesh.coordinates).inverted > 0)
    throw UsageError("the mesh has inverted elements; smooth it before layers are inserted");
  LayerStack plan = plan_volume_layers(state.mesh, options_of(request));
  require_layers_inside(request.smooth.keep_outside, plan, state.mesh, request.layers.walls);
  return open_volume_layers(insert_volume_layers(state.mesh, std::move(plan)), request, state, run);
}

}  // namespace winslow
