#pragma once

#include <imgui.h>

#include "gui/render/camera.h"
#include "gui/studio/session.h"
#include "gui/studio/theme.h"
#include "gui/studio/viewport.h"

namespace winslow::gui {

/// What is drawn over the mesh for the mouse's sake: pivot, ring, and during a drag the outline of
/// the body where it will be and the numbers of the motion.
struct Overlay {
  const Session& session;
  const Viewport& viewport;
  const ViewportScene& scene;
  const Camera& camera;
  const Theme& theme;
};

void draw_overlay(ImDrawList& list, const Overlay& overlay);

/// The part of it that belongs into a picture of the mesh alone: pinned control volumes.
void draw_pins(ImDrawList& list, const Overlay& overlay);

}  // namespace winslow::gui
