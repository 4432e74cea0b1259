#pragma once

#include "core/command/command.h"
#include "core/options/option.h"

/// Options by the names that files and command lines use:
///
///     winslow::MoveCommand move;
///     for (const winslow::Option& option : winslow::option_table(move))
///       std::puts(winslow::flag_of(option).c_str());
namespace winslow {

OptionTable option_table(QualityFloor& floor);
OptionTable option_table(MotionOptions& how);

/// All options of a command except markers, lists (walls, VCVs, displacements) and smoothing
/// options. The table of a MoveCommand with one body includes the body's motion. If there are
/// several bodies, each motion has its own table.
OptionTable option_table(SmoothCommand& command);
OptionTable option_table(MoveCommand& command);
OptionTable option_table(DeformCommand& command);
OptionTable option_table(ScrambleCommand& command);
OptionTable option_table(EditVcvCommand& command);
OptionTable option_table(LayersCommand& command);

}  // namespace winslow
