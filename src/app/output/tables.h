#pragma once

#include <iosfwd>
#include <nlohmann/json_fwd.hpp>

#include "core/geometry/periodic_pairs.h"
#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"
#include "core/quality/mesh_change.h"
#include "core/quality/quality.h"
#include "core/quality/surface_distance.h"

namespace winslow::app {

/// Deviation and volume, one line each.
void print_surface_change(std::ostream& out, const SurfaceChange& change);
/// "zone 2" over what follows about it; nothing for an empty name.
void print_zone_heading(std::ostream& out, const std::string& name);
/// Minimum, average and maximum of the three metrics, as the paper tabulates them, and the number
/// of nodes, elements and inverted elements.
void print_quality_table(std::ostream& out, const Mesh& mesh, const QualityReport& quality);
/// The worst elements by each metric and each field of walls that has values: ids (0-based, in the
/// order of the file), values, centres.
void print_worst_elements(std::ostream& out, const QualityReport& quality);
/// Inverted elements with their ids and centres, at most `limit` of them.
void print_inverted_elements(std::ostream& out, const Mesh& mesh, const QualityReport& quality,
                             int limit);
/// Bars, one line a bin, for each metric.
void print_histograms(std::ostream& out, const QualityReport& quality);

/// First height, tilt and growth of the cells at walls, and the size ratio of neighbours: how they
/// are spread, and how they were. before: null where there was no other mesh.
void print_walls(std::ostream& out, const WallReport* before, const WallReport& now);

/// The block "walls" (docs/command-line.md lists the keys). mesh: that of `now`.
nlohmann::json describe_walls(const WallReport* before, const WallReport& now, const Mesh& mesh);

/// Heights, error and tilt of the layers in a mesh, and the columns that were cut most: at most
/// `limit` of them, thinnest for what was asked first. x: #nodes by 2.
void print_layers(std::ostream& out, const LayerStack& stack, const Coordinates& x, int limit);

/// A line for each pair of markers that the file of a mesh names as periodic; nothing if it names
/// none.
void print_pairs(std::ostream& out, const GivenPeriodicity& periodicity, const Mesh& mesh);
/// The same for reports: a list, empty if the file names none.
nlohmann::json describe_pairs(const GivenPeriodicity& periodicity, const Mesh& mesh);

}  // namespace winslow::app
