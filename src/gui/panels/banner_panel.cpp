#include "gui/panels/banner_panel.h"

#include <string>

#include "gui/widgets/controls.h"
#include "gui/widgets/line_breaks.h"

namespace winslow::gui {

namespace {

void emit_show_inverted(const PanelContext& context) {
  const auto& measured = context.session.quality().latest();
  if (!measured || measured->report.inverted_elements.empty()) return;
  const Topology& topology = *context.topology();
  const auto nodes = topology.element(measured->report.inverted_elements.front());
  const Bounds box = bounds(context.session.coordinates(), nodes);
  context.emit(action::LookAt{box.centre(), 6 * box.size().norm()});
}

std::string text_of(const PanelContext& context, float width) {
  const std::string icon = context.theme.icon(Icon::warning);
  const std::string& text = context.session.messages().banner()->text;
  return ui::with_line_breaks((icon.empty() ? "" : icon + "  ") + text, width);
}

/// The text and up to three buttons fit on one line.
bool one_line(const PanelContext& context, float width) {
  const float text = ImGui::CalcTextSize(context.session.messages().banner()->text.c_str()).x;
  const bool lines = context.session.messages().banner()->text.find('\n') != std::string::npos;
  return !lines && text + context.theme.px(310) <= width;
}

}  // namespace

float BannerPanel::height(const PanelContext& context, float width) {
  const Theme& theme = context.theme;
  if (one_line(context, width)) return theme.px(44);
  // Above the buttons, on as many lines as it takes: what is cut off may be what matters.
  const float room = width - theme.px(2 * side_padding);
  const std::string text = text_of(context, room);
  const float wrapped = ImGui::CalcTextSize(text.c_str(), nullptr, false, room).y;
  return theme.px(62) + wrapped;
}

void BannerPanel::draw(const PanelContext& context) {
  const auto& banner = context.session.messages().banner();
  if (!banner) return;
  const bool bad =
      banner->kind == Banner::Kind::inverted_result || banner->kind == Banner::Kind::inverted_input;
  const bool undo = banner->kind == Banner::Kind::inverted_result ||
                    banner->kind == Banner::Kind::partial_motion ||
                    banner->kind == Banner::Kind::damaged;
  ImGui::AlignTextToFramePadding();
  ImGui::PushTextWrapPos(0);
  ui::text_colored(bad ? palette().danger : palette().warning,
                   text_of(context, ImGui::GetContentRegionAvail().x));
  ImGui::PopTextWrapPos();
  ui::note("banner");
  if (one_line(context, ImGui::GetWindowWidth())) ImGui::SameLine(0, context.theme.px(16));
  const bool remark = banner->kind == Banner::Kind::remark;
  if (undo) {
    if (ui::button("banner/undo", "Undo", {"Back to the mesh before this command."}))
      context.emit(action::Undo{});
    ImGui::SameLine();
  } else if (!remark &&
             ui::button("banner/smooth",
                        banner->kind == Banner::Kind::inverted_input ? "Smooth" : "Go on",
                        {"Smooth the mesh, its boundary held."})) {
    context.emit(action::RunSmooth{});
  }
  if (bad) {
    if (banner->kind == Banner::Kind::inverted_input) ImGui::SameLine();
    if (ui::button("banner/show", "Show", {"Look at the first inverted element."}))
      emit_show_inverted(context);
  }
  if (!remark) ImGui::SameLine();
  if (ui::button("banner/keep", bad ? "Keep it" : "Dismiss",
                 {"Leave the mesh as it is and hide this line."}))
    context.emit(action::DismissBanner{});
}

}  // namespace winslow::gui
