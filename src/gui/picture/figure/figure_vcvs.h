#pragma once

#include "gui/picture/figure/page.h"
#include "gui/picture/figure/vector_figure.h"

namespace winslow::gui {

/// Draws the VCVs of a figure over its mesh, shifted by `origin` on the page, as draw_vcvs() does
/// on screen.
void draw_figure_vcvs(Page& page, const VectorFigure& figure, const ScreenPoint& origin);

}  // namespace winslow::gui
