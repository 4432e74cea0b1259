#include "gui/panels/menu_bar.h"

#include <string>

#include "gui/widgets/controls.h"

namespace winslow::gui {

namespace {

bool menu(const char* name) {
  const bool open = ImGui::BeginMenu(name);
  ui::note(std::string("menu/") + name);
  return open;
}

bool item(const char* id, const char* label, const char* keys, bool enabled = true,
          bool checked = false) {
  const bool pressed = ImGui::MenuItem(label, keys, checked, enabled);
  ui::note(std::string("menu/") + id);
  return pressed;
}

}  // namespace

void MenuBar::draw(const PanelContext& context) {
  if (menu("File")) {
    draw_file(context);
    ImGui::EndMenu();
  }
  if (menu("Edit")) {
    draw_edit(context);
    ImGui::EndMenu();
  }
  if (menu("Solver")) {
    draw_solver(context);
    ImGui::EndMenu();
  }
  if (menu("View")) {
    draw_view(context);
    ImGui::EndMenu();
  }
  if (menu("Help")) {
    if (item("help", "Keys and mouse", "F1")) context.emit(action::ShowHelp{});
    ImGui::EndMenu();
  }
}

void MenuBar::draw_file(const PanelContext& context) {
  const Document* document = context.session.document();
  const bool can_save = document && !context.session.in_motion() && !context.session.saving();
  const auto dialog = [&](action::FilePurpose purpose) {
    context.emit(action::ShowFileDialog{purpose});
  };
  if (item("open", "Open mesh...", "Ctrl+O")) dialog(action::FilePurpose::open_mesh);
  ImGui::Separator();
  if (item("save", "Save", "Ctrl+S", can_save)) context.emit(action::SaveMesh{});
  if (item("save_as", "Save as...", "Ctrl+Shift+S", can_save))
    dialog(action::FilePurpose::save_mesh);
  if (item("recipe", "Export recipe...", "Ctrl+E", document && document->history().position() > 0))
    dialog(action::FilePurpose::export_recipe);
  ui::tooltip("Write the commands of this session to a file that \"winslow replay\" runs.");
  ImGui::Separator();
  if (item("screenshot", "Save picture", "F12")) context.emit(action::TakeScreenshot{});
  if (item("screenshot_as", "Save picture as...", "Shift+F12"))
    dialog(action::FilePurpose::screenshot);
  ImGui::Separator();
  if (item("quit", "Quit", "Ctrl+Q")) context.emit(action::Quit{});
}

void MenuBar::draw_edit(const PanelContext& context) {
  const Document* document = context.session.document();
  const bool busy = context.session.in_motion();
  const History* history = document ? &document->history() : nullptr;
  std::string undo = "Undo";
  std::string redo = "Redo";
  if (history && history->can_undo())
    undo += ": " + describe(history->command(history->position()));
  if (history && history->can_redo())
    redo += ": " + describe(history->command(history->position() + 1));
  if (item("undo", undo.c_str(), "Ctrl+Z", history && (busy || history->can_undo())))
    context.emit(action::Undo{});
  if (item("redo", redo.c_str(), "Ctrl+Shift+Z", history && !busy && history->can_redo()))
    context.emit(action::Redo{});
  if (item("reset", "Reset to the mesh as opened", "Ctrl+R",
           history && (busy || history->position() > 0)))
    context.emit(action::GoToStep{0});
  ImGui::Separator();
  if (item("select_none", "Select nothing", "Esc", !context.session.selection().empty()))
    context.emit(action::SelectMarkers{});
  ImGui::Separator();
  if (item("scramble", "Scramble the interior", nullptr, document && !busy))
    context.emit(action::Scramble{1});
  ui::tooltip("Put every interior node at a random place: a test of what smoothing can recover.");
}

void MenuBar::draw_solver(const PanelContext& context) {
  const JobRunner& job = context.session.job();
  const bool open = context.session.document() != nullptr;
  const bool dragging = context.session.dragging();
  if (job.active() && !job.paused()) {
    if (item("pause", "Pause", "Space", !dragging)) context.emit(action::PauseSolver{});
  } else if (item("run", job.paused() ? "Resume" : "Smooth", "Space", open)) {
    context.emit(action::RunSmooth{});
  }
  if (item("step", "Single step", "N", open && !dragging)) context.emit(action::StepSolver{1});
  if (item("step10", "Ten steps", "Shift+N", open && !dragging))
    context.emit(action::StepSolver{10});
  if (item("cancel", "Cancel", "Esc", job.active())) context.emit(action::CancelSolver{});
}

void MenuBar::draw_view(const PanelContext& context) {
  const bool open = context.session.document() != nullptr;
  if (item("fit", "Fit the whole mesh", "F", open)) context.emit(action::FitView{});
  if (item("fit_selection", "Fit the selection", "Shift+F",
           open && !context.session.selection().empty()))
    context.emit(action::FitSelection{});
  ImGui::Separator();
  ViewOptions view = context.view;
  bool changed = false;
  const auto toggle = [&](const char* id, const char* label, const char* keys, bool& value) {
    if (!item(id, label, keys, true, value)) return;
    value = !value;
    changed = true;
  };
  if (item("style", "Next style of elements", "W")) {
    step_style(view);
    changed = true;
  }
  toggle("nodes", "Nodes", nullptr, view.nodes);
  toggle("legend", "Legend", "L", view.legend);
  ImGui::Separator();
  toggle("left", "Bodies and solver", "F2", view.left_panel);
  toggle("right", "Quality and history", "F3", view.right_panel);
  toggle("plot", "Convergence", "F4", view.plot_panel);
  ImGui::Separator();
  bool dark = view.lightness == Lightness::dark;
  toggle("dark", "Dark theme", "Ctrl+D", dark);
  view.lightness = dark ? Lightness::dark : Lightness::light;
  if (item("larger", "Larger interface", "Ctrl+plus")) context.emit(action::StepScale{1});
  if (item("smaller", "Smaller interface", "Ctrl+minus")) context.emit(action::StepScale{-1});
  if (item("scale", "Scale of the screen", "Ctrl+0", view.scale > 0))
    context.emit(action::StepScale{0});
  if (changed) context.emit(action::SetView{view});
}

}  // namespace winslow::gui
