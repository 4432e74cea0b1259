#pragma once

#include <chrono>
#include <functional>
#include <thread>

#include "app/subcommands/render_flags.h"
#include "core/error.h"
#include "gui/picture/capture/recorder.h"
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

/// Writes frames of the meshes, one after the other, into flags.frames; returns what to tell the
/// user. Throws OutputError, and what `draw` throws.
inline std::string record_frames(const RenderFlags& flags, const std::vector<Mesh>& meshes,
                                 const std::function<gui::Image(const Mesh&)>& draw) {
  gui::Recorder recorder;
  gui::RecordingSpec spec;
  spec.rate = flags.rate;
  recorder.start(flags.frames, spec);
  for (const Mesh& mesh : meshes) recorder.add(draw(mesh));
  recorder.stop();
  for (;;) {
    if (const auto outcome = recorder.poll()) {
      if (outcome->kind != gui::Recorder::Outcome::Kind::done) throw OutputError(outcome->text);
      return outcome->text;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

/// Writes two pictures side by side: draw(title, whether it is the one before).
template <class Draw>
void write_both(const RenderFlags& flags, const Draw& draw) {
  const std::string title = flags.title.empty() ? "" : flags.title + ": ";
  const gui::Image left = draw(title + "before", true);
  gui::write_png(flags.output, gui::side_by_side(left, draw(title + "after", false)));
}

}  // namespace winslow::app
