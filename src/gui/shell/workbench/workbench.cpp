#include "gui/shell/workbench/workbench.h"

#include <imgui_internal.h>

#include "gui/files/assets.h"
#include "gui/menu/user_command.h"
#include "gui/panels/files/file_dialog.h"

namespace winslow::gui {

namespace {

// If its key is held longer than this, releasing it switches the magnifier off.
constexpr float tap_seconds = 0.4f;

bool magnifier_let_go() {
  return ImGui::GetIO().KeysDownDurationPrev[GLFW_KEY_M] > tap_seconds &&
         ImGui::IsKeyReleased(GLFW_KEY_M);
}

bool popup_open() {
  return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

/// Makes Esc close an open list or menu, without other effects. Dear ImGui does this only with
/// keyboard navigation.
void close_list() {
  ImGuiContext& g = *ImGui::GetCurrentContext();
  if (g.OpenPopupStack.empty() || !ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) return;
  const ImGuiWindow* window = g.OpenPopupStack.back().Window;
  if (!window) return;
  const std::string_view name = window->Name;
  if (!name.starts_with("##Combo_") && !name.starts_with("##Menu_")) return;
  ImGui::ClosePopupToLevel(g.OpenPopupStack.Size - 1, true);
  g.IO.KeysDownDuration[GLFW_KEY_ESCAPE] = g.IO.DeltaTime;  // no longer just pressed
}

}  // namespace

Workbench::Workbench(const WorkbenchOptions& options)
    : demo_meshes_(options.demo_meshes),
      settings_file_(options.profile),
      window_(options.scale),
      autosave_(options.profile),
      view_control_(session_, options.scale),
      pictures_({session_, context(), view_control_.camera(), view_control_.space().view(), window_,
                 regions_, pane_}) {
  restore_settings(settings_file_.initial(), view_control_, window_, opened_files_.recent());
}

Workbench::~Workbench() {
  if (session_.files().quit_accepted()) autosave_.finish();
}

void Workbench::apply(const Action& action) {
  std::visit([this](const auto& group) { apply_group(group); }, action);
}

bool Workbench::poll() {
  const bool drawn = pane_.poll();
  const bool captured = capture_.poll();
  const bool pictured = regions_.shows_welcome(session_) && regions_.welcome().busy();
  const bool changed = session_.poll();
  return autosave_.update(session_) || drawn || captured || pictured || changed;
}

bool Workbench::settled() const {
  if (session_.working() || pane_.busy() || capture_.busy() || dialogs_.file_dialog().busy())
    return false;
  if (demo_.demo() && (demo_.automatic() || !demo_.ready(session_))) return false;
  if (regions_.shows_welcome(session_) && regions_.welcome().busy()) return false;
  if (!session_.document()) return true;
  const ViewOptions& view = view_control_.options();
  return session_.quality().up_to_date(view.color, view.before);
}

void Workbench::update(InputQueue& queue, int width, int height, double seconds) {
  const InputState input = queue.next_frame(key_gate_.keys());
  window_.width = std::max(width, 1);
  window_.height = std::max(height, 1);
  poll();
  if (auto next = session_.files().take_next()) actions_.push_back(std::move(*next));
  // Call this before the layout of the panels, which refer to the mesh in the picture.
  pane_.follow_mesh(view_control_.options(), theme().scale);
  const ViewOptions& view = view_control_.options();
  view_control_.scale().set_window(window_.width, window_.height);
  window_.ui.set_scale(view_control_.scale().of(view.scale));
  window_.ui.set_palette(view.lightness == Lightness::dark ? dark_palette() : light_palette());
  window_.ui.begin(input, window_.width, window_.height, seconds);
  demo_.update(session_, seconds, actions_);
  take_input(input);
  draw_window(input);
  view_control_.navigator().observe(pane_.mouse_busy(), seconds);
  dispatch();
  finish_frame();
  const ShownMesh* shown = pane_.mesh_view().shown();
  key_gate_.after_frame(input, session_.document() ? std::optional(session_.shape()) : std::nullopt,
                        shown ? std::optional(shown->shape) : std::nullopt);
  opened_files_.update(session_, seconds);
  pictures_.forget_idle(seconds);
  keep_settings(seconds);
}

void Workbench::draw_window(const InputState& input) {
  const PanelContext shown = context();
  regions_.draw_menu(shown, window_);
  view_control_.set_columns(window_.layout.columns);
  const Area& v = window_.layout.viewport;
  if (view_control_.begin_frame(v.x, v.y, v.width, v.height)) regions_.welcome().close();
  regions_.draw(shown, window_.layout);
  if (const auto divided = regions_.drag_splitters(shown, window_.layout))
    view_control_.move_divider(static_cast<double>(*divided / v.width));
  regions_.draw_over_mesh(shown, v, Regions::Cards::all);
  const auto card = demo_.demo() ? widgets().find("demo/card") : std::nullopt;
  view_control_.navigator().set_card(card ? std::optional(ScreenBox{card->min, card->max})
                                          : std::nullopt);
  dialogs_.draw(shown, ScreenVector(window_.width, window_.height),
                ScreenVector(v.width, v.height));
  pane_.drive(input, shown, window_.layout);
}

void Workbench::take_input(const InputState& input) {
  if (auto open = opened_files_.drop(input.dropped)) actions_.push_back(std::move(*open));
  const bool listed = popup_open();
  close_list();
  if (listed || window_.ui.wants_keyboard()) return;
  if (view_control_.state().box_zoom_armed && ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false))
    return view_control_.disarm_box_zoom();
  if (view_control_.state().ruler && ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false))
    return view_control_.put_ruler_away();
  if (magnifier_let_go()) view_control_.release_magnifier();
  handle_shortcuts(context(), pane_.dragging());
}

void Workbench::dispatch() {
  view_control_.end_requests();
  // Actions may add others (a choice in a dialog), which are carried out in the same frame.
  for (std::size_t i = 0; i < actions_.size(); ++i) {
    const Action action = actions_[i];
    apply(action);
  }
  actions_.clear();
}

void Workbench::finish_frame() {
  if (view_control_.look_at_another()) regions_.welcome().close();
  pane_.measure_selection();
  // No measurement runs during the first picture of a large mesh.
  if (!session_.in_space() || pane_.mesh_view().shown())
    session_.quality().watch(view_control_.options().color, view_control_.options().before);
  pane_.update(view_control_.options(), view_control_.view(), theme().scale);
  const PanelContext shown = context();
  pane_.draw_overlays(*ImGui::GetBackgroundDrawList(),
                      {shown, view_control_.view(), layout(), pane_.lens(),
                       session_.in_space() ? &view_control_.space().view() : nullptr});
  window_.ui.end();
  capture_.after_frame(pictures_);
}

std::string Workbench::title() const {
  const Document* document = session_.document();
  if (!document) return "winslow";
  const std::string zone = document->source().zone_text();
  return (document->modified() ? "* " : "") + document->name() + (zone.empty() ? "" : ", " + zone) +
         " - winslow";
}

void Workbench::on(const action::RestoreSession& a) {
  if (a.discard_changes || !session_.files().unsaved()) return autosave_.restore(a.folder);
  session_.files().ask_to_save(a, action::RestoreSession{a.folder, true});
}

void Workbench::on(const action::StartDemo& a) {
  const Demo* demo = find_demo(a.id);
  if (!demo) return;
  if (session_.files().unsaved() && !a.discard_changes)
    return session_.files().ask_to_save(a, action::StartDemo{a.id, true});
  regions_.welcome().close();
  demo_.start(*demo, demo_meshes_.empty() ? assets_folder() : demo_meshes_, session_, actions_);
}

void Workbench::on(const action::EndDemo&) {
  demo_.end();
  view_control_.navigator().set_card(std::nullopt);
}

void Workbench::on(const action::EditField& a) {
  ViewOptions view = view_control_.options();
  view.left_panel = true;
  view_control_.set_options(view);
  window_.ui.want_keyboard(a.field);
}

void Workbench::on(const action::CopyText& a) {
  window_.ui.make_current();
  ImGui::SetClipboardText(a.text.c_str());
  session_.messages().tell(Notice::Kind::information, "Copied: " + a.text);
}

void Workbench::keep_settings(double seconds) {
  settings_file_.keep(settings(), seconds);
  if (const std::string problem = settings_file_.take_problem(); !problem.empty())
    session_.messages().tell(Notice::Kind::warning, problem);
}

}  // namespace winslow::gui
