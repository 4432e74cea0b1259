#pragma once

#include <filesystem>

#include "core/mesh/mesh.h"

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

}  // namespace winslow::io
