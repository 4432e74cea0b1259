#include <set>

#include "io/format/foreign_formats.h"
#include "io/format/mesh_in_space.h"
#include "io/su2/su2.h"
#include "io/su2/su2_lines.h"
#include "io/su2/su2_periodic.h"
#include "io/text/numbers.h"

namespace winslow::io::su2 {
namespace {

constexpr std::string_view keywords =
    "a keyword: NDIME=, NELEM=, NPOIN=, NMARK=, MARKER_TAG= or MARKER_ELEMS=";

/// Finds the common form of the line ends of all points.
class Tails {
 public:
  explicit Tails(Index count) { views_.reserve(static_cast<std::size_t>(count)); }

  /// `last`: the word read as the last coordinate of point i; `tail`: the text after it.
  void add(Index i, std::string_view last, std::string_view tail) {
    views_.push_back(tail);
    const auto number = parse_integer(tail);
    if (tail.empty()) {
      ++bare_;
      if (parse_integer(last) == i) {
        ++short_;
        if (first_short_.data() == nullptr) first_short_ = tail;
      }
    } else if (number == i) {
      ++numbered_;
    } else {
      renumbered_ = renumbered_ || number.has_value();
    }
  }

  /// The first line "x number", which lacks a coordinate: the word read as its last coordinate is
  /// the number of the point. Either other lines have a number after their coordinates, or no line
  /// has one and every last coordinate is the number of its point. With up to three points the
  /// latter may be a coincidence.
  std::optional<std::string_view> first_short() const {
    constexpr std::size_t may_be_chance = 3;
    const bool every = short_ == views_.size() && short_ > may_be_chance;
    if (short_ > 0 && (bare_ < views_.size() || every)) return first_short_;
    return std::nullopt;
  }

  bool renumbered() const { return renumbered_; }

  void keep(Details& details) const {
    details.point_numbers = numbered_ > 0;
    if (bare_ == views_.size() || numbered_ == views_.size()) return;
    details.point_tails.assign(views_.begin(), views_.end());
  }

 private:
  std::vector<std::string_view> views_;
  std::size_t bare_ = 0, numbered_ = 0, short_ = 0;
  std::string_view first_short_;
  bool renumbered_ = false;
};

/// Reads the lines of NPOIN= into `values` (#points by dimension): x, y, and z in dimension 3. Text
/// after them is ignored, as in SU2. Adds the places of the lines. Returns true if single numbers
/// at the ends of lines do not count from 0.
bool read_points(LineReader& lines, int dimension, std::span<double> values,
                 std::vector<std::size_t>& places, Details& details) {
  static constexpr std::array names{"point", "y of point", "z of point"};
  static constexpr std::array numerals{"no", "one", "two", "three"};
  const auto count = static_cast<Index>(values.size() / static_cast<std::size_t>(dimension));
  std::size_t start = 0;
  places.reserve(static_cast<std::size_t>(count));
  Tails tails(count);
  for (Index i = 0; i < count; ++i) {
    const Expected expected{"point", i, count};
    const Line line = lines.next_data(expected);
    places.push_back(lines.source().offset_of(line.text));
    LineWords words(line.text);
    std::string_view word;
    for (int k = 0; k < dimension; ++k) {
      word = words.next();
      const auto value = parse_number(word);
      if (!value) lines.fail(word, Expected{names[static_cast<std::size_t>(k)], i, count}.text());
      values[start++] = *value;
    }
    tails.add(i, word, words.rest());
  }
  if (const auto tail = tails.first_short()) {
    lines.fail(*tail, std::string(numerals[at(dimension)]) +
                          " coordinates before the number of the point");
  }
  tails.keep(details);
  return tails.renumbered();
}

/// A node that a free-form deformation box lists by marker and number (FFD_SURFACE_POINTS=).
struct BoxEntry {
  std::string_view marker;
  std::int64_t node;
};

/// Reads all boxes of a file: that of a zone may be in the part of another zone.
std::vector<BoxEntry> box_entries(const Source& source) {
  constexpr std::string_view key = "FFD_SURFACE_POINTS";
  std::vector<BoxEntry> entries;
  const auto text = source.text();
  for (auto start = text.find(key); start != std::string_view::npos;
       start = text.find(key, start + 1)) {
    LineReader lines(source, start, text.size());
    lines.next();
    while (!lines.at_end()) {
      const Line line = lines.next();
      if (!line.key.empty()) break;
      LineWords words(line.text);
      const auto marker = words.next();
      if (const auto node = parse_integer(words.next())) entries.push_back({marker, *node});
    }
  }
  return entries;
}

/// The entries that name nodes of this mesh, with their positions.
std::vector<BoxPoint> box_points(const std::vector<BoxEntry>& entries, const ParsedMesh& mesh) {
  std::vector<BoxPoint> points;
  if (entries.empty()) return points;
  std::set<std::string_view> markers;
  for (const Marker& marker : mesh.data.markers) markers.insert(marker.name);
  for (const BoxEntry& entry : entries) {
    if (entry.node < 0 || entry.node >= mesh.data.node_count() || !markers.contains(entry.marker))
      continue;
    const auto i = static_cast<Index>(entry.node);
    points.push_back({i, place_in_space(nullptr, mesh.data.coordinates, i)});
  }
  return points;
}

class Reader {
 public:
  Reader(const Source& source, const ZoneList::Zone& zone, const Dimensions& dimensions)
      : source_(source),
        lines_(source, zone.begin, zone.end),
        end_(zone.end),
        dimensions_(dimensions) {
    mesh_.details = details_;
    details_->dimension = dimensions.space;
    details_->line_end = first_line_end();
  }

  ParsedMesh read(bool dimension_known) {
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
    if (l.key == "NPERIODIC") return read_periodic(l);
    keep_unknown(l);
  }

  /// Keeps the text read since an offset.
  void keep_from(std::size_t begin) {
    auto& items = details_->items;
    if (items.empty() || items.back().part != Details::Part::text) {
      items.push_back({Details::Part::text, {}});
    }
    items.back().text.append(source_.text().substr(begin, lines_.offset() - begin));
  }
  /// Keeps the line that was read last.
  void keep(const Line& l) { keep_from(l.offset); }

  void read_periodic(const Line& l) {
    periodic_.read_transformations(lines_, l);
    keep_from(l.offset);
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
    if (l.value != "2" && l.value != "3")
      source_.fail(l.offset, "NDIME= " + std::string(l.value), "NDIME= 2 or NDIME= 3");
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
    mesh_.data.element_nodes.reserve(at(n) * at(dimensions_.cells + 1));
    mesh_.where.elements.reserve(static_cast<std::size_t>(n));
    for (Index e = 0; e < n; ++e) {
      const Expected expected{"element", e, n};
      const Line data = lines_.next_data(expected);
      mesh_.where.elements.push_back(source_.offset_of(data.text));
      LineWords words(data.text);
      const ElementType type = element_type(words.next(), expected);
      std::array<Index, 8> corners{};
      const auto size = static_cast<std::size_t>(corner_count(type));
      read_corners(words, {corners.data(), size}, expected);
      if (type == ElementType::prism) mirror_prism(corners);  // as in the meshes of SU2's own tests
      mesh_.data.add_element(type, {corners.data(), size});
      details_->element_numbers |= end_data_line(words, e, "element");
    }
  }

  ElementType element_type(std::string_view word, const Expected& expected) const {
    const auto type = parse_integer(word);
    if (!type) lines_.fail(word, expected.text());
    if (const auto element = element_of(*type, dimensions_.cells)) return *element;
    source_.fail(source_.offset_of(word),
                 "element type " + std::string(word) + type_hint(*type, dimensions_, false),
                 element_list(dimensions_.cells) + first_order_way(*type));
  }

  std::string first_order_way(std::int64_t type) const {
    const bool second = type_hint(type, dimensions_, false).find("order") != std::string::npos;
    return second ? first_order_hint(source_.name()) : "";
  }

  void read_point_section(const Line& l) {
    once(l, Details::Part::points);
    const auto space = std::min(l.value.find_first_of(" \t"), l.value.size());
    const Index n = count(l.value.substr(0, space), "the number of points", 4);
    const auto owned = trimmed(l.value.substr(space));
    if (!owned.empty() && parse_integer(owned) != n) {
      mesh_.warnings.push_back(
          "only " + std::string(owned) + " of " + std::to_string(n) +
          " points are the file's own: the others are copies, across a periodic "
          "boundary or of other parts of a partitioned mesh");
    }
    details_->items.back().text = owned;
    renumbered_ |=
        read_points(lines_, dimensions_.space, room_for(n), mesh_.where.nodes, *details_);
  }

  /// The storage for the coordinates of the points. Surfaces get a separate buffer: only the end of
  /// the file shows whether they lie in a plane.
  std::span<double> room_for(Index points) {
    if (of_surface()) {
      xyz_.resize(3 * static_cast<std::size_t>(points));
      return xyz_;
    }
    mesh_.data.coordinates = Coordinates(dimensions_.space, points);
    return mesh_.data.coordinates.values();
  }
  bool of_surface() const { return dimensions_.cells < dimensions_.space; }

  void read_marker_count(const Line& l) {
    once(l, Details::Part::marker_count);
    marker_count_ = count(l.value, "the number of markers", 12);
    marker_count_offset_ = l.offset;
  }

  void read_marker(const Line& tag) {
    const std::string name(tag.value);
    if (name.empty()) source_.fail(tag.offset, "no name", "MARKER_TAG= NAME");
    if (name == "SEND_RECEIVE") return keep_send_receive(tag);
    const std::string wanted = "MARKER_ELEMS= of marker " + in_quotes(name);
    const Line l = lines_.next_data({wanted.c_str()});
    if (l.key != "MARKER_ELEMS") lines_.fail(l.text, wanted);
    details_->items.push_back({Details::Part::marker, {}});
    const Index n = count(l.value, "the number of elements of a marker", 6);
    const std::size_t m = marker_of_name(name);
    Marker& marker = mesh_.data.markers[m];
    std::vector<std::size_t>& offsets = mesh_.where.marker_edges[m];
    details_->marker_parts.push_back({m, marker.faces.size(), static_cast<std::size_t>(n)});
    marker.faces.reserve(marker.faces.size() + static_cast<std::size_t>(n));
    offsets.reserve(marker.faces.size() + static_cast<std::size_t>(n));
    const std::string what = std::string("marker ") + side_name(dimensions_.cells);
    for (Index e = 0; e < n; ++e) {
      const Expected expected{what.c_str(), e, n};
      const Line data = lines_.next_data(expected);
      offsets.push_back(source_.offset_of(data.text));
      LineWords words(data.text);
      marker.faces.push_back(read_face(words, expected));
      details_->face_numbers |= end_data_line(words, e, expected.what);
    }
  }

  /// Index of the marker of that name, which is added if it is new.
  std::size_t marker_of_name(const std::string& name) {
    auto& markers = mesh_.data.markers;
    const auto [known, added] = marker_index_.emplace(name, markers.size());
    if (!added) {
      mesh_.warnings.push_back("MARKER_TAG= " + name + " stands there again: its " +
                               side_name(dimensions_.cells) + "s belong to the same marker");
      return known->second;
    }
    markers.push_back({name, static_cast<int>(markers.size()) + 1, {}});
    mesh_.where.marker_edges.emplace_back();
    return markers.size() - 1;
  }

  Face read_face(LineWords& words, const Expected& expected) {
    const auto word = words.next();
    const auto type = parse_integer(word);
    if (!type) lines_.fail(word, expected.text());
    const std::size_t size = face_corners(*type, dimensions_.cells);
    if (size == 0) {
      source_.fail(source_.offset_of(word),
                   "marker element type " + std::string(word) + type_hint(*type, dimensions_, true),
                   element_list(dimensions_.cells - 1));
    }
    std::array<Index, 4> corners{};
    const std::span<Index> used(corners.data(), size);
    read_corners(words, used, expected);
    return Face(used);
  }

  void keep_send_receive(const Line& tag) {
    ++details_->raw_markers;
    if (details_->raw_markers == 1) {
      mesh_.warnings.push_back(
          "marker SEND_RECEIVE is bookkeeping of the solver: it is kept as it is, no boundary");
    }
    lines_.back_to(tag);
    periodic_.read_list(lines_);
    keep_from(tag.offset);
  }

  void finish(bool dimension_known) {
    const auto has = [&](Details::Part part) {
      return std::any_of(details_->items.begin(), details_->items.end(),
                         [&](const auto& item) { return item.part == part; });
    };
    if (!dimension_known && !has(Details::Part::dimension)) {
      source_.fail(end_, "no NDIME=", "NDIME= 2 or NDIME= 3");
    }
    if (!has(Details::Part::points)) source_.fail(end_, "no NPOIN=", "the points of the mesh");
    if (!has(Details::Part::elements)) source_.fail(end_, "no NELEM=", "the elements of the mesh");
    const auto found = static_cast<Index>(details_->marker_parts.size()) + details_->raw_markers;
    if (marker_count_ && *marker_count_ != found) {
      source_.fail(marker_count_offset_, std::to_string(found) + " markers",
                   std::to_string(*marker_count_) + " as NMARK= says");
    }
    add_warnings();
    if (of_surface()) set_nodes(source_, xyz_, mesh_);
    details_->markers = mesh_.data.markers.size();
    check_finite(source_, mesh_);
    details_->periodic = std::make_shared<GivenPeriodicity>();
    details_->periodic->pairs = periodic_.pairs_of(source_, mesh_.data);
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
  std::size_t end_;
  Dimensions dimensions_;
  ParsedMesh mesh_;
  std::vector<double> xyz_;  // of the points of a surface mesh
  std::shared_ptr<Details> details_ = std::make_shared<Details>();
  std::optional<Index> marker_count_;
  std::size_t marker_count_offset_ = 0;
  std::map<std::string, std::size_t> marker_index_;
  PeriodicSections periodic_;
  std::set<std::string> unknown_;
  std::string unknown_list_;
  bool renumbered_ = false;
};

/// Value of the first line NDIME= in a part of the file; 0: it has none. Points may come before
/// NDIME= but cannot be read without it.
int stated_dimension(const Source& source, std::size_t begin, std::size_t end) {
  const auto lines = lines_with(source, begin, end, "NDIME", 1);
  return lines.empty() ? 0 : lines[0].value == "2" ? 2 : lines[0].value == "3" ? 3 : 0;
}

/// True if the first element of a zone in space belongs to a surface; then all do. Looked up in
/// advance, because markers (then lines) may come before the elements, and points may lie in a
/// plane.
bool has_surface_elements(const Source& source, const ZoneList::Zone& zone) {
  const auto heads = lines_with(source, zone.begin, zone.end, "NELEM", 1);
  if (heads.empty()) return false;
  LineReader lines(source, heads[0].offset, zone.end);
  lines.next();
  while (!lines.at_end()) {
    const Line line = lines.next();
    if (line.blank()) continue;
    const auto type = parse_integer(LineWords(line.text).next());
    return type && element_of(*type, 2);
  }
  return false;
}

/// space: NDIME= from anywhere in the file; 0: not given.
Dimensions dimensions_of(const Source& source, const ZoneList::Zone& zone, int space) {
  if (space != 3) return {2, 2};
  return {3, has_surface_elements(source, zone) ? 2 : 3};
}

/// What the zones of a file share.
struct ZoneFile {
  explicit ZoneFile(const Source& of)
      : source(of),
        list(find_zones(of)),
        // A line before the first zone may give it for all zones.
        common(list.several ? stated_dimension(of, 0, list.zones[0].begin) : 0),
        entries(box_entries(of)),
        numbers(list.numbers()) {
    if (list.several) blocks = std::make_shared<const std::vector<std::string>>(list.blocks(of));
  }

  ParsedMesh read(std::size_t chosen) const {
    const ZoneList::Zone& zone = list.zones[chosen];
    const int own = stated_dimension(source, zone.begin, zone.end);
    Reader reader(source, zone, dimensions_of(source, zone, own != 0 ? own : common));
    Details& details = reader.details();
    ParsedMesh mesh = reader.read(common != 0);
    details.zone = zone.number;
    details.box_points = box_points(entries, mesh);
    if (!list.several) return mesh;
    details.zones = numbers;
    details.blocks = blocks;
    details.block = chosen + 1;
    return mesh;
  }

  const Source& source;
  ZoneList list;
  int common;  // NDIME= of all zones; 0: each has its own
  std::vector<BoxEntry> entries;
  std::vector<int> numbers;
  std::shared_ptr<const std::vector<std::string>> blocks;
};

}  // namespace

ParsedMesh read_zone(Source& source, int number) {
  const ZoneFile file(source);
  return file.read(choose_zone(file.list, number, source.name()));
}

void read_zones(Source& source, const TakeZone& take) {
  const ZoneFile file(source);
  for (std::size_t z = 0; z < file.list.zones.size(); ++z) take(file.read(z));
}

}  // namespace winslow::io::su2
