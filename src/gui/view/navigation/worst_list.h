#pragma once

#include <optional>
#include <span>
#include <vector>

#include "gui/document/session/session.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"

/// The elements that a metric finds worst, of the mesh last measured.
namespace winslow::gui {

/// What elements can be ranked by: metrics of the report, what is measured at walls, the deviation
/// of a surface.
std::vector<ElementField> rankings(MeshKind kind);
/// What the list goes by: as chosen, or as coloured; what has no such list (the area, the fields of
/// the virtual control volumes and of layers) gives way to the normalized Jacobian.
ElementField worst_field(const ViewOptions& view, MeshKind kind);
/// Worst first, as many as the view wants.
std::span<const WorstElement> worst_elements(const Session& session, const ViewOptions& view);
/// The element `by` places further down the list than the one in focus; the first if none is.
/// None if there is no list.
std::optional<MeshItem> next_worst(const Session& session, const ViewOptions& view,
                                   const std::optional<MeshItem>& focus, int by);

}  // namespace winslow::gui
