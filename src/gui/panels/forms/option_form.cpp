#include "gui/panels/forms/option_form.h"

#include "core/command/option_tables.h"
#include "core/layers/layer_plan.h"
#include "core/motion/motion.h"
#include "core/strategy/smooth_options.h"
#include "gui/base/text.h"
#include "gui/document/jobs/run_settings.h"
#include "gui/widgets/controls.h"

namespace winslow::gui::ui {

namespace {

std::string id_of(const std::string& prefix, const Option& option) {
  std::string name(option.flag);
  if (name.empty() && !option.object.empty()) name = std::string(option.object) + '_';
  if (option.flag.empty()) name += option.key;
  return prefix + '/' + name;
}

std::string item_tip(std::string_view label, std::string_view help) {
  return help.empty() ? "" : "\n" + std::string(label) + ": " + std::string(help) + '.';
}

std::string tip_of(const Option& option) {
  std::string tip(option.help);
  if (!option.unit.empty()) tip += ", in " + std::string(option.unit);
  tip += '.';
  if (!option.advice.empty()) tip += ' ' + std::string(option.advice);
  if (const auto* choice = std::get_if<ChoiceOption>(&option.value)) {
    for (const ChoiceItem& item : choice->items())
      if (item.applies) tip += item_tip(item.label, item.help);
  } else if (const auto* shares = std::get_if<SharesOption>(&option.value)) {
    for (const auto& part : shares->choices()) tip += item_tip(part.label, part.help);
  }
  return tip;
}

/// True for a vector of three components.
bool is_long(const OptionValue& value) {
  if (const auto* vector = std::get_if<VectorOption>(&value))
    return vector->value->numbers(vector->numbers) == 3;
  if (const auto* vector = std::get_if<OptionalVectorOption>(&value))
    return *vector->value && (*vector->value)->numbers(vector->numbers) == 3;
  return std::holds_alternative<SpaceVectorOption>(value);
}

/// Draws the field of an option; returns true if its value changed.
class Field {
 public:
  Field(const std::string& prefix, const Option& option)
      : option_(option), id_(id_of(prefix, option)), tip_(tip_of(option)) {
    if (is_long(option.value)) {  // three fields need the whole row
      text_dim(option.label);
      tooltip(tip_);
    } else {
      row(std::holds_alternative<SwitchOption>(option.value) ? "" : std::string(option.label),
          tip_);
    }
  }

  bool operator()(const RealOption& real) const { return real_number(*real.value); }

  /// Where none is set, the number that holds instead can be edited. Entering it again unsets it.
  bool operator()(const OptionalRealOption& real) const {
    const std::optional<double> shown = *real.value ? *real.value : real.instead;
    if (!shown) return false;
    double edited = *shown;
    if (!real_number(edited)) return false;
    *real.value = edited == real.instead ? std::nullopt : std::optional(edited);
    return true;
  }

  bool operator()(const IntegerOption& integer) const { return number(id_, *integer.value, tip_); }

  /// The field contains 31-bit integers; a larger seed is kept until it is edited.
  bool operator()(const SeedOption& seed) const {
    auto low = static_cast<int>(*seed.value & 0x7fffffffu);
    if (!number(id_, low, tip_) || low < 0) return false;
    *seed.value = static_cast<std::uint64_t>(low);
    return true;
  }

  bool operator()(const VectorOption& vector) const {
    return components(*vector.value, vector.numbers);
  }

  bool operator()(const OptionalVectorOption& vector) const {
    return *vector.value && components(**vector.value, vector.numbers);
  }

  bool operator()(const SpaceVectorOption& vector) const {
    return *vector.value && space_vector_field({id_, tip_}, **vector.value);
  }

  /// Chosen in the list of markers.
  bool operator()(const NamesOption& names) const { return let_go(*names.value, "none of them"); }

  /// Chosen in the picture.
  bool operator()(const NodesOption& nodes) const { return let_go(*nodes.value, "none of them"); }

  /// Chosen below the list of markers, or named by a recipe.
  bool operator()(const FileOption& file) const { return let_go(*file.value, "none"); }

  bool operator()(const SwitchOption& on) const {
    return checkbox(id_, std::string(option_.label), *on.value, tip_);
  }

  bool operator()(const ChoiceOption& choice) const {
    std::vector<std::string> labels;
    std::vector<std::size_t> items;
    std::size_t chosen = 0;
    for (std::size_t i = 0; i < choice.items().size(); ++i) {
      if (!choice.items()[i].applies) continue;
      if (i == choice.chosen()) chosen = items.size();
      labels.push_back(choice.items()[i].label);
      items.push_back(i);
    }
    if (!combo(id_, labels, chosen, tip_)) return false;
    choice.choose(items[chosen]);
    return true;
  }

  /// Chooses a single part; a blend of several is shown, but cannot be chosen here.
  bool operator()(const SharesOption& shares) const {
    const auto choices = shares.choices();
    std::vector<std::string> labels;
    std::size_t chosen = choices.size();
    for (std::size_t i = 0; i < choices.size(); ++i) {
      labels.emplace_back(choices[i].label);
      if (alone(shares, choices[i])) chosen = i;
    }
    if (chosen == labels.size()) labels.emplace_back("Blend");
    if (!combo(id_, labels, chosen, tip_) || chosen >= choices.size()) return false;
    shares.clear();
    if (choices[chosen].share) *choices[chosen].share = 1;
    return true;
  }

 private:
  /// Shows a value that is chosen elsewhere, and a button that clears it.
  template <class Value>
  bool let_go(Value& value, const std::string& to) const {
    const float room = ImGui::GetContentRegionAvail().x * 0.7F;
    if (!button(id_, elided(value_text(option_), room), {.tooltip = tip_ + " Click: " + to + "."}))
      return false;
    value.clear();
    return true;
  }

  static bool alone(const SharesOption& shares, const SharesOption::Part& choice) {
    return std::ranges::all_of(shares.parts, [&](const auto& part) {
      return *part.share == (part.share == choice.share ? 1 : 0);
    });
  }

  bool components(GivenVector& vector, int otherwise) const {
    if (vector.numbers(otherwise) == 3) {
      Vec3 all = vector;
      if (!space_vector_field({id_, tip_}, all)) return false;
      vector = GivenVector::of_three(all);
      return true;
    }
    const std::string x = id_ + "_x";
    const std::string y = id_ + "_y";
    Vec2 plane = vector.head<2>();
    if (!vector_field({x, y, tip_}, plane)) return false;
    vector = plane;
    return true;
  }

  bool real_number(double& value) const {
    return number(id_, value, tip_, option_.unit == "degrees" ? "%.6g\xC2\xB0" : "%.6g");
  }

  const Option& option_;
  std::string id_, tip_;
};

}  // namespace

bool option_form(const std::string& prefix, const OptionTable& table) {
  bool changed = false;
  for (const Option& option : table) {
    if (!option.applies) continue;
    changed |= std::visit(Field(prefix, option), option.value);
    if (const std::string fault = fault_of(option); !fault.empty())
      text_colored(palette().danger, elided(fault, ImGui::GetContentRegionAvail().x));
  }
  return changed;
}

namespace {

class CommandFields {
 public:
  CommandFields(const std::string& prefix, MeshKind kind) : prefix_(prefix), kind_(kind) {}
  bool changed() const { return changed_; }

  /// For a command described completely by its table.
  template <class EditCommand>
  requires(!EditCommand::beyond_table) void operator()(EditCommand& command) {
    rows(option_table(command));
    if constexpr (requires { command.smooth; }) smoothing(command.smooth);
  }

  void operator()(MoveCommand& command) {
    for (std::size_t b = 0; b < command.bodies.size(); ++b) body(command, b);
    motion(command.how, command.smooth);
  }

  void operator()(DeformCommand& command) {
    if (auto* sine = std::get_if<SineDeformation>(&command.shape)) {
      rows(option_table(*sine));
    } else if (const auto* ways = std::get_if<DisplacementTable>(&command.shape)) {
      tell_table(ways->entries.size(), "displacement", ways->source);
    } else if (const auto* positions = std::get_if<PositionTable>(&command.shape)) {
      tell_table(positions->entries.size(), "position", positions->source);
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
  static void tell_table(std::size_t rows, const char* what, const std::string& source) {
    text_wrapped(counted(rows, what) + (source.empty() ? "" : " from " + source) +
                 "; they cannot be changed here.");
  }

  /// Draws a body; with several bodies, also its name.
  void body(MoveCommand& command, std::size_t number) {
    MovingBody& body = command.bodies[number];
    if (command.bodies.size() == 1) return rows(option_table(body.motion));
    text_wrapped("Motion of " + joined(body.markers));
    changed_ |= option_form(prefix_ + "/body" + std::to_string(number), option_table(body.motion));
  }

  void wall(LayerWall& wall, const std::string& prefix) {
    text_wrapped("Layers at " + joined(wall.markers));
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

namespace {

/// The names' share of the row: names of metrics are long, their values short.
constexpr float name_share = 0.72f;

constexpr const char* tip =
    "The motion ends before any element is worse than this: the body stays where it got to, and "
    "the line above the mesh says how far that is. A drag shows what lies beyond; let go, the body "
    "goes back to the limit.";

/// field: the metric for elements of this dimension.
bool limit_row(const std::string& id, const Option& option, const FieldInfo& field,
               std::optional<double>& limit) {
  const std::string row_tip = std::string(option.help) + '.';
  bool on = limit.has_value();
  const float start = ImGui::GetCursorPosX();
  const float width = ImGui::GetContentRegionAvail().x;
  bool changed = checkbox(id + "/on", std::string(field.label), on, row_tip);
  if (changed) limit = on ? std::optional(field.threshold) : std::nullopt;
  if (!limit) return changed;
  ImGui::SameLine(start + width * name_share);
  ImGui::SetNextItemWidth(-FLT_MIN);
  // The same height as the switch, so that the text of all rows is aligned.
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ImGui::GetStyle().FramePadding.x, 3));
  changed |= number(id, *limit, row_tip, option.unit == "degrees" ? "%.6g\xC2\xB0" : "%.6g");
  ImGui::PopStyleVar();
  if (const std::string fault = fault_of(option); !fault.empty())
    text_colored(palette().danger, elided(fault, ImGui::GetContentRegionAvail().x));
  return changed;
}

}  // namespace

bool quality_limits_form(const std::string& prefix, QualityFloor& floor, int cell_dimension,
                         bool follows_path) {
  const auto given =
      std::ranges::count_if(floor.limits, [](const auto& l) { return l.has_value(); });
  const std::string title =
      "Limits of quality" + (given > 0 ? " (" + std::to_string(given) + ")" : std::string());
  if (!fold(prefix + "/limits", title, tip)) return false;
  if (given > 0 && !follows_path) {
    text_wrapped(
        "Limits are kept on a path: choose the method \"Path following\", automatic steps and "
        "smoothing afterwards.");
    note(prefix + "/limits/path");
  }
  bool changed = false;
  const OptionTable table = option_table(floor);
  const auto& rating = rating_metrics(cell_dimension);
  for (std::size_t m = 0; m < limited_metrics().size(); ++m) {
    const Metric metric = limited_metrics()[m];
    if (std::ranges::find(rating, metric) == rating.end()) continue;
    changed |= limit_row(prefix + "/min_quality_" + std::string(table[m].key), table[m],
                         metric_info(metric, cell_dimension).field, floor.limits[m]);
  }
  return changed;
}

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
  if (!option_form(prefix, option_table(options, kind))) return false;
  // The new value may be incompatible with other options; a new table resolves this.
  settle(option_table(options, kind));
  return true;
}

}  // namespace winslow::gui::ui
