#include "gui/view/navigation/go_to.h"

#include <charconv>
#include <cstdio>

#include "core/error.h"
#include "core/inspect/space/surface_measures.h"
#include "core/mesh/coordinates.h"
#include "core/mesh/element_type.h"
#include "core/strategy/surface_shape.h"
#include "gui/base/text.h"

namespace winslow::gui {

namespace {

/// Texts for meshes of one kind.
struct ItemWords {
  const char* expected;  ///< names of items, for the error message
  const char* sides;     ///< name for sides of an element that lie on markers
  const char* quality;   ///< normalized Jacobian
  bool faces = false;    ///< faces have numbers
};

const ItemWords& item_words(MeshKind kind) {
  static constexpr std::array<ItemWords, 3> words{
      {{"Expected a node (n123), an element (e45), a point (0.5, 0.1), \"worst 3\" or a marker.",
        "Edges on", "sine"},
       {"Expected a node (n123), an element (e45), a point (0.5, 0.1, 2), \"worst 3\" or a marker.",
        "Edges on", "sine"},
       {"Expected a node (n123), an element (e45), a face (f12, wing 12), a point (0.5, 0.1, 2), "
        "\"worst 3\" or a marker.",
        "Faces on", "scaled Jacobian", true}}};
  return words[static_cast<std::size_t>(kind)];
}

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

/// Point with as many numbers as the mesh has coordinates; z = 0 in the plane.
std::optional<Vec3> point_of(const std::string& text, int dimension) {
  Vec3 p(0, 0, 0);
  int end = 0;
  const int read =
      std::sscanf(text.c_str(), "%lf , %lf%n , %lf%n", &p[0], &p[1], &end, &p[2], &end);
  const bool whole = read == dimension && static_cast<std::size_t>(end) == text.size();
  return whole && p.allFinite() ? std::optional(p) : std::nullopt;
}

Index count_of(MeshItem::Kind kind, const Topology& topology) {
  switch (kind) {
    case MeshItem::Kind::node:
      return topology.node_count();
    case MeshItem::Kind::element:
      return topology.element_count();
    case MeshItem::Kind::face:
      break;
  }
  return item_words(topology.kind()).faces ? topology.face_count() : 0;
}

MeshItem checked(MeshItem::Kind kind, long long id, const Topology& topology) {
  const Index count = count_of(kind, topology);
  if (id < 0 || id >= count) {
    const char* what = kind == MeshItem::Kind::node      ? "Nodes"
                       : kind == MeshItem::Kind::element ? "Elements"
                                                         : "Faces";
    throw UsageError(std::string(what) + " go from 0 to " + grouped(count - 1) + ".");
  }
  return {kind, static_cast<Index>(id)};
}

/// "wing 12": a face by its marker and its number there.
std::optional<MeshItem> marker_face(const std::string& text, const Topology& topology) {
  const auto gap = text.find_last_of(" \t");
  if (gap == std::string::npos) return std::nullopt;
  const auto marker = topology.markers().find(trimmed(text.substr(0, gap)));
  const auto number = whole_number(text.substr(gap + 1));
  if (!marker || !number) return std::nullopt;
  const auto& faces = topology.markers()[at(*marker)].faces;
  if (*number < 0 || *number >= static_cast<long long>(faces.size()))
    throw UsageError("Faces of " + topology.markers()[at(*marker)].name + " go from 0 to " +
                     grouped(static_cast<long long>(faces.size()) - 1) + ".");
  const auto face = topology.find_face(faces[static_cast<std::size_t>(*number)]);
  if (!face) return std::nullopt;
  return MeshItem{MeshItem::Kind::face, *face};
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

struct FaceOfMarker {
  std::string name;
  std::size_t number = 0;  ///< among the marker's faces
};
std::optional<FaceOfMarker> marker_of_face(const Topology& topology, const Face& face) {
  const Markers& markers = topology.markers();
  const auto sorted = face.sorted();
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const auto nodes = markers.nodes(static_cast<Index>(m));
    if (!std::ranges::all_of(face, [&](Index i) { return std::ranges::binary_search(nodes, i); }))
      continue;
    const auto& faces = markers[m].faces;
    const auto found =
        std::ranges::find_if(faces, [&](const Face& f) { return f.sorted() == sorted; });
    if (found != faces.end())
      return FaceOfMarker{markers[m].name, static_cast<std::size_t>(found - faces.begin())};
  }
  return std::nullopt;
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

std::string coordinate(double value) { return formatted(value, "%.8g"); }

using Lines = std::vector<std::pair<std::string, std::string>>;

std::string place_text(const Vec3& p) {
  return coordinate(p.x()) + ", " + coordinate(p.y()) + ", " + coordinate(p.z());
}

Vec3 middle_of(const SpacePoints& x, std::span<const Index> nodes) {
  Vec3 sum(0, 0, 0);
  for (const Index node : nodes) sum += x[node];
  return sum / static_cast<double>(nodes.size());
}

/// Sides between an element and its neighbours: faces of a volume element, else edges.
std::vector<Face> sides_of(const Topology& topology, Index e) {
  std::vector<Face> sides;
  for (const Face& face : topology.shape(e).faces)
    sides.push_back(by_nodes(face, topology.element(e)));
  return sides;
}

/// Adds where an element in space is, and what lies beyond its sides.
void add_surroundings(Lines& lines, Index e, const Mesh& mesh) {
  const Topology& topology = *mesh.topology;
  std::string neighbours, markers;
  for (const Face& nodes : sides_of(topology, e)) {
    const auto f = topology.find_face(nodes);
    if (!f) continue;
    const std::array<Index, 2> elements = topology.face(*f).elements;
    const Index other = elements[0] == e ? elements[1] : elements[0];
    if (other >= 0) neighbours += (neighbours.empty() ? "" : ", ") + std::to_string(other);
    if (const auto marker = marker_of_face(topology, nodes))
      markers += (markers.empty() ? "" : ", ") + marker->name;
  }
  lines.emplace_back("Middle",
                     place_text(middle_of(SpacePoints(mesh.coordinates), topology.element(e))));
  lines.emplace_back("Neighbours", neighbours.empty() ? "none" : neighbours);
  if (!markers.empty()) lines.emplace_back(item_words(topology.kind()).sides, markers);
}

Lines describe_face(Index f, const Session& session) {
  const Topology& topology = *session.topology();
  const SpacePoints x(session.coordinates());
  const Topology::SharedFace face = topology.face(f);
  const Vec3 normal = area_vector(x, face.nodes).normalized();
  Lines lines{{"Face " + std::to_string(f), face.elements[1] < 0 ? "boundary" : "interior"},
              {"Nodes", list_of({face.nodes.begin(), face.nodes.size()})}};
  if (const auto marker = marker_of_face(topology, face.nodes))
    lines.emplace_back("Marker", marker->name + ", its face " + std::to_string(marker->number));
  lines.emplace_back(
      "Elements",
      std::to_string(face.elements[0]) +
          (face.elements[1] < 0 ? std::string() : ", " + std::to_string(face.elements[1])));
  lines.emplace_back("Area", short_number(face_area(x, face.nodes)));
  lines.emplace_back("Middle", place_text(centre_of(x, face.nodes)));
  lines.emplace_back("Normal", place_text(normal));
  return lines;
}

/// Adds the worst element at a node.
void add_worst_around(Lines& lines, Index i, const Session& session) {
  const auto shared = session.mesh().shared();
  const Mesh& mesh = *shared;
  const std::vector<Vec3> normals =
      reference_normals(session.document()->state(), mesh.coordinates);
  double least = std::numeric_limits<double>::infinity();
  Index worst = -1;
  for (const Index e : mesh.topology->star(i)) {
    const double value = element_value(mesh, e, Metric::normalized_jacobian, normals);
    if (value >= least) continue;
    least = value;
    worst = e;
  }
  if (worst >= 0)
    lines.emplace_back("Worst of them", std::to_string(worst) + ", " +
                                            item_words(session.kind()).quality + ' ' +
                                            short_number(least));
}

Lines describe_element(Index e, const Session& session) {
  const Topology& topology = *session.topology();
  const auto shared = session.mesh().shared();
  const Mesh& mesh = *shared;
  Lines lines{{"Element " + std::to_string(e), std::string(topology.shape(e).name)},
              {"Nodes", list_of(topology.element(e))}};
  if (session.in_space()) add_surroundings(lines, e, mesh);
  const std::vector<Vec3> normals =
      reference_normals(session.document()->state(), mesh.coordinates);
  for (const Metric metric : all_metrics(topology.cell_dimension())) {
    const double value = element_value(mesh, e, metric, normals);
    lines.emplace_back(metric_label(metric),
                       std::isfinite(value) ? short_number(value) : "inverted");
  }
  if (const auto& given = session.document()->given())
    lines.emplace_back("Deviation", short_number(element_distance(mesh, e, *given)));
  return lines;
}

Lines describe_node(Index i, const Session& session) {
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
  const bool in_space = session.in_space();
  Lines lines{{"Node " + std::to_string(i), role}};
  for (int k = 0; k < session.coordinates().dimension(); ++k)
    lines.emplace_back(std::string(1, "xyz"[k]), coordinate(p[k]));
  lines.emplace_back("Marker", markers.empty() ? "none" : markers);
  lines.emplace_back("Degree", std::to_string(topology.neighbours(i).size()));
  if (in_space) lines.emplace_back("Neighbours", list_of(topology.neighbours(i)));
  lines.emplace_back("Elements", list_of(topology.star(i)));
  if (in_space) add_worst_around(lines, i, session);
  if (const auto& given = session.document()->given())
    lines.emplace_back("Deviation", short_number(given->to(p)));
  return lines;
}

}  // namespace

MeshItem parse_item(const std::string& text, const Session& session, const ViewOptions& view) {
  const std::string wanted = trimmed(text);
  const ItemWords& words = item_words(session.kind());
  if (wanted.empty()) throw UsageError(words.expected);
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
    if (words.faces && (letter == 'f' || letter == 'F'))
      return checked(MeshItem::Kind::face, *number, topology);
    if (letter == 'e' || letter == 'E' || letter == '#')
      return checked(MeshItem::Kind::element, *number, topology);
  }
  if (wanted.starts_with("worst")) return worst_item(trimmed(wanted.substr(5)), session, view);
  if (words.faces)
    if (const auto face = marker_face(wanted, topology)) return *face;
  if (const auto point = point_of(wanted, session.coordinates().dimension()))
    return nearest_node(*point, session);
  throw UsageError(words.expected);
}

std::string item_name(const MeshItem& item) {
  const char* letter = item.kind == MeshItem::Kind::node      ? "n"
                       : item.kind == MeshItem::Kind::element ? "e"
                                                              : "f";
  return letter + std::to_string(item.id);
}

std::vector<std::pair<std::string, std::string>> describe_item(const MeshItem& item,
                                                               const Session& session) {
  if (item.kind == MeshItem::Kind::face) return describe_face(item.id, session);
  return item.kind == MeshItem::Kind::node ? describe_node(item.id, session)
                                           : describe_element(item.id, session);
}

bool exists(const MeshItem& item, const Session& session) {
  if (!session.document() || item.id < 0) return false;
  return item.id < count_of(item.kind, *session.topology());
}

std::vector<ElementField> rankings(MeshKind kind) {
  const int dimension = cell_dimension_of(kind);
  std::vector<ElementField> fields;
  for (const Metric metric : reported_metrics(dimension)) fields.emplace_back(metric, dimension);
  if (kind != MeshKind::surface)
    fields.insert(fields.end(), all_wall_fields().begin(), all_wall_fields().end());
  if (kind == MeshKind::surface) fields.emplace_back(SurfaceField::deviation);
  return fields;
}

ElementField worst_field(const ViewOptions& view, MeshKind kind) {
  const std::vector<ElementField> fields = rankings(kind);
  for (const std::optional<ElementField>& field : {view.worst_by, view.color})
    if (field && std::ranges::find(fields, *field) != fields.end()) return *field;
  return fields.front();
}

namespace {

std::span<const WorstElement> worst_by(const QualityMonitor::Measured& measured,
                                       const ElementField& field) {
  if (field.wall()) return measured.report.worst_by(*field.wall());
  if (field.metric()) return measured.report.of(*field.metric()).worst;
  if (!measured.deviation) return {};
  return measured.deviation->worst;
}

}  // namespace

std::span<const WorstElement> worst_elements(const Session& session, const ViewOptions& view) {
  const auto& measured = session.quality().latest();
  if (!measured || !session.document()) return {};
  const std::span<const WorstElement> all = worst_by(*measured, worst_field(view, session.kind()));
  return all.first(std::min(all.size(), static_cast<std::size_t>(std::max(view.worst_count, 0))));
}

std::optional<MeshItem> next_worst(const Session& session, const ViewOptions& view,
                                   const std::optional<MeshItem>& focus, int by) {
  const auto worst = worst_elements(session, view);
  if (worst.empty()) return std::nullopt;
  const auto here = std::ranges::find_if(worst, [&](const WorstElement& w) {
    return focus && focus->kind == MeshItem::Kind::element && focus->id == w.element;
  });
  const auto last = static_cast<std::ptrdiff_t>(worst.size()) - 1;
  std::ptrdiff_t next = 0;
  if (here != worst.end()) next = std::clamp<std::ptrdiff_t>((here - worst.begin()) + by, 0, last);
  return MeshItem{MeshItem::Kind::element, worst[static_cast<std::size_t>(next)].element};
}

}  // namespace winslow::gui
