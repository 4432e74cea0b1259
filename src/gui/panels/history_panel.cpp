#include "gui/panels/dialogs.h"
#include "gui/panels/panels.h"

#include "core/command/option_tables.h"
#include "core/error.h"
#include "gui/base/text.h"
#include "gui/panels/forms/option_form.h"
#include "gui/panels/marker_roles.h"
#include "gui/widgets/controls.h"
#include "gui/widgets/dialog.h"

namespace winslow::gui {

namespace {

std::string summary(const SmoothResult& result) {
  if (result.outer_iterations == 0) return {};
  std::string text = counted(result.outer_iterations, "iteration");
  if (result.increments > 1) text += " in " + std::to_string(result.increments) + " steps";
  if (result.inverted > 0) return text + ", " + counted(result.inverted, "inverted element");
  return text + (result.converged ? ", converged" : ", not converged");
}

std::string duration(double seconds) {
  if (seconds <= 0) return {};
  if (seconds < 0.0995) return short_number(std::max(1.0, std::round(1000 * seconds))) + " ms";
  if (seconds < 99.5) return short_number(std::round(10 * seconds) / 10) + " s";
  return short_number(std::round(seconds / 6) / 10) + " min";
}

std::string title_of(const Document& document, std::size_t position) {
  if (position == 0) return "Opened " + document.source().path.filename().string();
  return describe(document.history().command(position));
}

struct IconOf {
  Icon operator()(const SmoothCommand&) const { return Icon::solver; }
  Icon operator()(const ScrambleCommand&) const { return Icon::random; }
  Icon operator()(const EditVcvCommand&) const { return Icon::target; }
  Icon operator()(const LayersCommand&) const { return Icon::view; }
  Icon operator()(const MoveCommand&) const { return Icon::motion; }
  template <class Other>
  Icon operator()(const Other&) const {
    return Icon::bodies;
  }
};
Icon icon_of(const Document& document, std::size_t position) {
  return position == 0 ? Icon::open : std::visit(IconOf(), document.history().command(position));
}

bool went_badly(const SmoothResult& result) { return result.inverted > 0 || !result.converged; }

/// Why a command is invalid; empty: it is valid.
std::string fault(Command command) {
  try {
    std::visit([](auto& of) { check(option_table(of)); }, command);
    if (const SmoothOptions* options = smooth_options(command)) validate(*options);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

/// The list of applied commands. The user can go to any of them, edit one and rerun those after it,
/// or export them as a recipe.
class HistoryPanel {
 public:
  void draw(const PanelContext& context) {
    if (!context.session.document()) return ui::text_dim("No mesh is open.");
    draw_steps(context);
    draw_queue(context);
    draw_buttons(context);
    draw_kept(context);
  }

 private:
  void draw_steps(const PanelContext& context) {
    const std::size_t size = context.session.document()->history().size();
    const float row = ImGui::GetTextLineHeight() + context.theme.px(12);
    const auto rows = static_cast<float>(std::clamp<std::size_t>(size, 3, 14));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(2, 2));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
    ImGui::BeginChild("steps", ImVec2(0, row * rows + context.theme.px(6)), true);
    for (std::size_t k = 0; k < size; ++k) draw_step(context, k);
    if (shown_size_ != size) ImGui::SetScrollHereY(1.0f);
    shown_size_ = size;
    ImGui::PopStyleVar(2);  // before the end of the list: later items keep their spacing
    ImGui::EndChild();
  }

  void draw_step(const PanelContext& context, std::size_t position) {
    const Document& document = *context.session.document();
    const History& history = document.history();
    const bool present = position == history.position();
    const bool undone = position > history.position();
    const std::string title = title_of(document, position);
    const std::string id = "history/" + std::to_string(position);
    const float pad = context.theme.px(6);
    const ImVec2 start = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, ImGui::GetTextLineHeight() + 2 * pad);
    const ImVec2 end(start.x + size.x, start.y + size.y);
    const bool pressed = ImGui::InvisibleButton(id.c_str(), size);
    ui::note(id);
    const bool over = ImGui::IsItemHovered();
    const std::string about = position == 0 ? "" : summary(history.result(position));
    const std::string took =
        position == 0 ? "" : duration(document.edits().tags()[position].seconds);
    const bool kept = position == history.reference_position();
    ui::tooltip((position == 0 ? title : "Step " + std::to_string(position) + ": " + title) +
                (about.empty() ? "" : "\n" + about) + (took.empty() ? "" : "\ntook " + took) +
                (kept ? "\nMotions keep this mesh." : "") +
                (present ? "\nThis is the mesh shown." : "\nClick to go to this mesh.") +
                (position > 0 ? "\nRight click: edit or delete this step." : ""));
    if (pressed && !present) context.emit(action::GoToStep{position});
    if (position > 0) draw_menu(context, position, "menu/" + id);

    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (present || over) list.AddRectFilled(start, end, palette().accent_soft, context.theme.px(4));
    const bool bad = position > 0 && went_badly(history.result(position));
    const ImU32 ink = undone ? palette().text_faint : bad ? palette().warning : palette().accent;
    const std::string glyph = context.theme.icon(icon_of(document, position));
    if (glyph.empty())
      list.AddCircleFilled(ImVec2(start.x + pad + context.theme.px(6), (start.y + end.y) / 2),
                           context.theme.px(3.5f), ink);
    else
      list.AddText(ImVec2(start.x + pad, start.y + pad), ink, glyph.c_str());
    // Number of iterations and duration in separate columns; if empty, the title uses their space.
    float right = end.x - pad;
    const auto column = [&](const std::string& text, float width) {
      if (text.empty()) return;
      const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
      list.AddText(ImVec2(right - extent.x, start.y + pad), palette().text_faint, text.c_str());
      right -= width;
    };
    column(took, context.theme.px(54));
    const int iterations = position == 0 ? 0 : history.result(position).outer_iterations;
    column(iterations > 0 ? grouped(iterations) + " it." : "", context.theme.px(56));
    const float x = start.x + pad + context.theme.px(22);
    const std::string text = ui::elided(title, right - x);
    list.AddText(ImVec2(x, start.y + pad), undone ? palette().text_faint : palette().text,
                 text.c_str());
  }

  /// Draws the context menu of a step.
  static void draw_menu(const PanelContext& context, std::size_t position, const std::string& id) {
    // The list has no spacing; restore it for the menu.
    const float gap = context.theme.px(8);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(gap, gap));
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(gap, gap));
    const bool open = ImGui::BeginPopupContextItem(id.c_str());
    const bool free = !context.session.in_motion();
    const auto item = [&](const char* id, const char* label, bool enabled) {
      const bool pressed = ImGui::MenuItem(label, nullptr, false, enabled);
      ui::note(std::string("history/menu/") + id);
      return pressed;
    };
    if (open) {
      if (item("go", "Go to this mesh", true)) context.emit(action::GoToStep{position});
      if (item("edit", "Edit...", free)) context.emit(action::ShowStepEditor{position});
      if (item("record", "Record again...", free)) context.emit(action::ShowRecordDialog{position});
      if (item("delete", "Delete", free)) context.emit(action::DeleteStep{position});
      ImGui::EndPopup();
    }
    ImGui::PopStyleVar(2);
  }

  void draw_buttons(const PanelContext& context) {
    const std::size_t position = context.session.document()->history().position();
    const bool free = !context.session.in_motion(), any = position > 0;
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
    const auto button = [&](const char* id, const char* label, const char* tip, bool can,
                            const Action& action) {
      if (ui::button(id, label, {tip, ui::ButtonStyle::normal, can, width}))
        context.actions.push_back(action);
    };
    button("history/edit", "Edit step...",
           "Change the numbers and options of the step that led to the mesh shown, and run it and "
           "those after it again.",
           any && free, action::ShowStepEditor{position});
    ImGui::SameLine(0, gap);
    button("history/delete", "Delete step",
           "Take this step out and run those after it again. The history as it is now is kept "
           "below.",
           any && free, action::DeleteStep{position});
    button(
        "history/save_recipe", "Save recipe...",
        "Write the commands up to the mesh shown to a file, for this panel or \"winslow replay\" "
        "to run again.",
        any, action::ShowFileDialog{FilePurpose::export_recipe});
    ImGui::SameLine(0, gap);
    button("history/replay", "Replay recipe...",
           "Apply the commands of a recipe to this mesh, one after the other.", free,
           action::ShowFileDialog{FilePurpose::replay_recipe});
  }

  void draw_queue(const PanelContext& context) {
    const CommandQueue& queue = context.session.jobs().queue();
    if (!queue.active()) return;
    ui::text_wrapped(queue.plan().title + ": command " + std::to_string(queue.done() + 1) + " of " +
                     std::to_string(queue.total()));
    const float share = static_cast<float>(queue.done()) / static_cast<float>(queue.total());
    ImGui::ProgressBar(share, ImVec2(-FLT_MIN, context.theme.px(6)), "");
    ui::note("history/progress");
    if (ui::button(
            "history/cancel", "Cancel",
            {queue.plan().revision ? "Stop and put the history back as it was before the change."
                                   : "Stop; what was carried out stays in the history.",
             ui::ButtonStyle::normal, true, -1}))
      context.emit(action::CancelSolver{});
  }

  void draw_kept(const PanelContext& context) {
    const auto& kept = context.session.document()->edits().kept();
    if (kept.empty()) return;
    ImGui::Spacing();
    ui::text_dim("Replaced histories");
    ui::tooltip("What an edit replaced stays here: the last " +
                std::to_string(EditHistory::most_kept) + " of them, until another mesh is opened.");
    const float button = context.theme.px(86);
    for (std::size_t k = 0; k < kept.size(); ++k) {
      const std::string& text = kept[k].why;
      ImGui::AlignTextToFramePadding();
      const float room = ImGui::GetContentRegionAvail().x;
      const float start = ImGui::GetCursorPosX();
      ImGui::TextUnformatted(ui::elided(text, room - button - context.theme.px(8)).c_str());
      ui::tooltip(text + ": " + counted(kept[k].history.size() - 1, "command"));
      ImGui::SameLine(start + room - button);
      if (ui::button("history/kept/" + std::to_string(k), "Bring back",
                     {"Put this history in place of the present one, which is kept here instead.",
                      ui::ButtonStyle::normal, !context.session.in_motion(), button}))
        context.emit(action::BringBack{k});
    }
  }

  std::size_t shown_size_ = 0;  // a new step scrolls into view
};

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
  return options ? options->slide.reference : std::string();
}

void StepEditor::set_reference(const std::filesystem::path& file) {
  SmoothOptions* options = smooth_options(command_);
  if (!open_ || !options) return;
  // Recipes and sessions may be read from another working folder.
  std::error_code failed;
  const std::filesystem::path whole = std::filesystem::absolute(file, failed);
  options->slide.reference = (failed ? file : whole.lexically_normal()).string();
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
  // The reference has a separate row, which can choose a file.
  const std::string name = std::exchange(options->slide.reference, {});
  ui::command_form("edit", command_, kind);
  options = smooth_options(command_);
  options->slide.reference = name;
  switch (reference_row(context.theme, "edit/reference", name)) {
    case ReferenceAsk::choose:
      aside_ = true;
      return context.emit(action::ShowFileDialog{FilePurpose::step_reference});
    case ReferenceAsk::clear:
      options->slide.reference.clear();
      break;
    case ReferenceAsk::nothing:
      break;
  }
}

void StepEditor::draw(const PanelContext& context) {
  if (!open_ || aside_) return;
  if (generation_ == 0) generation_ = context.session.generation();
  const ImVec2 screen = ImGui::GetMainViewport()->Size;
  const ui::Modal window(
      "###step_editor", std::exchange(wanted_, false), context.theme,
      {ImVec2(18, 14), ImVec2(std::min(context.theme.px(460), screen.x * 0.94f),
                              std::min(context.theme.px(620), screen.y * 0.92f))});
  if (!window.shown()) {
    open_ = false;
    return;
  }
  ui::text_in(context.theme.bold, ui::elided(title_, ImGui::GetContentRegionAvail().x));
  ui::note("edit/title");
  const float footer = 2 * ImGui::GetFrameHeightWithSpacing() + context.theme.px(8);
  ImGui::BeginChild("fields", ImVec2(0, -footer));
  draw_fields(context);
  ImGui::EndChild();
  draw_footer(context);
  if (aside_) ImGui::CloseCurrentPopup();
  // Another mesh was opened meanwhile, by a dropped file.
  if (generation_ != context.session.generation()) close();
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

DrawPanel history_panel() { return panel_of<HistoryPanel>(); }

}  // namespace winslow::gui
