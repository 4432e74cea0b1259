#include <algorithm>
#include <limits>
#include <optional>
#include <set>

#include "io/su2/su2.h"
#include "io/text/numbers.h"
#include "io/text/scanner.h"

namespace winslow::io::su2 {
namespace {

constexpr std::string_view keywords =
    "a keyword: NDIME=, NELEM=, NPOIN=, NMARK=, MARKER_TAG= or MARKER_ELEMS=";

/// VTK numbers of the element types that SU2 uses.
enum : std::int64_t { vertex = 1, line = 3, triangle = 5, quadrilateral = 9 };

bool is_comment(std::string_view text) { return !text.empty() && text.front() == '%'; }

class Reader {
 public:
  explicit Reader(const Source& source) : source_(source), scan_(source) {
    mesh_.details = details_;
  }

  ParsedMesh read() {
    refuse_3d();
    while (!scan_.at_end()) read_item();
    finish();
    return std::move(mesh_);
  }

 private:
  /// A keyword line: "KEY= value % comment".
  struct Line {
    std::size_t offset;
    std::string_view whole;
    std::string_view key;  ///< empty: not a keyword line
    std::string_view value;
  };

  Line next_line() {
    const std::size_t offset = scan_.offset();
    const auto whole = scan_.line();
    auto text = whole.substr(0, whole.find('%'));
    const auto equals = text.find('=');
    if (equals == std::string_view::npos) return {offset, whole, {}, {}};
    return {offset, whole, trimmed(text.substr(0, equals)), trimmed(text.substr(equals + 1))};
  }

  /// Points are read as x y [number], which would misread a third coordinate where NPOIN comes
  /// before NDIME: so look at NDIME first.
  void refuse_3d() {
    const auto text = source_.text();
    for (auto at = text.find("NDIME"); at != std::string_view::npos;
         at = text.find("NDIME", at + 1)) {
      if (at > 0 && text[at - 1] != '\n' && text[at - 1] != ' ' && text[at - 1] != '\t') continue;
      Scanner scan(source_, at);
      auto value = scan.line();
      value.remove_prefix(std::min(value.size(), value.find('=') + 1));
      value = trimmed(value.substr(0, value.find('%')));
      if (value == "3") source_.fail(at, "NDIME= 3 (a 3D mesh)", "NDIME= 2");
    }
  }

  void read_item() {
    const Line l = next_line();
    const auto text = trimmed(l.whole);
    if (text.empty() || is_comment(text)) return keep(l.whole);
    if (l.key.empty()) source_.fail(l.offset, in_quotes(text), std::string(keywords));
    if (l.key == "NDIME") return read_dimension(l);
    if (l.key == "NELEM") return read_elements(l);
    if (l.key == "NPOIN") return read_points(l);
    if (l.key == "NMARK") return read_marker_count(l);
    if (l.key == "MARKER_TAG") return read_marker(l);
    if (l.key == "NZONE" && l.value != "1") {
      source_.fail(l.offset, "NZONE= " + std::string(l.value), "a mesh of one zone");
    }
    if (l.key == "MARKER_ELEMS") {
      source_.fail(l.offset, "MARKER_ELEMS=", "MARKER_TAG= before it");
    }
    keep_unknown(l);
  }

  void keep(std::string_view line) {
    auto& items = details_->items;
    if (items.empty() || items.back().part != Details::Part::text) {
      items.push_back({Details::Part::text, {}});
    }
    items.back().text.append(line).append("\n");
  }

  void keep_unknown(const Line& l) {
    if (l.key != "NZONE" && l.key != "IZONE") {
      mesh_.warnings.push_back("keyword " + in_quotes(l.key) + " (line " + line_number(l.offset) +
                               ") is not understood; its lines are kept as they are");
    }
    keep(l.whole);
    for (;;) {
      const std::size_t offset = scan_.offset();
      if (scan_.at_end()) return;
      const auto next = next_line();
      if (!next.key.empty()) return scan_.seek(offset);
      keep(next.whole);
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
    if (!n) scan_.fail(value, what);
    return checked_count(source_, source_.offset_of(value), *n, bytes_each, scan_.bytes_left(),
                         {what});
  }

  void read_dimension(const Line& l) {
    once(l, Details::Part::dimension);
    if (l.value != "2") source_.fail(l.offset, "NDIME= " + std::string(l.value), "NDIME= 2");
  }

  /// Goes to the first word of the next data line: over blank lines and comments.
  void begin_data_line(const Expected& expected) {
    for (;;) {
      scan_.skip_space();
      if (scan_.at_end()) scan_.fail(source_.text().substr(source_.text().size()), expected);
      if (source_.text()[scan_.offset()] != '%') return;
      scan_.line();
    }
  }

  /// Reads the optional number at the end of a data line, and the comment after that.
  bool end_data_line(Index expected_number, const char* what) {
    auto word = scan_.word();
    const bool numbered = !word.empty() && !is_comment(word);
    if (numbered) {
      const auto number = parse_integer(word);
      if (!number)
        scan_.fail(word, std::string("the number of the ") + what + " or the end of the line");
      renumbered_ = renumbered_ || *number != expected_number;
      word = scan_.word();
      if (!word.empty() && !is_comment(word)) scan_.fail(word, "the end of the line");
    }
    scan_.line();
    return numbered;
  }

  void read_corners(std::span<Index> corners, const Expected& expected) {
    for (Index& corner : corners) {
      const auto word = scan_.word();
      const auto value = parse_integer(word);
      if (!value || *value < 0 || *value > std::numeric_limits<Index>::max()) {
        scan_.fail(word, "a node number of " + expected.text());
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
      begin_data_line(expected);
      mesh_.where.elements.push_back(scan_.offset());
      const auto word = scan_.word();
      const ElementType type = element_type(word, expected);
      std::array<Index, 4> corners{};
      const auto size = static_cast<std::size_t>(corner_count(type));
      read_corners({corners.data(), size}, expected);
      mesh_.data.add_element(type, {corners.data(), size});
      details_->element_numbers |= end_data_line(e, "element");
    }
  }

  ElementType element_type(std::string_view word, const Expected& expected) const {
    const auto type = parse_integer(word);
    if (!type) scan_.fail(word, expected);
    if (*type == triangle) return ElementType::triangle;
    if (*type == quadrilateral) return ElementType::quadrilateral;
    const auto offset = source_.offset_of(word);
    const bool solid = *type == 10 || *type == 12 || *type == 13 || *type == 14;
    const bool second_order = *type >= 21 && *type <= 37;
    source_.fail(offset,
                 "element type " + std::string(word) +
                     (solid          ? " (a 3D mesh)"
                      : second_order ? " (second order)"
                                     : ""),
                 "5 (triangle) or 9 (quadrilateral)");
  }

  void read_points(const Line& l) {
    once(l, Details::Part::points);
    const auto space = std::min(l.value.find_first_of(" \t"), l.value.size());
    const Index n = count(l.value.substr(0, space), "the number of points", 4);
    const auto owned = trimmed(l.value.substr(space));
    if (!owned.empty() && parse_integer(owned) != n) {
      mesh_.warnings.push_back("only " + std::string(owned) + " of " + std::to_string(n) +
                               " points are the file's own: it is one part of a partitioned mesh");
    }
    details_->items.back().text = owned;
    mesh_.data.coordinates = Coordinates(2, n);
    mesh_.where.nodes.reserve(static_cast<std::size_t>(n));
    for (Index i = 0; i < n; ++i) {
      const Expected expected{"point", i, n};
      begin_data_line(expected);
      mesh_.where.nodes.push_back(scan_.offset());
      const double x = scan_.number(expected);
      const double y = scan_.number({"y of point", i, n});
      mesh_.data.coordinates.set_xy(i, {x, y});
      details_->point_numbers |= end_data_line(i, "point");
    }
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
    Line l = next_line();
    while (l.key.empty() && !scan_.at_end() &&
           (trimmed(l.whole).empty() || is_comment(trimmed(l.whole)))) {
      l = next_line();
    }
    if (l.key != "MARKER_ELEMS") {
      scan_.fail(trimmed(l.whole), "MARKER_ELEMS= of marker " + in_quotes(name));
    }
    details_->items.push_back({Details::Part::marker, {}});
    const Index n = count(l.value, "the number of edges of a marker", 6);
    Marker marker{name, static_cast<int>(mesh_.data.markers.size()) + 1, {}};
    marker.faces.reserve(static_cast<std::size_t>(n));
    std::vector<std::size_t> offsets;
    offsets.reserve(static_cast<std::size_t>(n));
    for (Index e = 0; e < n; ++e) {
      const Expected expected{"marker edge", e, n};
      begin_data_line(expected);
      offsets.push_back(scan_.offset());
      const auto word = scan_.word();
      if (parse_integer(word) != line) refuse_marker_element(word, expected);
      std::array<Index, 2> edge{};
      read_corners(edge, expected);
      marker.faces.emplace_back(edge[0], edge[1]);
      details_->edge_numbers |= end_data_line(e, "marker edge");
    }
    mesh_.data.markers.push_back(std::move(marker));
    mesh_.where.marker_edges.push_back(std::move(offsets));
  }

  [[noreturn]] void refuse_marker_element(std::string_view word, const Expected& expected) const {
    const auto type = parse_integer(word);
    if (!type) scan_.fail(word, expected);
    const char* hint = *type == triangle || *type == quadrilateral ? " (a 3D mesh)"
                       : *type >= 21 && *type <= 37                ? " (second order)"
                                                                   : "";
    source_.fail(source_.offset_of(word), "marker element type " + std::string(word) + hint,
                 "3 (line)");
  }

  void keep_send_receive(const Line& tag) {
    keep(tag.whole);
    ++details_->raw_markers;
    if (details_->raw_markers == 1) {
      mesh_.warnings.push_back(
          "marker SEND_RECEIVE is bookkeeping of the solver: it is kept as it is, no boundary");
    }
    for (;;) {
      const std::size_t offset = scan_.offset();
      if (scan_.at_end()) return;
      const auto l = next_line();
      const bool own =
          l.key.empty() || l.key == "MARKER_ELEMS" || l.key == "SEND_TO" || l.key == "SEND_RECEIVE";
      if (!own) return scan_.seek(offset);
      keep(l.whole);
    }
  }

  void finish() {
    const auto has = [&](Details::Part part) {
      return std::any_of(details_->items.begin(), details_->items.end(),
                         [&](const auto& item) { return item.part == part; });
    };
    const auto end = source_.text().size();
    if (!has(Details::Part::dimension)) source_.fail(end, "no NDIME=", "NDIME= 2");
    if (!has(Details::Part::points)) source_.fail(end, "no NPOIN=", "the points of the mesh");
    if (!has(Details::Part::elements)) source_.fail(end, "no NELEM=", "the elements of the mesh");
    const auto found = static_cast<Index>(mesh_.data.markers.size()) + details_->raw_markers;
    if (marker_count_ && *marker_count_ != found) {
      source_.fail(marker_count_offset_, std::to_string(found) + " markers",
                   std::to_string(*marker_count_) + " as NMARK= says");
    }
    if (renumbered_) {
      mesh_.warnings.emplace_back(
          "the numbers at the ends of lines do not count from 0 upwards: as SU2 does, the order of "
          "the lines is used and the numbers are not");
    }
    details_->nodes = mesh_.data.node_count();
    details_->elements = mesh_.data.element_count();
    details_->markers = mesh_.data.markers.size();
    check_finite(source_, mesh_);
  }

  const Source& source_;
  Scanner scan_;
  ParsedMesh mesh_;
  std::shared_ptr<Details> details_ = std::make_shared<Details>();
  std::optional<Index> marker_count_;
  std::size_t marker_count_offset_ = 0;
  std::set<std::string> names_;
  bool renumbered_ = false;
};

}  // namespace

ParsedMesh read(Source& source) { return Reader(source).read(); }

}  // namespace winslow::io::su2
