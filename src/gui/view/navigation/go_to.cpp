#include "gui/view/navigation/go_to.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/error.h"
#include "core/mesh/element_type.h"
#include "gui/base/text.h"
#include "gui/view/navigation/worst_list.h"

namespace winslow::gui {

namespace {

constexpr const char* expected =
    "Expected a node (n123), an element (e45), a point (0.5, 0.1), \"worst 3\" or a marker.";

constexpr const char* expected_in_space =
    "Expected a node (n123), an element (e45), a point (0.5, 0.1, 2), \"worst 3\" or a marker.";

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::optional<long long> whole_number(const std::string& text) {
  long long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

/// With as many numbers as the mesh has coordinates; z = 0 in the plane.
std::optional<Vec3> point_of(const std::string& text, bool in_space) {
  Vec3 p(0, 0, 0);
  char rest = 0;
  const int read = in_space
                       ? std::sscanf(text.c_str(), "%lf , %lf , %lf %c", &p[0], &p[1], &p[2], &rest)
                       : std::sscanf(text.c_str(), "%lf , %lf %c", &p[0], &p[1], &rest);
  if (read != (in_space ? 3 : 2) || !p.allFinite()) return std::nullopt;
  return p;
}

Vec3 place_of(const Coordinates& x, Index node) {
  if (x.dimension() == 3) return x.xyz(node);
  return {x.xy(node).x(), x.xy(node).y(), 0};
}

MeshItem checked(MeshItem::Kind kind, long long id, const Topology& topology) {
  const bool node = kind == MeshItem::Kind::node;
  const Index count = node ? topology.node_count() : topology.element_count();
  if (id < 0 || id >= count)
    throw UsageError(std::string(node ? "Nodes" : "Elements") + " go from 0 to " +
                     grouped(count - 1) + ".");
  return {kind, static_cast<Index>(id)};
}

MeshItem nearest_node(const Vec3& point, const Session& session) {
  const Coordinates& x = session.coordinates();
  Index best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < x.size(); ++i) {
    const double d = (place_of(x, i) - point).squaredNorm();
    if (d >= least || !session.topology()->used(i)) continue;
    least = d;
    best = i;
  }
  return {MeshItem::Kind::node, best};
}

MeshItem worst_item(const std::string& rank, const Session& session, const ViewOptions& view) {
  const auto worst = worst_elements(session, view);
  const auto n = rank.empty() ? std::optional<long long>(1) : whole_number(rank);
  if (!n || *n < 1 || *n > static_cast<long long>(worst.size()))
    throw UsageError("The list of worst elements has " + std::to_string(worst.size()) +
                     (worst.size() == 1 ? " entry." : " entries."));
  return {MeshItem::Kind::element, worst[static_cast<std::size_t>(*n - 1)].element};
}

std::string list_of(std::span<const Index> ids) {
  std::string text;
  for (const Index id : ids) text += (text.empty() ? "" : ", ") + std::to_string(id);
  return text;
}

std::string coordinate(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.8g", value);
  return text;
}

std::vector<std::pair<std::string, std::string>> describe_element(Index e, const Session& session) {
  const Topology& topology = *session.topology();
  const Mesh mesh{session.topology(), session.coordinates()};
  std::vector<std::pair<std::string, std::string>> lines{
      {"Element " + std::to_string(e), std::string(shape_of(topology.element_type(e)).name)},
      {"Nodes", list_of(topology.element(e))}};
  for (const Metric metric : all_metrics(topology.cell_dimension())) {
    const double value = element_value(mesh, e, metric);
    lines.emplace_back(metric_label(metric),
                       std::isfinite(value) ? short_number(value) : "inverted");
  }
  return lines;
}

std::vector<std::pair<std::string, std::string>> describe_node(Index i, const Session& session) {
  const Topology& topology = *session.topology();
  const Vec3 p = place_of(session.coordinates(), i);
  std::string markers;
  for (std::size_t m = 0; m < topology.markers().size(); ++m) {
    const auto nodes = topology.markers().nodes(static_cast<Index>(m));
    if (std::ranges::binary_search(nodes, i))
      markers += (markers.empty() ? "" : ", ") + topology.markers()[m].name;
  }
  const char* role = !topology.used(i)         ? "unused"
                     : topology.on_boundary(i) ? "boundary"
                                               : "interior";
  std::vector<std::pair<std::string, std::string>> lines{
      {"Node " + std::to_string(i), role}, {"x", coordinate(p.x())}, {"y", coordinate(p.y())}};
  if (session.in_space()) lines.emplace_back("z", coordinate(p.z()));
  lines.emplace_back("Marker", markers.empty() ? "none" : markers);
  lines.emplace_back("Degree", std::to_string(topology.neighbours(i).size()));
  lines.emplace_back("Elements", list_of(topology.star(i)));
  return lines;
}

}  // namespace

MeshItem parse_item(const std::string& text, const Session& session, const ViewOptions& view) {
  const std::string wanted = trimmed(text);
  if (wanted.empty()) throw UsageError(session.in_space() ? expected_in_space : expected);
  const Topology& topology = *session.topology();
  // A marker may be called "n1" or "worst": a name that exists wins.
  if (const auto marker = topology.markers().find(wanted); marker)
    if (const auto nodes = topology.markers().nodes(*marker); !nodes.empty())
      return {MeshItem::Kind::node, nodes.front()};
  if (const auto number = whole_number(wanted))
    return checked(MeshItem::Kind::element, *number, topology);
  const std::string rest = trimmed(wanted.substr(1));
  if (const auto number = whole_number(rest)) {
    const char letter = wanted.front();
    if (letter == 'n' || letter == 'N') return checked(MeshItem::Kind::node, *number, topology);
    if (letter == 'e' || letter == 'E' || letter == '#')
      return checked(MeshItem::Kind::element, *number, topology);
  }
  if (wanted.starts_with("worst")) return worst_item(trimmed(wanted.substr(5)), session, view);
  if (const auto point = point_of(wanted, session.in_space())) return nearest_node(*point, session);
  throw UsageError(session.in_space() ? expected_in_space : expected);
}

std::string item_name(const MeshItem& item) {
  return (item.kind == MeshItem::Kind::node ? "n" : "e") + std::to_string(item.id);
}

std::vector<std::pair<std::string, std::string>> describe_item(const MeshItem& item,
                                                               const Session& session) {
  return item.kind == MeshItem::Kind::node ? describe_node(item.id, session)
                                           : describe_element(item.id, session);
}

Bounds surroundings(const MeshItem& item, const Session& session) {
  const Topology& topology = *session.topology();
  const Coordinates& x = session.coordinates();
  if (item.kind == MeshItem::Kind::element) return bounds(x, topology.element(item.id));
  const auto around = topology.neighbours(item.id);
  const Vec2 p = x.xy(item.id);
  if (around.empty()) return {p, p};
  // The node itself in the middle, whatever lies on one side of it.
  const Bounds box = bounds(x, around);
  const Vec2 half = (box.max - p).cwiseAbs().cwiseMax((p - box.min).cwiseAbs());
  return {p - half, p + half};
}

bool exists(const MeshItem& item, const Session& session) {
  if (!session.document() || item.id < 0) return false;
  const Topology& topology = *session.topology();
  return item.id <
         (item.kind == MeshItem::Kind::node ? topology.node_count() : topology.element_count());
}

}  // namespace winslow::gui
