#include "io/format/mesh_format.h"

#include "io/file/gzip.h"
#include "io/text/source.h"

namespace winslow::io {

Content::Content(std::string_view bytes) : whole(bytes), start(bytes) {
  if (start.starts_with("\xEF\xBB\xBF")) start.remove_prefix(3);
  while (!start.empty() && (start.front() == ' ' || start.front() == '\n' ||
                            start.front() == '\r' || start.front() == '\t')) {
    start.remove_prefix(1);
  }
  first_line = trimmed(start.substr(0, start.find('\n')));
}

bool Evidence::stronger_than(const Evidence& other) const {
  return kind != other.kind ? kind > other.kind : line < other.line;
}

const MeshFormat* format_of_extension(const std::filesystem::path& path) {
  const auto name = (path.has_filename() ? path : path.parent_path()).filename();
  for (const MeshFormat* format : mesh_formats()) {
    if (!format->folder_name.empty() && name == format->folder_name) return format;
  }
  std::string extension =
      (is_gzip_name(path) ? path.stem().extension() : path.extension()).string();
  if (extension.empty()) return nullptr;
  extension = lower_case(extension.substr(1));
  for (const MeshFormat* format : mesh_formats()) {
    if (format->name == extension) return format;
  }
  return nullptr;
}

const MeshFormat* format_of_folder(const std::filesystem::path& path) {
  for (const MeshFormat* format : mesh_formats())
    if (format->find_folder && !format->find_folder(path, {}).empty()) return format;
  return nullptr;
}

const MeshFormat* format_of_output(const std::filesystem::path& path, const MeshFormat* source) {
  if (const MeshFormat* format = format_of_extension(path)) return format;
  for (const MeshFormat* format : mesh_formats())
    if (format->is_folder_to_write && format->is_folder_to_write(path, format == source))
      return format;
  return nullptr;
}

const MeshFormat* format_of_content(std::string_view bytes) {
  const Content content(bytes);
  const MeshFormat* best = nullptr;
  Evidence strongest;
  for (const MeshFormat* format : mesh_formats()) {
    const Evidence evidence = format->recognise(content);
    if (!evidence.stronger_than(strongest)) continue;
    strongest = evidence;
    best = format;
  }
  return best;
}

std::string supported_extensions() {
  return list_of(mesh_formats(),
                 [](const MeshFormat* format) { return '.' + std::string(format->name); });
}

std::string writable_extensions() {
  return list_of(mesh_formats(), [](const MeshFormat* format) {
    return format->folder_name.empty() ? '.' + std::string(format->name)
                                       : "folder " + std::string(format->folder_name);
  });
}

std::string binary_formats() {
  std::string text;
  for (const MeshFormat* format : mesh_formats())
    if (format->has_binary) text += (text.empty() ? "" : ", ") + std::string(format->title);
  return text;
}

bool starts_with_word(std::string_view line, std::string_view word) {
  return line.starts_with(word) &&
         (line.size() == word.size() || line[word.size()] == ' ' || line[word.size()] == '\t');
}

Evidence signature_if(bool found) {
  return {found ? Evidence::Kind::signature : Evidence::Kind::none};
}

Evidence keyword_on_line(const Content& content, bool (*is_keyword)(std::string_view line)) {
  // There may be many comments and blank lines; of other lines only the first few are tested.
  constexpr int lines_to_see = 200, other_lines_to_see = 50;
  std::string_view rest = content.start;
  for (int i = 0; i < lines_to_see && !rest.empty(); ++i) {
    const auto end = rest.find('\n');
    const auto line = trimmed(rest.substr(0, end));
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (is_keyword(line)) return {Evidence::Kind::keyword, i};
    if (!line.empty() && line.front() != '#' && line.front() != '%' && i > other_lines_to_see)
      break;
  }
  return {};
}

}  // namespace winslow::io
