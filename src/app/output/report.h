#pragma once

#include <chrono>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "core/geometry/periodic_pairs.h"
#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"
#include "core/motion/motion.h"
#include "core/quality/quality.h"
#include "core/quality/surface_distance.h"
#include "core/strategy/run.h"

namespace winslow::app {

/// Wall-clock seconds since it was made or last restarted.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  /// The seconds so far; counts from zero again.
  double lap() {
    const double s = seconds();
    start_ = std::chrono::steady_clock::now();
    return s;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Where the time of a run went.
struct Timings {
  double load = 0, solve = 0, save = 0, total = 0;  ///< seconds
};

/// Largest resident set of this process so far, bytes.
std::int64_t peak_memory_bytes();

/// One executed command of a run.
struct CommandRecord {
  std::string name;                        ///< command_name()
  std::string description;                 ///< describe()
  std::vector<MovingBody> turned;          ///< bodies that turned; they name their pivots
  std::optional<std::string> formulation;  ///< of commands that smooth
  SmoothResult result;
  int dimension = 2;        ///< of the mesh's coordinates
  bool on_surface = false;  ///< of a surface mesh
  int zone = 0;  ///< number of the zone that it was carried out on; 0: of a file that has none
};

/// All that --report tells of a run.
struct RunReport {
  std::string command;  ///< the subcommand
  std::string input, output;
  bool written = false;  ///< output was written
  std::vector<CommandRecord> commands;
  Timings seconds;
  std::vector<std::string> warnings;
};

/// The block "quality", and what else is said of a mesh: "nodes", "elements", "inverted",
/// "inverted_elements" (ids and centres of the first 100), "worst", "walls", "units". The blocks
/// "quality_before" and "walls" say how it was, too, where `before` is given.
nlohmann::json describe_mesh(const Mesh& mesh, const QualityReport& quality,
                             const QualityReport* before = nullptr);

/// The block "layers": statistics of first_height, thickness, spacing_error, first_error and
/// orthogonality, counts, and the columns that were cut short.
nlohmann::json describe_layers(const LayerStack& stack, const Coordinates& x);

/// The block "surface".
nlohmann::json describe_surface(const SurfaceChange& change);

/// What came of a zone, or of the one mesh of a file.
struct ZoneResult {
  int zone;  ///< 0: of a file that has none
  const Mesh* mesh;
  const QualityReport* quality;
  const QualityReport* before;             ///< of what was read; null: nothing was done to it
  const LayerStack* layers;                ///< null: none
  const SurfaceChange* surface = nullptr;  ///< of a surface mesh, against what was read; else null
  /// What the file says of periodic sides of this very mesh; null: not asked.
  const GivenPeriodicity* periodic = nullptr;
};

/// What is said of meshes: of one mesh itself; of several "nodes", "elements" and "inverted"
/// together, and "zones", a list of what is said of each.
nlohmann::json describe_zones(const std::vector<ZoneResult>& zones);

/// Adds what all reports say of a run: "command", "input", "seconds", "peak_memory_bytes" and
/// "warnings".
void describe_circumstances(nlohmann::json& report, const RunReport& run);

/// The whole report (docs/command-line.md lists the keys).
nlohmann::json describe_run(const RunReport& run, const std::vector<ZoneResult>& zones);

/// Writes JSON atomically. Throws OutputError.
void write_json(const std::filesystem::path& path, const nlohmann::json& json);

/// True if every command of the run converged.
bool all_converged(const std::vector<CommandRecord>& commands);

}  // namespace winslow::app
