#pragma once

#include <optional>
#include <span>

#include "gui/document/session/session.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"

/// The elements that a metric finds worst, of the mesh last measured.
namespace winslow::gui {

/// Metric of the list: as chosen, or as coloured; what has no such list (the area, the fields of
/// the virtual control volumes) gives way to the normalized Jacobian.
Metric worst_metric(const ViewOptions& view);
/// Worst first, as many as the view wants.
std::span<const WorstElement> worst_elements(const Session& session, const ViewOptions& view);
/// The element `by` places further down the list than the one in focus; the first if none is.
/// None if there is no list.
std::optional<MeshItem> next_worst(const Session& session, const ViewOptions& view,
                                   const std::optional<MeshItem>& focus, int by);

}  // namespace winslow::gui
