#include "app/output/wall_table.h"

#include <array>
#include <nlohmann/json.hpp>
#include <ostream>
#include <span>
#include <string>

#include "app/output/formatted.h"

namespace winslow::app {
namespace {

using nlohmann::json;

/// Something that is measured of walls.
struct Measure {
  const char* key;    ///< in the report
  const char* label;  ///< in the table
  Quantiles WallReport::*of;
};

constexpr std::array measures{
    Measure{"first_height", "First height", &WallReport::first_height},
    Measure{"tilt", "Tilt, degrees", &WallReport::tilt},
    Measure{"growth", "Growth", &WallReport::growth},
    Measure{"size_ratio", "Size ratio", &WallReport::size_ratio},
};

void print_row(std::ostream& out, const std::string& name, const Quantiles& q) {
  if (q.count == 0) return;
  out << formatted("%-22s%11.4g%11.4g%11.4g%11.4g%11.4g\n", name.c_str(), q.min, q.low, q.median,
                   q.high, q.max);
}

json describe_quantiles(const Quantiles& q) {
  if (q.count == 0) return {};
  return {{"min", q.min}, {"p05", q.low}, {"median", q.median}, {"p95", q.high}, {"max", q.max}};
}

json describe_all(const WallReport& report) {
  json block;
  for (const Measure& measure : measures)
    block[measure.key] = describe_quantiles(report.*measure.of);
  return block;
}

json describe_one(const WallMeasures& wall) {
  return {{"first_height", describe_quantiles(quantiles_of(wall.first_height))},
          {"tilt", describe_quantiles(quantiles_of(wall.tilt))},
          {"growth", describe_quantiles(wall.growth)}};
}

/// Adds how first heights have changed, if they can be compared.
void describe_change(json& block, std::span<const WallMeasures> before,
                     std::span<const WallMeasures> now, const Mesh& mesh) {
  const auto change = compare_first_heights(before, now);
  if (!change || change->worst_node < 0) return;
  const Vec2 p = mesh.coordinates.xy(change->worst_node);
  block["first_height_ratio"] = describe_quantiles(change->ratio);
  block["first_height_changed"] = change->off;
  block["first_height_worst"] = {
      {"node", change->worst_node}, {"at", {p.x(), p.y()}}, {"ratio", change->worst_ratio}};
}

}  // namespace

void print_walls(std::ostream& out, const WallReport* before, const WallReport& now) {
  if (now.size_ratio.count == 0) return;
  out << formatted("%-22s%11s%11s%11s%11s%11s\n", "Walls", "minimum", "5 %", "median", "95 %",
                   "maximum");
  const auto change =
      before ? compare_first_heights(before->walls, now.walls) : std::optional<FirstHeightChange>();
  for (const Measure& measure : measures) {
    const std::string label = measure.label;
    if (before) print_row(out, label + ", before", before->*measure.of);
    print_row(out, label, now.*measure.of);
    if (change && measure.of == &WallReport::first_height)
      print_row(out, label + " / before", change->ratio);
  }
  if (now.walls.empty()) return;
  out << now.node_count() << " wall nodes";
  if (change && change->ratio.count > 0)
    out << formatted(", first height changed by more than %g %% at %.4g %% of them",
                     100 * FirstHeightChange::tolerance, 100 * change->off);
  out << '\n';
}

json describe_walls(const WallReport* before, const WallReport& now, const Mesh& mesh) {
  json block{{"nodes", now.node_count()}, {"now", describe_all(now)}};
  if (before) {
    block["before"] = describe_all(*before);
    describe_change(block, before->walls, now.walls, mesh);
  }
  block["units"] = {{"first_height", "units of the mesh"},
                    {"tilt", "degrees"},
                    {"growth", "1"},
                    {"size_ratio", "1"},
                    {"first_height_ratio", "1"},
                    {"first_height_changed", "1"}};
  json each = json::array();
  const bool paired = before && before->walls.size() == now.walls.size();
  for (std::size_t w = 0; w < now.walls.size(); ++w) {
    const WallMeasures& wall = now.walls[w];
    json& one = each.emplace_back();
    one["markers"] = wall.wall.markers;
    one["nodes"] = wall.wall.nodes.size();
    one["now"] = describe_one(wall);
    if (!paired) continue;
    one["before"] = describe_one(before->walls[w]);
    describe_change(one, {&before->walls[w], 1}, {&wall, 1}, mesh);
  }
  block["each"] = std::move(each);
  return block;
}

}  // namespace winslow::app
