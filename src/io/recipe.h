#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/command/command.h"

/// Recipes: a JSON file of commands, in order (docs/recipes.md has the format).
namespace winslow::io {

struct Recipe {
  std::string input;   ///< mesh to start from, relative to the recipe; may be empty
  std::string output;  ///< mesh to write, relative to the recipe; may be empty
  std::vector<Command> commands;
};

nlohmann::json to_json(const Command& command);
/// Throws InputError naming the key that is missing, unknown or of the wrong type.
/// `folder`: where displacement files named in the command are looked for.
Command command_from_json(const nlohmann::json& json, const std::filesystem::path& folder);

/// Throws InputError "FILE:LINE: ...".
Recipe read_recipe(const std::filesystem::path& path);
void write_recipe(const std::filesystem::path& path, const Recipe& recipe);

}  // namespace winslow::io
