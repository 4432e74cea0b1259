#pragma once

#include <imgui.h>

#include "gui/document/session/session.h"
#include "gui/render/view.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// Outline of the region outside which nothing moves (SmoothOptions::keep_outside), dashed, in the
/// plane or in space. A circle without a centre is drawn about the selection, if there is one.
void draw_region(ImDrawList& list, const Session& session, const View& view, const Theme& theme);

}  // namespace winslow::gui
