#include "io/recipe/recipe.h"

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "io/file/atomic_file.h"
#include "io/recipe/object_archive.h"

namespace winslow::io {
namespace {

using nlohmann::json;

/// Version of the format; a reader refuses all others.
constexpr int recipe_version = 1;

/// Adds the file whose table a command is read with, if there is one.
void note_table(const json& command, const std::filesystem::path& folder,
                std::vector<std::string>& tables) {
  for (const char* key : {"displacements", "positions"}) {
    const auto table = command.find(key);
    if (table == command.end() || !table->is_object()) continue;
    const auto file = table->find("file");
    if (file != table->end() && file->is_string())
      tables.push_back((folder / file->get<std::string>()).string());
  }
}

Recipe parse_recipe(const json& document, const std::filesystem::path& folder) {
  ObjectReader reader(document, "");
  int version = 0;
  reader.required("winslow_recipe", version);
  if (version != recipe_version) {
    throw JsonValueError("winslow_recipe", "found version " + std::to_string(version) +
                                               ", expected " + std::to_string(recipe_version));
  }
  Recipe recipe;
  reader.field("input", recipe.input);
  reader.field("output", recipe.output);
  reader.field("reference_mesh", recipe.reference_mesh);
  reader.field("zone", recipe.zone);
  if (recipe.zone < 0) throw JsonValueError("zone", "expected the number of a zone");
  reader.field("regions", recipe.regions);
  reader.field("config", recipe.config);
  const json& commands = reader.needed("commands");
  if (!commands.is_array()) throw JsonValueError("commands", "expected a list of commands");
  for (std::size_t i = 0; i < commands.size(); ++i) {
    recipe.commands.push_back(
        command_from_json(commands[i], folder, "commands[" + std::to_string(i) + ']'));
    note_table(commands[i], folder, recipe.tables);
  }
  reader.finish();
  return recipe;
}

/// Makes the path of a reference surface below the recipe's folder relative to it, so that both can
/// be moved together.
Command named_from(Command command, const std::filesystem::path& folder) {
  SmoothOptions* options = smooth_options(command);
  if (!options || options->slide.reference.empty()) return command;
  std::string& name = options->slide.reference;
  const std::filesystem::path file = std::filesystem::absolute(name).lexically_normal();
  const std::filesystem::path from = file.lexically_relative(folder.lexically_normal());
  name = !from.empty() && *from.begin() != ".." ? from.string() : file.string();
  return command;
}

}  // namespace

Recipe read_recipe(const std::filesystem::path& path) {
  const JsonSource source = read_json(path);
  try {
    return parse_recipe(source.document, path.parent_path());
  } catch (const JsonValueError& error) {
    throw InputError(path.string() + ':' + std::to_string(source.line_of(error.path())) + ": " +
                     error.what());
  }
}

void write_recipe(const std::filesystem::path& path, const Recipe& recipe) {
  nlohmann::ordered_json document;
  document["winslow_recipe"] = recipe_version;
  if (!recipe.input.empty()) document["input"] = recipe.input;
  if (!recipe.output.empty()) document["output"] = recipe.output;
  if (!recipe.reference_mesh.empty()) document["reference_mesh"] = recipe.reference_mesh;
  if (recipe.zone != 0) document["zone"] = recipe.zone;
  if (!recipe.regions.empty()) document["regions"] = recipe.regions;
  if (!recipe.config.empty()) document["config"] = recipe.config;
  document["commands"] = json::array();
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  for (const Command& command : recipe.commands) {
    document["commands"].push_back(nlohmann::ordered_json(to_json(named_from(command, folder))));
  }
  std::string text;
  try {
    text = document.dump(2);
  } catch (const json::exception&) {  // JSON is UTF-8; names in a mesh file may be anything
    throw OutputError(path.string() + ": a name in the recipe is not UTF-8 text");
  }
  write_atomically(path, [&](std::ostream& out) { out << text << '\n'; });
}

}  // namespace winslow::io
