#pragma once

#include <imgui.h>

#include <span>

#include "core/inspect/nodal_view.h"
#include "gui/render/view.h"

namespace winslow::gui {

/// VCVs drawn over the mesh at their nodes, as in figure 1 of AIAA 2009-1362: each as large as its
/// star on average, turned to lie over it. unit: width of a hair line, pixels; font: of the node
/// numbers, which are left out where there is no room.
void draw_vcvs(ImDrawList& list, const View& view, std::span<const NodalView> nodes, float unit,
               ImFont* font);

/// The same of one node of a surface mesh, in its tangent plane.
void draw_vcv(ImDrawList& list, const View& view, const NodalView& node, const StarPlane& plane,
              float unit, ImFont* font);

/// A ring around a node.
void draw_node_ring(ImDrawList& list, const ImVec2& at, float radius, float width, ImU32 ink);

}  // namespace winslow::gui
