#include <algorithm>
#include <cmath>

#include "gui/base/text.h"
#include "gui/files/assets.h"
#include "gui/shell/workbench/workbench.h"

namespace winslow::gui {

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
  view_control_.set_card(std::nullopt);
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

/// One mesh at a time: of several files dropped together, the first.
void Workbench::take_dropped(const InputState& input) {
  if (input.dropped.empty()) return;
  dropped_ = input.dropped.size();
  actions_.emplace_back(action::OpenMesh{input.dropped.front()});
}

/// Keeps the list of recent files in step with what is open.
void Workbench::follow_files(double seconds) {
  recent_.update(seconds);
  const Document* document = session_.document();
  const auto path = document ? document->path() : std::filesystem::path();
  if (path == shown_path_) return;
  shown_path_ = path;
  if (path.empty()) return;
  recent_.add(path);
  if (dropped_ > 1)
    session_.messages().tell(Notice::Kind::warning,
                             "Opened " + document->name() + ", the first of " +
                                 counted(dropped_, "file") +
                                 " that were dropped: the studio shows one mesh at a time.");
  dropped_ = 0;
}

Settings Workbench::settings() const {
  Settings settings;
  settings.view = view_control_.options();
  settings.left_width = window_.layout.left_width;
  settings.right_width = window_.layout.right_width;
  settings.plot_height = window_.layout.plot_height;
  settings.folded = window_.ui.folded();
  settings.views = view_control_.space().views(view_control_.options());
  settings.recent = recent_.paths();
  const float scale = view_control_.scale().screen();
  // The screen's own scale: a window has its size whatever the user makes of what is in it.
  settings.window = {static_cast<int>(std::lround(static_cast<float>(window_.width) / scale)),
                     static_cast<int>(std::lround(static_cast<float>(window_.height) / scale))};
  return settings;
}

void Workbench::take_settings(const Settings& settings) {
  view_control_.set_options(settings.view);
  if (settings.left_width > 0) window_.layout.left_width = settings.left_width;
  if (settings.right_width > 0) window_.layout.right_width = settings.right_width;
  if (settings.plot_height > 0) window_.layout.plot_height = settings.plot_height;
  window_.ui.folded() = settings.folded;
  view_control_.space().set_views(settings.views);
  recent_.set(settings.recent);
}

void Workbench::keep_settings(double seconds) {
  settings_file_.keep(settings(), seconds);
  if (const std::string problem = settings_file_.take_problem(); !problem.empty())
    session_.messages().tell(Notice::Kind::warning, problem);
}

}  // namespace winslow::gui
