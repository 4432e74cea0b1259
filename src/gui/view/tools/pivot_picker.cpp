#include "gui/view/tools/pivot_picker.h"

#include "core/mesh/element_type.h"
#include "core/mesh/surface_faces.h"

namespace winslow::gui {

namespace {

constexpr double feature_turn = 40;  // degrees by which a surface turns at a sharp edge
constexpr double straight_turn =
    12;  // degrees by which a row may leave the direction of its first edge

double distance_to_edge(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double t = std::clamp((p - a).dot(along) / std::max(along.squaredNorm(), 1e-300), 0.0, 1.0);
  return (p - a - t * along).norm();
}

}  // namespace

std::vector<Index> seen_face(const SeenPlace& seen, const Mesh& mesh) {
  if (seen.marker < 0 || seen.element < 0) return {};
  const SpacePoints x(mesh.coordinates);
  const auto corners = mesh.topology->element(seen.element);
  std::vector<Index> best;
  double least = 1e300;
  for (const Face& local : shape_of(mesh.topology->element_type(seen.element)).faces) {
    std::vector<Index> nodes;
    for (const Index k : local) nodes.push_back(corners[at(k)]);
    const Face face{std::span<const Index>(nodes)};
    const Vec3 area = area_vector(x, face);
    if (!(area.norm() > 0)) continue;
    const Vec3 normal = area.normalized();
    // How far the place is from the face's plane, and how much the surface seen is turned against
    // it.
    const double off =
        std::abs(normal.dot(seen.point - centre_of(x, face))) / std::sqrt(area.norm());
    const double turned = 1 - std::abs(normal.dot(seen.normal));
    if (off + turned >= least) continue;
    least = off + turned;
    if (normal.dot(seen.normal) < 0) std::ranges::reverse(nodes);
    best = std::move(nodes);
  }
  return best;
}

std::optional<Index> nearest_corner(const SeenPlace& seen, const Mesh& mesh) {
  std::optional<Index> nearest;
  double least = 0;
  for (const Index node : seen_face(seen, mesh)) {
    const double distance = (mesh.coordinates.xyz(node) - seen.point).norm();
    if (nearest && distance >= least) continue;
    least = distance;
    nearest = node;
  }
  return nearest;
}

std::optional<PivotSource> PivotPicker::source_at(const SeenPlace& seen, PivotFrom from,
                                                  std::optional<Index> first,
                                                  const Session& session) {
  const auto shared = session.mesh().shared();
  const Mesh& mesh = *shared;
  const std::vector<Index> face = seen_face(seen, mesh);
  if (face.empty()) return std::nullopt;
  if (from == PivotFrom::face) return PivotSource{from, face};
  if (from == PivotFrom::edge) {
    find_sharp_edges(session);
    const auto distance = [&](std::size_t k) {
      const Index a = face[k], b = face[(k + 1) % face.size()];
      const bool sharp = std::ranges::binary_search(sharp_, std::array<Index, 2>{a, b});
      // Sharp edges are what one means by a hinge.
      return (sharp ? 0.4 : 1.0) *
             distance_to_edge(seen.point, mesh.coordinates.xyz(a), mesh.coordinates.xyz(b));
    };
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < face.size(); ++k)
      if (distance(k) < distance(nearest)) nearest = k;
    return PivotSource{from,
                       straight_row(face[nearest], face[(nearest + 1) % face.size()], session)};
  }
  const auto node = nearest_corner(seen, mesh);
  PivotSource source{from, {}};
  if (from == PivotFrom::nodes && first && *first != *node) source.nodes.push_back(*first);
  source.nodes.push_back(*node);
  return source;
}

void PivotPicker::find_sharp_edges(const Session& session) {
  if (generation_ == session.generation()) return;
  generation_ = session.generation();
  const auto& faces = session.document()->boundary()->faces;
  const SurfaceEdges edges = surface_edges(faces);
  const auto sharp = feature_edges(SpacePoints(session.coordinates()), faces, edges, feature_turn);
  sharp_.clear();
  for (std::size_t k = 0; k < sharp.size(); ++k) {
    if (sharp[k] == 0) continue;
    sharp_.push_back(edges.nodes[k]);
    sharp_.push_back({edges.nodes[k][1], edges.nodes[k][0]});
  }
  std::ranges::sort(sharp_);
}

/// From edge to edge, straight on, as long as none leaves the direction of the first.
Index PivotPicker::end_of_row(Index from, Index to, const Coordinates& x) const {
  const double least = std::cos(radians(straight_turn));
  const Vec3 direction = (x.xyz(to) - x.xyz(from)).normalized();
  std::size_t steps = 0;
  for (bool goes_on = true; goes_on && steps < sharp_.size(); ++steps) {
    goes_on = false;
    double best = least;
    Index next = -1;
    for (auto it = std::ranges::lower_bound(sharp_, std::array<Index, 2>{to, 0});
         it != sharp_.end() && (*it)[0] == to; ++it) {
      const double cosine = direction.dot((x.xyz((*it)[1]) - x.xyz(to)).normalized());
      if (cosine < best) continue;
      best = cosine;
      next = (*it)[1];
    }
    if (next < 0) continue;
    to = next;
    goes_on = true;
  }
  return to;
}

std::vector<Index> PivotPicker::straight_row(Index a, Index b, const Session& session) {
  find_sharp_edges(session);
  if (!std::ranges::binary_search(sharp_, std::array<Index, 2>{a, b})) return {a, b};
  const Coordinates& x = session.coordinates();
  return {end_of_row(b, a, x), end_of_row(a, b, x)};
}

namespace {

struct OnBorder {
  double distance = std::numeric_limits<double>::infinity();  // pixels
  Index marker = -1;
  std::array<Index, 2> edge{};
  Vec3 point{0, 0, 0};
};

/// The nearest place of an edge, if it is nearer than what was found.
void take_nearer(OnBorder& best, const ScreenPoint& at, Index marker,
                 const std::array<Index, 2>& edge, const SpacePoints& x, const View& view) {
  const Vec3 a = x[edge[0]], b = x[edge[1]];
  const ScreenPoint from = view.project(a).at;
  const ScreenVector along = view.project(b).at - from, way = at - from;
  const double squared = along.x() * along.x() + along.y() * along.y();
  const double share =
      squared > 0 ? std::clamp((way.x() * along.x() + way.y() * along.y()) / squared, 0.0, 1.0) : 0;
  const double distance = (from + along * share - at).norm();
  if (distance < best.distance) best = {distance, marker, edge, a + share * (b - a)};
}

/// No surface lies before it.
bool is_seen(const Vec3& point, const VolumeView& picture, const View& view) {
  constexpr double slack = 6;  // pixels: the surface is nowhere nearer to its border
  const View::Projection there = view.project(point);
  const auto hit = picture.pick(view, there.at);
  return !hit || view.project(hit->point).depth > there.depth - slack * view.pixel_size(point);
}

Index element_at(const Topology& topology, const std::array<Index, 2>& edge) {
  for (const Index e : topology.star(edge[0]))
    if (std::ranges::find(topology.element(e), edge[1]) != topology.element(e).end()) return e;
  return -1;
}

}  // namespace

std::optional<SeenPlace> seen_border(const ScreenPoint& at, double reach, const VolumeView& picture,
                                     const View& view, const MarkerLooks& looks) {
  const Mesh* mesh = picture.mesh();
  if (!mesh || !is_surface(*mesh->topology)) return std::nullopt;
  const Topology& topology = *mesh->topology;
  const SpacePoints x(mesh->coordinates);
  OnBorder best;
  for (std::size_t m = 0; m < topology.markers().size(); ++m) {
    const Marker& marker = topology.markers()[m];
    if (looks.of(marker.name).hidden) continue;
    for (const Face& face : marker.faces)
      take_nearer(best, at, static_cast<Index>(m), face.edge(), x, view);
  }
  if (best.marker < 0 || best.distance > reach || !is_seen(best.point, picture, view))
    return std::nullopt;
  const Index element = element_at(topology, best.edge);
  if (element < 0) return std::nullopt;
  Vec3 normal = area_vector(x, Face(topology.element(element))).normalized();
  if (normal.dot(view.unproject(at).direction) > 0) normal = -normal;
  return SeenPlace{best.point, normal, element, best.marker, {}};
}

}  // namespace winslow::gui
