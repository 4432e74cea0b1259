#pragma once

#include <filesystem>

#include "core/command/command.h"

namespace winslow::gui {

/// What commands led to, exactly: it reads back to the same bits. Files are for the machine that
/// wrote them.
/// before: the state that the command was given; connectivity, VCVs and layers that the command
/// left as they were are not written again; empty: the state stands for itself. Atomically. Throws
/// OutputError.
void write_step(const std::filesystem::path& path, const MeshState& state, const MeshState& before,
                const SmoothResult& smooth);
/// before: as it was written with. Throws InputError for a file that is missing, cut short,
/// changed, or does not fit the state before.
CommandResult read_step(const std::filesystem::path& path, const MeshState& before);

}  // namespace winslow::gui
