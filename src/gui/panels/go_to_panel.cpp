#include "gui/panels/go_to_panel.h"

#include "core/error.h"
#include "gui/view/navigation/go_to.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

const char* hint_of(MeshKind kind) {
  if (kind == MeshKind::plane) return "n123, e45, 0.5, 0.1 ...";
  return kind == MeshKind::volume ? "n123, e45, f12, 0.5, 0.1, 2 ..."
                                  : "n123, e45, 0.5, 0.1, 2 ...";
}

}  // namespace

void GoToPanel::draw(const PanelContext& context) {
  if (!context.session.document()) return;
  // Asked for by its key, the field must not be folded away.
  if (context.view_state.go_to_wanted) ui::unfold("section/go_to");
  if (!ui::section("section/go_to", "Go to")) return;
  draw_field(context);
  if (!error_.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, palette().danger);
    ui::text_wrapped(error_);
    ImGui::PopStyleColor();
    ui::note("go_to/error");
  }
  draw_item(context);
}

void GoToPanel::draw_field(const PanelContext& context) {
  constexpr const char* tip =
      "n123 goes to a node, e45 to an element, 0.5, 0.1 to the node nearest to a point, worst 3 to "
      "an entry of the list above, the name of a marker to its first node; of a volume mesh f12 to "
      "a face, wing 12 to that face of a marker. Ctrl+G comes here.";
  if (context.view_state.go_to_wanted) ImGui::SetKeyboardFocusHere();
  const float go = context.theme.px(44);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - go -
                          ImGui::GetStyle().ItemInnerSpacing.x);
  // What is typed next is another place, not more of the last one.
  bool wanted = ImGui::InputTextWithHint(
      "##go_to", hint_of(context.session.kind()), text_.data(), text_.size(),
      ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  ui::note("go_to/field");
  ui::tooltip(tip);
  ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  wanted |= ui::button("go_to/go", "Go", {"Go there (Enter).", ui::ButtonStyle::normal, true, go});
  if (!wanted) return;
  try {
    context.emit(action::GoTo{parse_item(text_.data(), context.session, context.view)});
    error_.clear();
  } catch (const UsageError& error) {
    error_ = error.what();
  }
}

void GoToPanel::draw_item(const PanelContext& context) {
  const auto& focus = context.view_state.focus;
  if (!focus || !exists(*focus, context.session)) return;
  const float left = ImGui::GetCursorPosX();
  ImGui::BeginGroup();
  bool first = true;
  if (described_ != focus || shape_ != context.session.shape() ||
      generation_ != context.session.generation()) {
    lines_ = describe_item(*focus, context.session);
    described_ = focus;
    shape_ = context.session.shape();
    generation_ = context.session.generation();
  }
  for (const auto& [name, value] : lines_) {
    if (first)
      ui::text_colored(palette().text, name);
    else
      ui::text_dim(name);
    ImGui::SameLine(left + context.theme.px(150));
    ui::text_wrapped(value);
    first = false;
  }
  ImGui::EndGroup();
  ui::note("go_to/item");
  if (ui::button("go_to/again", "Show", {"Bring it into view again.", ui::ButtonStyle::normal}))
    context.emit(action::GoTo{focus});
  ImGui::SameLine();
  if (ui::button("go_to/clear", "Clear", {"Highlight nothing.", ui::ButtonStyle::normal}))
    context.emit(action::GoTo{});
}

}  // namespace winslow::gui
