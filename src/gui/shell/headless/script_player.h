#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "gui/shell/headless/headless_studio.h"
#include "gui/shell/headless/script.h"

namespace winslow::gui {

/// Does what a script says. `folder`: where its pictures go; empty: the working folder. Tells `say`
/// what was written. Throws Error "FILE:LINE: ..." where something cannot be done.
void play_script(const Script& script, HeadlessStudio& studio, const std::filesystem::path& folder,
                 const std::function<void(const std::string&)>& say);

}  // namespace winslow::gui
