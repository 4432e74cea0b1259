#pragma once

#include "gui/picture/figure/page.h"
#include "gui/picture/figure/vector_figure.h"

namespace winslow::gui {

/// Draws the mesh of a figure as a camera sees it into that camera's viewport, which is put at
/// `origin` on the page: elements
/// in the colours of their values, inverted ones in red, edges, the boundary in its markers'
/// colours. Each edge is drawn once; edges of one kind form one path.
void draw_figure_mesh(Page& page, const VectorFigure& figure, const Camera& camera,
                      const ScreenPoint& origin);

/// Draws the VCVs of a figure over its mesh, shifted by `origin` on the page, as draw_vcvs() does
/// on screen.
void draw_figure_vcvs(Page& page, const VectorFigure& figure, const ScreenPoint& origin);

}  // namespace winslow::gui
