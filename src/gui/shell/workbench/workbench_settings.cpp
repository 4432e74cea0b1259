#include <algorithm>
#include <cmath>

#include "gui/shell/workbench/workbench.h"

namespace winslow::gui {

/// What was chosen, or what the screen wants; less where the window is too small for that, or the
/// buttons of a prompt would lie outside it.
float Workbench::scale() const {
  return fitting_scale(view_.scale > 0 ? view_.scale : static_cast<double>(options_.scale));
}

float Workbench::fitting_scale(double wanted) const {
  // Of a layout in which tables and labels have room; a window can be made hardly smaller.
  constexpr double least_width = 720, least_height = 450;
  const double fits = std::min(width_ / least_width, height_ / least_height);
  if (wanted <= fits) return static_cast<float>(wanted);
  double largest = scales.front();
  for (const double s : scales)
    if (s <= fits) largest = s;
  return static_cast<float>(std::min(wanted, largest));
}

void Workbench::on(const action::EditView& a) {
  const double before = view_.scale;
  a.edit.apply_to(view_);
  const bool scaled = view_.scale != before && view_.scale > 0;
  if (!scaled || static_cast<double>(scale()) >= view_.scale - 1e-3) return;
  session_.messages().tell(
      Notice::Kind::information,
      "This window has room for " + std::to_string(std::lround(100 * scale())) + " % only");
}

void Workbench::on(const action::StepScale& a) {
  if (a.by == 0) {
    view_.scale = 0;
    return;
  }
  const auto tell = [&](const char* text) {
    session_.messages().tell(Notice::Kind::information, text);
  };
  const auto now = static_cast<double>(scale());
  const auto up = std::ranges::find_if(scales, [&](double s) { return s > now + 1e-3; });
  const auto here = std::ranges::find_if(scales, [&](double s) { return s > now - 1e-3; });
  if (a.by < 0) {
    if (here == scales.begin()) return tell("The interface is as small as it gets");
    view_.scale = *(here - 1);
    return;
  }
  if (up == scales.end()) return tell("The interface is as large as it gets");
  if (static_cast<double>(fitting_scale(*up)) < *up - 1e-3)
    return tell("This window has no room for a larger interface");
  view_.scale = *up;
}

Settings Workbench::settings() const {
  Settings settings;
  settings.view = view_;
  settings.left_width = layout_.left_width;
  settings.right_width = layout_.right_width;
  settings.plot_height = layout_.plot_height;
  settings.folded = ui_->folded();
  settings.recent = recent_.paths();
  // The screen's own scale: a window has its size whatever the user makes of what is in it.
  settings.window = {static_cast<int>(std::lround(static_cast<float>(width_) / options_.scale)),
                     static_cast<int>(std::lround(static_cast<float>(height_) / options_.scale))};
  return settings;
}

void Workbench::take_settings(const Settings& settings) {
  view_ = settings.view;
  if (settings.left_width > 0) layout_.left_width = settings.left_width;
  if (settings.right_width > 0) layout_.right_width = settings.right_width;
  if (settings.plot_height > 0) layout_.plot_height = settings.plot_height;
  ui_->folded() = settings.folded;
  recent_.set(settings.recent);
}

void Workbench::keep_settings(double seconds) {
  settings_file_.keep(settings(), seconds);
  if (const std::string problem = settings_file_.take_problem(); !problem.empty())
    session_.messages().tell(Notice::Kind::warning, problem);
}

}  // namespace winslow::gui
