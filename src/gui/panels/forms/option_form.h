#pragma once

#include "core/command/command.h"
#include "core/mesh/topology.h"
#include "core/options/option.h"
#include "core/quality/mesh_change.h"

namespace winslow::gui::ui {

/// Fields for the options of a table, without those that have no effect in the present combination.
/// The id of a field is PREFIX/KEY, within an object PREFIX/OBJECT_KEY. True if one changed.
bool option_form(const std::string& prefix, const OptionTable& table);

/// Fields for all data of a command of any kind, except its markers and tables of displacements.
/// Ids begin with `prefix`: "edit/rotate". kind: of the mesh. True if something changed.
bool command_form(const std::string& prefix, Command& command, MeshKind kind);

/// Quality limits of a motion, in a fold: a switch for each metric that can have one and, where it
/// is on, the value. Ids: PREFIX/limits (fold), PREFIX/min_quality_METRIC/on (switch),
/// PREFIX/min_quality_METRIC (value). follows_path: false if limits cannot be enforced with the
/// chosen method; the form then says which method to choose. cell_dimension: of the mesh. True if a
/// limit changed.
bool quality_limits_form(const std::string& prefix, QualityFloor& floor, int cell_dimension,
                         bool follows_path);

/// Fields for all SmoothOptions, used by the solver panel and by the editor of commands. Ids begin
/// with `prefix`: "solver/damping".

/// The method, as one choice: sets formulation, iteration and steps together. label_share: the
/// label's share of the row. True if it changed.
bool method_choice(const std::string& prefix, SmoothOptions& smooth, MotionOptions& motion,
                   float label_share = 0.42f);

/// All other options, except those without effect in the present combination and those not
/// supported for this kind of mesh. True if one changed.
bool smooth_options_form(const std::string& prefix, SmoothOptions& options, MeshKind kind);

}  // namespace winslow::gui::ui
