#include "gui/panels/step_editor.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <system_error>

#include "core/command/option_tables.h"
#include "core/error.h"
#include "gui/base/text.h"
#include "gui/panels/forms/command_form.h"
#include "gui/panels/reference_row.h"
#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

constexpr const char* step_popup = "###step_editor";

/// Why a command cannot be run; empty if it can.
std::string fault(Command command) {
  try {
    std::visit([](auto& of) { check(option_table(of)); }, command);
    if (const SmoothOptions* options = smooth_options(command)) validate(*options);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace

void StepEditor::open(std::size_t position, Command command) {
  position_ = position;
  command_ = std::move(command);
  title_ = "Step " + std::to_string(position) + ": " + describe(command_);
  generation_ = 0;
  open_ = wanted_ = true;
  aside_ = false;
}

std::string StepEditor::reference() {
  const SmoothOptions* options = smooth_options(command_);
  return options ? options->slide.reference.name : std::string();
}

void StepEditor::set_reference(const std::filesystem::path& file) {
  SmoothOptions* options = smooth_options(command_);
  if (!open_ || !options) return;
  // Recipes and sessions are read elsewhere.
  std::error_code failed;
  const std::filesystem::path whole = std::filesystem::absolute(file, failed);
  options->slide.reference = {(failed ? file : whole.lexically_normal()).string(), nullptr};
}

void StepEditor::draw_fields(const PanelContext& context) {
  SmoothOptions* options = smooth_options(command_);
  const MeshKind kind = context.session.kind();
  const bool slides = options && (kind == MeshKind::surface ||
                                  (kind == MeshKind::volume && !options->slide.markers.empty()));
  if (!slides) {
    ui::command_form("edit", command_, kind);
    return;
  }
  // It has a row of its own, which can choose a file.
  const std::string name = std::exchange(options->slide.reference.name, {});
  ui::command_form("edit", command_, kind);
  options = smooth_options(command_);
  options->slide.reference.name = name;
  switch (reference_row(context.theme, "edit/reference", name)) {
    case ReferenceAsk::choose:
      aside_ = true;
      return context.emit(action::ShowFileDialog{FilePurpose::step_reference});
    case ReferenceAsk::clear:
      options->slide.reference = {};
      break;
    case ReferenceAsk::nothing:
      break;
  }
}

void StepEditor::draw(const PanelContext& context) {
  if (!open_ || aside_) return;
  if (wanted_) ImGui::OpenPopup(step_popup);
  if (generation_ == 0) generation_ = context.session.generation();
  wanted_ = false;
  const ImVec2 screen = ImGui::GetMainViewport()->Size;
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always,
                          ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(ImVec2(std::min(context.theme.px(460), screen.x * 0.94f),
                                  std::min(context.theme.px(620), screen.y * 0.92f)));
  constexpr auto flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      ImVec2(context.theme.px(18), context.theme.px(14)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, context.theme.px(8));
  if (ImGui::BeginPopupModal(step_popup, nullptr, flags)) {
    ImGui::PushFont(context.theme.bold);
    ImGui::TextUnformatted(ui::elided(title_, ImGui::GetContentRegionAvail().x).c_str());
    ImGui::PopFont();
    ui::note("edit/title");
    const float footer = 2 * ImGui::GetFrameHeightWithSpacing() + context.theme.px(8);
    ImGui::BeginChild("fields", ImVec2(0, -footer));
    draw_fields(context);
    ImGui::EndChild();
    draw_footer(context);
    if (aside_) ImGui::CloseCurrentPopup();
    // A file was dropped on the window meanwhile.
    if (generation_ != context.session.generation()) close();
    ImGui::EndPopup();
  } else {
    open_ = false;
  }
  ImGui::PopStyleVar(2);
}

void StepEditor::draw_footer(const PanelContext& context) {
  const History& history = context.session.document()->history();
  const std::string why = fault(command_);
  const std::size_t after = history.size() > position_ ? history.size() - 1 - position_ : 0;
  if (!why.empty())
    ui::text_colored(palette().danger, ui::elided(why, ImGui::GetContentRegionAvail().x));
  else
    ui::text_dim(after == 0 ? "Nothing comes after this step."
                            : counted(after, "step") + " after this one " +
                                  (after == 1 ? "is" : "are") + " run again.");
  ui::tooltip(why);
  const float gap = ImGui::GetStyle().ItemSpacing.x;
  const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
  if (ui::button("edit/run", "Run again from here",
                 {"The history as it is now is kept: the History tab can bring it back.",
                  ui::ButtonStyle::primary, why.empty() && !context.session.in_motion(), width})) {
    context.emit(action::EditStep{position_, command_});
    return close();
  }
  ImGui::SameLine();
  if (ui::button("edit/cancel", "Cancel", {"", ui::ButtonStyle::normal, true, width}) ||
      ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false))
    close();
}

void StepEditor::close() {
  open_ = aside_ = false;
  ImGui::CloseCurrentPopup();
}

}  // namespace winslow::gui
