#include "gui/panels/layers/layer_lists.h"

#include "gui/base/text.h"
#include "gui/panels/layers/layer_forms.h"
#include "gui/widgets/controls.h"
#include "gui/widgets/list_rows.h"

namespace winslow::gui {

namespace {

/// "25 layers, first 1e-05, ratio 1.2, in part".
std::string summary(const LayerWall& wall) {
  const LayerSpacing& spacing = wall.spacing;
  std::string text = spacing.match_outside ? "layers to match" : counted(spacing.count, "layer");
  text += ", first " + short_number(spacing.first);
  text += spacing.total ? ", " + short_number(*spacing.total) + " thick"
                        : ", ratio " + short_number(spacing.ratio);
  return text + (wall.part != WallPart{} ? ", in part" : "");
}

}  // namespace

LayerWall* WallList::find(const std::vector<std::string>& markers) {
  const auto found = std::ranges::find_if(walls_, [&](const LayerWall& wall) {
    return std::ranges::is_permutation(wall.markers, markers);
  });
  return found == walls_.end() ? nullptr : &*found;
}

void WallList::add(LayerWall wall) {
  for (LayerWall& other : walls_)
    std::erase_if(other.markers, [&](const std::string& name) {
      return std::ranges::find(wall.markers, name) != wall.markers.end();
    });
  std::erase_if(walls_, [](const LayerWall& other) { return other.markers.empty(); });
  walls_.push_back(std::move(wall));
}

void WallList::draw(const PanelContext& context) {
  ui::draw_list("walls", walls_.size(), context.theme,
                [&](std::size_t k) { return draw_row(context, k); });
}

/// Draws a row. False if the wall was removed.
bool WallList::draw_row(const PanelContext& context, std::size_t k) {
  const LayerWall& wall = walls_[k];
  const std::string names = joined(wall.markers);
  std::vector<Index> markers = markers_named(*context.topology(), wall.markers);
  const ui::RowAnswer answer = ui::draw_list_row(
      {"layers/wall/" + std::to_string(k), names, summary(wall),
       names + "\n" + summary(wall) +
           "\nClick to select these markers and change the settings of this wall.",
       "Take this wall out of the list.", markers == context.session.selection().markers()},
      context.theme);
  if (answer == ui::RowAnswer::pressed) context.emit(action::SelectMarkers{std::move(markers)});
  if (answer != ui::RowAnswer::removed) return true;
  walls_.erase(walls_.begin() + static_cast<std::ptrdiff_t>(k));
  return false;
}

namespace {

std::string summary(const ColumnOverride& column) {
  std::string text;
  if (column.columns) text = counted(*column.columns, "column");
  if (column.thickness)
    text += (text.empty() ? "" : ", ") +
            (*column.thickness > 0 ? short_number(*column.thickness) + " thick" : "no layers");
  return text.empty() ? "as planned" : text;
}

bool on_walls(Index node, const Topology& topology, const std::vector<LayerWall>& walls) {
  return std::ranges::any_of(walls, [&](const LayerWall& wall) {
    return std::ranges::any_of(wall.markers, [&](const std::string& name) {
      const auto marker = topology.markers().find(name);
      return marker && std::ranges::binary_search(topology.markers().nodes(*marker), node);
    });
  });
}

}  // namespace

std::vector<ColumnOverride> ColumnList::on(const Topology& topology,
                                           const std::vector<LayerWall>& walls) const {
  std::vector<ColumnOverride> found;
  for (const ColumnOverride& column : columns_)
    if ((column.columns || column.thickness) && on_walls(column.node, topology, walls))
      found.push_back(column);
  return found;
}

void ColumnList::draw(const PanelContext& context, const std::vector<LayerWall>& walls) {
  if (!ui::fold("layers/columns", "Single columns",
                "What single nodes of a wall are to have instead of what the rules choose: how "
                "many columns stand there, and how thick the layers are."))
    return;
  draw_add(context, walls);
  const Coordinates& x = context.session.coordinates();
  ui::draw_list("columns", columns_.size(), context.theme, [&](std::size_t k) {
    const Index node = columns_[k].node;
    const std::string name = "Node " + std::to_string(node);
    const ui::RowAnswer answer =
        ui::draw_list_row({"layers/column/" + std::to_string(k), name, summary(columns_[k]),
                           name + "\nClick to go to this node and change what it is to have.",
                           "Leave this node to the rules again.", k == chosen_},
                          context.theme);
    if (answer == ui::RowAnswer::removed) {
      columns_.erase(columns_.begin() + static_cast<std::ptrdiff_t>(k));
      return false;
    }
    if (answer == ui::RowAnswer::pressed) {
      chosen_ = k;
      if (node < x.size()) context.emit(action::GoTo{MeshItem{MeshItem::Kind::node, node}});
    }
    return true;
  });
  if (chosen_ >= columns_.size()) chosen_ = 0;
  if (!columns_.empty()) draw_fields();
}

void ColumnList::draw_add(const PanelContext& context, const std::vector<LayerWall>& walls) {
  const auto& node = context.session.nodes().inspected();
  const bool on_wall = node && on_walls(*node, *context.topology(), walls);
  const bool known =
      node && std::ranges::find(columns_, *node, &ColumnOverride::node) != columns_.end();
  const std::string label =
      on_wall ? "Add node " + std::to_string(*node) : std::string("Add the selected node");
  const std::string tip =
      on_wall ? (known ? "This node is in the list already."
                       : "Set the columns and the thickness at this node by hand.")
              : "Select a node of these walls first: Alt+click it, or type its number in the tab "
                "VCV.";
  if (!ui::button("layers/columns/add", label,
                  {tip, ui::ButtonStyle::normal, on_wall && !known, -1}))
    return;
  chosen_ = columns_.size();
  ColumnOverride column;
  column.node = *node;
  column.columns = 1;
  columns_.push_back(column);
}

void ColumnList::draw_fields() {
  ColumnOverride& column = columns_[chosen_];
  constexpr const char* tip =
      "Columns that stand on the node: 1 is no fan, several need a convex corner. 0: as the rules "
      "choose.";
  ui::row("Columns", tip, layer_label_share);
  int count = column.columns.value_or(0);
  if (ui::number("layers/columns/count", count, tip)) {
    column.columns.reset();
    if (count > 0) column.columns = std::min(count, 20);
  }
  bool own = column.thickness.has_value();
  if (ui::checkbox("layers/columns/own", "Thickness by hand", own,
                   "Gaps, corners and neighbours do not limit it; it limits its neighbours."))
    column.thickness = own ? std::optional(thickness_) : std::nullopt;
  if (!own) return;
  layer_field("layers/columns/thickness", "Thickness", *column.thickness,
              "Of all layers at this node, in units of the mesh. 0: the layers end there.");
  thickness_ = *column.thickness;
}

}  // namespace winslow::gui
