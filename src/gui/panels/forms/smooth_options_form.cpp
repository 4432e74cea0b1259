#include "gui/panels/forms/smooth_options_form.h"

#include <vector>

#include "core/strategy/surface_options.h"
#include "gui/document/jobs/method.h"
#include "gui/panels/forms/option_form.h"
#include "gui/widgets/controls.h"

namespace winslow::gui::ui {

bool method_choice(const std::string& prefix, SmoothOptions& smooth, MotionOptions& motion,
                   float label_share) {
  constexpr const char* tip =
      "Path following: the mesh follows the moving boundary through valid meshes only. The "
      "default; change nothing unless you want to see the other.\n"
      "Direct: the paper's outer iteration. The boundary goes to its place at once, which tangles "
      "the mesh, and the iteration untangles it. Every iteration is shown.";
  std::vector<std::string> names{"Path following", "Direct (the paper's)"};
  auto chosen = static_cast<std::size_t>(method_of(smooth, motion));
  if (chosen == names.size()) names.emplace_back("Custom (see Advanced)");
  row("Method", tip, label_share);
  if (!combo(prefix + "/method", names, chosen, tip)) return false;
  use_method(static_cast<Method>(chosen), smooth, motion);
  return true;
}

bool smooth_options_form(const std::string& prefix, SmoothOptions& options, MeshKind kind) {
  const auto table = [&] {
    return kind == MeshKind::surface ? surface_option_table(options) : option_table(options);
  };
  if (!option_form(prefix, table())) return false;
  // What was chosen may not go with the other choices; the rows of a new table know.
  settle(table());
  return true;
}

}  // namespace winslow::gui::ui
