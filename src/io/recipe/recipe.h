#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "core/command/command.h"

/// Executes the commands of a file in order:
///
///     const winslow::io::Recipe recipe = winslow::io::read_recipe("recipe.json");
///     const winslow::io::MeshFile file = winslow::io::read_mesh(recipe.input);
///     state = winslow::make_state(file.mesh);
///     for (const winslow::Command& step : recipe.commands)
///       state = winslow::execute(winslow::io::resolve_files(step, file.details.get()),
///       state).state;
///
/// A recipe: a JSON file of commands, in order (docs/recipes.md describes the format).
namespace winslow::io {

struct Recipe {
  std::string input;   ///< mesh to start from, relative to the recipe; may be empty
  std::string output;  ///< mesh to write, relative to the recipe; may be empty
  std::vector<Command> commands;
  int zone = 0;  ///< for an input of several zones: the zone to change; 0: all
  /// Mesh whose element shapes motions keep, relative to the recipe; empty: the input.
  std::string reference_mesh = {};
  /// Files of displacements or positions that the recipe was read with; they are not written.
  std::vector<std::string> tables = {};
  /// Name of the cell array of the input that holds the regions; empty: one of the known names.
  std::string regions = {};
  /// Configuration file of SU2 for the input, relative to the recipe; empty: none.
  std::string config = {};
};

nlohmann::json to_json(const Command& command);
/// Reads a command strictly: throws InputError with the key that is missing, unknown, of the wrong
/// type or out of range. `folder`: base of relative paths of displacement files. `where`: name of
/// the command in messages, e.g. "commands[2]".
Command command_from_json(const nlohmann::json& json, const std::filesystem::path& folder,
                          const std::string& where = "");

/// Throws InputError "FILE:LINE: ...". Options missing in the file keep the defaults of their
/// structs.
Recipe read_recipe(const std::filesystem::path& path);
/// Writes a recipe atomically; displacements are embedded. Throws OutputError.
void write_recipe(const std::filesystem::path& path, const Recipe& recipe);

}  // namespace winslow::io
