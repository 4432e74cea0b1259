#pragma once

#include <string>

#include "gui/menu/panel_context.h"

namespace winslow::gui {

/// The number of the node that is inspected, which can be typed, and its pin. typed: what stands in
/// the field.
void draw_node_header(const PanelContext& context, int& typed);
/// What to do while no node is inspected.
void draw_node_hint();
/// A value with what it is.
void draw_figure(const char* id, const char* label, const std::string& value, const char* tip,
                 ImU32 color = palette().text);
/// A sentence in the place of a node's figures: why it has no VCV.
void draw_no_vcv(const std::string& why);
/// Changes one VCV and smooths.
void edit_vcv(const PanelContext& context, VcvEdit edit);
/// By printf.
std::string formatted(double value, const char* format);

}  // namespace winslow::gui
