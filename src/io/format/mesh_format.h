#pragma once

#include "core/mesh/topology.h"
#include "io/file/atomic_file.h"
#include "io/format/parsed_mesh.h"

/// Describes each mesh format. TO ADD A FORMAT, write its reader, its writer and a MeshFormat, and
/// list the MeshFormat in mesh_formats.cpp. Reading, writing, messages, file dialogs, help and the
/// table of docs/formats.md then include it.
namespace winslow::io {

/// The bytes of a file that help to recognise its format.
struct Content {
  explicit Content(std::string_view bytes);

  std::string_view whole;
  std::string_view start;       ///< without byte order mark and leading blanks
  std::string_view first_line;  ///< of start, trimmed
};

/// How clearly the content belongs to a format.
struct Evidence {
  enum class Kind {
    none,
    keyword,    ///< a keyword on one of the first lines
    signature,  ///< the first line says so
    size        ///< a count in the header that fits the size of the file
  };
  Kind kind = Kind::none;
  int line = 0;  ///< of the keyword: the earlier one counts

  bool stronger_than(const Evidence& other) const;
};

/// Gets the zones of a file one by one, each right after it was read.
using TakeZone = std::function<void(ParsedMesh zone)>;

/// One mesh format. The defaults suit most formats. Texts must be literals.
struct MeshFormat {
  std::string_view name;           ///< the extension without its dot, in lower case: "msh"
  std::string_view title;          ///< "Gmsh"
  std::string_view versions = {};  ///< in docs/formats.md: "2.2 and 4.1"
  // What the format can hold, for docs/formats.md.
  std::string_view encodings = "text", markers = "yes", regions = "yes", quadrilaterals = "yes",
                   volumes = "yes";
  /// For formats whose meshes are folders: the name of such a folder.
  std::string_view folder_name = {};
  /// Indexed by MeshKind: true if such a mesh can be written. Surface formats write the boundary of
  /// a volume mesh.
  std::array<bool, 3> writes{true, true, true};
  bool polyhedra = false;  ///< true: the format can hold cells with any faces
  bool polygons = false;   ///< true: the format can hold plane cells with any corners
  bool keeps_markers = true;
  bool keeps_periodic = false;  ///< true: the writer itself handles periodic sides
  bool keeps_data = false;      ///< true: the writer itself handles the data arrays of a source
  bool has_binary = false;
  /// Why this build of the program can neither read nor write the format; empty: it can.
  std::string_view missing = {};

  Evidence (*recognise)(const Content& content);
  ParsedMesh (*read)(Source& source) = nullptr;
  /// Replaces read() for formats that hold several meshes (zones) in one file. zone: its number; 0:
  /// the first. Throws UsageError if the file has no such zone.
  ParsedMesh (*read_zone)(Source& source, int zone) = nullptr;
  /// Goes with read_zone(): reads all zones of a file that is opened once.
  void (*read_zones)(Source& source, const TakeZone& take) = nullptr;
  /// Replaces read() for formats that hold data arrays. regions: name of the cell array that holds
  /// the regions; empty: one of the names that are known. Throws UsageError if there is none.
  ParsedMesh (*read_arrays)(Source& source, std::string_view regions) = nullptr;
  // For formats whose meshes are folders.
  /// The folder that a path stands for when it is read; empty: none. time: ReadOptions::time.
  std::filesystem::path (*find_folder)(const std::filesystem::path& path,
                                       const std::string& time) = nullptr;
  /// Replaces read(). The source has the folder as its name, and no bytes.
  ParsedMesh (*read_folder)(Source& source, const std::filesystem::path& path,
                            const std::string& time) = nullptr;
  /// Whether a path names a folder to write to. of_format: the mesh comes from this format.
  bool (*is_folder_to_write)(const std::filesystem::path& path, bool of_format) = nullptr;
  /// The folder that a path stands for when it is written. input: the mesh that is read; empty:
  /// unknown. Throws UsageError for what must not be written.
  std::filesystem::path (*folder_to_write)(const std::filesystem::path& path,
                                           const std::filesystem::path& input) = nullptr;
  /// Replaces write() (then null) for formats that write several files, or whose file names say
  /// more than the extension. Returns the files; writing them later may add to `warnings`.
  std::vector<OutputFile> (*files)(const std::filesystem::path& path, const Mesh& mesh,
                                   const FormatDetails* details, const WriteOptions& options,
                                   std::vector<std::string>& warnings) = nullptr;
  /// options.binary alone decides the encoding, not the source. details: of the mesh's source file,
  /// of any format; may be null. Returns warnings.
  std::vector<std::string> (*write)(std::ostream& out, const Mesh& mesh,
                                    const FormatDetails* details,
                                    const WriteOptions& options) = nullptr;
  /// Null: the format has no zones. All zones must come from one file of this format; its other
  /// zones are written unchanged.
  std::vector<std::string> (*write_zones)(std::ostream& out, std::span<const MeshZone> zones,
                                          const WriteOptions& options) = nullptr;

  bool can_write(MeshKind kind) const { return writes[static_cast<std::size_t>(kind)]; }
};

/// All formats, in the order in which lists show them.
std::span<const MeshFormat* const> mesh_formats();

/// Find a format, by extension (upper or lower case, ignoring ".gz" after it) or by the first bytes
/// and the size; null if there is none.
const MeshFormat* format_of_extension(const std::filesystem::path& path);
const MeshFormat* format_of_content(std::string_view content);
/// The format whose mesh is the folder for which a path stands; null for an ordinary file.
const MeshFormat* format_of_folder(const std::filesystem::path& path);
/// The format to write to a path: by its extension, or that of the folder that it names. source: of
/// the mesh that is written; null: unknown, or none.
const MeshFormat* format_of_output(const std::filesystem::path& path, const MeshFormat* source);

/// ".su2, .msh, ..." for messages.
std::string supported_extensions();
/// The same for what is written: formats whose meshes are folders by the name of the folder.
std::string writable_extensions();
/// Titles of the formats that can be written in binary: "Gmsh, VTK, ...".
std::string binary_formats();

// Helpers for recognise().
/// True if the line begins with the word, followed by a blank or the end.
bool starts_with_word(std::string_view line, std::string_view word);
Evidence signature_if(bool found);
/// Evidence from the first line, among the leading ones, for which `is_keyword` is true.
Evidence keyword_on_line(const Content& content, bool (*is_keyword)(std::string_view line));

}  // namespace winslow::io
