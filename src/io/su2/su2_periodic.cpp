#include "io/su2/su2_periodic.h"

#include <Eigen/Geometry>
#include <set>

#include "core/options/option.h"
#include "io/format/periodicity.h"
#include "io/text/numbers.h"

namespace winslow::io::su2 {
namespace {

constexpr std::string_view not_a_section = "MARKER_ELEMS= or SEND_TO= of marker SEND_RECEIVE";

/// Reads three numbers from a line, which may begin with a keyword.
Vec3 read_vector(LineReader& lines, std::string_view key, const Expected& expected) {
  const Line line = lines.next_data(expected);
  if (!line.key.empty() && line.key != key) lines.fail(line.text, expected.text());
  LineWords words(line.key.empty() ? line.text : line.value);
  Vec3 vector;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const auto word = words.next();
    const auto value = parse_number(word);
    if (!value || !std::isfinite(*value)) lines.fail(word, expected.text());
    vector[k] = *value;
  }
  if (const auto more = words.next(); !more.empty()) lines.fail(more, "the end of the line");
  return vector;
}

std::int64_t integer(LineReader& lines, std::string_view word, const std::string& expected) {
  const auto value = parse_integer(word);
  if (!value) lines.fail(word, expected);
  return *value;
}

bool all_in(const std::vector<Index>& nodes, const std::set<Index>& set) {
  return !nodes.empty() &&
         std::ranges::all_of(nodes, [&](Index node) { return set.contains(node); });
}

/// The points of one transformation: senders and their images.
struct Group {
  std::vector<PeriodicPair> pairs;
  std::optional<std::size_t> first, second;  ///< markers all of whose points are among them
};

void find_markers(const std::vector<std::vector<Index>>& markers, Group& group) {
  std::set<Index> senders, images;
  for (const auto& [node, image] : group.pairs) {
    senders.insert(node);
    images.insert(image);
  }
  for (std::size_t m = 0; m < markers.size(); ++m) {
    if (!group.first && all_in(markers[m], senders)) group.first = m;
    if (!group.second && all_in(markers[m], images)) group.second = m;
  }
}

/// Splits a group into pairs of its markers and halo points beyond them.
void add_group(const Group& group, const MeshData& data,
               const std::vector<std::vector<Index>>& markers, std::vector<GivenPairs>& out) {
  const std::vector<Index>& images = markers[*group.second];
  GivenPairs sides, halo;
  for (const PeriodicPair& pair : group.pairs)
    (std::ranges::binary_search(images, pair.image) ? sides : halo).pairs.push_back(pair);
  halo.halo = true;
  for (GivenPairs* given : {&sides, &halo}) {
    given->first = data.markers[*group.first].name;
    given->second = data.markers[*group.second].name;
    if (!given->pairs.empty()) out.push_back(std::move(*given));
  }
}

}  // namespace

void PeriodicSections::read_transformations(LineReader& lines, const Line& count) {
  const std::int64_t n = integer(lines, count.value, "the number of periodic transformations");
  if (n < 0)
    lines.source().fail(count.offset, "NPERIODIC= " + std::string(count.value), "0 or more");
  std::set<std::int64_t> seen;
  for (std::int64_t i = 0; i < n; ++i) {
    const Line head = lines.next_data({"PERIODIC_INDEX="});
    if (head.key != "PERIODIC_INDEX")
      lines.fail(head.text, "PERIODIC_INDEX= of transformation " + std::to_string(i + 1) + " of " +
                                std::to_string(n));
    Transformation one{
        integer(lines, head.value, "the number of a transformation"), head.offset, {}};
    if (!seen.insert(one.index).second)
      lines.source().fail(head.offset, "a second PERIODIC_INDEX= " + std::to_string(one.index),
                          "one only");
    const Vec3 centre = read_vector(lines, "PERIODIC_CENTER", {"the centre of a rotation, x y z"});
    const Vec3 angles = read_vector(lines, "PERIODIC_ROTATION", {"angles of a rotation, x y z"});
    one.image = image_of(centre, angles,
                         read_vector(lines, "PERIODIC_TRANSLATION", {"a translation, x y z"}));
    transformations_.push_back(one);
  }
}

void PeriodicSections::read_list(LineReader& lines) {
  const Line tag = lines.next();
  List list{tag.offset, true, {}};
  const Line elements = lines.next_data({"MARKER_ELEMS= of marker SEND_RECEIVE"});
  if (elements.key != "MARKER_ELEMS") lines.fail(elements.text, std::string(not_a_section));
  const std::int64_t stated = integer(lines, elements.value, "the number of points");
  const Index n = checked_count(lines.source(), lines.source().offset_of(elements.value), stated, 3,
                                lines.bytes_left(), {"the number of points"});
  const Line to = lines.next_data({"SEND_TO= of marker SEND_RECEIVE"});
  if (to.key != "SEND_TO" && to.key != "SEND_RECV")
    lines.fail(to.text, "SEND_TO= of marker SEND_RECEIVE");
  const std::int64_t domain = integer(lines, to.value, "the number of a domain");
  list.sends = domain > 0;
  for (Index i = 0; i < n; ++i) {
    const Expected expected{"point of marker SEND_RECEIVE", i, n};
    const Line line = lines.next_data(expected);
    LineWords words(line.text);
    const auto type = words.next();
    if (parse_integer(type) != 1) lines.fail(type, "1 (vertex), " + expected.text());
    Point point{integer(lines, words.next(), expected.text()), 0, line.offset};
    if (const auto word = words.next(); !word.empty())
      point.index = integer(lines, word, "the number of a transformation");
    list.points.push_back(point);
  }
  lists_.push_back(std::move(list));
}

std::map<std::int64_t, PeriodicSections::SentPoints> PeriodicSections::points_by_transformation(
    const Source& source, Index nodes) const {
  std::map<std::int64_t, SentPoints> points;
  for (const List& list : lists_) {
    for (const Point& point : list.points) {
      if (point.node < 0 || point.node >= nodes)
        source.fail(point.offset, "point " + std::to_string(point.node),
                    "0 to " + std::to_string(nodes - 1));
      if (point.index == 0) continue;
      SentPoints& of = points[point.index];
      (list.sends ? of.sent : of.received).push_back(&point);
    }
  }
  for (const auto& [index, of] : points)
    if (of.sent.size() != of.received.size())
      source.fail((of.sent.empty() ? of.received : of.sent).front()->offset,
                  std::to_string(of.sent.size()) + " points sent by transformation " +
                      std::to_string(index) + " and " + std::to_string(of.received.size()) +
                      " received",
                  "as many");
  return points;
}

std::vector<GivenPairs> PeriodicSections::pairs_of(const Source& source,
                                                   const MeshData& data) const {
  if (lists_.empty() && transformations_.empty()) return {};
  const auto points = points_by_transformation(source, data.node_count());
  std::vector<std::vector<Index>> markers;
  for (const Marker& marker : data.markers) markers.push_back(nodes_of(marker.faces));
  if (points.empty()) return by_place(data, markers);
  std::vector<GivenPairs> out;
  std::vector<Group> halos;
  for (const auto& [index, of] : points) {
    Group group;
    for (std::size_t i = 0; i < of.sent.size(); ++i)
      group.pairs.push_back(
          {static_cast<Index>(of.sent[i]->node), static_cast<Index>(of.received[i]->node)});
    find_markers(markers, group);
    if (group.first && group.second)
      add_group(group, data, markers, out);
    else
      halos.push_back(std::move(group));
  }
  if (out.empty()) return out;
  const std::string first = out.front().first, second = out.front().second;
  for (Group& group : halos) {
    out.push_back({first, second, std::move(group.pairs), {}});
    out.back().halo = true;
  }
  return out;
}

std::vector<GivenPairs> PeriodicSections::by_place(
    const MeshData& data, const std::vector<std::vector<Index>>& markers) const {
  std::vector<GivenPairs> out;
  constexpr double share = 0.05;  // of the shortest edge, as in PeriodicPairs
  std::set<std::size_t> taken;
  for (const Transformation& one : transformations_) {
    if (one.image.rotation.isIdentity(0) && one.image.offset.isZero(0)) continue;
    for (std::size_t a = 0; a < markers.size(); ++a) {
      for (std::size_t b = 0; b < markers.size(); ++b) {
        if (a == b || markers[a].size() != markers[b].size() || markers[a].empty()) continue;
        if (taken.contains(a) || taken.contains(b)) continue;
        GivenPairs given{data.markers[a].name, data.markers[b].name, {}, {}};
        given.pairs = matched(one.image, markers[a], markers[b], data.coordinates,
                              share * shortest_edge(data.markers[a].faces, data.coordinates));
        if (given.pairs.empty()) continue;
        taken.insert({a, b});
        out.push_back(std::move(given));
      }
    }
  }
  return out;
}

std::string configuration_line(const PeriodicPairs& pairs) {
  // The rotation about the origin: angles about x, y and z, in this order.
  const Eigen::Matrix3d& r = pairs.image.rotation;
  const Vec3 angles(std::atan2(r(2, 1), r(2, 2)), std::asin(std::clamp(-r(2, 0), -1.0, 1.0)),
                    std::atan2(r(1, 0), r(0, 0)));
  std::string text = "MARKER_PERIODIC= ( " + pairs.first + ", " + pairs.second + ", 0, 0, 0";
  for (const double angle : angles) {
    text += ", ";
    append_number(text, angle == 0 ? 0.0 : degrees(angle));
  }
  for (const double part : pairs.image.offset) {
    text += ", ";
    append_number(text, part == 0 ? 0.0 : part);
  }
  return text + " )";
}

}  // namespace winslow::io::su2
