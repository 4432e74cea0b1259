#include "io/openfoam/foam_file.h"

#include "core/mesh/index_sets.h"

namespace winslow::io::openfoam {

void FoamFaces::add(std::span<const Index> face, std::size_t place) {
  nodes.insert(nodes.end(), face.begin(), face.end());
  offsets.push_back(index_count(nodes.size(), "points of faces"));
  places.push_back(place);
}

std::string_view FoamScanner::next() {
  skip();
  const auto text = source_.text().substr(0, range_.end);
  const std::size_t begin = std::min(scan_.offset(), text.size());
  std::size_t end = begin;
  if (begin < text.size() && text[begin] == '"') {
    end = std::min(text.find('"', begin + 1), text.size() - 1) + 1;
  } else if (begin < text.size() &&
             std::string_view("(){};[]").find(text[begin]) != std::string_view::npos) {
    end = begin + 1;
  } else {
    end = std::min(text.find_first_of("(){};[] \t\r\n\v\f", begin), text.size());
  }
  scan_.seek(end);
  return text.substr(begin, end - begin);
}

std::string_view FoamScanner::peek() {
  const std::size_t here = offset();
  const auto word = next();
  scan_.seek(here);
  return word;
}

void FoamScanner::expect(std::string_view word) {
  const auto found = next();
  if (found != word) fail(found, "'" + std::string(word) + "'");
}

std::int64_t FoamScanner::integer(const Expected& expected) {
  const auto word = next();
  const auto value = parse_integer(word);
  if (!value) fail(word, expected.text());
  return *value;
}

double FoamScanner::number(const Expected& expected) {
  const auto word = next();
  const auto value = parse_number(word);
  if (!value) fail(word, expected.text());
  return *value;
}

Index FoamScanner::count(const Expected& expected, std::size_t bytes_each) {
  const std::size_t start = offset();
  const std::int64_t found = integer(expected);
  return checked_count(source_, start, found, bytes_each, scan_.bytes_left(), expected);
}

void FoamScanner::skip() {
  const auto text = source_.text().substr(0, range_.end);
  for (;;) {
    scan_.skip_space();
    const auto rest = text.substr(std::min(scan_.offset(), text.size()));
    if (rest.starts_with("//")) {
      scan_.line();
    } else if (rest.starts_with("/*")) {
      const auto end = text.find("*/", scan_.offset() + 2);
      if (end == std::string_view::npos)
        source_.fail(scan_.offset(), "a comment without end", "*/");
      scan_.seek(end + 2);
    } else {
      return;
    }
  }
}

namespace {

/// Reads the entry `arch`: "LSB;label=32;scalar=64".
void read_arch(std::string_view arch, FoamForm& form) {
  form.big_endian = arch.find("MSB") != std::string_view::npos;
  if (arch.find("label=64") != std::string_view::npos) form.label_bytes = 8;
  if (arch.find("scalar=32") != std::string_view::npos) form.scalar_bytes = 4;
}

}  // namespace

FoamForm FoamScanner::header() {
  FoamForm form;
  if (peek() != "FoamFile") return form;
  next();
  expect("{");
  for (auto key = next(); key != "}"; key = next()) {
    if (key.empty()) fail(key, "'}'");
    const auto value = peek();
    if (key == "format" && value != "ascii" && value != "binary") fail(value, "ascii or binary");
    if (key == "format") form.binary = value == "binary";
    if (key == "class") form.content = value;
    if (key == "arch") read_arch(value, form);
    for (auto word = next(); word != ";"; word = next()) {
      if (word.empty()) fail(word, "';'");
    }
  }
  if (form.binary) source_.set_binary(range_, scan_.offset());
  return form;
}

Index FoamScanner::open_list(const FoamForm& form, const Expected& expected, std::size_t text_bytes,
                             std::size_t binary_bytes) {
  const std::size_t start = offset();
  const std::int64_t found = integer(expected);
  // "1000000{0}" is a list of equal entries.
  const std::size_t bytes = form.binary ? binary_bytes : peek() == "{" ? 0 : text_bytes;
  const Index n = bytes == 0
                      ? checked_count(source_, start, found, 1, source_.text().size(), expected)
                      : checked_count(source_, start, found, bytes, scan_.bytes_left(), expected);
  // An empty binary list has no brackets.
  if (peek() == "(" || (n > 0 && peek() != "{")) expect("(");
  return n;
}

void FoamScanner::close_list(const FoamForm& form, Index count) {
  if (peek() == ")" || count > 0 || !form.binary) expect(")");
}

FoamList<Index> FoamScanner::labels(const FoamForm& form, const Expected& entry, Index least) {
  FoamList<Index> list;
  const Index n = open_list(form, {"the length of a list"}, 2, form.label_bytes);
  const auto add = [&](std::int64_t value, std::size_t place) {
    if (value < least || value > std::numeric_limits<Index>::max())
      source_.fail(place, std::to_string(value), entry.text());
    list.values.push_back(static_cast<Index>(value));
    list.places.push_back(place);
  };
  if (peek() == "{") {
    next();
    const std::size_t place = offset();
    const std::int64_t value = integer(entry);
    for (Index i = 0; i < n; ++i) add(value, place);
    expect("}");
    return list;
  }
  for (Index i = 0; i < n; ++i) {
    const Expected expected{entry.what, i, n};
    const std::size_t place = form.binary ? scan_.offset() : offset();
    add(form.binary ? scan_.bytes<std::int64_t>(form.label(), form.big_endian, expected)
                    : integer(expected),
        place);
  }
  close_list(form, n);
  return list;
}

FoamList<double> FoamScanner::points(const FoamForm& form) {
  FoamList<double> list;
  const Index n = open_list(form, {"the number of points"}, 7, 3 * form.scalar_bytes);
  list.values.reserve(3 * at(n));
  for (Index i = 0; i < n; ++i) {
    const Expected expected{"a coordinate of point", i, n};
    list.places.push_back(form.binary ? scan_.offset() : offset());
    if (!form.binary) expect("(");
    for (int k = 0; k < 3; ++k)
      list.values.push_back(form.binary
                                ? scan_.bytes<double>(form.scalar(), form.big_endian, expected)
                                : number(expected));
    if (!form.binary) expect(")");
  }
  close_list(form, n);
  return list;
}

Index FoamScanner::point_of_face(std::int64_t node, std::size_t place, Index points) const {
  if (node < 0 || node >= points)
    source_.fail(place, "point " + std::to_string(node), "0 to " + std::to_string(points - 1));
  return static_cast<Index>(node);
}

FoamFaces FoamScanner::faces(const FoamForm& form, Index points) {
  if (form.binary || form.content == "faceCompactList") return compact_faces(form, points);
  FoamFaces faces;
  const Index n = open_list(form, {"the number of faces"}, 8, 8);
  std::vector<Index> corners;
  for (Index f = 0; f < n; ++f) {
    const std::size_t begin = offset();
    const Index size = count({"the number of points of face", f, n}, 2);
    expect("(");
    corners.clear();
    for (Index k = 0; k < size; ++k) {
      const std::size_t place = offset();
      corners.push_back(point_of_face(integer({"a point of face", f, n}), place, points));
    }
    expect(")");
    faces.add(corners, begin);
  }
  close_list(form, n);
  return faces;
}

FoamFaces FoamScanner::compact_faces(const FoamForm& form, Index points) {
  const FoamList<Index> offsets = labels(form, {"where a face begins in the list of points"});
  const FoamList<Index> nodes = labels(form, {"a point of a face"});
  FoamFaces faces;
  for (std::size_t i = 0; i < nodes.values.size(); ++i)
    point_of_face(nodes.values[i], nodes.places[i], points);
  for (std::size_t f = 0; f + 1 < offsets.values.size(); ++f) {
    const Index begin = offsets.values[f], end = offsets.values[f + 1];
    if (begin > end || at(end) > nodes.values.size())
      source_.fail(offsets.places[f + 1],
                   "face " + std::to_string(f) + " from point " + std::to_string(begin) + " to " +
                       std::to_string(end),
                   "ascending numbers up to " + std::to_string(nodes.values.size()));
    faces.add(std::span(nodes.values).subspan(at(begin), at(end - begin)),
              begin < end ? nodes.places[at(begin)] : offsets.places[f]);
  }
  return faces;
}

std::string with_entry(const std::string& header, std::string_view key, const std::string& value) {
  Source source("", header);
  FoamScanner scan(source, {0, header.size()});
  while (!scan.peek().empty()) {
    const bool found = scan.next() == key;
    if (!found) continue;
    const std::size_t begin = scan.offset();
    std::size_t end = begin;
    for (auto word = scan.next(); word != ";" && !word.empty(); word = scan.next())
      end = scan.position();
    return header.substr(0, begin) + value + header.substr(end);
  }
  return header;
}

void write_points(TextWriter& out, std::span<const double> xyz, const FoamForm& form) {
  out << xyz.size() / 3 << "\n(";
  if (!form.binary) {
    out << '\n';
    for (std::size_t i = 0; i < xyz.size(); i += 3)
      out << '(' << xyz[i] << ' ' << xyz[i + 1] << ' ' << xyz[i + 2] << ")\n";
  } else if (form.scalar_bytes == 4) {
    for (const double value : xyz) out.raw(static_cast<float>(value), form.big_endian);
  } else {
    for (const double value : xyz) out.raw(value, form.big_endian);
  }
  out << ')';
}

}  // namespace winslow::io::openfoam
