#pragma once

#include <iosfwd>
#include <nlohmann/json_fwd.hpp>

#include "core/geometry/periodic_pairs.h"
#include "core/mesh/mesh.h"

namespace winslow::app {

/// A line for each pair of markers that the file of a mesh names as periodic; nothing if it names
/// none.
void print_pairs(std::ostream& out, const GivenPeriodicity& periodicity, const Mesh& mesh);
/// The same for reports: a list, empty if the file names none.
nlohmann::json describe_pairs(const GivenPeriodicity& periodicity, const Mesh& mesh);

}  // namespace winslow::app
