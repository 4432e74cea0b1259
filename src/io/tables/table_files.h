#pragma once

#include <filesystem>

#include "core/mesh/mesh.h"
#include "core/motion/motion.h"
#include "core/outer/outer_solver.h"

/// An outline for a plot:
///
///     winslow::io::write_boundary("flap.dat", mesh, {"flap"});
namespace winslow::io {

/// A run of marker edges, end to end.
struct BoundaryLine {
  std::vector<Index> nodes;  ///< a closed line repeats its first node at the end
  bool closed = false;
};
/// The edges of a marker joined to as few lines as their directions allow; every edge is in one of
/// them. Edges that are given against the direction of their neighbours are turned.
std::vector<BoundaryLine> boundary_lines(const Marker& marker);

/// File name extensions that write_boundary knows: ".csv", ".dat", ".vtk".
const std::vector<std::string>& boundary_extensions();

/// Writes markers as curves, without the mesh. The extension says how:
/// .csv  marker, line (from 0), node (from 0), x, y; a row a point
/// .dat  a line "NAME" a curve, then "x y" a point, curves parted by an empty line: what plotting
///       programs and tools for aerofoils read
/// .vtk  legacy VTK polydata: a cell a line, with "marker" as cell data
/// Atomically. Throws UsageError (no marker, unknown marker or extension) and OutputError.
void write_boundary(const std::filesystem::path& path, const Mesh& mesh,
                    const std::vector<std::string>& markers);

/// Displacements from a file:
///
///     winslow::DeformCommand deform;
///     deform.markers = {"wing"};
///     deform.shape = winslow::io::read_displacements("displacements.csv");

/// Reads a CSV file of displacements (separators: comma, semicolon, tab or blanks; '#' starts a
/// comment). A first line of names, among node (or id), x, y, z, dx, dy, dz, says what the columns
/// are and others are skipped; z and dz are for volume meshes. Without it three columns are node,
/// dx, dy, four are x, y, dx, dy and six are x, y, z, dx, dy, dz. Nodes count from 0; lengths are
/// in the unit of the mesh. Throws InputError "FILE:LINE: found ..., expected ...".
DisplacementTable read_displacements(const std::filesystem::path& path);

/// The iterations of one command as a table:
///
///     winslow::io::write_convergence_csv("history.csv", {{1, result.smooth.history}});

/// The outer iterations of one command.
struct ConvergenceTable {
  int command = 1;  ///< its number, 1 for the first
  std::span<const IterationRecord> records;
};

/// Writes one line for every outer iteration: iteration, residual, largest_move, inverted,
/// min_sine, damping, clipped, linear_iterations, fraction, command, stage. Numbers read back to
/// the same bits. Atomically. Throws OutputError.
void write_convergence_csv(const std::filesystem::path& path,
                           const std::vector<ConvergenceTable>& tables);

}  // namespace winslow::io
