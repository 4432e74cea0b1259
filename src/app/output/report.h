#pragma once

#include <chrono>
#include <nlohmann/json_fwd.hpp>

#include "core/geometry/periodic_pairs.h"
#include "core/layers/layer_stack.h"
#include "core/mesh/mesh.h"
#include "core/motion/motion.h"
#include "core/quality/openfoam_measures.h"
#include "core/quality/surface_distance.h"
#include "core/strategy/run.h"

namespace winslow::app {

/// Measures wall-clock seconds since construction or the last lap().
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  /// Returns the seconds so far and restarts from zero.
  double lap() {
    const double s = seconds();
    start_ = std::chrono::steady_clock::now();
    return s;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Times of the phases of a run.
struct Timings {
  double load = 0, solve = 0, save = 0, total = 0;  ///< seconds
};

/// Largest resident set of this process so far, bytes.
std::int64_t peak_memory_bytes();

/// One executed command of a run.
struct CommandRecord {
  std::string name;                        ///< command_name()
  std::string description;                 ///< describe()
  std::vector<MovingBody> turned;          ///< bodies that turned, with their pivots
  std::optional<std::string> formulation;  ///< of commands that smooth
  SmoothResult result;
  int dimension = 2;        ///< of the mesh's coordinates
  bool on_surface = false;  ///< the mesh is a surface mesh
  int zone = 0;             ///< number of the zone that it changed; 0 for a file without zones
};

/// Content of --report about a run.
struct RunReport {
  std::string command;  ///< the subcommand
  std::string input, output;
  bool written = false;  ///< output was written
  std::vector<CommandRecord> commands;
  Timings seconds;
  std::vector<std::string> warnings;
};

/// Describes a mesh: the block "quality", and "nodes", "elements", "markers" with their sizes,
/// "inverted", "inverted_elements" (ids and centres of the first 100), "worst", "walls", "units".
/// With `before`, the blocks "quality_before" and "walls" also describe the earlier state.
nlohmann::json describe_mesh(const Mesh& mesh, const QualityReport& quality,
                             const QualityReport* before = nullptr);

/// The block "memory_bytes": bytes by part; null where nothing was counted.
nlohmann::json describe_memory(const MemoryUse& memory);
/// The memory of the command of a run that took the most.
MemoryUse most_memory(const std::vector<CommandRecord>& commands);

/// The block "layers": statistics of first_height, thickness, spacing_error, first_error and
/// orthogonality, counts, and the columns that were cut short.
nlohmann::json describe_layers(const LayerStack& stack, const Coordinates& x);

/// The block "surface".
nlohmann::json describe_surface(const SurfaceChange& change);

/// The result for a zone, or for the mesh of a file without zones.
struct ZoneResult {
  int zone;  ///< 0 for a file without zones
  const Mesh* mesh;
  const QualityReport* quality;
  const QualityReport* before;             ///< of the mesh that was read; null: mesh unchanged
  const LayerStack* layers;                ///< null: none
  const SurfaceChange* surface = nullptr;  ///< change of a surface mesh by the run; else null
  /// Periodic sides that the file names for this mesh; null: not reported.
  const GivenPeriodicity* periodic = nullptr;
  std::string regions_array = {};  ///< name of the array that holds the regions; empty: none
  const OpenFoamMeasures* openfoam = nullptr;  ///< of a volume mesh; null: not measured
};

/// Describes meshes. One mesh: describe_mesh() and its other blocks. Several: the sums of "nodes",
/// "elements" and "inverted", and "zones", a list with the description of each.
nlohmann::json describe_zones(const std::vector<ZoneResult>& zones);

/// Adds the keys of a run that all reports have: "version", "command", "input", "seconds",
/// "peak_memory_bytes" and "warnings".
void describe_circumstances(nlohmann::json& report, const RunReport& run);

/// The whole report (docs/command-line.md lists the keys).
nlohmann::json describe_run(const RunReport& run, const std::vector<ZoneResult>& zones);

/// Writes JSON to the standard output if the path is standard_output, otherwise to a file,
/// atomically. Throws OutputError.
void write_json(const std::string& path, const nlohmann::json& json);

/// True if every command of the run converged.
bool all_converged(const std::vector<CommandRecord>& commands);

}  // namespace winslow::app
