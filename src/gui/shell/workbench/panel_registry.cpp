#include "gui/shell/workbench/panel_registry.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

const char* name_of(MeshKind kind) {
  switch (kind) {
    case MeshKind::plane:
      return "plane";
    case MeshKind::surface:
      return "surface";
    case MeshKind::volume:
      return "volume";
  }
  return "";
}

}  // namespace

void PanelRegistry::add(RegisteredPanel panel) {
  if (std::ranges::any_of(panels_, [&](const auto& other) { return other.id == panel.id; }))
    throw std::logic_error("two panels \"" + panel.id + "\"");
  panels_.push_back(std::move(panel));
}

void PanelRegistry::draw(Region region, const PanelContext& context, MeshKind mesh) const {
  for (const RegisteredPanel& entry : panels_) {
    if (entry.region != region || (entry.shown && !entry.shown(context))) continue;
    if (entry.serves.contains(mesh))
      entry.panel->draw(context);
    else
      ui::text_dim(entry.title + ": not for " + name_of(mesh) + " meshes.");
  }
}

}  // namespace winslow::gui
