#include "io/format/foreign_formats.h"

#include "io/file/gzip.h"
#include "io/text/numbers.h"
#include "io/text/source.h"

namespace winslow::io {
namespace {

/// How much of a file the tests look at.
constexpr std::size_t seen = 4000;

std::string_view head(const Content& content) { return content.start.substr(0, seen); }

bool is_one_of(char c, std::string_view characters) {
  return characters.find(c) != std::string_view::npos;
}

/// The N-th line of the content that is not blank, trimmed; empty if there is none.
std::string_view line_of(const Content& content, int n) {
  std::string_view rest = head(content);
  while (!rest.empty()) {
    const auto end = std::min(rest.find('\n'), rest.size());
    const auto line = trimmed(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (!line.empty() && n-- == 0) return line;
  }
  return {};
}

/// True if one of the first lines begins with one of the words, in capitals or not. `comment`
/// begins lines that are skipped.
bool any_line_begins(const Content& content, std::string_view comment,
                     std::initializer_list<std::string_view> words) {
  constexpr int lines = 60;
  for (int n = 0; n < lines; ++n) {
    const std::string line = lower_case(line_of(content, n));
    if (line.empty()) return false;
    if (!comment.empty() && line.starts_with(comment)) continue;
    const auto begins = [&](std::string_view word) {
      return line.starts_with(word) &&
             (line.size() == word.size() || is_one_of(line[word.size()], " \t,*=:"));
    };
    if (std::ranges::any_of(words, begins)) return true;
  }
  return false;
}

bool is_hdf5(const Content& content) { return content.whole.starts_with("\x89HDF\r\n\x1a\n"); }

bool is_vtk_xml(const Content& content, std::string_view type) {
  const std::string_view text = head(content);
  const auto tag = text.find("<VTKFile");
  if (!text.starts_with("<") || tag == std::string_view::npos) return false;
  const auto end = text.find('>', tag);
  return text.substr(tag, end - tag).find("type=\"" + std::string(type)) != std::string_view::npos;
}

/// True for the sections of ANSYS Fluent's format: "(0 "a comment")", "(2 3)", "(10 (0 1 ...".
bool is_fluent(const Content& content) {
  const std::string_view text = content.start;
  if (!text.starts_with("(")) return false;
  const auto digits = text.substr(1).find_first_not_of("0123456789");
  return digits != std::string_view::npos && digits > 0 && digits < 6 &&
         is_one_of(text[1 + digits], " \"(\t\r\n");
}

bool is_plane_fluent(const Content& content) {
  return is_fluent(content) && head(content).find("(2 2)") != std::string_view::npos;
}

bool is_nastran(const Content& content) {
  return any_line_begins(content, "$",
                         {"grid", "begin bulk", "ctria3", "cquad4", "ctetra", "chexa", "cpenta"});
}

/// Universal files: "-1" and the number of a data set, each on a line of its own.
bool is_universal(const Content& content) {
  const auto number = parse_integer(line_of(content, 1));
  return line_of(content, 0) == "-1" && number && *number > 0 && *number < 100000;
}

constexpr std::string_view save_by_paraview =
    "pvpython -c \"from paraview.simple import *; "
    "SaveData('STEM_saved.vtu', MergeBlocks(OpenDataFile('IN')))\"";

constexpr ForeignFormat all[] = {
    {"a plane mesh of ANSYS Fluent", ".msh, .cas", "OpenFOAM", "fluentMeshToFoam IN, in a case",
     [](const Content& content, std::string_view) { return is_plane_fluent(content); }},
    {"a mesh of ANSYS Fluent", ".msh, .cas", "OpenFOAM", "fluent3DMeshToFoam IN, in a case",
     [](const Content& content, std::string_view) { return is_fluent(content); }},
    {"an Abaqus input deck", ".inp", "meshio", "meshio convert IN STEM.vtu",
     [](const Content& content, std::string_view) {
       return content.start.starts_with("*") &&
              any_line_begins(content, "**", {"*heading", "*node", "*part", "*element"});
     }},
    {"Nastran bulk data", ".bdf, .nas, .fem, .dat", "Gmsh", "gmsh IN -save -o STEM.msh",
     [](const Content& content, std::string_view extension) {
       const bool own = extension == ".bdf" || extension == ".nas" || extension == ".fem";
       return (own || content.first_line.starts_with("$") || extension == ".dat") &&
              is_nastran(content);
     }},
    {"an I-deas universal file", ".unv", "Gmsh", "gmsh IN -save -o STEM.msh",
     [](const Content& content, std::string_view) { return is_universal(content); }},
    {"a mesh of MFEM", ".mesh", "MFEM's mesh-explorer",
     "mesh-explorer -m IN, key V, writes mesh-explorer.vtk",
     [](const Content& content, std::string_view) {
       return starts_with_word(content.first_line, "MFEM");
     }},
    {"a mesh of dolfin (FEniCS)", ".xml", "meshio", "meshio convert IN STEM.vtu",
     [](const Content& content, std::string_view) {
       return content.start.starts_with("<") &&
              head(content).find("<dolfin") != std::string_view::npos;
     }},
    {"an XDMF file", ".xdmf, .xmf", "meshio", "meshio convert IN STEM.vtu",
     [](const Content& content, std::string_view) {
       return content.start.starts_with("<") &&
              head(content).find("<Xdmf") != std::string_view::npos;
     }},
    {"a VTK file of several pieces", ".pvtu", "ParaView", save_by_paraview,
     [](const Content& content, std::string_view) {
       return is_vtk_xml(content, "PUnstructuredGrid");
     }},
    {"a VTK file of several blocks", ".vtm, .vtmb, .pvd", "ParaView", save_by_paraview,
     [](const Content& content, std::string_view) {
       return is_vtk_xml(content, "vtk") || is_vtk_xml(content, "Collection");
     }},
    {"a VTK file that is no unstructured grid", ".vtp, .vts, .vtr, .vti", "ParaView",
     "pvpython -c \"from paraview.simple import *; "
     "SaveData('STEM_saved.vtu', AppendDatasets(OpenDataFile('IN')))\"",
     [](const Content& content, std::string_view) {
       return is_vtk_xml(content, "P") || is_vtk_xml(content, "StructuredGrid") ||
              is_vtk_xml(content, "RectilinearGrid") || is_vtk_xml(content, "ImageData");
     }},
    {"a binary Medit file", ".meshb", "meshio", "meshio convert IN STEM.mesh",
     [](const Content& content, std::string_view extension) {
       const auto& bytes = content.whole;
       const bool coded = bytes.starts_with(std::string_view("\1\0\0\0", 4)) ||
                          bytes.starts_with(std::string_view("\0\0\0\1", 4));
       return coded && extension == ".meshb";
     }},
    {"a mesh of Salome (MED)", ".med", "meshio", "meshio convert IN STEM.vtu",
     [](const Content& content, std::string_view extension) {
       return extension == ".med" && is_hdf5(content);
     }},
    {"an Exodus file", ".e, .exo, .ex2, .g", "meshio", "meshio convert IN STEM.vtu",
     [](const Content& content, std::string_view extension) {
       const bool named = extension == ".e" || extension == ".exo" || extension == ".ex2" ||
                          extension == ".g" || extension == ".exoii";
       return named && (is_hdf5(content) || content.whole.starts_with("CDF"));
     }},
    {"a mesh of Netgen", ".vol", "meshio", "meshio convert IN STEM.vtu",
     [](const Content& content, std::string_view) { return content.first_line == "mesh3d"; }},
    {"a mesh of Gambit", ".neu", "OpenFOAM", "gambitToFoam IN, in a case",
     [](const Content& content, std::string_view) {
       return content.first_line.starts_with("CONTROL INFO");
     }},
    {"a Tecplot file", ".dat, .tec", "meshio", "meshio convert IN STEM.vtu",
     [](const Content& content, std::string_view) {
       return any_line_begins(content, "#", {"variables"}) &&
              any_line_begins(content, "#", {"zone"});
     }},
    {"geometry in STEP, no mesh", ".step, .stp", "Gmsh", "gmsh IN -3 -o STEM.msh",
     [](const Content& content, std::string_view) {
       return content.first_line.starts_with("ISO-10303-21");
     }},
    {"a script of Gmsh, no mesh", ".geo", "Gmsh", "gmsh IN -3 -o STEM.msh",
     [](const Content& content, std::string_view extension) {
       return extension == ".geo" && !content.start.starts_with("$");
     }},
};

/// The path without its extension, and without that of compression.
std::filesystem::path stem_of(const std::filesystem::path& path) {
  std::filesystem::path stem = path;
  if (is_gzip_name(stem)) stem.replace_extension();
  return stem.replace_extension();
}

/// Puts a name for each word IN or STEM.
std::string filled(std::string_view command, const std::filesystem::path& path) {
  // Inside of quotes of a longer text a name cannot have quotes of its own.
  const bool quoted = command.find('\'') != std::string_view::npos;
  const auto word = [&](const std::string& name) { return quoted ? name : shell_word(name); };
  std::string text;
  while (!command.empty()) {
    if (command.starts_with("STEM")) {
      const auto end = std::min(command.find_first_of(" ')\""), command.size());
      text += word(stem_of(path).string() + std::string(command.substr(4, end - 4)));
      command.remove_prefix(end);
    } else if (command.starts_with("IN") && !command.starts_with("INT")) {
      text += word(path.string());
      command.remove_prefix(2);
    } else {
      text += command.front();
      command.remove_prefix(1);
    }
  }
  return text;
}

std::string extension_of(const std::filesystem::path& path) {
  return lower_case((is_gzip_name(path) ? path.stem() : path).extension().string());
}

}  // namespace

std::span<const ForeignFormat> foreign_formats() { return all; }

const ForeignFormat* foreign_format_of(const Content& content, const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  const auto* found = std::ranges::find_if(
      all, [&](const ForeignFormat& foreign) { return foreign.recognise(content, extension); });
  return found == std::end(all) ? nullptr : found;
}

std::string refusal_of(const ForeignFormat& foreign, const std::filesystem::path& path) {
  return "found " + std::string(foreign.title) + ", expected a mesh (" + supported_extensions() +
         "); " + std::string(foreign.with) + " converts it: " + filled(foreign.command, path);
}

std::string first_order_hint(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension == ".su2")
    return "; write the mesh anew with elements of first order (of Gmsh: Mesh.ElementOrder = 1)";
  const std::filesystem::path stem = stem_of(path);
  const std::string name = stem.filename().string();
  std::string before, in = path.filename().string();
  if (extension == ".vtu") {  // which Gmsh does not read
    in = name + "_second_order.msh";
    before = "meshio convert --output-format gmsh22 " + shell_word(path.string()) + ' ' +
             shell_word((stem.parent_path() / in).string()) + " && ";
  }
  const std::string script = shell_word(stem.string() + "_first_order.geo");
  // Gmsh takes names in a script as relative to its folder.
  return "; Gmsh makes elements of first order: " + before + "echo " +
         shell_word("Merge \"" + in + "\"; SetOrder 1; Save \"" + name + "_first_order.msh\";") +
         " > " + script + " && gmsh " + script + " -";
}

std::string paraview_command(const std::filesystem::path& path, std::string_view data_set) {
  const std::string begin = "pvpython -c \"from paraview.simple import *; SaveData('";
  return filled(begin + "STEM_saved.vtu', " + std::string(data_set) + ")\"", path);
}

std::string shell_word(const std::string& name) {
  constexpr std::string_view plain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./+:,=@%";
  if (!name.empty() && name.find_first_not_of(plain) == std::string::npos) return name;
  std::string word = "'";
  for (const char c : name) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace winslow::io
