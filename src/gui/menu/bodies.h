#pragma once

#include "gui/menu/user_command.h"

/// The open mesh's boundary as commands name it.
namespace winslow::gui {

/// Markers that a user takes together.
struct NamedBody {
  std::string name;            ///< "flap", "upper, lower"
  std::vector<Index> markers;  ///< ascending
  bool hole = false;           ///< a body in the flow, rather than the rim around everything
};

/// Holes with markers, in the order of their loops.
std::vector<NamedBody> bodies(const PanelContext& context);
/// Those, and each marker that is not a whole body by itself.
std::vector<NamedBody> bodies_and_markers(const PanelContext& context);
/// "flap", "upper, lower".
std::string names_of(const PanelContext& context, const std::vector<Index>& markers);

/// Name of the first of these markers that is locked; empty: none is.
std::string locked_marker(const PanelContext& context, const std::vector<Index>& markers);

// What stands in the way of commands on bodies, as UserCommand::blocked.
UserCommand::Text while_locked(std::vector<Index> markers);
std::string without_bodies(const PanelContext& context);
std::string without_selection(const PanelContext& context);
/// No mesh, nothing selected, or the solver is at work.
std::string selection_in_use(const PanelContext& context);

/// The field of the panel in which one types how far a selection moves along x.
const char* translation_field(const PanelContext& context);

/// Changes the looks of markers; one that is hidden or locked then is not selected any longer.
void change_looks(const PanelContext& context, const std::vector<Index>& markers,
                  const std::function<void(MarkerLook&)>& change);

/// Selects the next body that is not locked, or with -1 the one before.
void cycle_bodies(const PanelContext& context, int step);

}  // namespace winslow::gui
