#pragma once

#include "gui/view/tools/gizmo.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

/// hot: the handle under the mouse or in use. turning: shades the angle turned so far.
void draw_gizmo(ImDrawList& list, const Gizmo& gizmo, Handle hot, bool turning, const Theme& theme);

/// What a handle does, for a hint beside the mouse; "" for none.
const char* handle_hint(Handle handle);

}  // namespace winslow::gui
