#pragma once

#include <bitset>
#include <concepts>
#include <tuple>

#include "core/command/option_tables.h"
#include "core/options/option.h"
#include "core/strategy/smooth_options.h"
#include "gui/settings/view_options.h"

namespace winslow::gui {

/// True if T is `Options` or const `Options`.
template <class T, class Options>
concept Is = std::same_as<std::remove_const_t<T>, Options>;

// References to all fields of options without a table, as a tuple. If a struct gets another field,
// this does not compile until the field is added.

template <Is<Isolation> T>
auto option_fields(T& options) {
  auto& [on, threshold, above, rest] = options;
  return std::tie(on, threshold, above, rest);
}

template <Is<Magnifier> T>
auto option_fields(T& options) {
  auto& [on, factor, pin] = options;
  return std::tie(on, factor, pin);
}

template <Is<SpaceOptions> T>
auto option_fields(T& options) {
  auto& [cuts, crinkle, perspective, up, axes, worst, free_orbit, peel] = options;
  return std::tie(cuts, crinkle, perspective, up, axes, worst, free_orbit, peel);
}

template <Is<ViewOptions> T>
auto option_fields(T& options) {
  auto& [color, color_map, color_axis, percentiles, range, bands, isolation, fill, wireframe,
         line_width, nodes, rim_nodes, roles, directions, markers, node_ids, element_ids, legend,
         legend_place, scale_bar, mark_inverted, comparison, divider, before, magnifier, space,
         worst_by, worst_count, lightness, backdrop, scale, left_panel, right_panel, side_tab,
         plot_panel] = options;
  return std::tuple_cat(std::tie(color, color_map, color_axis, percentiles, range, bands),
                        option_fields(isolation),
                        std::tie(fill, wireframe, line_width, nodes, rim_nodes, roles, directions,
                                 markers, node_ids, element_ids, legend, legend_place, scale_bar,
                                 mark_inverted, comparison, divider, before),
                        option_fields(magnifier), option_fields(space),
                        std::tie(worst_by, worst_count, lightness, backdrop, scale, left_panel,
                                 right_panel, side_tab, plot_panel));
}

/// A change of some fields of options. Other fields are not modified, so that edits of different
/// fields in one frame can be applied in any order.
template <class Options>
class OptionEdit {
 public:
  /// An edit without changes.
  OptionEdit() = default;
  /// Changes the fields in which `after` differs from `before`.
  OptionEdit(const Options& before, Options after) : values_(std::move(after)) {
    each([this, old = option_fields(before), now = option_fields(std::as_const(values_))](auto k) {
      set_[k] = !(std::get<k>(old) == std::get<k>(now));
    });
  }
  /// Changes every field.
  static OptionEdit all(Options values) {
    OptionEdit edit;
    edit.values_ = std::move(values);
    edit.set_.set();
    return edit;
  }

  bool empty() const { return set_.none(); }
  void apply_to(Options& options) const {
    each([this, from = option_fields(values_), to = option_fields(options)](auto k) {
      if (set_[k]) std::get<k>(to) = std::get<k>(from);
    });
  }

 private:
  static constexpr std::size_t count =
      std::tuple_size_v<decltype(option_fields(std::declval<Options&>()))>;
  template <class Visitor>
  static void each(Visitor&& visit) {
    [&]<std::size_t... k>(std::index_sequence<k...>) {
      (visit(std::integral_constant<std::size_t, k>{}), ...);
    }
    (std::make_index_sequence<count>{});
  }

  Options values_;
  std::bitset<count> set_;
};

/// The same for options with a table (core/options/option.h): changes the options in the table.
template <class Options>
requires requires(Options& options) { option_table(options); }
class OptionEdit<Options> {
 public:
  OptionEdit() = default;
  OptionEdit(const Options& before, const Options& after) : before_(before), after_(after) {}
  static OptionEdit all(const Options& values) {
    OptionEdit edit(values, values);
    edit.all_ = true;
    return edit;
  }

  bool empty() const {
    Options before = before_, after = after_;
    return !all_ && same_values(option_table(before), option_table(after));
  }
  void apply_to(Options& options) const {
    if (all_) {
      options = after_;
      return;
    }
    Options before = before_, after = after_;
    copy_changes(option_table(before), option_table(after), option_table(options));
  }

 private:
  Options before_, after_;
  bool all_ = false;
};

/// The edit that changes `before` into `after`.
template <class Options>
OptionEdit<Options> difference(const Options& before, const Options& after) {
  return {before, after};
}
/// The edit that sets every field.
template <class Options>
OptionEdit<Options> whole(const Options& options) {
  return OptionEdit<Options>::all(options);
}

}  // namespace winslow::gui
