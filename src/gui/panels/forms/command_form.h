#pragma once

#include <string>

#include "core/command/command.h"
#include "core/mesh/mesh_kind.h"

namespace winslow::gui::ui {

/// Fields for all that a command of any kind holds, except on which markers it acts and tables of
/// displacements. Ids begin with `prefix`: "edit/rotate". kind: of the mesh. True if something
/// changed.
bool command_form(const std::string& prefix, Command& command, MeshKind kind);

}  // namespace winslow::gui::ui
