#include "core/strategy/surface_options.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

namespace winslow {

namespace {

/// The same choice, of these items alone.
template <class Value>
ChoiceOption left_of(Value& value, const OptionValue& option,
                     std::initializer_list<std::string_view> names) {
  std::vector<ChoiceItem> items = std::get<ChoiceOption>(option).items();
  for (ChoiceItem& item : items)
    item.applies = std::ranges::find(names, std::string_view(item.name)) != names.end();
  return {value, std::move(items)};
}

/// The energy of the variational form alone smooths and untangles them; all nodes slide.
constexpr std::array<std::pair<std::string_view, std::string_view>, 12> hidden{
    {{"", "formulation"},
     {"", "outer"},
     {"", "untangle"},
     {"", "damping"},
     {"", "adapt_damping"},
     {"", "acceleration"},
     {"", "clip"},
     {"", "vcv_lengths"},
     {"", "vcv_updates"},
     {"slide", "markers"},
     {"slide", "surface_first"},
     {"slide", "periodic"}}};

bool is_hidden(const Option& option) {
  return option.object == "keep_outside" ||
         std::ranges::find(hidden, std::pair(option.object, option.key)) != hidden.end();
}

}  // namespace

OptionTable surface_option_table(SmoothOptions& options) {
  OptionTable table = option_table(options);
  for (Option& option : table) {
    if (is_hidden(option)) option.applies = false;
    if (option.object == "slide" && (option.key == "feature_angle" || option.key == "features"))
      option.applies = true;
    if (!option.object.empty()) continue;
    if (option.key == "formulation")
      option.value = left_of(options.formulation, option.value, {"variational"});
    else if (option.key == "outer")
      option.value = left_of(options.outer, option.value, {"auto", "newton"});
    else if (option.key == "untangle")
      option.value = left_of(options.untangle, option.value, {"auto", "energy"});
    else if (option.key == "vcv")
      option.value = left_of(options.vcv, option.value, {"auto", "equal"});
  }
  return table;
}

void settle_for_surface(SmoothOptions& options) {
  settle(surface_option_table(options));
  // A linear solver that the pointwise form alone takes, and the other way round.
  settle(surface_option_table(options));
  options.vcv_lengths = 0;
  options.vcv_updates = 0;
  options.keep_outside = {};
  SlideOptions& slide = options.slide;
  slide.markers.clear();
  slide.periodic.clear();
  slide.surface_first = false;
}

}  // namespace winslow
