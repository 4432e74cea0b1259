#pragma once

#include "gui/document/session/session.h"
#include "gui/settings/view_options.h"
#include "gui/settings/view_state.h"

/// Finds a node or an element by its id, and describes it.
namespace winslow::gui {

/// Finds the item that a text names. "n123" is a node; "e45", "#45" or "45" an element; "x, y" the
/// node nearest to a point; "worst" or "worst 3" an entry of the list of worst elements; a marker's
/// name its first node. In a volume mesh "f12" is a face, and "wing 12" the marker's 12th, from 0
/// on in the order of the file. Throws UsageError, saying what was expected.
MeshItem parse_item(const std::string& text, const Session& session, const ViewOptions& view);

/// Name of an item as parse_item() accepts it: "e45", "n123", "f12".
std::string item_name(const MeshItem& item);

/// Describes an item by lines of a name and a value.
std::vector<std::pair<std::string, std::string>> describe_item(const MeshItem& item,
                                                               const Session& session);

/// True if the open mesh has the item.
bool exists(const MeshItem& item, const Session& session);

/// The worst elements by a metric, of the mesh last measured.

/// Fields by which elements can be ranked: metrics of the report, measures at walls, the deviation
/// of a surface.
std::vector<ElementField> rankings(MeshKind kind);
/// The field that ranks the list: the chosen one, else the one that colours elements. The
/// normalized Jacobian replaces fields without such a list (area, fields of the virtual control
/// volumes and of layers).
ElementField worst_field(const ViewOptions& view, MeshKind kind);
/// The worst elements, worst first, as many as `view` asks for.
std::span<const WorstElement> worst_elements(const Session& session, const ViewOptions& view);
/// The element `by` places further down the list than the focus; the first element without a focus.
/// None without a list.
std::optional<MeshItem> next_worst(const Session& session, const ViewOptions& view,
                                   const std::optional<MeshItem>& focus, int by);

}  // namespace winslow::gui
