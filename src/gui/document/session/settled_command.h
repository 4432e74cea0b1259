#pragma once

#include "gui/document/jobs/job_runner.h"

namespace winslow::gui {

/// A path that could not be followed to its end leaves the boundary where it got to. The history
/// must say that, not what was asked for: a recipe replayed gives this mesh. Changes the outcome's
/// command accordingly.
/// base: the mesh that the job began with. started_elsewhere: see JobRunner. Returns the share of
/// the way that was reached; 1: all of it.
double settle_command(JobRunner::Outcome& outcome, const Mesh& base, bool started_elsewhere);

}  // namespace winslow::gui
