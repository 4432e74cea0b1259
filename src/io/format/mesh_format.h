#pragma once

#include "core/mesh/topology.h"
#include "io/file/atomic_file.h"
#include "io/format/parsed_mesh.h"

/// What the program knows of each mesh format. TO ADD A FORMAT, write its reader and writer and a
/// MeshFormat, and name that in mesh_formats.cpp: reading and writing, messages, file dialogs, help
/// and the table of docs/formats.md follow.
namespace winslow::io {

/// The bytes of a file, as far as a format is recognised by them.
struct Content {
  explicit Content(std::string_view bytes);

  std::string_view whole;
  std::string_view start;       ///< without byte order mark and leading blanks
  std::string_view first_line;  ///< of start, trimmed
};

/// How clearly a content is that of a format.
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

/// One mesh format: what most of them are, and what it says otherwise. Texts are literals.
struct MeshFormat {
  std::string_view name;           ///< the extension without its dot, in lower case: "msh"
  std::string_view title;          ///< "Gmsh"
  std::string_view versions = {};  ///< in docs/formats.md: "2.2 and 4.1"
  // What docs/formats.md says that it holds.
  std::string_view encodings = "text", markers = "yes", regions = "yes", quadrilaterals = "yes",
                   volumes = "yes";
  /// Of formats whose meshes are folders: what such a folder is called.
  std::string_view folder_name = {};
  /// By MeshKind: it can be written. Of a volume mesh formats of surfaces hold what bounds it.
  std::array<bool, 3> writes{true, true, true};
  bool keeps_markers = true;
  bool keeps_periodic = false;  ///< what it says of periodic sides is its writer's affair
  bool has_binary = false;
  /// Why this build of the program can neither read nor write it; empty: it can.
  std::string_view missing = {};

  Evidence (*recognise)(const Content& content);
  ParsedMesh (*read)(Source& source) = nullptr;
  /// Instead of read(), of formats that hold several meshes, zones, in one file. The number of the
  /// zone; 0: the first. Throws UsageError if there is none of that number.
  ParsedMesh (*read_zone)(Source& source, int zone) = nullptr;
  /// Of formats whose meshes are folders: the one that a path stands for, which read() finds in the
  /// name of a source without bytes; empty: for none.
  std::filesystem::path (*find_folder)(const std::filesystem::path& path) = nullptr;
  /// Of formats that write several files, or whose file's name says more than its extension: the
  /// files, instead of write(), which is null. What is written later may add to `warnings`.
  std::vector<OutputFile> (*files)(const std::filesystem::path& path, const Mesh& mesh,
                                   const FormatDetails* details, const WriteOptions& options,
                                   std::vector<std::string>& warnings) = nullptr;
  /// options.binary is what to do, whatever the source was. details: of the file that the mesh came
  /// from, of this format or of another; may be null. Returns warnings.
  std::vector<std::string> (*write)(std::ostream& out, const Mesh& mesh,
                                    const FormatDetails* details,
                                    const WriteOptions& options) = nullptr;
  /// Null: the format has no zones. All come from one file of this format; zones of it that are not
  /// given are written as they were.
  std::vector<std::string> (*write_zones)(std::ostream& out, std::span<const MeshZone> zones,
                                          const WriteOptions& options) = nullptr;

  bool can_write(MeshKind kind) const { return writes[static_cast<std::size_t>(kind)]; }
};

/// All formats, in the order of lists.
std::span<const MeshFormat* const> mesh_formats();

/// Null if there is none: by extension (in any case of letters, ".gz" after it left out), by the
/// first bytes and the size.
const MeshFormat* format_of_extension(const std::filesystem::path& path);
const MeshFormat* format_of_content(std::string_view content);

/// ".su2, .msh, ..." for messages.
std::string supported_extensions();
/// Titles of the formats that can be written in binary: "Gmsh, VTK, ...".
std::string binary_formats();

// For recognise().
/// The line begins with the word, and nothing but blanks follows at once.
bool starts_with_word(std::string_view line, std::string_view word);
Evidence signature_if(bool found);
/// Evidence of the first of the first lines that `is_keyword` says yes to.
Evidence keyword_on_line(const Content& content, bool (*is_keyword)(std::string_view line));

}  // namespace winslow::io
