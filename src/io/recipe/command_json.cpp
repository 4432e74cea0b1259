#include <nlohmann/json.hpp>

#include "core/command/option_tables.h"
#include "core/error.h"
#include "core/layers/layer_plan.h"
#include "core/motion/node_table.h"
#include "io/recipe/object_archive.h"
#include "io/recipe/recipe.h"
#include "io/tables/table_files.h"

namespace winslow::io {

namespace {

using nlohmann::json;

/// Missing bounds are infinite, because JSON cannot write infinity.
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
  if (reader.has("part")) wall.part = read_part(reader.needed("part"), reader.path_of("part"));
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

enum class Empty { allowed, refused };

/// Reads every item of a list with `read`. expected: "a list of walls".
template <class Read>
auto read_list(const json& list, const std::string& path, const Read& read,
               const char* expected = "a list", Empty empty = Empty::allowed) {
  std::vector<decltype(read(list, path))> items;
  if (!list.is_array() || (list.empty() && empty == Empty::refused))
    throw JsonValueError(path, std::string("expected ") + expected);
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

/// Reads walls and overrides of layers, then checks all layer options; the table must have been
/// read before. Throws JsonValueError.
void read_layer_lists(ObjectReader& reader, LayerOptions& layers) {
  layers.walls = read_list(reader.needed("walls"), reader.path_of("walls"), read_wall);
  if (layers.walls.empty()) {
    throw JsonValueError(reader.path_of("walls"), "expected a list of walls");
  }
  if (reader.has("overrides")) {
    layers.overrides =
        read_list(reader.needed("overrides"), reader.path_of("overrides"), read_override);
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

// Option tables define the simple fields; the code here handles lists and parts of commands.

template <class Options>
void option_fields(ObjectReader& reader, Options& options) {
  read_options(reader, option_table(options));
}

template <class Options>
void option_fields(ObjectWriter& writer, const Options& options) {
  Options copy = options;
  write_options(writer, option_table(copy));
}

json write_table(const DisplacementTable& table) {
  json entries = json::array();
  for (const DisplacementEntry& entry : table.entries) {
    json item;
    if (entry.node) {
      item["node"] = *entry.node;
    } else {
      item["position"] = vector_json(entry.position);
    }
    item["displacement"] = vector_json(entry.displacement);
    if (entry.line > 0) item["line"] = entry.line;
    entries.push_back(std::move(item));
  }
  return {{"entries", std::move(entries)}, {"source", table.source}};
}

DisplacementEntry read_entry(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  if (reader.has("node") == reader.has("position")) {
    throw JsonValueError(path, "expected either \"node\" or \"position\"");
  }
  DisplacementEntry entry;
  if (reader.has("node")) {
    reader.required("node", entry.node.emplace());
  } else {
    entry.position = read_vector(reader.needed("position"), reader.path_of("position"));
  }
  entry.displacement = read_vector(reader.needed("displacement"), reader.path_of("displacement"));
  reader.field("line", entry.line);
  reader.finish();
  return entry;
}

json write_table(const PositionTable& table) {
  json entries = json::array();
  for (const PositionEntry& entry : table.entries) {
    json item{{"node", entry.node}, {"position", vector_json(entry.position)}};
    if (entry.line > 0) item["line"] = entry.line;
    entries.push_back(std::move(item));
  }
  return {{"entries", std::move(entries)}, {"source", table.source}};
}

PositionEntry read_position_entry(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  PositionEntry entry;
  reader.required("node", entry.node);
  entry.position = read_vector(reader.needed("position"), reader.path_of("position"));
  reader.field("line", entry.line);
  reader.finish();
  return entry;
}

/// Reads a table of single nodes from the recipe itself, or from a file beside it.
template <class Table, class ReadEntry>
Table read_table(const json& value, const std::string& path, const std::filesystem::path& folder,
                 const ReadEntry& read_entry, Table (*read_file)(const std::filesystem::path&)) {
  ObjectReader reader(value, path);
  if (reader.has("file")) {
    std::string file;
    reader.required("file", file);
    reader.finish();
    return read_file(folder / file);
  }
  Table table;
  table.entries = read_list(reader.needed("entries"), reader.path_of("entries"), read_entry);
  reader.field("source", table.source);
  reader.finish();
  return table;
}

Vec3 read_direction(const json& value, const std::string& path) {
  std::vector<double> numbers;
  ObjectReader::read(value, path, numbers);
  if (numbers.size() != 3) throw JsonValueError(path, "expected three numbers");
  return {numbers[0], numbers[1], numbers[2]};
}

VcvEdit read_vcv_edit(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  VcvEdit edit;
  reader.required("node", edit.node);
  reader.field("neighbours", edit.neighbours);
  reader.field("angles", edit.angles);
  reader.field("lengths", edit.lengths);
  if (const json* list = reader.find("directions"))
    edit.directions = read_list(*list, reader.path_of("directions"), read_direction,
                                "a list of directions [x, y, z]");
  reader.finish();
  return edit;
}

// Fields of commands that are not in their option tables.

void read_beyond(ObjectReader& reader, EditVcvCommand& command, const std::filesystem::path&) {
  command.edits = read_list(reader.needed("nodes"), reader.path_of("nodes"), read_vcv_edit,
                            "a list of nodes", Empty::refused);
}

MovingBody read_body(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  MovingBody body;
  reader.required("markers", body.markers);
  option_fields(reader, body.motion);
  reader.finish();
  return body;
}

/// A single body uses the command's own keys, several bodies are a list.
void read_beyond(ObjectReader& reader, MoveCommand& command, const std::filesystem::path&) {
  const json* list = reader.find("bodies");
  if (!list) return reader.required("markers", command.bodies.front().markers);
  RigidMotion motion;
  std::vector<std::string> own{"markers"};
  for (const Option& option : option_table(motion)) own.emplace_back(option.key);
  for (const std::string& key : own)
    if (reader.has(key.c_str()))
      throw JsonValueError(reader.path_of(key.c_str()),
                           "expected in the objects of \"bodies\", which say how each one moves");
  command.bodies =
      read_list(*list, reader.path_of("bodies"), read_body, "a list of bodies", Empty::refused);
}

void read_beyond(ObjectReader& reader, DeformCommand& command,
                 const std::filesystem::path& folder) {
  const bool sine = reader.has("sine"), ways = reader.has("displacements");
  if (sine + ways + reader.has("positions") != 1) {
    throw JsonValueError(reader.path(),
                         "expected either \"sine\", \"displacements\" or \"positions\"");
  }
  // A table says by itself what moves.
  if (sine || reader.has("markers")) reader.required("markers", command.markers);
  if (sine) {
    reader.object("sine", [&](auto& inner) {
      option_fields(inner, command.shape.emplace<SineDeformation>());
    });
  } else if (ways) {
    command.shape = read_table(reader.needed("displacements"), reader.path_of("displacements"),
                               folder, read_entry, read_displacements);
  } else {
    command.shape = read_table(reader.needed("positions"), reader.path_of("positions"), folder,
                               read_position_entry, read_positions);
  }
}

void read_beyond(ObjectReader& reader, LayersCommand& command, const std::filesystem::path&) {
  read_layer_lists(reader, command.layers);
}

void write_beyond(ObjectWriter& writer, const MoveCommand& command) {
  if (command.bodies.size() == 1) return writer.required("markers", command.bodies.front().markers);
  json list = json::array();
  for (const MovingBody& body : command.bodies) {
    ObjectWriter item;
    item.required("markers", body.markers);
    option_fields(item, body.motion);
    list.push_back(item.take());
  }
  writer.required("bodies", list);
}

void write_beyond(ObjectWriter& writer, const DeformCommand& command) {
  if (!command.markers.empty()) writer.required("markers", command.markers);
  if (const auto* sine = std::get_if<SineDeformation>(&command.shape))
    writer.object("sine", [&](auto& inner) { option_fields(inner, *sine); });
  if (const auto* table = std::get_if<DisplacementTable>(&command.shape))
    writer.field("displacements", write_table(*table));
  if (const auto* table = std::get_if<PositionTable>(&command.shape))
    writer.field("positions", write_table(*table));
}

void write_beyond(ObjectWriter& writer, const EditVcvCommand& command) {
  json nodes = json::array();
  for (const VcvEdit& edit : command.edits) {
    ObjectWriter item;
    item.required("node", edit.node);
    if (!edit.neighbours.empty()) item.field("neighbours", edit.neighbours);
    if (!edit.angles.empty()) item.field("angles", edit.angles);
    if (!edit.lengths.empty()) item.field("lengths", edit.lengths);
    json directions = json::array();
    for (const Vec3& d : edit.directions) directions.push_back({d.x(), d.y(), d.z()});
    if (!directions.empty()) item.field("directions", directions);
    nodes.push_back(item.take());
  }
  writer.required("nodes", nodes);
}

void write_beyond(ObjectWriter& writer, const LayersCommand& command) {
  write_layer_lists(writer, command.layers);
}

/// The fields that all commands share: the options of their tables, smoothing options.
template <class Archive, class Command>
void common_fields(Archive& archive, Command& command) {
  option_fields(archive, command);
  if constexpr (requires { command.smooth; }) {
    archive.object("smooth", [&](auto& inner) { option_fields(inner, command.smooth); });
  }
}

Command command_named(const std::string& name, const std::string& path) {
  std::string known;
  for (Command& command : all_commands()) {
    if (command_name(command) == name) return command;
    known += (known.empty() ? "" : ", ") + std::string(command_name(command));
  }
  throw JsonValueError(path, "found \"" + name + "\", expected one of " + known);
}

Command read_command(ObjectReader& reader, const std::filesystem::path& folder) {
  std::string name;
  reader.required("command", name);
  Command command = command_named(name, reader.path_of("command"));
  std::visit(
      [&](auto& of) {
        common_fields(reader, of);
        if constexpr (std::decay_t<decltype(of)>::beyond_table) read_beyond(reader, of, folder);
      },
      command);
  return command;
}

}  // namespace

json to_json(const Command& command) {
  ObjectWriter writer;
  writer.required("command", std::string(command_name(command)));
  std::visit(
      [&](const auto& of) {
        common_fields(writer, of);
        if constexpr (std::decay_t<decltype(of)>::beyond_table) write_beyond(writer, of);
      },
      command);
  return writer.take();
}

Command command_from_json(const json& value, const std::filesystem::path& folder,
                          const std::string& where) {
  ObjectReader reader(value, where);
  Command command = read_command(reader, folder);
  reader.finish();
  if (SmoothOptions* options = smooth_options(command)) {
    // The path is relative to the recipe, as for tables of displacements. It is resolved here, so
    // that the command means the same file wherever it is written next.
    std::string& reference = options->slide.reference;
    if (!reference.empty()) reference = std::filesystem::absolute(folder / reference).string();
    try {
      validate(*options);
    } catch (const UsageError& error) {
      throw JsonValueError(reader.path_of("smooth"), error.what());
    }
  }
  return command;
}

}  // namespace winslow::io
