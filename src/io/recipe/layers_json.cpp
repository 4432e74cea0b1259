#include "io/recipe/layers_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"

namespace winslow::io {

namespace {

using nlohmann::json;

template <class Archive, class Spacing>
void spacing_fields(Archive& archive, Spacing& spacing) {
  archive.field("count", spacing.count);
  archive.field("first", spacing.first);
  archive.field("ratio", spacing.ratio);
  archive.field("growth", spacing.growth);
  archive.field("match_outside", spacing.match_outside);
}

template <class Archive, class Command>
void layer_fields(Archive& archive, Command& command) {
  archive.field("control", command.control);
  archive.field("height_tolerance", command.tolerance);
  archive.field("most_corrections", command.most_corrections);
  archive.field("fans", command.layers.fans);
  archive.field("fan_threshold", command.layers.fan_threshold);
  archive.field("fan_angle", command.layers.fan_angle);
  archive.field("clearance", command.layers.clearance);
  archive.field("crossing", command.layers.crossing);
  archive.field("steepest", command.layers.steepest);
  archive.field("scale_all", command.layers.scale_all);
}

/// Bounds that are not written are infinite, which JSON has no word for.
WallPart read_part(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  WallPart part;
  reader.field("xmin", part.xmin);
  reader.field("xmax", part.xmax);
  reader.field("ymin", part.ymin);
  reader.field("ymax", part.ymax);
  reader.finish();
  return part;
}

json write_part(const WallPart& part) {
  json bounds = json::object();
  for (const auto& [key, bound] : {std::pair{"xmin", part.xmin}, std::pair{"xmax", part.xmax},
                                   std::pair{"ymin", part.ymin}, std::pair{"ymax", part.ymax}}) {
    if (std::isfinite(bound)) bounds[key] = bound;
  }
  return bounds;
}

LayerWall read_wall(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  LayerWall wall;
  reader.required("markers", wall.markers);
  spacing_fields(reader, wall.spacing);
  if (reader.has("total")) reader.required("total", wall.spacing.total.emplace());
  if (reader.has("part")) wall.part = read_part(reader.at("part"), reader.path_of("part"));
  reader.finish();
  return wall;
}

ColumnOverride read_override(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  ColumnOverride own;
  reader.required("node", own.node);
  if (reader.has("columns")) reader.required("columns", own.columns.emplace());
  if (reader.has("thickness")) reader.required("thickness", own.thickness.emplace());
  reader.finish();
  return own;
}

/// Reads every item of a list with `read`.
template <class Item, class Read>
std::vector<Item> read_list(const json& list, const std::string& path, const Read& read) {
  std::vector<Item> items;
  if (!list.is_array()) throw JsonValueError(path, "expected a list");
  for (std::size_t i = 0; i < list.size(); ++i) {
    items.push_back(read(list[i], path + '[' + std::to_string(i) + ']'));
  }
  return items;
}

json write_walls(const std::vector<LayerWall>& walls) {
  json list = json::array();
  for (const LayerWall& wall : walls) {
    ObjectWriter item;
    item.required("markers", wall.markers);
    spacing_fields(item, wall.spacing);
    if (wall.spacing.total) item.field("total", *wall.spacing.total);
    if (wall.part != WallPart{}) item.field("part", write_part(wall.part));
    list.push_back(item.take());
  }
  return list;
}

json write_overrides(const std::vector<ColumnOverride>& overrides) {
  json list = json::array();
  for (const ColumnOverride& own : overrides) {
    ObjectWriter item;
    item.required("node", own.node);
    if (own.columns) item.field("columns", *own.columns);
    if (own.thickness) item.field("thickness", *own.thickness);
    list.push_back(item.take());
  }
  return list;
}

constexpr std::array<const char*, 3> layer_tasks{"insert", "respace", "hold"};

}  // namespace

LayersCommand read_layers(ObjectReader& reader) {
  LayersCommand command;
  std::string task = layer_tasks[0];
  reader.field("task", task);
  const auto found = std::find(layer_tasks.begin(), layer_tasks.end(), task);
  if (found == layer_tasks.end()) {
    throw JsonValueError(reader.path_of("task"),
                         "found \"" + task + "\", expected insert, respace or hold");
  }
  command.task = static_cast<LayerTask>(found - layer_tasks.begin());
  command.layers.walls =
      read_list<LayerWall>(reader.at("walls"), reader.path_of("walls"), read_wall);
  if (command.layers.walls.empty()) {
    throw JsonValueError(reader.path_of("walls"), "expected a list of walls");
  }
  if (reader.has("overrides")) {
    command.layers.overrides = read_list<ColumnOverride>(
        reader.at("overrides"), reader.path_of("overrides"), read_override);
  }
  layer_fields(reader, command);
  try {
    validate(command.layers);
  } catch (const UsageError& error) {
    throw JsonValueError(reader.path(), error.what());
  }
  return command;
}

void write_layers(ObjectWriter& writer, const LayersCommand& command) {
  writer.field("task", std::string(layer_tasks[static_cast<std::size_t>(command.task)]));
  writer.required("walls", write_walls(command.layers.walls));
  if (!command.layers.overrides.empty()) {
    writer.field("overrides", write_overrides(command.layers.overrides));
  }
  layer_fields(writer, command);
}

}  // namespace winslow::io
