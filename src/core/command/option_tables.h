#pragma once

#include "core/command/command.h"
#include "core/options/option.h"

/// Options by their names, as files and command lines have them:
///
///     winslow::MoveCommand move;
///     for (const winslow::Option& option : winslow::option_table(move))
///       std::puts(winslow::flag_of(option).c_str());
namespace winslow {

OptionTable option_table(QualityFloor& floor);
OptionTable option_table(MotionOptions& how);

/// All that a user can set of a command, but for markers, lists (walls, VCVs, displacements) and
/// how it is smoothed. Of a MoveCommand of one body its motion is in the table, too; each of
/// several has a table of its own.
OptionTable option_table(SmoothCommand& command);
OptionTable option_table(MoveCommand& command);
OptionTable option_table(DeformCommand& command);
OptionTable option_table(ScrambleCommand& command);
OptionTable option_table(EditVcvCommand& command);
OptionTable option_table(LayersCommand& command);

}  // namespace winslow
