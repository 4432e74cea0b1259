#include "gui/panels/layers/wall_list.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "gui/base/text.h"
#include "gui/panels/layers/list_row.h"

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

std::vector<Index> indices(const std::vector<std::string>& names, const Topology& topology) {
  std::vector<Index> markers;
  for (const std::string& name : names)
    if (const auto marker = topology.markers().find(name)) markers.push_back(*marker);
  return markers;
}

}  // namespace

std::string marker_list(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

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
  draw_list("walls", walls_.size(), context.theme,
            [&](std::size_t k) { return draw_row(context, k); });
}

/// False if the wall was taken out.
bool WallList::draw_row(const PanelContext& context, std::size_t k) {
  const LayerWall& wall = walls_[k];
  const std::string names = marker_list(wall.markers);
  std::vector<Index> markers = indices(wall.markers, *context.topology());
  std::ranges::sort(markers);
  const RowAnswer answer = draw_list_row(
      {"layers/wall/" + std::to_string(k), names, summary(wall),
       names + "\n" + summary(wall) +
           "\nClick to select these markers and change the settings of this wall.",
       "Take this wall out of the list.", markers == context.session.selection().markers()},
      context.theme);
  if (answer == RowAnswer::pressed) context.emit(action::SelectMarkers{std::move(markers)});
  if (answer != RowAnswer::removed) return true;
  walls_.erase(walls_.begin() + static_cast<std::ptrdiff_t>(k));
  return false;
}

}  // namespace winslow::gui
