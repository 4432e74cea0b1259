#pragma once

#include <CLI/CLI.hpp>

#include "io/format/mesh_file.h"

namespace winslow::app {

/// Files of a job that changes a mesh, and what is said about it.
struct JobFiles {
  std::string input;
  int zone = 0;  ///< of a file of several zones; 0: all of them
  std::string output;
  std::string report;       ///< JSON; empty: none
  std::string history;      ///< CSV; empty: none
  std::string save_recipe;  ///< JSON; empty: none
  bool allow_inverted = false;
  bool accept_partial = false;  ///< write the last valid mesh of a motion that was not completed
  bool quiet = false;
  io::WriteOptions encoding;
};

void add_input(CLI::App& app, std::string& input);
/// Declares --zone; `without`: what is done where it is not given.
void add_zone_flag(CLI::App& app, int& zone, const std::string& without);
/// Declares --zone, -o, --report, --history, --allow-inverted, --accept-partial, --quiet and those
/// of add_encoding_flags.
void add_job_flags(CLI::App& app, JobFiles& files);
/// Declares --save-recipe.
void add_recipe_flag(CLI::App& app, JobFiles& files);
/// Declares --binary, --ascii, --gmsh-version, --cgns-container.
void add_encoding_flags(CLI::App& app, io::WriteOptions& encoding);
void add_quiet_flag(CLI::App& app, bool& quiet);

/// Throws before hours are spent: UsageError if the extension of a mesh is unknown, OutputError if
/// its folder does not exist or cannot be written to. An empty path is fine.
void check_mesh_output(const std::string& path);
/// The same for any other file.
void check_output(const std::string& path);
/// Throws UsageError if two of the files that are to be written are the same.
void check_distinct(const std::vector<std::string>& paths);

}  // namespace winslow::app
