#include "app/options/flags.h"

#include <unistd.h>

#include <set>

#include "core/error.h"
#include "io/format/mesh_format.h"

namespace winslow::app {

namespace fs = std::filesystem;

void add_input(CLI::App& app, std::string& input) {
  app.add_option("IN", input, "Mesh to read (" + io::supported_extensions() + ")")
      ->required()
      ->type_name("");
}

void add_inputs(CLI::App& app, std::vector<std::string>& inputs) {
  app.add_option("IN", inputs, "Meshes to read (" + io::supported_extensions() + ")")
      ->required()
      ->type_name("");
}

void add_zone_flag(CLI::App& app, int& zone, const std::string& without) {
  FlagGroup(app)
      .value_as("--zone", zone, "N",
                "Zone of a mesh file that has several, by its number (SU2: IZONE=; CGNS: in the "
                "order of names); without: " +
                    without)
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
}

void add_reading_flags(CLI::App& app, io::ReadOptions& reading, const std::string& without_zone) {
  add_zone_flag(app, reading.zone, without_zone);
  FlagGroup group(app);
  group.value_as("--time", reading.time, "latest|T",
                 "Time of an OpenFOAM case whose points have moved: the latest, or the name of its "
                 "folder, as 0.5; without: that of the path, else constant");
  group.value_as(
      "--regions", reading.regions, "ARRAY",
      "Cell array of a VTK or VTU file whose whole numbers are the regions of the elements; "
      "without: one of the names that mesh generators and solvers use, such as MaterialIDs");
  group.on(
      "--repair", [&reading] { reading.defects = io::Defects::repair; },
      "Mend the mesh first: points in one place, elements given twice, without area or facing "
      "the other way, points of no element; each is counted");
}

void add_config_flag(CLI::App& app, std::string& config) {
  FlagGroup(app).value("--config", config, "FILE.cfg",
                       "Configuration file of SU2 for the mesh: markers of MARKER_SYM slide, those "
                       "of MARKER_PERIODIC move together, unless --fixed NAME holds them");
}

void add_job_flags(CLI::App& app, JobFiles& files) {
  add_reading_flags(app, files.reading,
                    "all that have the markers named, all zones if none is named");
  add_config_flag(app, files.config);
  FlagGroup group(app, "Output");
  group.value(
      "-o,--output", files.output, "OUT",
      "Mesh to write; may be IN itself. Of OpenFOAM a folder: CASE/0.5 for the moved points "
      "of a time, another case for all of the mesh");
  group.value("--report", files.report, "FILE.json",
              "Write what was done, and the quality, as JSON; -: to the standard output, and what "
              "else is said to the standard error");
  group.value("--history", files.history, "FILE.csv",
              "Write a line for every outer iteration as CSV");
  group.on("--memory", files.memory,
           "Say how much memory the run took at most, and for what: mesh, targets, matrices, "
           "preconditioner, ...; --report always has it");
  group.on("--allow-inverted", files.allow_inverted,
           "Write OUT even if elements are inverted (the exit status is still 4)");
  group.on("--accept-partial", files.accept_partial,
           "Write the last valid mesh of a motion that could not be completed (the exit status "
           "is still 4)");
  add_encoding_flags(app, files.encoding);
  add_quiet_flag(app, files.quiet);
}

void add_reference_mesh_flag(CLI::App& app, JobFiles& files) {
  FlagGroup(app, "Motion")
      .value("--reference-mesh", files.reference_mesh, "FILE",
             "Mesh of the same connectivity whose element shapes targets keep, auto and rest refer "
             "to, in place of IN: the mesh before the first of several runs from file to file");
}

void add_recipe_flag(CLI::App& app, JobFiles& files) {
  FlagGroup(app, "Output")
      .value("--save-recipe", files.save_recipe, "FILE.json",
             "Write this run as a recipe for replay");
}

void add_encoding_flags(CLI::App& app, io::WriteOptions& encoding) {
  const auto set = [&encoding](bool binary) {
    encoding.binary = binary;
    encoding.keep_encoding = false;
  };
  auto* binary = app.add_flag_callback(
                        "--binary", [set] { set(true); },
                        "Write binary where the format has it (" + io::binary_formats() + ")")
                     ->group("Output");
  app.add_flag_callback(
         "--ascii", [set] { set(false); }, "Write text, whatever the source was")
      ->excludes(binary)
      ->group("Output");
  FlagGroup group(app, "Output");
  group
      .value_as("--gmsh-version", encoding.gmsh_version, "2.2|4.1",
                "Version of a Gmsh file; default: that of the source, else 4.1")
      ->check(one_of({"2.2", "4.1"}));
  group
      .value_as("--cgns-container", encoding.cgns_container, "hdf5|adf",
                "What holds a CGNS file; default: that of the source, else hdf5")
      ->check(one_of({"hdf5", "adf"}));
}

void add_quiet_flag(CLI::App& app, bool& quiet) {
  app.add_flag("-q,--quiet", quiet, "Say nothing but errors");
}

void check_output(const std::string& path) {
  if (path.empty() || path == standard_output) return;
  std::error_code error;
  const fs::path target(path);
  if (fs::is_directory(target, error)) {
    throw OutputError(path + ": is a folder; expected the name of a file to write");
  }
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) {
    throw OutputError(path + ": the folder " + folder.string() + " does not exist");
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    throw OutputError(path + ": the folder " + folder.string() + " cannot be written to");
  }
}

void check_is_file(const std::string& path, const char* flag) {
  if (path == standard_output)
    throw UsageError(
        std::string(flag) +
        " -: found - for the standard output, expected the name of a file (./- for one "
        "that is called -)");
}

void check_mesh_output(const std::string& path, const std::string& input) {
  if (path.empty()) return;
  const io::MeshFormat* source = input.empty() ? nullptr : io::format_of_folder(input);
  const io::MeshFormat* format = io::format_of_output(path, source);
  if (!format) {
    throw UsageError(path + ": unknown extension, expected one of " + io::writable_extensions());
  }
  if (!format->missing.empty()) throw UsageError(path + ": " + std::string(format->missing));
  if (!format->folder_to_write) {
    check_output(path);
    return;
  }
  // A mesh folder may already exist, or is made together with its parent folders.
  fs::path folder = fs::absolute(format->folder_to_write(path, source ? input : std::string()));
  std::error_code error;
  while (!fs::exists(folder, error) && folder.has_relative_path()) folder = folder.parent_path();
  if (!fs::is_directory(folder, error))
    throw OutputError(path + ": " + folder.string() + " is no folder");
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw OutputError(path + ": the folder " + folder.string() + " cannot be written to");
}

void check_distinct(const std::vector<std::string>& paths) {
  std::set<fs::path> seen;
  for (const std::string& path : paths) {
    if (path.empty()) continue;
    if (path == standard_output) {
      if (!seen.insert(path).second)
        throw UsageError(
            "two outputs would be written to the standard output (-): name a file for one");
      continue;
    }
    std::error_code pipe;  // set for a pipe, whose path cannot be resolved
    const fs::path whole = fs::weakly_canonical(fs::absolute(path), pipe);
    if (!seen.insert(pipe ? fs::absolute(path) : whole).second) {
      throw UsageError(path + " would be written twice");
    }
  }
}

namespace {

/// The file itself, however it is named; a mesh in a folder is that folder.
fs::path whole_path(const std::string& path) {
  fs::path named = path;
  for (const io::MeshFormat* format : io::mesh_formats()) {
    if (!format->find_folder) continue;
    if (const fs::path folder = format->find_folder(path, {}); !folder.empty()) named = folder;
  }
  std::error_code error;  // set for a pipe, whose path cannot be resolved
  fs::path whole = fs::weakly_canonical(fs::absolute(named), error);
  if (error) return fs::absolute(named);
  return whole.has_filename() ? whole : whole.parent_path();
}

}  // namespace

void check_inputs_kept(const std::vector<std::string>& outputs,
                       const std::vector<std::string>& inputs) {
  std::set<fs::path> kept;
  for (const std::string& input : inputs)
    if (!input.empty() && input != standard_output) kept.insert(whole_path(input));
  for (const std::string& output : outputs) {
    if (output.empty() || output == standard_output || !kept.contains(whole_path(output))) continue;
    throw UsageError(output +
                     " is a file that this run reads, and would be replaced: name another "
                     "file to write");
  }
}

}  // namespace winslow::app
