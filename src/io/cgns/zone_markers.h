#pragma once

#include <string>
#include <vector>

#include "io/cgns/cgns.h"
#include "io/cgns/point_set.h"
#include "io/cgns/sections.h"

namespace winslow::io::cgns {

/// Makes the markers of a zone, in this order:
///
/// - from its boundary conditions (BC_t), named by their family (FamilyName) if they have one; else
///   by the section of lines that they cover whole, if they do, as SU2 names them; else by
///   themselves. Those of one name are one marker;
/// - from its interfaces (GridConnectivity_t, GridConnectivity1to1_t) but those of `joined`: their
///   edges that are in no marker yet;
/// - from the sections of lines: their lines that are in no marker yet, named by the section.
void make_markers(const NodeView& zone, const ZoneHead& head, const ZoneBoundary& boundary,
                  const ZoneSides& sides, const std::vector<std::string>& joined, ParsedMesh& mesh,
                  Details& details);

}  // namespace winslow::io::cgns
