#pragma once

#include "gui/render/draw_list.h"

/// How dense lines are, and how many of them are worth drawing.
namespace winslow::gui {

/// Distance from an edge to the opposite side of its thinnest element. Layers of long, thin cells
/// are dense across their long edges only, which the length of an edge would not show.
double edge_spacing(const Topology& topology, const Coordinates& coordinates,
                    const Topology::Edge& edge);

/// Puts the interior lines of a list in the order of their spacing, the widest first, in one pass
/// (a coarse order: 2048 classes). Seen from afar, a graded mesh then needs only its first lines.
/// Call it while they are the list's only lines.
void sort_by_spacing(DrawList& list);

/// Number of interior lines, from the first, among which are all whose spacing is at least this.
std::size_t lines_spaced(const DrawList& list, float spacing);

}  // namespace winslow::gui
