#pragma once

#include "gui/render/draw_list.h"

/// How dense lines are, and how many of them are worth drawing.
namespace winslow::gui {

/// Distance from an edge to the opposite side of its thinnest element. Layers of long, thin cells
/// are dense across their long edges only, which the length of an edge would not show.
double edge_spacing(const Topology& topology, const Coordinates& coordinates,
                    const Topology::Edge& edge);

/// Lines closer together than fade_distance times their width fade in proportion: triangles have
/// three families of lines, which then cover half of the surface together. At the given share of
/// that distance, a third of a pixel for thin lines, they are gone and only the colours remain.
inline constexpr float fade_distance = 6.0f;
inline constexpr float vanishing_share = 0.06f;

/// Lines closer together than this share of fade_distance times their width are no longer told
/// apart: where there are very many, the surface takes on their mean colour instead, which costs
/// next to nothing and does not flicker. Up to twice that spacing, surface and lines share.
inline constexpr float merging_share = 0.25f;
inline constexpr std::size_t many_lines = 150'000;

/// The spacing below which a list's lines are merged into its triangles, in units of the mesh; 0:
/// none are, as there are few. pixels_per_unit: of the view.
float merging_spacing(const DrawList& list, float width, float pixels_per_unit);

/// Opacity, 0 to 1, of a line of that width among others at that distance (both in pixels).
double line_opacity(double spacing, double width);

/// Puts the interior lines of a list in the order of their spacing, the widest first, in one pass
/// (a coarse order: 2048 classes). Seen from afar, a graded mesh then needs only its first lines.
/// Call it while they are the list's only lines.
void sort_by_spacing(DrawList& list);

/// Number of interior lines, from the first, among which are all whose spacing is at least this.
std::size_t lines_spaced(const DrawList& list, float spacing);

}  // namespace winslow::gui
