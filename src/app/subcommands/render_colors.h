#pragma once

#include "app/subcommands/render_flags.h"
#include "gui/picture/frame/picture_parts.h"
#include "gui/picture/picture.h"

namespace winslow::app {

/// What the flags say of the colours of values. Of programs with graphics.
inline gui::ColorChoice color_choice(const RenderFlags& flags) {
  gui::ColorChoice choice;
  choice.map = flags.map;
  if (flags.axis != "automatic")
    choice.axis = flags.axis == "log" ? gui::ColorAxis::logarithmic : gui::ColorAxis::linear;
  choice.range = flags.range;
  choice.percentiles = flags.percentiles;
  return choice;
}

/// Writes two pictures side by side: draw(title, whether it is the one before).
template <class Draw>
void write_both(const RenderFlags& flags, const Draw& draw) {
  const std::string title = flags.title.empty() ? "" : flags.title + ": ";
  const gui::Image left = draw(title + "before", true);
  gui::write_png(flags.output, gui::side_by_side(left, draw(title + "after", false)));
}

}  // namespace winslow::app
