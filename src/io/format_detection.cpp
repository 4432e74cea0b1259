#include "io/format_detection.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "io/text/scanner.h"

namespace winslow::io {
namespace {

struct Entry {
  Format format;
  std::string_view name;
  bool markers;
};

/// Names are extensions too.
constexpr std::array<Entry, 8> entries{{{Format::su2, "su2", true},
                                        {Format::gmsh, "msh", true},
                                        {Format::vtk, "vtk", true},
                                        {Format::vtu, "vtu", true},
                                        {Format::obj, "obj", false},
                                        {Format::off, "off", false},
                                        {Format::ply, "ply", false},
                                        {Format::stl, "stl", false}}};

const Entry& entry(Format format) {
  return *std::find_if(entries.begin(), entries.end(),
                       [&](const Entry& e) { return e.format == format; });
}

bool is_binary_stl(std::string_view content) {
  constexpr std::size_t header = 84;
  std::uint32_t count = 0;
  if (content.size() < header) return false;
  std::memcpy(&count, content.data() + header - sizeof count, sizeof count);
  return count > 0 && content.size() == header + std::size_t{50} * count;
}

bool starts_with_word(std::string_view line, std::string_view word) {
  return line.starts_with(word) &&
         (line.size() == word.size() || line[word.size()] == ' ' || line[word.size()] == '\t');
}

/// SU2 and OBJ have no first line of their own: look for their keywords in the first lines.
std::optional<Format> format_of_lines(std::string_view content) {
  constexpr int lines_to_see = 200;
  for (int i = 0; i < lines_to_see && !content.empty(); ++i) {
    const auto end = content.find('\n');
    const auto line = trimmed(content.substr(0, end));
    content.remove_prefix(end == std::string_view::npos ? content.size() : end + 1);
    for (const std::string_view key : {"NDIME", "NPOIN", "NELEM", "NMARK", "MARKER_TAG", "NZONE"}) {
      if (line.starts_with(key) && line.find('=') != std::string_view::npos) return Format::su2;
    }
    for (const std::string_view key : {"v", "f", "vn", "vt", "mtllib", "usemtl"}) {
      if (starts_with_word(line, key)) return Format::obj;
    }
    if (!line.empty() && line.front() != '#' && line.front() != '%' && i > 50) break;
  }
  return std::nullopt;
}

}  // namespace

std::string_view format_name(Format format) { return entry(format).name; }

bool keeps_markers(Format format) { return entry(format).markers; }

std::optional<Format> format_of_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  if (extension.empty()) return std::nullopt;
  extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  for (const Entry& e : entries) {
    if (e.name == extension) return e.format;
  }
  return std::nullopt;
}

std::optional<Format> format_of_content(std::string_view content) {
  if (is_binary_stl(content)) return Format::stl;
  std::string_view start = content;
  if (start.starts_with("\xEF\xBB\xBF")) start.remove_prefix(3);
  while (!start.empty() && (start.front() == ' ' || start.front() == '\n' ||
                            start.front() == '\r' || start.front() == '\t')) {
    start.remove_prefix(1);
  }
  const auto first = trimmed(start.substr(0, start.find('\n')));
  if (first == "$MeshFormat" || first == "$NOD" || first == "$Comments") return Format::gmsh;
  if (first.starts_with("# vtk DataFile")) return Format::vtk;
  if (start.starts_with("<") && start.substr(0, 2000).find("<VTKFile") != std::string_view::npos) {
    return Format::vtu;
  }
  if (first == "ply") return Format::ply;
  for (const std::string_view magic : {"OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCNOFF"}) {
    if (starts_with_word(first, magic)) return Format::off;
  }
  if (starts_with_word(first, "solid")) return Format::stl;
  return format_of_lines(start);
}

std::string supported_extensions() {
  std::string text;
  for (const Entry& e : entries) text += (text.empty() ? "." : ", .") + std::string(e.name);
  return text;
}

}  // namespace winslow::io
