#pragma once

#include "io/format/mesh_format.h"

/// Formats that winslow does not read, with the command that converts their files. A refusal then
/// says what the file is and what to type:
///
///     if (const ForeignFormat* foreign = foreign_format_of(Content(bytes), path))
///       throw InputError(refusal_of(*foreign, path));
///
/// TO ADD ONE, add a row to the table in foreign_formats.cpp. docs/formats.md shows the table.
namespace winslow::io {

/// One format of other programs. Texts are literals.
struct ForeignFormat {
  std::string_view title;       ///< "an Abaqus input deck", as messages say it
  std::string_view extensions;  ///< as documentation shows them: ".inp"
  std::string_view with;        ///< the program that converts it: "meshio"
  /// What to type. IN stands for the file, STEM for the file without its extension.
  std::string_view command;
  /// extension: of the file, in lower case, with its dot.
  bool (*recognise)(const Content& content, std::string_view extension);
};

std::span<const ForeignFormat> foreign_formats();

/// The format of a file that winslow does not read; null if it is none of the table.
const ForeignFormat* foreign_format_of(const Content& content, const std::filesystem::path& path);

/// "found an Abaqus input deck, expected a mesh (.su2, ...); meshio converts it: meshio convert
/// wing.inp wing.vtu"
std::string refusal_of(const ForeignFormat& foreign, const std::filesystem::path& path);

/// How a mesh with elements of second or higher order becomes one of first order: a sentence that
/// ends messages about such elements. Begins with "; ".
std::string first_order_hint(const std::filesystem::path& path);

/// A command for ParaView's Python that saves a data set beside a file, with another name.
/// data_set: how it is made, with IN for the file: "OpenDataFile('IN')".
std::string paraview_command(const std::filesystem::path& path, std::string_view data_set);

/// A file name as a word of a shell: in quotes if it needs them.
std::string shell_word(const std::string& name);

}  // namespace winslow::io
