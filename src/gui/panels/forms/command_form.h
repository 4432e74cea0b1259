#pragma once

#include <string>

#include "core/command/command.h"

namespace winslow::gui::ui {

/// Fields for all that a command of any kind holds, except on which markers it acts and tables of
/// displacements. Ids begin with `prefix`: "edit/rotate". cell_dimension: of the mesh. True if
/// something changed.
bool command_form(const std::string& prefix, Command& command, int cell_dimension);

}  // namespace winslow::gui::ui
