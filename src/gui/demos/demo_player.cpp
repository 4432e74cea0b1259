#include "gui/demos/demo_player.h"

#include "gui/files/assets.h"

namespace winslow::gui {

namespace {

/// Time to read the card and look at the mesh before the next automatic step.
constexpr double seconds_per_step = 6;

}  // namespace

void DemoPlayer::start(const Demo& demo, const std::filesystem::path& folder,
                       const Session& session, ActionQueue& actions) {
  demo_ = &demo;
  step_ = 0;
  automatic_ = opened_ = begun_ = opening_seen_ = false;
  rested_ = 0;
  before_.assign(demo.steps.size(), 0);
  generation_ = session.generation();
  actions.emplace_back(action::OpenMesh{bundled_path(folder, demo.mesh), true});
}

bool DemoPlayer::ready(const Session& session) const {
  return demo_ && opened_ && begun_ && !session.in_motion();
}

void DemoPlayer::go(int by, const Session& session, ActionQueue& actions) {
  if (!ready(session)) return;
  if (by < 0) {
    if (step_ == 0) return;
    actions.emplace_back(action::GoToStep{before_[step_]});
    --step_;
    automatic_ = false;
    rested_ = 0;
    return;
  }
  if (step_ + 1 == demo_->steps.size()) return end();
  ++step_;
  begin_step(session, actions);
}

void DemoPlayer::begin_step(const Session& session, ActionQueue& actions) {
  const DemoStep& step = demo_->steps[step_];
  const Document& document = *session.document();
  before_[step_] = document.history().position();
  begun_ = true;
  rested_ = 0;
  std::vector<Index> markers;
  for (const std::string& name : step.select)
    if (const auto marker = document.topology()->markers().find(name)) markers.push_back(*marker);
  actions.emplace_back(action::SelectMarkers{markers});
  if (step.view) {
    const auto& [x0, y0, x1, y1] = *step.view;
    const Vec2 half(0.5 * (x1 - x0), 0.5 * (y1 - y0));
    actions.emplace_back(action::LookAt{Vec3(x0 + half.x(), y0 + half.y(), 0), half.maxCoeff()});
  }
  if (step.space) actions.emplace_back(action::ShowLook{*step.space});
  if (!step.command) return;
  if (step.afresh) actions.emplace_back(action::GoToStep{0});
  Command command = *step.command;
  // Use the options of the panels: the user may be trying other settings.
  if (SmoothOptions* smooth = winslow::smooth_options(command)) {
    *smooth = session.solver_settings().smooth_options();
    if (step.regular) smooth->targets = TargetBlend::regular();
    if (step.pointwise_over) {
      smooth->formulation = Formulation::pointwise;
      smooth->outer = OuterMethod::picard;
      smooth->vcv = *step.pointwise_over;
      smooth->vcv_updates = 0;
      smooth->vcv_lengths = 0;
    }
  }
  actions.emplace_back(action::RunCommand{std::move(command), false, true});
}

void DemoPlayer::update(const Session& session, double seconds, ActionQueue& actions) {
  if (!demo_) return;
  if (!opened_) {
    opening_seen_ |= session.files().loading();
    if (session.generation() != generation_ && session.document()) {
      opened_ = true;
      generation_ = session.generation();
      begin_step(session, actions);
    } else if (opening_seen_ && !session.files().loading()) {
      end();  // the mesh could not be read; the session has reported it
    }
    return;
  }
  if (session.generation() != generation_) return end();
  if (!automatic_ || !ready(session)) return;
  rested_ += seconds;
  if (rested_ < seconds_per_step) return;
  if (step_ + 1 == demo_->steps.size())
    automatic_ = false;
  else
    go(1, session, actions);
}

}  // namespace winslow::gui
