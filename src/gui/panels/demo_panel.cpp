#include "gui/panels/demo_panel.h"

#include <string>

#include "gui/base/text.h"
#include "gui/demos/demo_player.h"
#include "gui/menu/user_command.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

void draw_numbers(const PanelContext& context) {
  const auto& measured = context.session.quality().latest();
  const bool known = measured && measured->shape == context.session.shape();
  if (!known || !context.picture_follows()) return ui::text_dim(" ");
  const QualityReport& report = measured->report;
  const std::string inverted = counted(report.inverted, "inverted element");
  ui::text_colored(report.inverted > 0 ? palette().danger : palette().success, inverted);
  ui::note("demo/inverted");
  ImGui::SameLine();
  const bool in_space = context.session.in_space();
  ui::text_dim((in_space ? "smallest scaled Jacobian " : "smallest sine ") +
               short_number(report.of(Metric::normalized_jacobian).statistics.min) +
               (in_space ? ", largest R/3r " : ", largest R/2r ") +
               short_number(report.of(Metric::aspect_ratio).statistics.max));
}

void draw_buttons(const PanelContext& context) {
  const DemoPlayer& player = context.demo;
  const std::size_t steps = player.demo()->steps.size();
  const bool ready = player.ready(context.session);
  const bool last = player.step() + 1 == steps;
  const float width = context.theme.px(86);
  if (ui::button("demo/back", "Back",
                 {tooltip_of(user_command("demo_back")), ui::ButtonStyle::normal,
                  ready && player.step() > 0, width}))
    context.emit(action::StepDemo{-1});
  ImGui::SameLine();
  if (ui::button("demo/next", last ? "Finish" : "Next",
                 {tooltip_of(user_command("demo_next")), ui::ButtonStyle::primary, ready, width}))
    context.emit(action::StepDemo{1});
  ImGui::SameLine();
  if (ui::button("demo/play", player.automatic() ? "Wait" : "Auto-play",
                 {"Go on by itself, or wait at each step.", ui::ButtonStyle::normal, !last, width}))
    context.emit(action::PlayDemo{!player.automatic()});
  ImGui::SameLine();
  if (ui::button("demo/end", "End",
                 {"Leave the demo; the mesh stays open. (Esc)", ui::ButtonStyle::flat, true,
                  context.theme.px(60)}))
    context.emit(action::EndDemo{});
}

}  // namespace

float DemoPanel::height(const PanelContext& context, float width) {
  const Demo* demo = context.demo.demo();
  if (!demo) return 0;
  const std::string& text = demo->steps[context.demo.step()].text;
  const float gap = ImGui::GetStyle().ItemSpacing.y;
  return 3 * ImGui::GetTextLineHeightWithSpacing() + gap +
         ImGui::CalcTextSize(text.c_str(), nullptr, false, width).y + ImGui::GetFrameHeight();
}

void DemoPanel::draw(const PanelContext& context) {
  const Demo* demo = context.demo.demo();
  if (!demo) return;
  const DemoStep& step = demo->steps[context.demo.step()];
  const std::string place = "Step " + std::to_string(context.demo.step() + 1) + " of " +
                            std::to_string(demo->steps.size()) + " of case " + demo->id + ": ";
  ui::text_colored(palette().text_faint,
                   ui::elided(place + demo->title, ImGui::GetContentRegionAvail().x));
  ui::note("demo/step/" + std::to_string(context.demo.step() + 1));
  ImGui::PushFont(context.theme.bold);
  ImGui::TextUnformatted(step.title.c_str());
  ImGui::PopFont();
  ui::text_wrapped(step.text);
  if (context.demo.ready(context.session))
    draw_numbers(context);
  else
    ui::text_dim(context.session.files().loading() ? "Reading the mesh ..." : "At work ...");
  draw_buttons(context);
}

}  // namespace winslow::gui
