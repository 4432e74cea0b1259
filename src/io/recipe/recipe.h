#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "core/command/command.h"

/// The commands of a file, one after the other:
///
///     const winslow::io::Recipe recipe = winslow::io::read_recipe("recipe.json");
///     const winslow::io::MeshFile file = winslow::io::read_mesh(recipe.input);
///     state = winslow::make_state(file.mesh);
///     for (const winslow::Command& step : recipe.commands)
///       state = winslow::execute(winslow::io::resolve_files(step, file.details.get()),
///       state).state;
///
/// Recipes: a JSON file of commands, in order (docs/recipes.md has the format).
namespace winslow::io {

struct Recipe {
  std::string input;   ///< mesh to start from, relative to the recipe; may be empty
  std::string output;  ///< mesh to write, relative to the recipe; may be empty
  std::vector<Command> commands;
  int zone = 0;  ///< of an input of several zones: the one that the commands are for; 0: all
};

nlohmann::json to_json(const Command& command);
/// Strict: throws InputError naming the key that is missing, unknown, of the wrong type or out of
/// range. `folder`: where displacement files named in the command are looked for. `where`: what to
/// call the command in messages, e.g. "commands[2]".
Command command_from_json(const nlohmann::json& json, const std::filesystem::path& folder,
                          const std::string& where = "");

/// Throws InputError "FILE:LINE: ...". What the file leaves out has the defaults of the options
/// structs.
Recipe read_recipe(const std::filesystem::path& path);
/// Atomically. Displacements are embedded. Throws OutputError.
void write_recipe(const std::filesystem::path& path, const Recipe& recipe);

}  // namespace winslow::io
