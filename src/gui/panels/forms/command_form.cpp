#include "gui/panels/forms/command_form.h"

#include <limits>
#include <vector>

#include "gui/base/text.h"
#include "gui/panels/forms/smooth_options_form.h"
#include "gui/widgets/controls.h"

namespace winslow::gui::ui {

namespace {

class CommandFields {
 public:
  explicit CommandFields(const std::string& prefix) : prefix_(prefix) {}
  bool changed() const { return changed_; }

  void operator()(SmoothCommand& command) { options(command.smooth); }

  void operator()(MoveCommand& command) {
    vector("dx", "dy", "Translate", command.motion.translate,
           "How far the body moves, x and y, in units of the mesh.");
    field("rotate", "Rotate", command.motion.rotate,
          "Degrees about the pivot, counter-clockwise positive.", "%.6g\xC2\xB0");
    vector("pivot_x", "pivot_y", "Pivot", command.motion.pivot,
           "The point about which the body turns, in units of the mesh.");
    motion(command.how, command.smooth);
  }

  void operator()(DeformCommand& command) {
    if (auto* sine = std::get_if<SineDeformation>(&command.shape)) {
      deformation(*sine);
    } else {
      const auto& table = std::get<DisplacementTable>(command.shape);
      text_wrapped(counted(table.entries.size(), "displacement") +
                   (table.source.empty() ? "" : " from " + table.source) +
                   "; they cannot be changed here.");
    }
    motion(command.how, command.smooth);
  }

  void operator()(ScrambleCommand& command) {
    constexpr const char* tip = "Another seed, other random places.";
    row("Seed", tip);
    // The field holds whole numbers of 32 bits; a larger seed from a recipe stays until it is
    // typed over.
    auto seed = static_cast<int>(command.seed & 0x7fffffffu);
    if (!number(prefix_ + "/seed", seed, tip) || seed < 0) return;
    command.seed = static_cast<std::uint64_t>(seed);
    changed_ = true;
  }

  void operator()(LayersCommand& command) {
    if (command.task == LayerTask::hold) {
      text_wrapped("The layers keep the heights that they have.");
      return options(command.smooth);
    }
    for (std::size_t w = 0; w < command.layers.walls.size(); ++w)
      wall(command.layers.walls[w], "wall" + std::to_string(w) + "_");
    if (command.task == LayerTask::insert) insertion(command);
    field("clearance", "Clearance", command.layers.clearance,
          "Share of a gap's width that the layers of either side may take, below 0.5.");
    options(command.smooth);
  }

  void operator()(EditVcvCommand& command) {
    text_wrapped(counted(command.edits.size(), "virtual control volume") +
                 (command.edits.size() == 1 ? "; its" : "; their") +
                 " angles and lengths are changed in the tab VCV.");
    options(command.smooth);
  }

 private:
  void insertion(LayersCommand& command) {
    row("");
    changed_ |= checkbox(prefix_ + "/control", "Hold the spacing", command.control,
                         "Ask for the heights through the virtual control volumes. Off: smoothing "
                         "spreads the layers as it likes.");
    row("");
    changed_ |= checkbox(prefix_ + "/fans", "Fans at sharp corners", command.layers.fans,
                         "Several columns at sharp convex corners, such as a trailing edge.");
    if (command.layers.fans)
      field("fan_angle", "Fan angle", command.layers.fan_angle,
            "Between neighbouring columns of a fan, degrees.");
  }

  void wall(LayerWall& wall, const std::string& name) {
    std::string markers;
    for (const std::string& marker : wall.markers)
      markers += (markers.empty() ? "" : ", ") + marker;
    text_wrapped("Layers at " + markers);
    constexpr const char* tip = "Number of layers.";
    row("Count", tip);
    int count = wall.spacing.count;
    if (number(prefix_ + '/' + name + "count", count, tip) && count > 0) {
      wall.spacing.count = count;
      changed_ = true;
    }
    field(name + "first", "First height", wall.spacing.first,
          "Height of the layer at the wall, in units of the mesh.");
    field(name + "ratio", "Ratio", wall.spacing.ratio, "Of the second height to the first.");
    field(name + "growth", "Growth", wall.spacing.growth, "Of the ratio, from layer to layer.");
    if (wall.spacing.total)
      field(name + "total", "Thickness", *wall.spacing.total,
            "Of all layers, in units of the mesh; it gives the ratio.");
  }

  void deformation(SineDeformation& sine) {
    field("amplitude", "Amplitude", sine.amplitude, "Largest displacement, in units of the mesh.");
    field("waves", "Waves", sine.waves, "Full periods over the length of the body.");
    vector("direction_x", "direction_y", "Direction", sine.direction,
           "In which the nodes are displaced. Its length does not matter.");
    constexpr const char* tip = "At which ends the displacement fades to nothing.";
    row("Fade", tip);
    auto chosen = static_cast<std::size_t>(sine.fade);
    if (combo(prefix_ + "/fade", {"None", "Start", "End", "Both"}, chosen, tip)) {
      sine.fade = static_cast<Fade>(chosen);
      changed_ = true;
    }
    if (sine.fade != Fade::none)
      field("fade_length", "Fade length", sine.fade_length,
            "Share of the body's length over which it fades, at most 0.5.");
  }

  void motion(MotionOptions& how, SmoothOptions& smooth) {
    changed_ |= method_choice(prefix_, smooth, how);
    constexpr const char* tip =
        "Steps in which the boundary moves, each followed by smoothing. 0: along the path through "
        "valid meshes; 1: at once, as in the paper.";
    row("Steps", tip);
    int increments = how.increments;
    if (number(prefix_ + "/increments", increments, tip) && increments >= 0) {
      how.increments = increments;
      changed_ = true;
    }
    row("");
    changed_ |= checkbox(prefix_ + "/smooth_after", "Smooth afterwards", how.smooth_after,
                         "Off: only the boundary moves, the interior stays.");
    if (how.smooth_after) options(smooth);
  }

  void options(SmoothOptions& smooth) { changed_ |= smooth_options_form(prefix_, smooth); }

  void field(const std::string& name, const char* label, double& value, std::string_view tip,
             const char* format = "%.6g") {
    row(label, tip);
    changed_ |= number(prefix_ + '/' + name, value, tip, format);
  }

  void vector(const char* x, const char* y, const char* label, Vec2& value, std::string_view tip) {
    row(label, tip);
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
    for (int axis : {0, 1}) {
      if (axis == 1) ImGui::SameLine(0, gap);
      ImGui::SetNextItemWidth(width);
      double component = value[axis];
      if (!number(prefix_ + '/' + (axis == 0 ? x : y), component, tip)) continue;
      value[axis] = component;
      changed_ = true;
    }
  }

  const std::string& prefix_;
  bool changed_ = false;
};

}  // namespace

bool command_form(const std::string& prefix, Command& command) {
  CommandFields form(prefix);
  std::visit(form, command);
  return form.changed();
}

}  // namespace winslow::gui::ui
