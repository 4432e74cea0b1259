#pragma once

#include <iosfwd>
#include <nlohmann/json_fwd.hpp>

#include "core/geometry/periodic_pairs.h"
#include "core/layers/layer_stack.h"
#include "core/memory.h"
#include "core/mesh/mesh.h"
#include "core/quality/mesh_change.h"
#include "core/quality/quality.h"
#include "core/quality/surface_distance.h"

namespace winslow::app {

/// Prints deviation and volume of a surface, one line each.
void print_surface_change(std::ostream& out, const SurfaceChange& change);
/// Prints a heading such as "zone 2"; nothing for an empty name.
void print_zone_heading(std::ostream& out, const std::string& name);
/// Prints the parts of the memory of a run, those that are not 0, and what is left of its peak
/// (bytes).
void print_memory(std::ostream& out, const MemoryUse& memory, std::int64_t peak);
/// Minimum, average and maximum of the three metrics over all elements, as the paper tabulates
/// them, and the number of nodes, elements and inverted elements; then the same without the
/// elements of a volume mesh that cannot move, if there are some.
void print_quality_table(std::ostream& out, const Mesh& mesh, const QualityReport& quality);
/// Prints how many regions the elements have, by which cell array; nothing for an empty name.
void print_regions(std::ostream& out, const Topology& topology, const std::string& array);
/// Prints the worst elements for each metric and each wall field that has values: ids (0-based, in
/// the order of the file), values, centres.
void print_worst_elements(std::ostream& out, const QualityReport& quality);
/// Prints at most `limit` inverted elements with their ids and centres.
void print_inverted_elements(std::ostream& out, const Mesh& mesh, const QualityReport& quality,
                             int limit);
/// Prints the folds of a surface mesh, with at most `limit` of their edges: nodes, elements,
/// places. Nothing for a surface without folds.
void print_folds(std::ostream& out, const SurfaceFolds& folds, int limit);
/// The same for reports; null for other meshes.
nlohmann::json describe_folds(const SurfaceFolds& folds);
/// Prints a histogram of each metric, one line per bin.
void print_histograms(std::ostream& out, const QualityReport& quality);

/// Prints distributions of first height, tilt and growth of the cells at walls, and of the size
/// ratio of neighbours. before: the same of the earlier mesh; null if there was none.
/// heights_asked_for: the run was to change first heights, so it is not said that they changed.
void print_walls(std::ostream& out, const WallReport* before, const WallReport& now,
                 bool heights_asked_for = false);

/// The block "walls" (docs/command-line.md lists the keys). mesh: the mesh of `now`.
nlohmann::json describe_walls(const WallReport* before, const WallReport& now, const Mesh& mesh);

/// Prints heights, error and tilt of the layers in a mesh, and the columns that were cut most: at
/// most `limit`, those with the smallest fraction of the requested thickness first. x: #nodes by 2.
void print_layers(std::ostream& out, const LayerStack& stack, const Coordinates& x, int limit);

/// Prints a line for each pair of markers that the mesh file names as periodic. by_default: they
/// move together without an option.
void print_pairs(std::ostream& out, const GivenPeriodicity& periodicity, bool by_default,
                 const Mesh& mesh);
/// The same for reports: a list, empty if the file names none.
nlohmann::json describe_pairs(const GivenPeriodicity& periodicity, const Mesh& mesh);

}  // namespace winslow::app
