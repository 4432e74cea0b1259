#include "gui/panels/picture/recording_panel.h"

#include <cmath>
#include <string>

#include "gui/base/text.h"
#include "gui/picture/capture/capture.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

std::string percent(double share) {
  return std::to_string(static_cast<int>(std::lround(100 * share))) + " %";
}

std::string state_text(const Recorder& recorder) {
  switch (recorder.state()) {
    case Recorder::State::recording:
      return "Recording: " + counted(recorder.frames(), "frame") +
             (recorder.dropped() > 0 ? ", " + grouped(recorder.dropped()) + " left out" : "");
    case Recorder::State::writing:
      return "Writing frames: " + percent(recorder.progress());
    case Recorder::State::encoding:
      return "Making the film: " + percent(recorder.progress());
    case Recorder::State::idle:
      break;
  }
  return {};
}

}  // namespace

void RecordingPanel::draw(const PanelContext& context) {
  const Recorder& recorder = context.capture.recorder();
  const bool recording = recorder.state() == Recorder::State::recording;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float middle = at.y + ImGui::GetFrameHeight() / 2;
  const float radius = context.theme.px(5);
  ImGui::GetWindowDrawList()->AddCircleFilled(ImVec2(at.x + radius, middle), radius,
                                              recording ? palette().danger : palette().text_faint);
  ImGui::SetCursorScreenPos(ImVec2(at.x + radius + context.theme.px(14), at.y));
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(state_text(recorder).c_str());
  ui::note("recording/state");
  const float width = context.theme.px(64);
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x -
                  (recording ? 2 * width + ImGui::GetStyle().ItemSpacing.x : width));
  if (recording) {
    if (ui::button("recording/stop", "Stop",
                   {"End the recording and write it", ui::ButtonStyle::primary, true, width}))
      context.emit(action::StopRecording{});
    ImGui::SameLine();
  }
  if (ui::button("recording/cancel", recording ? "Discard" : "Cancel",
                 {"End it and throw it away", ui::ButtonStyle::normal, true, width}))
    context.emit(action::CancelRecording{});
}

}  // namespace winslow::gui
