#pragma once

#include "gui/render/draw_list.h"

namespace winslow::gui {

/// Cuts a convex polygon off where an axis exceeds a limit, or falls below it (sign -1): Sutherland
/// and Hodgman.
std::vector<Vec2> cut_side(const std::vector<Vec2>& polygon, int axis, double limit, double sign);

/// A tangled mesh lies over itself: a scrambled one paints every pixel some thousand times, which
/// takes minutes where triangles are filled in software. This leaves of such a list what is seen:
/// - of the inverted triangles, which are all of one colour and lie above the others, the pieces
///   that are not behind other inverted ones: the picture stays the same;
/// - of the other triangles pieces likewise, in DrawList::seen;
/// - of the outlines of inverted elements what lies at the rim of what is inverted, and some of the
///   others;
/// - interior lines with their spacing divided by the number of layers, so that they fade as lines
///   of small cells do.
/// A list that hardly lies over itself stays as it is. Call it before sort_by_spacing(), while
/// interior lines are the list's only ones.
void hide_covered(DrawList& list);

/// Elements are see-through now: a thousand layers of faint ones would take as long as ever, and
/// hide those that are not faint. Adds to a list that lies over itself the triangles of
/// DrawList::Seen::through, in place of those of the last call: of the opaque elements what is
/// seen, and beside them one layer of the faint ones. rgba: colours of the elements, 8 bits each.
/// True if the list has changed.
bool seen_through(DrawList& list, std::span<const std::uint32_t> rgba);

}  // namespace winslow::gui
