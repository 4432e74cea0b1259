#pragma once

#include <iosfwd>
#include <nlohmann/json_fwd.hpp>

#include "core/quality/openfoam_measures.h"

namespace winslow::app {

/// Prints OpenFOAM's measures with the limits of its checkMesh, and what checkMesh fails for.
void print_openfoam_measures(std::ostream& out, const OpenFoamMeasures& measures);

/// The block "openfoam" of a report: each measure by its name, "boundary_openness",
/// "total_volume", counts of faults, "failures" and "further_failures" (of -allGeometry).
nlohmann::json describe_openfoam_measures(const OpenFoamMeasures& measures);

}  // namespace winslow::app
