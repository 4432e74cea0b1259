#include "core/quality/mesh_change.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/mesh/place_text.h"

namespace winslow {

namespace {

constexpr double changed_share = 0.05, grossly_changed = 0.2, sine_kept = 0.5;

std::string number(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// Compares what is measured of walls one after the other, in one order.
class HeightComparison {
 public:
  void add(const WallMeasures& before, const WallMeasures& after) {
    for (std::size_t k = 0; k < before.first_height.size(); ++k) {
      const double ratio = after.first_height[k] / before.first_height[k];
      if (!std::isfinite(ratio)) continue;
      ratios_.push_back(ratio);
      if (std::abs(ratio - 1) > FirstHeightChange::tolerance) ++changed_;
      const double factor = std::abs(std::log(ratio));
      if (change_.worst_node >= 0 && factor <= worst_factor_) continue;
      worst_factor_ = factor;
      change_.worst_node = before.wall.nodes[k];
      change_.worst_ratio = ratio;
    }
  }
  FirstHeightChange take() {
    if (!ratios_.empty())
      change_.off = static_cast<double>(changed_) / static_cast<double>(ratios_.size());
    change_.ratio = quantiles_of(std::move(ratios_));
    return change_;
  }

 private:
  std::vector<double> ratios_;
  std::size_t changed_ = 0;
  double worst_factor_ = 0;
  FirstHeightChange change_;
};

std::vector<WallMeasures> heights_only(const Mesh& mesh) {
  std::vector<WallMeasures> walls;
  for (Wall& wall : find_walls(mesh)) {
    WallMeasures& of = walls.emplace_back();
    of.first_height = first_heights(mesh, wall);
    of.wall = std::move(wall);
  }
  return walls;
}

void describe_heights(const Mesh& before, const Mesh& after, Damage& damage) {
  const auto change = compare_first_heights(heights_only(before), heights_only(after));
  if (!change || !spoils_walls(*change)) return;
  damage.node = change->worst_node;
  damage.text = "first heights changed by more than 5 % at " + number("%.3g", 100 * change->off) +
                " % of the wall nodes, at worst to " + number("%.3g", change->worst_ratio) +
                " times what they were at " + place_text(after.coordinates.xy(change->worst_node));
}

void describe_sine(double before, double after, const Mesh& mesh, Damage& damage) {
  if (after >= sine_kept * before) return;
  const Index worst = worst_element(mesh, Metric::normalized_jacobian);
  damage.element = worst;
  damage.text +=
      (damage.text.empty() ? "" : ", and ") +
      std::string(mesh.topology->cell_dimension() == 3 ? "the smallest scaled Jacobian fell from "
                                                       : "the smallest sine fell from ") +
      number("%.3g", before) + " to " + number("%.3g", after) + " at " +
      place_text(element_centre(mesh, worst), mesh.coordinates.dimension());
}

}  // namespace

std::optional<FirstHeightChange> compare_first_heights(std::span<const WallMeasures> before,
                                                       std::span<const WallMeasures> after) {
  const auto same = [](const WallMeasures& a, const WallMeasures& b) {
    return a.wall.nodes == b.wall.nodes;
  };
  if (!std::ranges::equal(before, after, same)) return std::nullopt;
  HeightComparison comparison;
  for (std::size_t w = 0; w < before.size(); ++w) comparison.add(before[w], after[w]);
  return comparison.take();
}

bool spoils_walls(const FirstHeightChange& change) {
  if (change.off > changed_share) return true;
  return change.ratio.count > 0 &&
         (change.ratio.min < 1 - grossly_changed || change.ratio.max > 1 + grossly_changed);
}

Damage find_damage(const Mesh& before, const Mesh& after) {
  Damage damage;
  if (before.topology != after.topology) return damage;
  const Validity was = check_validity(*before.topology, before.coordinates);
  const Validity is = check_validity(*after.topology, after.coordinates);
  if (was.inverted > 0 || is.inverted > 0) return damage;
  if (before.topology->space_dimension() == 2) describe_heights(before, after, damage);
  describe_sine(was.min_sine, is.min_sine, after, damage);
  return damage;
}

}  // namespace winslow
