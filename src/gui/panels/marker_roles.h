#pragma once

#include "gui/menu/panel_context.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

// What the nodes of markers do while the mesh is smoothed, in the list of markers: a word in every
// row, which a click changes, and below the list what belongs to it.

/// Room that the words take, pixels.
float role_width(const Theme& theme);
/// The word: a click has a marker that stays slide, and the other way round; that of a periodic
/// side offers what it can be periodic with. min, max: where it stands.
void draw_role(const PanelContext& context, Index marker, const ImVec2& min, const ImVec2& max);
/// Pairs of the file, feature angle, spacing, what slides along edges, and why the boundary cannot
/// move so: below the list. previewed: roles are shown while what sets them is edited.
void draw_role_settings(const PanelContext& context, bool& previewed);

/// What a click on a row "Reference surface" asks for.
enum class ReferenceAsk { nothing, choose, clear };

/// The file whose surface nodes slide on: a button that chooses one, and, where there is one, a
/// cross that lets go of it. id: of the button, that of the cross has "_none" behind it. name:
/// empty: the mesh's own surface. reading: a file that is being read; empty: none.
ReferenceAsk reference_row(const Theme& theme, const std::string& id, const std::string& name,
                           const std::filesystem::path& reading = {});

}  // namespace winslow::gui
