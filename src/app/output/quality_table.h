#pragma once

#include <iosfwd>
#include <string>

#include "core/mesh/mesh.h"
#include "core/quality/quality.h"
#include "core/quality/surface_change.h"

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

}  // namespace winslow::app
