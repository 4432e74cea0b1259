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

void add_zone_flag(CLI::App& app, int& zone, const std::string& without) {
  app.add_option("--zone", zone,
                 "Zone of a mesh file that has several, by its number (SU2: IZONE=; CGNS: in the "
                 "order of names); without: " +
                     without)
      ->check(CLI::Range(1, std::numeric_limits<int>::max()))
      ->option_text("N");
}

void add_job_flags(CLI::App& app, JobFiles& files) {
  add_zone_flag(app, files.zone, "all that have the markers named, all zones if none is named");
  const char* group = "Output";
  app.add_option("-o,--output", files.output, "Mesh to write; may be IN itself")
      ->type_name("OUT")
      ->group(group);
  app.add_option("--report", files.report, "Write what was done, and the quality, as JSON")
      ->type_name("FILE.json")
      ->group(group);
  app.add_option("--history", files.history, "Write a line for every outer iteration as CSV")
      ->type_name("FILE.csv")
      ->group(group);
  app.add_flag("--allow-inverted", files.allow_inverted,
               "Write OUT even if elements are inverted (the exit status is still 4)")
      ->group(group);
  app.add_flag("--accept-partial", files.accept_partial,
               "Write the last valid mesh of a motion that could not be completed (the exit status "
               "is still 4)")
      ->group(group);
  add_encoding_flags(app, files.encoding);
  add_quiet_flag(app, files.quiet);
}

void add_recipe_flag(CLI::App& app, JobFiles& files) {
  app.add_option("--save-recipe", files.save_recipe, "Write this run as a recipe for replay")
      ->type_name("FILE.json")
      ->group("Output");
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
  app.add_option("--gmsh-version", encoding.gmsh_version,
                 "Version of a Gmsh file; default: that of the source, else 4.1")
      ->check(one_of({"2.2", "4.1"}))
      ->option_text("2.2|4.1")
      ->group("Output");
  app.add_option("--cgns-container", encoding.cgns_container,
                 "What holds a CGNS file; default: that of the source, else hdf5")
      ->check(one_of({"hdf5", "adf"}))
      ->option_text("hdf5|adf")
      ->group("Output");
}

void add_quiet_flag(CLI::App& app, bool& quiet) {
  app.add_flag("-q,--quiet", quiet, "Say nothing but errors");
}

void check_output(const std::string& path) {
  if (path.empty()) return;
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

void check_mesh_output(const std::string& path) {
  if (path.empty()) return;
  const io::MeshFormat* format = io::format_of_extension(path);
  if (!format) {
    throw UsageError(path + ": unknown extension, expected one of " + io::supported_extensions());
  }
  if (!format->missing.empty()) throw UsageError(path + ": " + std::string(format->missing));
  // A mesh that is a folder may be there already, or be made together with those above it.
  const fs::path target(path);
  const fs::path name = (target.has_filename() ? target : target.parent_path()).filename();
  if (!format->folder_name.empty() && name == format->folder_name) return;
  check_output(path);
}

void check_distinct(const std::vector<std::string>& paths) {
  std::set<fs::path> seen;
  for (const std::string& path : paths) {
    if (path.empty()) continue;
    std::error_code pipe;  // which leads to no file that other names could lead to
    const fs::path whole = fs::weakly_canonical(fs::absolute(path), pipe);
    if (!seen.insert(pipe ? fs::absolute(path) : whole).second) {
      throw UsageError(path + " would be written twice");
    }
  }
}

}  // namespace winslow::app
