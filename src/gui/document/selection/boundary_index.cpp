#include "gui/document/selection/boundary_index.h"

#include "gui/base/screen.h"

namespace winslow::gui {

namespace {

std::pair<Index, Index> key(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

double signed_area(const Coordinates& x, const std::vector<Index>& loop) {
  const Vec2 origin = x.xy(loop.front());  // a local origin avoids cancellation
  double area = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 p = x.xy(loop[i]) - origin;
    const Vec2 q = x.xy(loop[(i + 1) % loop.size()]) - origin;
    area += p.x() * q.y() - p.y() * q.x();
  }
  return 0.5 * area;
}

bool contains(const Coordinates& x, const std::vector<Index>& loop, const Vec2& point) {
  bool inside = false;
  for (std::size_t i = 0; i < loop.size(); ++i)
    if (right_of<Vec2>(point, x.xy(loop[i]), x.xy(loop[(i + 1) % loop.size()]))) inside = !inside;
  return inside;
}

}  // namespace

BoundaryIndex::BoundaryIndex(std::shared_ptr<const Topology> topology)
    : topology_(std::move(topology)) {
  const auto& markers = topology_->markers();
  for (std::size_t m = 0; m < markers.size(); ++m)
    for (const Face& edge : markers[m].faces)
      edges_.push_back({edge[0], edge[1], static_cast<Index>(m)});
  find_bodies();
}

void BoundaryIndex::find_bodies() {
  std::map<std::pair<Index, Index>, Index> marker_at;
  for (const Edge& e : edges_) marker_at[key(e.a, e.b)] = e.marker;
  marker_body_.assign(topology_->markers().size(), -1);
  for (const auto& loop : topology_->boundary_loops()) {
    Body body{loop, {}, false};
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto it = marker_at.find(key(loop[i], loop[(i + 1) % loop.size()]));
      if (it == marker_at.end()) continue;
      body.markers.push_back(it->second);
      marker_body_[at(it->second)] = static_cast<Index>(bodies_.size());
    }
    std::sort(body.markers.begin(), body.markers.end());
    body.markers.erase(std::unique(body.markers.begin(), body.markers.end()), body.markers.end());
    bodies_.push_back(std::move(body));
  }
}

void BoundaryIndex::update(const Coordinates& coordinates) {
  const bool first = coordinates_.empty();
  coordinates_ = coordinates;
  boxes_.clear();
  for (const Edge& e : edges_) {
    boxes_.push_back({coordinates_.xy(e.a), coordinates_.xy(e.a)});
    boxes_.back().add(coordinates_.xy(e.b));
  }
  if (!first) return tree_.refit(boxes_);
  for (Body& body : bodies_) body.hole = signed_area(coordinates_, body.nodes) < 0;
  tree_ = BoxTree<2>(boxes_);
}

double BoundaryIndex::edge_distance(const Edge& edge, const Vec2& point) const {
  const Vec2 a = coordinates_.xy(edge.a);
  const Vec2 d = coordinates_.xy(edge.b) - a;
  const double length2 = d.squaredNorm();
  const double t = length2 > 0 ? std::clamp((point - a).dot(d) / length2, 0.0, 1.0) : 0.0;
  return (point - a - t * d).norm();
}

const BoundaryIndex::Edge* BoundaryIndex::nearest(const Vec2& point, double radius) const {
  const auto edge = [this](Index i) -> const Edge& { return edges_[at(i)]; };
  const auto found =
      tree_.nearest(point, radius, [&](Index i) { return edge_distance(edge(i), point); });
  return found ? &edge(found->item) : nullptr;
}

const BoundaryIndex::Body* BoundaryIndex::body_containing(const Vec2& point) const {
  const Body* found = nullptr;
  double smallest = std::numeric_limits<double>::max();
  for (const Body& body : bodies_) {
    if (!body.hole || body.markers.empty() || !contains(coordinates_, body.nodes, point)) continue;
    const double area = std::abs(signed_area(coordinates_, body.nodes));
    if (area >= smallest) continue;
    smallest = area;
    found = &body;
  }
  return found;
}

BoundaryIndex::Hit BoundaryIndex::hit_of(Index marker, bool inside) const {
  const Body* body = body_of(marker);
  // A body moves as a whole; the outer boundary often consists of unrelated markers.
  const bool whole = body && body->hole;
  return {marker, whole ? body->markers : std::vector<Index>{marker}, whole, inside};
}

std::optional<BoundaryIndex::Hit> BoundaryIndex::pick(const Vec2& point, double radius) const {
  if (coordinates_.empty()) return std::nullopt;
  if (const Edge* edge = nearest(point, radius)) return hit_of(edge->marker, false);
  if (const Body* body = body_containing(point)) return hit_of(body->markers.front(), true);
  return std::nullopt;
}

std::optional<BoundaryIndex::NodeHit> BoundaryIndex::pick_node(const Vec2& point,
                                                               double radius) const {
  const Edge* edge = nearest(point, radius);
  if (!edge) return std::nullopt;
  const double to_a = (coordinates_.xy(edge->a) - point).norm();
  const double to_b = (coordinates_.xy(edge->b) - point).norm();
  if (std::min(to_a, to_b) > radius) return std::nullopt;
  NodeHit hit{to_a <= to_b ? edge->a : edge->b, marker_body_[at(edge->marker)], 0};
  if (hit.body < 0) return std::nullopt;
  const auto& loop = bodies_[at(hit.body)].nodes;
  const auto it = std::find(loop.begin(), loop.end(), hit.node);
  if (it == loop.end()) return std::nullopt;
  hit.position = static_cast<std::size_t>(it - loop.begin());
  return hit;
}

const BoundaryIndex::Body* BoundaryIndex::body_of(Index marker) const {
  const Index body = marker_body_[at(marker)];
  return body < 0 ? nullptr : &bodies_[at(body)];
}

double BoundaryIndex::reach(const std::vector<Index>& markers, const Vec2& point) const {
  double reach = 0;
  for (Index m : markers)
    for (Index node : topology_->markers().nodes(m))
      reach = std::max(reach, (coordinates_.xy(node) - point).norm());
  return reach;
}

std::vector<std::string> marker_names(const Topology& topology, const std::vector<Index>& markers) {
  std::vector<std::string> names;
  for (const Index m : markers) names.push_back(topology.markers()[at(m)].name);
  return names;
}

std::vector<Index> markers_named(const Topology& topology, const std::vector<std::string>& names) {
  std::vector<Index> markers;
  for (const std::string& name : names)
    if (const auto marker = topology.markers().find(name)) markers.push_back(*marker);
  std::ranges::sort(markers);
  return markers;
}

bool BoundaryArc::contains(std::size_t position) const {
  if (first <= last) return position >= first && position <= last;
  return position >= first || position <= last;
}

BoundaryArc extended(const BoundaryArc& arc, std::size_t position, std::size_t n) {
  if (arc.contains(position)) return arc;
  const std::size_t forward = (position + n - arc.last) % n;
  const std::size_t backward = (arc.first + n - position) % n;
  return forward <= backward ? BoundaryArc{arc.body, arc.first, position}
                             : BoundaryArc{arc.body, position, arc.last};
}

DragGrip grip_of(const BoundaryArc& arc, double radius, const BoundaryIndex& boundary,
                 const Topology& topology, const Coordinates& rest) {
  const auto& body = boundary.bodies()[at(arc.body)];
  FadedArc faded = faded_arc(body.nodes, rest, arc.first, arc.last, radius);
  return {marker_names(topology, body.markers), std::move(faded.nodes), std::move(faded.shares)};
}

bool SurfacePatch::contains(Index node) const { return std::ranges::binary_search(nodes, node); }

DragGrip grip_of(const SurfacePatch& patch, double radius, const Mesh& rest) {
  std::vector<Face> faces;
  for (const Index m : patch.markers) {
    const auto& own = rest.topology->markers()[at(m)].faces;
    faces.insert(faces.end(), own.begin(), own.end());
  }
  FadedPatch faded = faded_patch(faces, rest.coordinates, patch.nodes, radius);
  return {marker_names(*rest.topology, patch.markers), std::move(faded.nodes),
          std::move(faded.shares)};
}

}  // namespace winslow::gui
