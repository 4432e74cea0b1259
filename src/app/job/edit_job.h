#pragma once

#include "app/options/flags.h"
#include "app/output/terminal.h"
#include "core/command/command.h"
#include "core/quality/openfoam_measures.h"
#include "core/quality/surface_distance.h"
#include "io/tables/slide_files.h"

namespace winslow::app {

/// A mesh file, or one of its zones, with the commands for it and the result.
struct ZoneRun {
  io::MeshFile source;
  std::vector<std::optional<Command>> commands;  ///< of the job, in order; none: not for this zone
  std::vector<SlideFiles> files;                 ///< the files that each command needs
  MeshState result;
  QualityReport quality, before;  ///< of the result; of the mesh that was read
  std::optional<SurfaceChange> surface =
      std::nullopt;  ///< for a surface mesh: change from the mesh that was read
  std::optional<OpenFoamMeasures> openfoam = std::nullopt;  ///< measured by `quality` alone

  /// Number of the zone; 0 for a file without zones.
  int number() const;
  /// "zone 2"; empty for a file without zones.
  std::string name() const;
};

/// Number of inverted elements of all results.
Index inverted_elements(const std::vector<ZoneRun>& zones);

/// Reads the zone that the options name; 0: all zones, in the order of the file. A file without
/// zones is one mesh. Throws what io::read_mesh throws.
std::vector<io::MeshFile> read_zones(const std::string& path, const io::ReadOptions& options);

/// Warnings of all files without duplicates.
std::vector<std::string> warnings_of(const std::vector<io::MeshFile>& files);

/// Distributes commands to zones. A command that names markers is for the zones that have any of
/// them, with only these markers; a command without markers is for all zones. Zones without a
/// command are left out. Throws UsageError for a marker that no zone has (the message suggests the
/// nearest), and for node numbers that would be ambiguous between several zones.
std::vector<ZoneRun> share_out(std::vector<io::MeshFile> zones,
                               const std::vector<Command>& commands, const std::string& file);

/// Replaces names of groups of markers in a command, and patterns with a * (io::expand_groups(),
/// io::expand_patterns()).
void expand_groups(Command& command, const std::vector<io::MeshFile>& files);
/// Adds what the files say about their boundaries to the commands (io::add_file_defaults()).
/// config: a configuration file of SU2 that says more; empty: none. Returns a sentence for each
/// zone and command, each sentence once.
std::vector<std::string> add_file_defaults(std::vector<ZoneRun>& zones, const std::string& config);

/// Reads the files that the commands need. A zone may lack periodic sides if another zone of the
/// file has some. Throws what io::resolve_files() throws.
void resolve_files(std::vector<ZoneRun>& zones, const io::ReferenceReader& read);

/// Throws UsageError for a marker that the mesh does not have; the message suggests the nearest and
/// lists the existing ones. `file`: name of the mesh in the message.
void check_markers(const std::vector<Command>& commands, const Topology& topology,
                   const std::string& file);
/// The same for a marker that none of several meshes has.
void check_markers(const std::vector<Command>& commands,
                   const std::vector<const Topology*>& topologies, const std::string& file);

/// The record of a command for a report. after: the mesh that it left.
CommandRecord make_record(const Command& command, SmoothResult result, const Mesh& after);
/// Measures the mesh of a zone before and after a run.
void measure(ZoneRun& zone, const QualityOptions& options);
/// What --report writes of a run.
nlohmann::json make_report(const std::vector<ZoneRun>& zones, const RunReport& run);

/// A run that reads a mesh, applies commands and writes the result.
struct EditJob {
  std::string name;  ///< the subcommand
  JobFiles files;
  std::vector<Command> commands;
};

/// Runs a job. Files are checked before the solve; results are written after it, all or none: the
/// mesh only if it is valid or files.allow_inverted is set, report and history in any case. Throws
/// the library's errors, and then writes nothing.
ExitCode run_edit_job(const EditJob& job);

}  // namespace winslow::app
