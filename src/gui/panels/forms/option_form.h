#pragma once

#include "core/command/command.h"
#include "core/mesh/topology.h"
#include "core/options/option.h"
#include "core/quality/mesh_change.h"

namespace winslow::gui::ui {

/// Fields for the options of a table; those that have no effect with what else is chosen are not
/// shown. The id of a field is PREFIX/KEY, of one within an object PREFIX/OBJECT_KEY. True if one
/// changed.
bool option_form(const std::string& prefix, const OptionTable& table);

/// Fields for all that a command of any kind holds, except on which markers it acts and tables of
/// displacements. Ids begin with `prefix`: "edit/rotate". kind: of the mesh. True if something
/// changed.
bool command_form(const std::string& prefix, Command& command, MeshKind kind);

/// Limits that a motion keeps, folded away: for each metric that is reported a switch and, where it
/// is on, the value. The fold has the id PREFIX/limits, a switch PREFIX/min_quality_METRIC/on, a
/// value PREFIX/min_quality_METRIC. follows_path: false where the motion is such that no limit can
/// be kept; the form then says what to choose. cell_dimension: of the mesh. True if a limit
/// changed.
bool quality_limits_form(const std::string& prefix, QualityFloor& floor, int cell_dimension,
                         bool follows_path);

/// Fields for everything that SmoothOptions holds: one form for the solver panel and for commands
/// that are edited. Ids begin with `prefix`: "solver/damping".

/// The method, as one choice: sets formulation, iteration and steps together. label_share: of the
/// row, that the label takes. True if it changed.
bool method_choice(const std::string& prefix, SmoothOptions& smooth, MotionOptions& motion,
                   float label_share = 0.42f);

/// All other options; those that have no effect in the present combination, and those that a mesh
/// of this kind refuses, are not shown. True if one changed.
bool smooth_options_form(const std::string& prefix, SmoothOptions& options, MeshKind kind);

}  // namespace winslow::gui::ui
