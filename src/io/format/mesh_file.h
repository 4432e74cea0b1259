#pragma once

#include <filesystem>
#include <map>

#include "core/error.h"
#include "core/geometry/periodic_pairs.h"
#include "core/mesh/mesh.h"

/// Writing a mesh back changes only the coordinates of its file:
///
///     const winslow::io::MeshFile file = winslow::io::read_mesh("wing.cgns");
///     winslow::MeshState state = winslow::make_state(file.mesh);
///     state = winslow::execute(command, state).state;
///     winslow::io::write_mesh("moved.cgns", state.mesh, file.details.get());
///
/// Reading and writing meshes: the one header that the rest of the program needs.
namespace winslow::io {

struct MeshFormat;     // io/format/mesh_format.h
class PlanePlacement;  // io/format/mesh_in_space.h

/// What a file says about its markers, besides their faces.
struct MarkerRoles {
  /// Planes of symmetry and the like, whose nodes slide along them unless they are held
  /// (add_file_defaults()), with the file's word for them: "symmetryPlane".
  std::vector<std::pair<std::string, std::string>> symmetry;
  /// The nodes of the file's periodic pairs move together unless their markers are held.
  bool pairs_move = false;
  /// Two markers each that are periodic sides, whose nodes move together unless they are held.
  std::vector<std::pair<std::string, std::string>> pairs;
  /// Names that stand for several markers.
  std::map<std::string, std::vector<std::string>> groups;
};

/// Content of a file beyond a Mesh (version, entity and node tags, order of blocks, ...). Kept from
/// reading to writing, so that in a file of the same format only the coordinates change. Each
/// format derives its own class.
struct FormatDetails {
  virtual ~FormatDetails() = default;
  const MeshFormat* format = nullptr;  ///< of the source
  bool binary = false;                 ///< the source was binary
  bool changed = false;                ///< repaired, or parts left out: not what the file says
  std::vector<double> plane_z;         ///< z of each node, or one for all; empty: 0
  /// The plane of a mesh whose z is not constant; null: z is constant.
  std::shared_ptr<PlanePlacement> plane;
  Index nodes = 0, elements = 0;  ///< sizes of the mesh that was read
  std::vector<int> zones;         ///< numbers of all zones of the file; empty: no zones
  int zone = 0;                   ///< the one that was read
  /// Periodic sides that the file names; null for details that came from no file.
  std::shared_ptr<GivenPeriodicity> periodic;
  std::string regions_array;  ///< name of the cell array that holds the regions; empty: none

  /// Names of the data arrays that the file holds besides the mesh, for messages; empty: none.
  virtual std::string data_names() const { return {}; }
  MarkerRoles roles;

  /// True if a mesh has as many nodes and elements as the one that was read.
  bool same_size(const Topology& topology) const {
    return nodes == topology.node_count() && elements == topology.element_count();
  }
};

/// A mesh read from a file.
struct MeshFile {
  Mesh mesh;
  const MeshFormat* format = nullptr;            ///< null for one that came from no file
  std::shared_ptr<const FormatDetails> details;  ///< null for a mesh that came from no file
  std::vector<std::string> warnings;             ///< sentences; each names the file
  bool defective = false;  ///< read to be shown (Defects::show), although it is no sound mesh
};

/// What to do with a file whose content is no mesh: an edge with three elements, two points in one
/// place, elements without area, ...
enum class Defects {
  refuse,  ///< throw InputError
  /// Read what can be shown: elements as they are where connectivity allows it, others left out. A
  /// warning says what is wrong and where. For looking at a mesh, not for moving it.
  show,
  repair  ///< mend what can be mended (io/format/mesh_repair.h), refuse the rest
};

/// A file that holds no mesh, but one that Defects::repair mends. what() says so in words of the
/// command line.
class MendableError : public InputError {
 public:
  /// fault: "FILE:LINE: ...".
  explicit MendableError(const std::string& fault) : InputError(fault + std::string(hint)) {}
  /// What is wrong, without the way to mend it.
  std::string fault() const {
    const std::string_view text = what();
    return std::string(text.substr(0, text.size() - hint.size()));
  }

 private:
  static constexpr std::string_view hint = "; --repair mends it";
};

struct ReadOptions {
  int zone = 0;  ///< number of the zone to read, of formats that have zones; 0: the first
  /// Name of the cell array that holds the regions, of formats that have arrays; empty: one of the
  /// names that are known.
  std::string regions = {};
  Defects defects = Defects::refuse;
  /// Of formats whose meshes move with time (OpenFOAM): "latest" or the name of a time; empty: that
  /// of the path, else the mesh at the begin.
  std::string time = {};
};

/// Reads a mesh. The content decides the format (with a warning if the extension disagrees); the
/// extension decides if the content is not conclusive. Throws InputError "FILE:LINE: ..." / "FILE:
/// byte N: ...". Never crashes on any content, and never allocates more than the file's size
/// justifies. Throws MendableError, an InputError, if Defects::repair would help, and UsageError
/// for a zone or an array that the file does not have.
MeshFile read_mesh(const std::filesystem::path& path, const ReadOptions& options = {});
/// Reads all zones of a file in the order of their numbers, whatever options.zone is; a file
/// without zones is one. The time grows with the size of the file, not with the number of its
/// zones. Throws as read_mesh() does.
std::vector<MeshFile> read_mesh_zones(const std::filesystem::path& path,
                                      const ReadOptions& options = {});

struct WriteOptions {
  const MeshFormat* format = nullptr;  ///< null: by the extension of the path
  bool binary = false;                 ///< binary instead of text, if the format has it
  bool keep_encoding = true;           ///< binary also if the source is binary and of this format
  std::string gmsh_version;            ///< "2.2" or "4.1"; empty: that of the source, else 4.1
  /// "hdf5" or "adf"; empty: that of the source, else HDF5.
  std::string cgns_container = {};
  bool zone_alone = false;  ///< for a file of several zones: write only the one that was read
};

/// Writes a mesh to a temporary file beside `path` and renames it. `details` may be null or of
/// another format; what does not apply is ignored. Returns warnings (markers lost, ...). Throws
/// OutputError (the target is then unchanged) and UsageError (unknown extension).
std::vector<std::string> write_mesh(const std::filesystem::path& path, const Mesh& mesh,
                                    const FormatDetails* details, const WriteOptions& options = {});

/// One of the zones of a file.
struct MeshZone {
  const Mesh* mesh;
  const FormatDetails* details;
};

/// Writes zones that were read from one file back into one file, with its other zones as they were.
/// Throws UsageError if there are several and the format to write has no zones.
std::vector<std::string> write_mesh_zones(const std::filesystem::path& path,
                                          std::span<const MeshZone> zones,
                                          const WriteOptions& options = {});
/// Copies a mesh file that nothing has changed, so that the output has the same bytes: a writer may
/// print the same numbers in other words. It is compressed or not as the names say. details: of the
/// mesh that was read from `from`. Returns false, and writes nothing, where a copy is not what was
/// asked for: for another format or encoding, one zone alone, a mesh of several files. Throws
/// OutputError.
bool copy_mesh(const std::filesystem::path& from, const std::filesystem::path& to,
               const FormatDetails* details, const WriteOptions& options = {});
/// A sentence that says which zone was read, if the file has others; else empty.
std::vector<std::string> zones_left(const FormatDetails* details,
                                    const std::filesystem::path& path);
/// True if a file of that name can hold all zones of the file that the details belong to.
bool keeps_zones(const std::filesystem::path& path, const FormatDetails& details);

}  // namespace winslow::io
