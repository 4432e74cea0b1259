#pragma once

#include <string>
#include <vector>

#include "io/format/mesh_file.h"

namespace winslow::io {

/// Completes what a reader has found of periodic sides: whose mesh it is, and whether its nodes
/// match. Pairs that do not get a fault, which says so.
void settle_periodicity(FormatDetails& details, const Mesh& mesh, const std::string& file);

/// "lower" and "upper", ...: the pairs of a file, each named once.
std::string named_pairs(const GivenPeriodicity& periodicity);

/// Sentences on pairs that matched in the file and do not match any more.
std::vector<std::string> stale_pairs(const FormatDetails& details, const Mesh& mesh);

}  // namespace winslow::io
