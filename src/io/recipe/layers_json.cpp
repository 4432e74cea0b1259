#include "io/recipe/layers_json.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/layers/layer_option_tables.h"
#include "io/recipe/option_fields.h"

namespace winslow::io {

namespace {

using nlohmann::json;

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
  read_options(reader, option_table(wall.spacing));
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
  for (LayerWall wall : walls) {
    ObjectWriter item;
    item.required("markers", wall.markers);
    write_options(item, option_table(wall.spacing));
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

}  // namespace

void read_layer_lists(ObjectReader& reader, LayerOptions& layers) {
  layers.walls = read_list<LayerWall>(reader.at("walls"), reader.path_of("walls"), read_wall);
  if (layers.walls.empty()) {
    throw JsonValueError(reader.path_of("walls"), "expected a list of walls");
  }
  if (reader.has("overrides")) {
    layers.overrides = read_list<ColumnOverride>(reader.at("overrides"),
                                                 reader.path_of("overrides"), read_override);
  }
  try {
    validate(layers);
  } catch (const UsageError& error) {
    throw JsonValueError(reader.path(), error.what());
  }
}

void write_layer_lists(ObjectWriter& writer, const LayerOptions& layers) {
  writer.required("walls", write_walls(layers.walls));
  if (!layers.overrides.empty()) writer.field("overrides", write_overrides(layers.overrides));
}

}  // namespace winslow::io
