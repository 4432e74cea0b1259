#pragma once

#include <filesystem>

#include "core/mesh/mesh.h"
#include "core/motion/node_table.h"
#include "core/outer/outer_solver.h"

/// Writes an outline for a plot:
///
///     winslow::io::write_boundary("flap.dat", mesh, {"flap"});
namespace winslow::io {

/// A chain of marker edges.
struct BoundaryLine {
  std::vector<Index> nodes;  ///< a closed line repeats its first node at the end
  bool closed = false;
};
/// Joins the edges of a marker to lines, which end where the marker ends or three edges meet; every
/// edge is in exactly one. Edges against the direction of their neighbours are reversed.
std::vector<BoundaryLine> boundary_lines(const Marker& marker);

/// File name extensions that write_boundary accepts: ".csv", ".dat", ".vtk".
const std::vector<std::string>& boundary_extensions();

/// Writes markers as curves, without the mesh. The extension chooses the format:
/// .csv  marker, line (from 0), node (from 0), x, y; one row per point
/// .dat  a line "NAME" per curve, a line "x y" per point, an empty line between curves: read by
///       plotting programs and tools for aerofoils
/// .vtk  legacy VTK polydata: one cell per line, with "marker" as cell data
/// Writes atomically. Throws UsageError (no marker, unknown marker or extension) and OutputError.
void write_boundary(const std::filesystem::path& path, const Mesh& mesh,
                    const std::vector<std::string>& markers);

/// Reads displacements from a file:
///
///     winslow::DeformCommand deform;
///     deform.markers = {"wing"};
///     deform.shape = winslow::io::read_displacements("displacements.csv");

/// Reads a CSV file of displacements (separators: comma, semicolon, tab or blanks; '#' starts a
/// comment). A header line may name the columns: node (or id), x, y, z, dx, dy, dz; other columns
/// are skipped; z and dz are for volume meshes. Without a header three columns are node, dx, dy,
/// four are x, y, dx, dy and six are x, y, z, dx, dy, dz. Nodes count from 0; lengths are in the
/// unit of the mesh. Throws InputError "FILE:LINE: found ..., expected ...", also for a header of
/// positions.
DisplacementTable read_displacements(const std::filesystem::path& path);

/// Reads a file of positions after the motion, in the same way. A header line may name the columns:
/// node (or id), x, y, z; other columns are skipped. Without a header three columns are node, x, y
/// and four are node, x, y, z, as in the surface files of SU2. Throws InputError as above, also for
/// a header of displacements.
PositionTable read_positions(const std::filesystem::path& path);

/// Writes the iterations of one command as a table:
///
///     winslow::io::write_convergence_csv("history.csv", {{1, result.smooth.history}});

/// The outer iterations of one command.
struct ConvergenceTable {
  int command = 1;  ///< number of the command, 1 for the first
  std::span<const IterationRecord> records;
};

/// Writes one line for every outer iteration: iteration, residual, largest_move, inverted,
/// min_sine, damping, clipped, linear_iterations, fraction, command, stage. Numbers are read back
/// exactly. Writes atomically. Throws OutputError.
void write_convergence_csv(const std::filesystem::path& path,
                           const std::vector<ConvergenceTable>& tables);

}  // namespace winslow::io
