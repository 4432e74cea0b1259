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

}  // namespace winslow::gui
