#pragma once

#include "gui/document/session/session.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"

/// Going to a node or an element by its id, and saying what it is.
namespace winslow::gui {

/// The node or element that a text names: "n123" a node, "e45", "#45" or "45" an element, "x, y"
/// the node nearest to a point, "worst" or "worst 3" an entry of the list of worst elements, the
/// name of a marker its first node. Of a volume mesh "f12" a face, and "wing 12" the marker's 12th,
/// from 0 on in the order of the file. Throws UsageError, saying what was expected.
MeshItem parse_item(const std::string& text, const Session& session, const ViewOptions& view);

/// "e45", "n123", "f12": as parse_item takes it.
std::string item_name(const MeshItem& item);

/// What it is, as lines of a name and a value.
std::vector<std::pair<std::string, std::string>> describe_item(const MeshItem& item,
                                                               const Session& session);

/// True if the open mesh has the item.
bool exists(const MeshItem& item, const Session& session);

/// The elements that a metric finds worst, of the mesh last measured.

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
