#include "gui/panels/banner_panel.h"

#include <string>

#include "gui/widgets/controls.h"

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

/// The text and up to three buttons do not fit on one line.
bool two_lines(const PanelContext& context, float width) {
  const float text = ImGui::CalcTextSize(context.session.banner()->text.c_str()).x;
  return text + context.theme.px(310) > width;
}

}  // namespace

float BannerPanel::height(const PanelContext& context, float width) {
  return context.theme.px(two_lines(context, width) ? 78.0f : 44.0f);
}

void BannerPanel::draw(const PanelContext& context) {
  const auto& banner = context.session.banner();
  if (!banner) return;
  const bool bad =
      banner->kind == Banner::Kind::inverted_result || banner->kind == Banner::Kind::inverted_input;
  const bool undo =
      banner->kind == Banner::Kind::inverted_result || banner->kind == Banner::Kind::partial_motion;
  ImGui::AlignTextToFramePadding();
  const std::string icon = context.theme.icon(Icon::warning);
  const bool wide = !two_lines(context, ImGui::GetWindowWidth());
  const std::string text = icon.empty() ? banner->text : icon + "  " + banner->text;
  ui::text_colored(bad ? palette().danger : palette().warning,
                   ui::elided(text, ImGui::GetContentRegionAvail().x));
  ui::note("banner");
  ui::tooltip(banner->text);
  if (wide) ImGui::SameLine(0, context.theme.px(16));
  if (undo) {
    if (ui::button("banner/undo", "Undo", {"Back to the mesh before this command."}))
      context.emit(action::Undo{});
    ImGui::SameLine();
  } else if (ui::button("banner/smooth",
                        banner->kind == Banner::Kind::inverted_input ? "Smooth" : "Go on",
                        {"Smooth the mesh, its boundary held."})) {
    context.emit(action::RunSmooth{});
  }
  if (bad) {
    if (banner->kind == Banner::Kind::inverted_input) ImGui::SameLine();
    if (ui::button("banner/show", "Show", {"Look at the first inverted element."}))
      emit_show_inverted(context);
  }
  ImGui::SameLine();
  if (ui::button("banner/keep", bad ? "Keep it" : "Dismiss",
                 {"Leave the mesh as it is and hide this line."}))
    context.emit(action::DismissBanner{});
}

}  // namespace winslow::gui
