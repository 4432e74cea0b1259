#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "io/su2/su2.h"
#include "io/su2/su2_box.h"
#include "io/su2/su2_lines.h"
#include "io/su2/su2_points.h"
#include "io/su2/su2_zones.h"
#include "io/text/numbers.h"

namespace winslow::io::su2 {
namespace {

constexpr std::string_view keywords =
    "a keyword: NDIME=, NELEM=, NPOIN=, NMARK=, MARKER_TAG= or MARKER_ELEMS=";

/// VTK numbers of the element types that SU2 uses.
enum : std::int64_t { vertex = 1, line = 3, triangle = 5, quadrilateral = 9 };

/// " (second order)" and the like: why an element type is none of ours.
std::string hint_of(std::int64_t type) {
  // SU2 adds 100 for each order above the first of elements with Lagrange nodes.
  if (type > 100 && type < 2000) return " (order " + std::to_string(type / 100 + 1) + ")";
  if (type == 10 || type == 12 || type == 13 || type == 14) return " (a 3D mesh)";
  if (type >= 21 && type <= 37) return " (second order)";
  return {};
}

class Reader {
 public:
  Reader(const Source& source, std::size_t begin, std::size_t end)
      : source_(source), lines_(source, begin, end), begin_(begin), end_(end) {
    mesh_.details = details_;
    details_->line_end = first_line_end();
  }

  ParsedMesh read(bool dimension_known) {
    refuse_3d();
    while (!lines_.at_end()) read_item();
    finish(dimension_known);
    return std::move(mesh_);
  }
  Details& details() { return *details_; }

 private:
  std::string first_line_end() const {
    const auto newline = source_.text().find('\n');
    const bool windows =
        newline != std::string_view::npos && newline > 0 && source_.text()[newline - 1] == '\r';
    return windows ? "\r\n" : "\n";
  }

  /// Points are read as x y and what follows, which would drop a third coordinate where NPOIN comes
  /// before NDIME: so look at NDIME first.
  void refuse_3d() {
    const auto text = source_.text().substr(0, end_);
    for (auto at = text.find("NDIME", begin_); at != std::string_view::npos;
         at = text.find("NDIME", at + 1)) {
      const auto newline = text.rfind('\n', at);
      const std::size_t begin = newline == std::string_view::npos ? 0 : newline + 1;
      const Line l = LineReader(source_, begin, end_).next();
      if (l.key == "NDIME" && l.value == "3") {
        source_.fail(at, "NDIME= 3 (a 3D mesh)", "NDIME= 2");
      }
    }
  }

  void read_item() {
    const Line l = lines_.next();
    if (l.blank()) return keep(l);
    if (l.key.empty()) source_.fail(l.offset, in_quotes(l.text), std::string(keywords));
    if (l.key == "NDIME") return read_dimension(l);
    if (l.key == "NELEM") return read_elements(l);
    if (l.key == "NPOIN") return read_point_section(l);
    if (l.key == "NMARK") return read_marker_count(l);
    if (l.key == "MARKER_TAG" || l.key == "MARKERTAG") return read_marker(l);
    if (l.key == "MARKER_ELEMS") {
      source_.fail(l.offset, "MARKER_ELEMS=", "MARKER_TAG= before it");
    }
    keep_unknown(l);
  }

  void keep(const Line& l) {
    auto& items = details_->items;
    if (items.empty() || items.back().part != Details::Part::text) {
      items.push_back({Details::Part::text, {}});
    }
    items.back().text.append(l.bytes);
  }

  void keep_unknown(const Line& l) {
    if (l.key != "NZONE" && l.key != "IZONE" && unknown_.insert(std::string(l.key)).second &&
        unknown_.size() <= unknown_shown) {
      unknown_list_ += (unknown_list_.empty() ? "" : ", ") + in_quotes(l.key) + " (line " +
                       line_number(l.offset) + ")";
    }
    keep(l);
    while (!lines_.at_end()) {
      const Line next = lines_.next();
      if (!next.key.empty()) return lines_.back_to(next);
      keep(next);
    }
  }

  std::string line_number(std::size_t offset) const {
    const auto where = source_.where(offset);
    return where.substr(where.rfind(':') + 1);
  }

  void once(const Line& l, Details::Part part) {
    const bool seen = std::any_of(details_->items.begin(), details_->items.end(),
                                  [&](const auto& item) { return item.part == part; });
    if (seen) source_.fail(l.offset, "a second " + std::string(l.key) + "=", "one only");
    details_->items.push_back({part, {}});
  }

  Index count(std::string_view value, const char* what, std::size_t bytes_each) const {
    const auto n = parse_integer(value);
    if (!n) lines_.fail(value, what);
    return checked_count(source_, source_.offset_of(value), *n, bytes_each, lines_.bytes_left(),
                         {what});
  }

  void read_dimension(const Line& l) {
    once(l, Details::Part::dimension);
    if (l.value != "2") source_.fail(l.offset, "NDIME= " + std::string(l.value), "NDIME= 2");
  }

  /// Reads the optional number at the end of a data line.
  bool end_data_line(LineWords& words, Index expected_number, const char* what) {
    const auto word = words.next();
    if (word.empty()) return false;
    const auto number = parse_integer(word);
    if (!number) {
      lines_.fail(word, std::string("the number of the ") + what + " or the end of the line");
    }
    renumbered_ = renumbered_ || *number != expected_number;
    if (const auto more = words.next(); !more.empty()) lines_.fail(more, "the end of the line");
    return true;
  }

  void read_corners(LineWords& words, std::span<Index> corners, const Expected& expected) {
    for (Index& corner : corners) {
      const auto word = words.next();
      const auto value = parse_integer(word);
      if (!value || *value < 0 || *value > std::numeric_limits<Index>::max()) {
        lines_.fail(word, "a node number of " + expected.text());
      }
      corner = static_cast<Index>(*value);
    }
  }

  void read_elements(const Line& l) {
    once(l, Details::Part::elements);
    const Index n = count(l.value, "the number of elements", 8);
    mesh_.data.types.reserve(static_cast<std::size_t>(n));
    mesh_.data.element_offsets.reserve(static_cast<std::size_t>(n) + 1);
    mesh_.data.element_nodes.reserve(static_cast<std::size_t>(n) * 3);
    mesh_.where.elements.reserve(static_cast<std::size_t>(n));
    for (Index e = 0; e < n; ++e) {
      const Expected expected{"element", e, n};
      const Line data = lines_.next_data(expected);
      mesh_.where.elements.push_back(source_.offset_of(data.text));
      LineWords words(data.text);
      const ElementType type = element_type(words.next(), expected);
      std::array<Index, 4> corners{};
      const auto size = static_cast<std::size_t>(corner_count(type));
      read_corners(words, {corners.data(), size}, expected);
      mesh_.data.add_element(type, {corners.data(), size});
      details_->element_numbers |= end_data_line(words, e, "element");
    }
  }

  ElementType element_type(std::string_view word, const Expected& expected) const {
    const auto type = parse_integer(word);
    if (!type) lines_.fail(word, expected.text());
    if (*type == triangle) return ElementType::triangle;
    if (*type == quadrilateral) return ElementType::quadrilateral;
    source_.fail(source_.offset_of(word), "element type " + std::string(word) + hint_of(*type),
                 "5 (triangle) or 9 (quadrilateral)");
  }

  void read_point_section(const Line& l) {
    once(l, Details::Part::points);
    const auto space = std::min(l.value.find_first_of(" \t"), l.value.size());
    const Index n = count(l.value.substr(0, space), "the number of points", 4);
    const auto owned = trimmed(l.value.substr(space));
    if (!owned.empty() && parse_integer(owned) != n) {
      mesh_.warnings.push_back("only " + std::string(owned) + " of " + std::to_string(n) +
                               " points are the file's own: it is one part of a partitioned mesh");
    }
    details_->items.back().text = owned;
    renumbered_ |= read_points(lines_, n, mesh_, *details_);
  }

  void read_marker_count(const Line& l) {
    once(l, Details::Part::marker_count);
    marker_count_ = count(l.value, "the number of markers", 12);
    marker_count_offset_ = l.offset;
  }

  void read_marker(const Line& tag) {
    const std::string name(tag.value);
    if (name.empty()) source_.fail(tag.offset, "no name", "MARKER_TAG= NAME");
    if (name == "SEND_RECEIVE") return keep_send_receive(tag);
    if (!names_.insert(name).second) {
      source_.fail(tag.offset, "a second marker " + in_quotes(name), "one only");
    }
    const std::string wanted = "MARKER_ELEMS= of marker " + in_quotes(name);
    const Line l = lines_.next_data({wanted.c_str()});
    if (l.key != "MARKER_ELEMS") lines_.fail(l.text, wanted);
    details_->items.push_back({Details::Part::marker, {}});
    const Index n = count(l.value, "the number of edges of a marker", 6);
    Marker marker{name, static_cast<int>(mesh_.data.markers.size()) + 1, {}};
    marker.faces.reserve(static_cast<std::size_t>(n));
    std::vector<std::size_t> offsets;
    offsets.reserve(static_cast<std::size_t>(n));
    for (Index e = 0; e < n; ++e) {
      const Expected expected{"marker edge", e, n};
      const Line data = lines_.next_data(expected);
      offsets.push_back(source_.offset_of(data.text));
      LineWords words(data.text);
      const auto type = words.next();
      if (parse_integer(type) != line) refuse_marker_element(type, expected);
      std::array<Index, 2> edge{};
      read_corners(words, edge, expected);
      marker.faces.emplace_back(edge[0], edge[1]);
      details_->edge_numbers |= end_data_line(words, e, "marker edge");
    }
    mesh_.data.markers.push_back(std::move(marker));
    mesh_.where.marker_edges.push_back(std::move(offsets));
  }

  [[noreturn]] void refuse_marker_element(std::string_view word, const Expected& expected) const {
    const auto type = parse_integer(word);
    if (!type) lines_.fail(word, expected.text());
    const bool solid_face = *type == triangle || *type == quadrilateral;
    source_.fail(
        source_.offset_of(word),
        "marker element type " + std::string(word) + (solid_face ? " (a 3D mesh)" : hint_of(*type)),
        "3 (line)");
  }

  void keep_send_receive(const Line& tag) {
    keep(tag);
    ++details_->raw_markers;
    if (details_->raw_markers == 1) {
      mesh_.warnings.push_back(
          "marker SEND_RECEIVE is bookkeeping of the solver: it is kept as it is, no boundary");
    }
    while (!lines_.at_end()) {
      const Line l = lines_.next();
      const bool own =
          l.key.empty() || l.key == "MARKER_ELEMS" || l.key == "SEND_TO" || l.key == "SEND_RECEIVE";
      if (!own) return lines_.back_to(l);
      keep(l);
    }
  }

  void finish(bool dimension_known) {
    const auto has = [&](Details::Part part) {
      return std::any_of(details_->items.begin(), details_->items.end(),
                         [&](const auto& item) { return item.part == part; });
    };
    if (!dimension_known && !has(Details::Part::dimension)) {
      source_.fail(end_, "no NDIME=", "NDIME= 2");
    }
    if (!has(Details::Part::points)) source_.fail(end_, "no NPOIN=", "the points of the mesh");
    if (!has(Details::Part::elements)) source_.fail(end_, "no NELEM=", "the elements of the mesh");
    const auto found = static_cast<Index>(mesh_.data.markers.size()) + details_->raw_markers;
    if (marker_count_ && *marker_count_ != found) {
      source_.fail(marker_count_offset_, std::to_string(found) + " markers",
                   std::to_string(*marker_count_) + " as NMARK= says");
    }
    add_warnings();
    details_->nodes = mesh_.data.node_count();
    details_->elements = mesh_.data.element_count();
    details_->markers = mesh_.data.markers.size();
    check_finite(source_, mesh_);
  }

  void add_warnings() {
    if (!unknown_list_.empty()) {
      const bool one = unknown_.size() == 1;
      if (unknown_.size() > unknown_shown)
        unknown_list_ += " and " + std::to_string(unknown_.size() - unknown_shown) + " more";
      mesh_.warnings.push_back((one ? "keyword " : "keywords ") + unknown_list_ +
                               (one ? " is" : " are") +
                               " not understood; the lines are kept as they are");
    }
    if (renumbered_) {
      mesh_.warnings.emplace_back(
          "the numbers at the ends of lines do not count from 0 upwards: as SU2 does, the order of "
          "the lines is used and the numbers are not");
    }
  }

  static constexpr std::size_t unknown_shown = 3;  // a box for deformations has a dozen of its own

  const Source& source_;
  LineReader lines_;
  std::size_t begin_, end_;
  ParsedMesh mesh_;
  std::shared_ptr<Details> details_ = std::make_shared<Details>();
  std::optional<Index> marker_count_;
  std::size_t marker_count_offset_ = 0;
  std::set<std::string> names_;
  std::set<std::string> unknown_;
  std::string unknown_list_;
  bool renumbered_ = false;
};

/// True if what stands before the first zone says NDIME= 2, as it may for all zones.
bool says_dimension(const Source& source, std::size_t head_end) {
  LineReader lines(source, 0, head_end);
  while (!lines.at_end()) {
    const Line l = lines.next();
    if (l.key == "NDIME" && l.value == "2") return true;
  }
  return false;
}

}  // namespace

ParsedMesh read_zone(Source& source, int number) {
  const ZoneList list = find_zones(source);
  const std::size_t chosen = choose_zone(list, number, source.name());
  const ZoneList::Zone& zone = list.zones[chosen];
  Reader reader(source, zone.begin, zone.end);
  Details& details = reader.details();
  ParsedMesh mesh = reader.read(list.several && says_dimension(source, list.zones[0].begin));
  details.zone = zone.number;
  details.box_points = box_points(source, mesh);
  if (!list.several) return mesh;
  details.zones = list.numbers();
  details.blocks = std::make_shared<const std::vector<std::string>>(list.blocks(source));
  details.block = chosen + 1;
  return mesh;
}

}  // namespace winslow::io::su2
