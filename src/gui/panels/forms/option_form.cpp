#include "gui/panels/forms/option_form.h"

#include <algorithm>
#include <vector>

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
    for (const auto& part : shares->parts) tip += item_tip(part.label, part.help);
  }
  return tip;
}

/// One field: draws itself, and says whether its value changed.
class Field {
 public:
  Field(const std::string& prefix, const Option& option)
      : option_(option), id_(id_of(prefix, option)), tip_(tip_of(option)) {
    if (in_space(option)) {  // three fields want the whole row
      text_dim(option.label);
      tooltip(tip_);
    } else {
      row(std::holds_alternative<SwitchOption>(option.value) ? "" : std::string(option.label),
          tip_);
    }
  }

  bool operator()(const RealOption& real) const { return real_number(*real.value); }

  bool operator()(const OptionalRealOption& real) const {
    return *real.value && real_number(**real.value);
  }

  bool operator()(const IntegerOption& integer) const { return number(id_, *integer.value, tip_); }

  /// The field holds whole numbers of 31 bits; a larger seed stays until it is typed over.
  bool operator()(const SeedOption& seed) const {
    auto low = static_cast<int>(*seed.value & 0x7fffffffu);
    if (!number(id_, low, tip_) || low < 0) return false;
    *seed.value = static_cast<std::uint64_t>(low);
    return true;
  }

  bool operator()(const VectorOption& vector) const {
    return components(*vector.value, vector.third);
  }

  bool operator()(const OptionalVectorOption& vector) const {
    return *vector.value && components(**vector.value, vector.third);
  }

  bool operator()(const SpaceVectorOption& vector) const {
    return *vector.value && space_vector_field({id_, tip_}, **vector.value);
  }

  /// Chosen in the list of markers; here they are named, and can be let go of.
  bool operator()(const NamesOption& names) const {
    if (!button(id_, elided(value_text(option_), ImGui::GetContentRegionAvail().x * 0.7F),
                {.tooltip = tip_ + " Click: none of them."}))
      return false;
    names.value->clear();
    return true;
  }

  /// Chosen in the picture; here they are named, and can be let go of.
  bool operator()(const NodesOption& nodes) const {
    if (!button(id_, elided(value_text(option_), ImGui::GetContentRegionAvail().x * 0.7F),
                {.tooltip = tip_ + " Click: none of them."}))
      return false;
    nodes.value->clear();
    return true;
  }

  /// Chosen below the list of markers, or named by a recipe; here it can be let go of.
  bool operator()(const FileOption& file) const {
    if (!button(id_, elided(value_text(option_), ImGui::GetContentRegionAvail().x * 0.7F),
                {.tooltip = tip_ + " Click: none."}))
      return false;
    file.value->clear();
    return true;
  }

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

  /// One of the parts alone; a blend of several is shown, but not made.
  bool operator()(const SharesOption& shares) const {
    std::vector<std::string> labels;
    std::size_t chosen = shares.parts.size();
    for (std::size_t i = 0; i < shares.parts.size(); ++i) {
      labels.emplace_back(shares.parts[i].label);
      if (alone(shares, i)) chosen = i;
    }
    if (chosen == labels.size()) labels.emplace_back("Blend");
    if (!combo(id_, labels, chosen, tip_) || chosen >= shares.parts.size()) return false;
    for (const auto& part : shares.parts) *part.share = 0;
    *shares.parts[chosen].share = 1;
    return true;
  }

 private:
  static bool alone(const SharesOption& shares, std::size_t part) {
    for (std::size_t i = 0; i < shares.parts.size(); ++i)
      if (*shares.parts[i].share != (i == part ? 1 : 0)) return false;
    return true;
  }

  /// A vector of three components, all of which are given.
  static bool in_space(const Option& option) {
    const auto has = [](const std::optional<double>* third) {
      return third != nullptr && third->has_value();
    };
    if (const auto* vector = std::get_if<VectorOption>(&option.value)) return has(vector->third);
    if (const auto* vector = std::get_if<OptionalVectorOption>(&option.value))
      return has(vector->third);
    return std::holds_alternative<SpaceVectorOption>(option.value);
  }

  bool components(Vec2& vector, std::optional<double>* third) const {
    if (in_space(option_)) {
      Vec3 all(vector.x(), vector.y(), third->value());
      if (!space_vector_field({id_, tip_}, all)) return false;
      vector = all.head<2>();
      *third = all.z();
      return true;
    }
    const std::string x = id_ + "_x";
    const std::string y = id_ + "_y";
    return vector_field({x, y, tip_}, vector);
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

}  // namespace winslow::gui::ui
