#pragma once

#include "app/job/edit_job.h"

namespace winslow::app {

/// Warns of damage to a valid result that may hurt a flow solver, with the options that prevent it:
/// "zone 2: ...; --slide farfield lets its nodes move along it". Empty: none, or the commands
/// request heights of layers.
std::string damage_warning(const ZoneRun& zone);

/// Warns of a surface that is still folded. Empty: none, or the result has inverted elements, which
/// print_verdict() reports.
std::string fold_warning(const ZoneRun& zone);

/// Prints to the standard output how each command ended, the quality of each zone before and after,
/// and the file that was written.
void print_outcome(const JobFiles& files, const std::vector<ZoneRun>& zones, const RunReport& run);

/// Prints to the standard error why the exit code is not 0, even if the run is quiet (then without
/// the list of inverted elements). Prints nothing for other codes than inverted and not_converged.
void print_verdict(const JobFiles& files, const std::vector<ZoneRun>& zones, const RunReport& run,
                   ExitCode code);

}  // namespace winslow::app
