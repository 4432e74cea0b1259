#pragma once

#include "gui/render/space/volume_scene.h"

namespace winslow::gui {

/// The bodies of a mesh as lines alone, to be laid over another state of it: their edges, those
/// that show the form more strongly, and where cuts go through them.
SpaceScene build_ghost(const Mesh& mesh, const VolumeBoundary& boundary, const VolumeLook& look,
                       const VolumeStyle& style);

}  // namespace winslow::gui
