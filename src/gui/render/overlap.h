#pragma once

#include "gui/render/draw_list.h"

namespace winslow::gui {

/// Cuts a convex polygon off where an axis exceeds a limit, or falls below it (sign -1): Sutherland
/// and Hodgman.
std::vector<Vec2> cut_side(const std::vector<Vec2>& polygon, int axis, double limit, double sign);

/// Reduces a list to what is visible. A tangled mesh overlaps itself: a scrambled one paints every
/// pixel some thousand times, which takes minutes if triangles are filled in software. These
/// remain:
/// - of the inverted triangles, which are all of one colour and lie above the others, the pieces
///   that are not behind other inverted ones: the picture stays the same;
/// - of the other triangles the visible pieces, in DrawList::seen;
/// - the outlines of inverted elements at the rim of the inverted region, and some of the others;
/// - interior lines with their spacing divided by the number of layers, so that they fade as lines
///   of small cells do.
/// A list that hardly lies over itself stays as it is. Call it before sort_by_spacing(), while
/// interior lines are the list's only ones.
void hide_covered(DrawList& list);

/// Adds the triangles of DrawList::Seen::through to a list that overlaps itself, in place of those
/// of the last call: the visible parts of the opaque elements, and one layer of the see-through
/// ones. A thousand layers of these would be slow, and hide the opaque ones. rgba: colours of the
/// elements, 8 bits each. True if the list has changed.
bool seen_through(DrawList& list, std::span<const std::uint32_t> rgba);

}  // namespace winslow::gui
