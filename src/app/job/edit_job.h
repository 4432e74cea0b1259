#pragma once

#include "app/options/flags.h"
#include "app/output/terminal.h"
#include "core/command/command.h"
#include "core/quality/quality.h"
#include "core/quality/surface_distance.h"
#include "io/tables/slide_files.h"

namespace winslow::app {

/// The mesh of a file, or one of its zones, and what becomes of it.
struct ZoneRun {
  io::MeshFile source;
  std::vector<std::optional<Command>> commands;  ///< of the job, in order; none: not of this zone
  std::vector<SlideFiles> files;                 ///< what each of them asks of files
  MeshState result;
  QualityReport quality, before;  ///< of the result; of what was read
  std::optional<SurfaceChange> surface =
      std::nullopt;  ///< of a surface mesh, against what was read

  /// Of the zone; 0 for a file that is one mesh.
  int number() const;
  /// "zone 2"; empty for a file that is one mesh.
  std::string name() const;
};

/// The zone of that number; 0: all zones of the file, in its order. A file without zones is one
/// mesh. Throws what io::read_mesh throws.
std::vector<io::MeshFile> read_zones(const std::string& path, int zone);

/// Warnings of all of them; what several say alike is said once.
std::vector<std::string> warnings_of(const std::vector<io::MeshFile>& files);

/// Shares commands out to zones. A command that names markers goes to the zones that have any of
/// them, with those alone; one that names none goes to all. Zones that no command goes to are left
/// out. Throws UsageError for a marker that no zone has (the message suggests the nearest), and for
/// numbers of nodes that would mean other nodes in each of several zones.
std::vector<ZoneRun> share_out(std::vector<io::MeshFile> zones,
                               const std::vector<Command>& commands, const std::string& file);

/// Resolves what the commands ask of files. A zone without periodic sides does without
/// them if another zone of the file has some. Throws what io::resolve_files() throws.
void resolve_files(std::vector<ZoneRun>& zones, const io::ReferenceReader& read);

/// Throws UsageError for a marker that the mesh does not have; the message suggests the nearest and
/// lists what there is. `file` is the mesh's name for the message.
void check_markers(const std::vector<Command>& commands, const Topology& topology,
                   const std::string& file);
/// The same for a marker that none of several meshes has.
void check_markers(const std::vector<Command>& commands,
                   const std::vector<const Topology*>& topologies, const std::string& file);

/// A run that reads a mesh, applies commands to it, and writes what comes out.
struct EditJob {
  std::string name;  ///< the subcommand
  JobFiles files;
  std::vector<Command> commands;
};

/// Runs a job. Files are checked before the solve; results are written after it, all or none:
/// the mesh only if it is valid or files.allow_inverted is set, report and history in any case.
/// Throws the library's errors; nothing is written then.
ExitCode run_edit_job(const EditJob& job);

}  // namespace winslow::app
