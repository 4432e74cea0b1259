#pragma once

#include <filesystem>
#include <string>

#include "gui/widgets/theme.h"

namespace winslow::gui {

/// What a click on a row "Reference surface" asks for.
enum class ReferenceAsk { nothing, choose, clear };

/// The file whose surface nodes slide on: a button that chooses one, and, where there is one, a
/// cross that lets go of it. id: of the button, that of the cross has "_none" behind it. name:
/// empty: the mesh's own surface. reading: a file that is being read; empty: none.
ReferenceAsk reference_row(const Theme& theme, const std::string& id, const std::string& name,
                           const std::filesystem::path& reading = {});

}  // namespace winslow::gui
