#pragma once

#include <imgui.h>

#include "gui/panels/layout.h"
#include "gui/widgets/theme.h"

/// Windows of Dear ImGui that fill an area of the layout.
namespace winslow::gui {

struct RegionStyle {
  ImVec2 padding;
  ImU32 background = palette().panel;
  ImGuiWindowFlags flags = 0;
};
/// Widgets up to end_region() stand in this area. name: no other region has it.
void begin_region(const char* name, const Area& area, const RegionStyle& style);
/// A line along the sides, or nothing.
enum class RegionEdge { line, none };
void end_region(RegionEdge edge = RegionEdge::line);

}  // namespace winslow::gui
