#pragma once

#include "gui/menu/user_command.h"

/// Bodies and markers of the open mesh, as named in commands.
namespace winslow::gui {

/// Markers that the user selects together.
struct NamedBody {
  std::string name;            ///< "flap", "upper, lower"
  std::vector<Index> markers;  ///< ascending
  bool hole = false;           ///< a body in the flow, not the outer boundary
};

/// Holes with markers, in the order of their loops.
std::vector<NamedBody> bodies(const PanelContext& context);
/// These bodies, and each marker that is not a body by itself.
std::vector<NamedBody> bodies_and_markers(const PanelContext& context);
/// "flap", "upper, lower".
std::string names_of(const PanelContext& context, const std::vector<Index>& markers);

/// Name of the first locked marker; empty: none is locked.
std::string locked_marker(const PanelContext& context, const std::vector<Index>& markers);

// Reasons for UserCommand::blocked of commands on bodies.
UserCommand::Text while_locked(std::vector<Index> markers);
std::string without_bodies(const PanelContext& context);
std::string without_selection(const PanelContext& context);
/// No mesh, nothing selected, or the solver is running.
std::string selection_in_use(const PanelContext& context);

/// Id of the panel's field for the translation of the selection along x.
const char* translation_field(const PanelContext& context);

/// Changes the looks of markers. Hidden or locked markers are removed from the selection.
void change_looks(const PanelContext& context, const std::vector<Index>& markers,
                  const std::function<void(MarkerLook&)>& change);

/// Selects the next body that is not locked or, with -1, the previous one.
void cycle_bodies(const PanelContext& context, int step);

}  // namespace winslow::gui
