#pragma once

#include "core/layers/layer_plan.h"
#include "core/layers/layer_spacing.h"
#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"
#include "core/motion/motion.h"
#include "core/strategy/keep_outside.h"
#include "core/strategy/mesh_state.h"
#include "core/strategy/run.h"
#include "core/strategy/smooth_options.h"

namespace winslow {

/// What a command does with layers.
enum class LayerTask {
  insert,   ///< insert new layers: the only task that changes the connectivity
  respace,  ///< change the heights of existing layers
  hold      ///< keep the heights of existing layers from now on
};

/// The wanted layers of a mesh, and how they are smoothed.
struct LayerRequest {
  LayerTask task = LayerTask::insert;
  LayerOptions layers;
  /// True: control the heights through the VCVs. False (insert only): smooth the new connectivity
  /// without control.
  bool control = true;
  double tolerance = 2e-3;   ///< relative error of any height above which the VCVs are corrected
  int most_corrections = 8;  ///< smoothing runs after the first
  SmoothOptions smooth;
};

/// The options by which an insertion plans its layers.
LayerOptions options_of(const LayerRequest& request);

/// Fulfils a request. An insertion plans and inserts the layers and makes room for them: it moves
/// the elements outside along a path of valid meshes. Then it smooths towards VCVs for the wanted
/// heights, and corrects these VCVs until the heights are met. Layers that are to be held are added
/// to those already held at other walls. state: before on entry, after on return. Throws
/// UsageError, Cancelled; NumericError if no room can be made.
SmoothResult run_layers(const LayerRequest& request, MeshState& state, const RunOptions& run);

/// Moves the boundary of a mesh with held layers. Where walls come too near to one another, layers
/// get thinner before the motion; where there is room again, they regain their heights. Afterwards
/// the VCVs are corrected until the wanted heights are met. state as above. Throws as
/// smooth_motion().
SmoothResult move_with_layers(MeshState& state, const Motion& motion, const MotionOptions& how,
                              const SmoothOptions& smooth, const RunOptions& run);

/// Layers of a mesh in which a command fixes some nodes (`kept`, ascending): those outside the
/// region of SmoothOptions::keep_outside.

/// The fixed nodes when layers are made or respaced at these walls. A circle without a centre is
/// centred on the walls. Throws as nodes_kept_outside(), except for walls that lie outside.
std::vector<Index> nodes_kept_by_layers(const KeepOutside& keep, const Mesh& mesh,
                                        std::span<const LayerWall> walls);

/// Throws UsageError naming the first wall that lies outside the region, or whose layers reach out
/// of it, with their wanted or their present column lengths.
void require_layers_inside(const KeepOutside& keep, const LayerStack& stack, const Mesh& mesh,
                           std::span<const LayerWall> walls);

/// The same for the columns that stand on the nodes of a motion.
void require_moved_layers_inside(const KeepOutside& keep, const LayerStack& stack, const Mesh& mesh,
                                 std::span<const Index> moving);

/// Throws UsageError naming the first node inside the mesh that a motion takes and that belongs to
/// layers: its height cannot be held.
void require_no_moved_layers(const LayerStack& stack, const Topology& topology,
                             std::span<const Index> moving);

/// Restores columns with a kept node to those in `before`: no run can reach other heights there.
void restore_kept_columns(LayerStack& stack, const LayerStack& before, std::span<const Index> kept);

/// measure_layers() without the columns that have a kept node.
LayerMeasures measure_movable_layers(LayerStack stack, const Coordinates& x,
                                     std::span<const Index> kept);

}  // namespace winslow
