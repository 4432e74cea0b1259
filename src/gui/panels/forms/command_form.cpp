#include "gui/panels/forms/command_form.h"

#include <vector>

#include "core/command/option_tables.h"
#include "core/layers/layer_option_tables.h"
#include "core/motion/motion_options.h"
#include "gui/base/text.h"
#include "gui/panels/forms/option_form.h"
#include "gui/panels/forms/quality_limits_form.h"
#include "gui/panels/forms/smooth_options_form.h"
#include "gui/widgets/controls.h"

namespace winslow::gui::ui {

namespace {

class CommandFields {
 public:
  CommandFields(const std::string& prefix, MeshKind kind) : prefix_(prefix), kind_(kind) {}
  bool changed() const { return changed_; }

  /// Of a command that its table describes.
  template <class EditCommand>
  requires(!EditCommand::beyond_table) void operator()(EditCommand& command) {
    rows(option_table(command));
    if constexpr (requires { command.smooth; }) smoothing(command.smooth);
  }

  void operator()(MoveCommand& command) {
    rows(option_table(command.motion));
    motion(command.how, command.smooth);
  }

  void operator()(DeformCommand& command) {
    if (auto* sine = std::get_if<SineDeformation>(&command.shape)) {
      rows(option_table(*sine));
    } else {
      const auto& table = std::get<DisplacementTable>(command.shape);
      text_wrapped(counted(table.entries.size(), "displacement") +
                   (table.source.empty() ? "" : " from " + table.source) +
                   "; they cannot be changed here.");
    }
    motion(command.how, command.smooth);
  }

  void operator()(LayersCommand& command) {
    if (command.task == LayerTask::hold) {
      text_wrapped("The layers keep the heights that they have.");
      return smoothing(command.smooth);
    }
    for (std::size_t w = 0; w < command.layers.walls.size(); ++w)
      wall(command.layers.walls[w], prefix_ + "/wall" + std::to_string(w));
    OptionTable table = option_table(command);
    std::erase_if(table, [](const Option& option) { return option.key == "task"; });
    rows(table);
    smoothing(command.smooth);
  }

  void operator()(EditVcvCommand& command) {
    text_wrapped(counted(command.edits.size(), "virtual control volume") +
                 (command.edits.size() == 1 ? "; its" : "; their") +
                 " angles and lengths are changed in the tab VCV.");
    smoothing(command.smooth);
  }

 private:
  void wall(LayerWall& wall, const std::string& prefix) {
    std::string markers;
    for (const std::string& marker : wall.markers)
      markers += (markers.empty() ? "" : ", ") + marker;
    text_wrapped("Layers at " + markers);
    changed_ |= option_form(prefix, option_table(wall.spacing));
  }

  void motion(MotionOptions& how, SmoothOptions& smooth) {
    changed_ |= method_choice(prefix_, smooth, how);
    OptionTable table = option_table(how);
    std::erase_if(table, [](const Option& option) { return option.object == "min_quality"; });
    rows(table);
    changed_ |= quality_limits_form(prefix_, how.floor, cell_dimension_of(kind_),
                                    follows_path(how, smooth));
    if (how.smooth_after) smoothing(smooth);
  }

  void rows(const OptionTable& table) { changed_ |= option_form(prefix_, table); }

  void smoothing(SmoothOptions& smooth) { changed_ |= smooth_options_form(prefix_, smooth, kind_); }

  const std::string& prefix_;
  MeshKind kind_;
  bool changed_ = false;
};

}  // namespace

bool command_form(const std::string& prefix, Command& command, MeshKind kind) {
  CommandFields form(prefix, kind);
  std::visit(form, command);
  return form.changed();
}

}  // namespace winslow::gui::ui
