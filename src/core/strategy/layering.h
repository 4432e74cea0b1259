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

/// What is done about layers.
enum class LayerTask {
  insert,   ///< new layers: the one command that changes the connectivity
  respace,  ///< the layers that the mesh has get other heights
  hold      ///< the layers that the mesh has keep their heights from here on
};

/// Layers that a mesh is to have, and how they are smoothed.
struct LayerRequest {
  LayerTask task = LayerTask::insert;
  LayerOptions layers;
  /// Hold the wanted heights, through the VCVs; false (insert only): smooth the new connectivity as
  /// it is.
  bool control = true;
  double tolerance = 2e-3;   ///< relative error of any height above which the VCVs are corrected
  int most_corrections = 8;  ///< smoothing runs after the first
  SmoothOptions smooth;
};

/// What an insertion plans its layers by.
LayerOptions options_of(const LayerRequest& request);

/// Fulfils a request. Insertion: plans and inserts layers, makes room for them by pushing the
/// elements outside along a path of valid meshes, then smooths towards VCVs that ask for the wanted
/// heights, and corrects these until the heights are met. Layers that are inserted to be held, or
/// that the mesh has and holds from here on, join those that are held at other walls. state: before
/// on entry, after on return. Throws UsageError, Cancelled; NumericError if no room can be made.
SmoothResult run_layers(const LayerRequest& request, MeshState& state, const RunOptions& run);

/// Moves the boundary of a mesh whose state has layers that are held. Where walls come so near to
/// one another that there is no room, layers get thinner first, and heights that they gave up
/// return where there is room again. Afterwards the VCVs are corrected until the wanted heights
/// are met. state as above. Throws as smooth_motion().
SmoothResult move_with_layers(MeshState& state, const Motion& motion, const MotionOptions& how,
                              const SmoothOptions& smooth, const RunOptions& run);

/// Layers of a mesh in which a command keeps some nodes where they are (`kept`, ascending): those
/// outside the region of SmoothOptions::keep_outside.

/// The nodes that layers which are made or spaced at these walls leave where they are. A circle
/// without a centre stands about the walls. Throws as nodes_kept_outside(); not where walls lie
/// outside.
std::vector<Index> nodes_kept_by_layers(const KeepOutside& keep, const Mesh& mesh,
                                        std::span<const LayerWall> walls);

/// Throws UsageError naming the first wall that lies outside the region, or whose layers, as long
/// as the columns are to be or as they run in the mesh, reach out of it.
void require_layers_inside(const KeepOutside& keep, const LayerStack& stack, const Mesh& mesh,
                           std::span<const LayerWall> walls);

/// The same of the columns that stand on the nodes of a motion.
void require_moved_layers_inside(const KeepOutside& keep, const LayerStack& stack, const Mesh& mesh,
                                 std::span<const Index> moving);

/// Columns with a node that is kept are again as in `before`: no run can meet other heights there.
void restore_kept_columns(LayerStack& stack, const LayerStack& before, std::span<const Index> kept);

/// measure_layers() without the columns that have a node that is kept.
LayerMeasures measure_movable_layers(LayerStack stack, const Coordinates& x,
                                     std::span<const Index> kept);

}  // namespace winslow
