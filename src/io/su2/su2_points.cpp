#include "io/su2/su2_points.h"

#include <set>

#include "io/format/mesh_in_space.h"
#include "io/text/numbers.h"

namespace winslow::io::su2 {

std::vector<BoxPoint> box_points(const Source& source, const ParsedMesh& mesh) {
  constexpr std::string_view key = "FFD_SURFACE_POINTS";
  std::vector<BoxPoint> points;
  std::set<std::string_view> markers;
  for (const Marker& marker : mesh.data.markers) markers.insert(marker.name);
  const auto text = source.text();
  for (auto at = text.find(key); at != std::string_view::npos; at = text.find(key, at + 1)) {
    LineReader lines(source, at, text.size());
    lines.next();
    while (!lines.at_end()) {
      const Line line = lines.next();
      if (!line.key.empty()) break;
      LineWords words(line.text);
      const auto marker = words.next();
      const auto node = parse_integer(words.next());
      if (!node || *node < 0 || *node >= mesh.data.node_count() || !markers.contains(marker))
        continue;
      const auto i = static_cast<Index>(*node);
      points.push_back({i, place_in_space(nullptr, mesh.data.coordinates, i)});
    }
  }
  return points;
}

bool box_is_stale(const std::vector<BoxPoint>& points, const Coordinates& x) {
  return std::any_of(points.begin(), points.end(), [&](const BoxPoint& point) {
    return point.node < x.size() && place_in_space(nullptr, x, point.node) != point.place;
  });
}

namespace {

/// What the ends of the lines of all points have in common.
class Tails {
 public:
  explicit Tails(Index count) { views_.reserve(static_cast<std::size_t>(count)); }

  /// `last`: the word taken for the last coordinate of point i; `tail`: what follows it.
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

  /// A line "x number" lacks a coordinate: what is taken for its last one is the number of the
  /// point, while other lines have a number behind it. Where no line has, and every last coordinate
  /// is the point's number, all lack one; up to three points may lie like that.
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

}  // namespace

bool read_points(LineReader& lines, int dimension, std::span<double> values,
                 std::vector<std::size_t>& places, Details& details) {
  static constexpr std::array<const char*, 3> names{"point", "y of point", "z of point"};
  const auto count = static_cast<Index>(values.size() / static_cast<std::size_t>(dimension));
  std::size_t at = 0;
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
      values[at++] = *value;
    }
    tails.add(i, word, words.rest());
  }
  if (const auto tail = tails.first_short()) {
    lines.fail(*tail, (dimension == 2 ? "two" : "three") +
                          std::string(" coordinates before the number of the point"));
  }
  tails.keep(details);
  return tails.renumbered();
}

}  // namespace winslow::io::su2
