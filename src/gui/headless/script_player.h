#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gui/headless/headless_studio.h"
#include "gui/headless/script.h"

namespace winslow::gui {

/// Does what a script says. `folder`: where its pictures go; empty: the working folder. Adds what
/// was written to `said`. Throws Error "FILE:LINE: ..." where something cannot be done.
void play_script(const Script& script, HeadlessStudio& studio, const std::filesystem::path& folder,
                 std::vector<std::string>& said);

}  // namespace winslow::gui
