#pragma once

#include <string>

#include "core/command/command.h"
#include "core/mesh/mesh_kind.h"

/// Fields for everything that SmoothOptions holds: one form for the solver panel and for commands
/// that are edited. Ids begin with `prefix`: "solver/damping".
namespace winslow::gui::ui {

/// The method, as one choice: sets formulation, iteration and steps together. label_share: of the
/// row, that the label takes. True if it changed.
bool method_choice(const std::string& prefix, SmoothOptions& smooth, MotionOptions& motion,
                   float label_share = 0.42f);

/// All other options; those that have no effect in the present combination, and those that a mesh
/// of this kind refuses, are not shown. True if one changed.
bool smooth_options_form(const std::string& prefix, SmoothOptions& options, MeshKind kind);

}  // namespace winslow::gui::ui
