#pragma once

#include "gui/menu/panel_context.h"
#include "gui/widgets/theme.h"

namespace winslow::gui {

// The roles of markers' nodes in smoothing, for the list of markers: a word in every row, changed
// by a click, and the related settings below the list.

/// Width of the words, pixels.
float role_width(const Theme& theme);
/// Draws the word. A click switches between fixed and sliding; for a periodic side it offers
/// possible partners. min, max: box of the word.
void draw_role(const PanelContext& context, Index marker, const ImVec2& min, const ImVec2& max);
/// Draws the settings below the list: pairs of the file, feature angle, spacing, sliding along
/// edges, and why the boundary cannot move with them. previewed: roles are shown while their
/// settings are edited.
void draw_role_settings(const PanelContext& context, bool& previewed);

/// Result of a click on a row "Reference surface".
enum class ReferenceAsk { nothing, choose, clear };

/// A row for the file of the reference surface: a button that chooses it and, if there is one, a
/// cross that clears it. id: of the button; the cross appends "_none". name: empty for the mesh's
/// own surface. reading: a file being read; empty: none.
ReferenceAsk reference_row(const Theme& theme, const std::string& id, const std::string& name,
                           const std::filesystem::path& reading = {});

}  // namespace winslow::gui
