#pragma once

#include <imgui.h>

#include "gui/document/session/session.h"
#include "gui/render/view.h"
#include "gui/view/tools/typed_motion.h"
#include "gui/widgets/theme.h"

/// What is said beside the mouse.
namespace winslow::gui {

struct MouseLabel {
  std::string text;
  ImU32 background;
};

/// Below one another; on the mouse's other side where the view ends, since panels would cover them.
void draw_beside_mouse(ImDrawList& list, const View& view, const Theme& theme,
                       const std::vector<MouseLabel>& labels);

/// How far a drag is, and whether the mesh can follow, and what it is blocked by.
std::vector<MouseLabel> drag_labels(std::string motion, const Session& session);

/// What is typed into a field, with a bar where the next character goes.
std::string typed_field(const TypedMotion& typed, std::size_t field);
std::string label_number(double value, const char* format = "%.4g");

}  // namespace winslow::gui
