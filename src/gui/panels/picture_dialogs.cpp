#include "gui/panels/dialogs.h"
#include "gui/panels/panels.h"

#include "core/error.h"
#include "gui/base/text.h"
#include "gui/picture/capture/capture.h"
#include "gui/widgets/controls.h"
#include "gui/widgets/dialog.h"

namespace winslow::gui {

namespace {

struct Choice {
  const char* label;
  double scale;
};
constexpr std::array<Choice, 4> choices{
    {{"As the window", 1}, {"Twice as large", 2}, {"Four times as large", 4}, {"Other", 0}}};

}  // namespace

void PictureSettings::set(const PictureSpec& spec, const ScreenVector& on_screen) {
  spec_ = spec;
  width_ = spec.size ? (*spec.size)[0] : static_cast<int>(std::lround(on_screen.x()));
  height_ = spec.size ? (*spec.size)[1] : static_cast<int>(std::lround(on_screen.y()));
}

void PictureSettings::draw(const std::string& id, bool film, const ScreenVector& window,
                           const ScreenVector& mesh) {
  std::vector<std::string> labels;
  std::size_t chosen = choices.size() - 1;
  for (std::size_t k = 0; k < choices.size(); ++k) {
    labels.emplace_back(choices[k].label);
    if (!spec_.size && choices[k].scale == spec_.scale) chosen = k;
  }
  ui::row("Size", "Letters and lines grow with the picture: it looks the same, only finer.");
  if (ui::combo(id + "/size", labels, chosen)) {
    spec_.size.reset();
    spec_.scale = choices[chosen].scale;
    if (chosen + 1 == choices.size()) spec_.size = {width_, height_};
  }
  if (spec_.size) {
    ui::row("Width", "Pixels");
    ui::number(id + "/width", width_);
    ui::row("Height", "Pixels");
    ui::number(id + "/height", height_);
    spec_.size = {width_, height_};
  }
  bool mesh_alone = !spec_.panels;
  if (ui::checkbox(id + "/mesh_alone", "The mesh alone", mesh_alone,
                   "Without panels, handles and buttons"))
    spec_.panels = !mesh_alone;
  if (mesh_alone && !film)
    ui::checkbox(id + "/transparent", "Transparent background", spec_.transparent,
                 "No paper behind the mesh: for slides and drawings");
  ui::checkbox(id + "/legend", "Legend", spec_.legend, "The bar that says what the colours mean");
  error_.clear();
  try {
    const ScreenVector& extent = spec_.panels ? window : mesh;
    const auto size = picture_size(spec_, extent.x(), extent.y());
    ui::text_dim(grouped(size[0]) + " x " + grouped(size[1]) + " pixels");
  } catch (const Error& wrong) {
    error_ = wrong.what();
    ui::text_colored(palette().danger, "Too large or too small");
    ui::tooltip(error_);
  }
}

void PictureDialog::draw(const PanelContext& context, const ScreenVector& window,
                         const ScreenVector& mesh) {
  if (std::exchange(opened_, false)) settings_.set(context.capture.picture(), window);
  ui::Dialog dialog("###picture", "Save a picture", wanted_, context.theme);
  if (!dialog.shown()) return;
  settings_.draw("picture", false, window, mesh);
  ImGui::Spacing();
  ui::text_dim("A name that ends in .svg or .pdf gives vector graphics");
  ui::text_dim("of the mesh alone, for print.");
  const auto answer = dialog.buttons("picture", "Choose file...", settings_.error().empty());
  if (!answer.accepted) return;
  context.emit(action::SetPictureSpec{settings_.spec()});
  context.emit(action::ShowFileDialog{FilePurpose::picture});
}

namespace {

constexpr int fastest = 60;

}  // namespace

void RecordDialog::open(std::optional<std::size_t> step) {
  step_ = step;
  wanted_ = opened_ = true;
}

void RecordDialog::draw(const PanelContext& context, const ScreenVector& window,
                        const ScreenVector& mesh) {
  if (std::exchange(opened_, false)) {
    spec_ = context.capture.recording();
    settings_.set(spec_.picture, window);
  }
  ui::Dialog dialog("###record", step_ ? "Record this step again" : "Record the mesh", wanted_,
                    context.theme);
  if (!dialog.shown()) return;
  if (step_) {
    const Document* document = context.session.document();
    if (document && *step_ < document->history().size())
      ui::text_dim(describe(document->history().command(*step_)));
  } else {
    std::vector<std::string> ways{"Whenever the mesh moved", "By the clock"};
    if (meshes_in_space.contains(context.session.kind()))
      ways.emplace_back("While the view turns once");
    auto when = std::min(static_cast<std::size_t>(spec_.when), ways.size() - 1);
    ui::row("A frame",
            "Whenever the mesh has moved: no frame shows the same mesh twice. By the clock, with "
            "what you do to the view in between. Or while the view of a volume mesh turns once "
            "about the upright axis.");
    ui::combo("record/when", ways, when);
    spec_.when = static_cast<RecordingSpec::When>(when);
    if (spec_.when == RecordingSpec::When::turntable) {
      ui::row("Seconds", "That the turn takes in the film");
      ui::number("record/seconds", spec_.turn_seconds);
      if (!(spec_.turn_seconds >= 0.1 && spec_.turn_seconds <= 600)) spec_.turn_seconds = 6;
    }
  }
  ui::row("Frames a second", "Of the film");
  ui::number("record/rate", spec_.rate);
  spec_.rate = std::clamp(spec_.rate, 1, fastest);
  settings_.draw("record", true, window, mesh);
  ui::checkbox("record/keep", "Keep the PNG frames beside the film", spec_.keep_frames);
  const auto answer = dialog.buttons("record", "Choose file...", settings_.error().empty());
  if (!answer.accepted) return;
  spec_.picture = settings_.spec();
  context.emit(action::SetRecordingSpec{spec_});
  context.emit(action::ShowFileDialog{FilePurpose::recording});
}

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

void draw_recording(const PanelContext& context) {
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
