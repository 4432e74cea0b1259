#include "gui/panels/picture/record_dialog.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "gui/picture/capture/capture.h"
#include "gui/widgets/controls.h"
#include "gui/widgets/dialog.h"

namespace winslow::gui {

namespace {

constexpr int fastest = 60;

}  // namespace

void RecordDialog::open(std::optional<std::size_t> step) {
  step_ = step;
  wanted_ = opened_ = true;
}

void RecordDialog::set_extents(const ScreenVector& window, const ScreenVector& mesh) {
  window_ = window;
  mesh_ = mesh;
}

void RecordDialog::draw(const PanelContext& context) {
  if (std::exchange(opened_, false)) {
    spec_ = context.capture.recording();
    settings_.set(spec_.picture, window_.x(), window_.y());
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
    if (context.session.in_space()) ways.emplace_back("While the view turns once");
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
  const ScreenVector& extent = settings_.spec().panels ? window_ : mesh_;
  settings_.draw("record", true, extent.x(), extent.y());
  ui::checkbox("record/keep", "Keep the PNG frames beside the film", spec_.keep_frames);
  const auto answer = dialog.buttons("record", "Choose file...", settings_.error().empty());
  if (!answer.accepted) return;
  spec_.picture = settings_.spec();
  context.emit(action::SetRecordingSpec{spec_});
  context.emit(action::ShowFileDialog{FilePurpose::recording});
}

}  // namespace winslow::gui
