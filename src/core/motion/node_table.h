#pragma once

#include "core/motion/motion.h"

/// Prescribes single nodes, on the boundary or inside, as a structural solver hands them over:
///
///     winslow::PositionTable table;
///     table.entries.push_back({.node = 17, .position = {0.2, 0.05}});
///     winslow::DeformCommand deform;  // names no marker: the table says what moves
///     deform.shape = table;
///
/// A table says where nodes go. They have no unknowns in the run: they end where the table says.
///
/// MARKERS: Without markers every node may be in the table, and all other nodes of the boundary
/// stay. With markers, a table may have nodes of these markers and nodes inside the mesh; nodes of
/// the markers without an entry stay.
namespace winslow {

/// One row of a table of displacements: a node, given by its index (0-based, order of the file) or
/// by its place, and its displacement. A place is that of all nodes that lie exactly there: the two
/// sides of a crack or of a baffle move together. A plane mesh ignores third components.
struct DisplacementEntry {
  std::optional<Index> node;
  GivenVector position;  ///< place before the motion; used if node is empty
  GivenVector displacement;
  int line = 0;  ///< of the source file, for messages; 0: unknown
};

/// How far single nodes move.
struct DisplacementTable {
  std::vector<DisplacementEntry> entries;
  std::string source;  ///< name of the source file, for messages
};

/// One row of a table of positions: a node and where it is after the motion.
struct PositionEntry {
  Index node = 0;        ///< 0-based, order of the file
  GivenVector position;  ///< after the motion, in units of the mesh
  int line = 0;          ///< of the source file, for messages; 0: unknown
};

/// Where single nodes are after the motion, to the bit.
struct PositionTable {
  std::vector<PositionEntry> entries;
  std::string source;  ///< name of the source file, for messages
};

/// Make the motion of a table. Its nodes move in straight lines. Each throws UsageError, naming
/// source and line, for an empty table, an unknown marker, an entry that matches no node, a node
/// that no element uses, a node on the boundary of other markers than the chosen ones, two entries
/// for one node, a number that is not finite, and a missing component.
std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const DisplacementTable& table);
std::unique_ptr<Motion> make_motion(const Topology& topology, const Coordinates& rest,
                                    const std::vector<std::string>& markers,
                                    const PositionTable& table);

}  // namespace winslow
