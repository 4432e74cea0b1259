#include "gui/settings/view_options.h"

namespace winslow::gui {

ElementStyle style_of(const ViewOptions& view) {
  if (!view.fill) return ElementStyle::edges;
  return view.wireframe ? ElementStyle::both : ElementStyle::surfaces;
}

void set_style(ViewOptions& view, ElementStyle style) {
  view.fill = style != ElementStyle::edges;
  view.wireframe = style != ElementStyle::surfaces;
}

bool legend_has_strip(const ViewOptions& view) {
  return view.legend && view.color && docked(view.legend_place);
}

void step_style(ViewOptions& view) {
  set_style(view, static_cast<ElementStyle>((static_cast<int>(style_of(view)) + 1) % 3));
}

}  // namespace winslow::gui
