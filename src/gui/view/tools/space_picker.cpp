#include "gui/view/tools/space_picker.h"

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
  for (const Face& local : mesh.topology->shape(seen.element).faces) {
    std::vector<Index> nodes;
    for (const Index k : local) nodes.push_back(corners[at(k)]);
    const Face face{std::span<const Index>(nodes)};
    const Vec3 area = area_vector(x, face);
    if (!(area.norm() > 0)) continue;
    const Vec3 normal = area.normalized();
    // Distance of the place from the face's plane, and angle between the visible surface and the
    // face.
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
      // Hinges usually lie on sharp edges.
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

/// Walks from edge to edge, as long as none leaves the direction of the first.
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

/// Replaces `best` by the nearest place of an edge, if that is nearer.
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

/// True if no surface hides the point.
bool is_seen(const Vec3& point, const VolumeView& picture, const View& view) {
  constexpr double slack = 6;  // pixels, since the border lies on the surface
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

namespace {

/// What lies at a place of the screen.
std::optional<SeenPlace> seen_at(const ScreenPoint& at, const PointerFrame& frame) {
  const ViewportScene& scene = frame.scene;
  const auto hit = scene.picture.pick(frame.view, at);
  // A line can be picked from beside it, too.
  const auto border = seen_border(at, boundary_radius * scene.scale, scene.picture, frame.view,
                                  scene.options.markers);
  if (!hit && !border) return std::nullopt;
  SeenPlace seen =
      hit ? SeenPlace{hit->point, hit->normal, hit->element, hit->marker, {}} : *border;
  if (border) seen.marker = border->marker;
  const Mesh& mesh = *scene.picture.mesh();
  double nearest = node_radius * scene.scale;
  for (const Index node : mesh.topology->element(seen.element)) {
    const double distance = (frame.view.project(mesh.coordinates.xyz(node)).at - at).norm();
    if (distance > nearest) continue;
    nearest = distance;
    seen.node = node;
  }
  return seen;
}

/// What lies at a place if it is wanted, else the first wanted item at eight places around it, so
/// that the rim of a body can be picked from beside it. reach: pixels.
template <class Wanted>
std::optional<SeenPlace> seen_near(const std::optional<SeenPlace>& there, double reach,
                                   const PointerFrame& frame, const Wanted& wanted) {
  if (there && wanted(*there)) return there;
  constexpr int directions = 8;
  for (int k = 0; k < directions; ++k) {
    const double angle = 2 * pi * k / directions;
    const ScreenVector arm(std::cos(angle), std::sin(angle));
    auto beside = seen_at(frame.pointer.position + reach * frame.scene.scale * arm, frame);
    if (beside && wanted(*beside)) return beside;
  }
  return std::nullopt;
}

bool on_surface(const SeenPlace& place) { return place.marker >= 0; }

/// The face of the boundary at a visible place; none: the place is on a cut or on an inner element.
std::optional<Index> face_at(const Session& session, const SeenPlace& seen) {
  const Topology& topology = *session.topology();
  const SpacePoints x(session.coordinates());
  std::optional<Index> best;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Face& side : topology.shape(seen.element).faces) {
    const auto f = topology.find_face(by_nodes(side, topology.element(seen.element)));
    if (!f || topology.face(*f).elements[1] >= 0) continue;
    const Face nodes = topology.face(*f).nodes;
    const Vec3 normal = area_vector(x, nodes).normalized();
    // An element may have several faces on the boundary: the one in whose plane the place lies.
    const double distance = std::abs(normal.dot(seen.point - centre_of(x, nodes)));
    if (distance >= nearest) continue;
    nearest = distance;
    best = f;
  }
  return best;
}

}  // namespace

void SpacePicker::forget() {
  seen_.reset();
  surface_.reset();
  looked_.reset();
}

void SpacePicker::find(const PointerFrame& frame, bool handled) {
  const ViewportScene& scene = frame.scene;
  const Looked now{frame.pointer.position, ViewKey(frame.view), scene.picture.scenes()};
  if (looked_ != now) seen_ = seen_at(frame.pointer.position, frame);
  looked_ = now;
  surface_.reset();
  if (seen_ && frame.picks_nodes()) found_.node = seen_->node;
  if (handled) return;
  find_held(frame);
  if (seen_ && on_surface(*seen_) && !scene.session.selection().space().pick() && held().empty() &&
      !std::ranges::binary_search(scene.taken_out, seen_->marker))
    found_.markers = {seen_->marker};
}

/// Finds what the tools would do with what is under the mouse.
void SpacePicker::find_held(const PointerFrame& frame) {
  const ViewportScene& scene = frame.scene;
  const Selection& selection = scene.session.selection();
  const auto& pick = selection.space().pick();
  if (!pick && !selection.shape_edit().active) return;
  surface_ = seen_near(seen_, boundary_radius, frame, on_surface);
  if (!surface_) return;
  if (pick) {
    found_.pivot_source =
        pivot_picker_.source_at(*surface_, *pick->from, pick->first, scene.session);
  } else if (!scene.session.in_motion() &&
             !std::ranges::binary_search(scene.taken_out, surface_->marker)) {
    const auto shared = scene.session.mesh().shared();
    const Mesh& mesh = *shared;
    found_.held = seen_face(*surface_, mesh);
    const auto node = nearest_corner(*surface_, mesh);
    if (node &&
        (frame.view.project(mesh.coordinates.xyz(*node)).at - frame.pointer.position).norm() <=
            node_radius * scene.scale)
      found_.held = {*node};
  }
}

std::optional<Vec3> SpacePicker::point(const PointerFrame& /*frame*/) const {
  return seen_ ? std::optional(seen_->point) : std::nullopt;
}

/// The visible point in the middle of the view; else the middle of the mesh, if in view, or the
/// view's centre.
Vec3 SpacePicker::middle(const PointerFrame& frame) const {
  const VolumeView& picture = frame.scene.picture;
  const ScreenBox box = frame.view.viewport();
  if (const auto hit = picture.pick(frame.view, box.centre())) return hit->point;
  Vec3 centre = frame.view.looked_at().centre;
  if (!picture.mesh()) return centre;
  Vec3 middle = picture.scenes()->parts.front()->extent.centre();
  return box.contains(frame.view.project(middle).at) ? middle : centre;
}

/// Grabs a node of the boundary, and the nodes that are held with it.
std::optional<Vec3> SpacePicker::grab(const PointerFrame& frame) {
  if (!takes()) return std::nullopt;
  const Session& session = frame.scene.session;
  const Index node = held().front();
  const auto& patch = session.selection().shape_edit().patch;
  if (!patch || !patch->contains(node)) click_for_shape(false, frame);
  return session.coordinates().xyz(node);
}

bool SpacePicker::inspect(const PointerFrame& frame) const {
  const bool has_vcv = frame.picks_nodes() && seen_ && seen_->node &&
                       !frame.scene.session.topology()->on_boundary(*seen_->node);
  if (has_vcv) frame.actions.emplace_back(action::InspectNode{*seen_->node});
  return has_vcv;
}

void SpacePicker::click(const PointerFrame& frame) const {
  const PointerState& p = frame.pointer;
  const Selection& selection = frame.scene.session.selection();
  ActionQueue& actions = frame.actions;
  const bool add = p.shift || p.control;
  if (selection.space().pick() && click_for_pivot(frame)) return;
  if (selection.shape_edit().active && !p.alt) return click_for_shape(add, frame);
  if (!add && inspect(frame)) return;
  if (p.alt) {
    if (seen_ && seen_->node)
      actions.emplace_back(action::GoTo{MeshItem{MeshItem::Kind::node, *seen_->node}, false});
    else
      actions.emplace_back(action::Remark{"No node is there. Click nearer to one, or zoom in."});
    return;
  }
  if (!seen_) {
    if (!add) actions.emplace_back(action::SelectMarkers{{}, false});
    return;
  }
  if (seen_->marker < 0) {
    actions.emplace_back(action::GoTo{MeshItem{MeshItem::Kind::element, seen_->element}, false});
    return;
  }
  if (!std::ranges::binary_search(frame.scene.taken_out, seen_->marker))
    actions.emplace_back(action::SelectMarkers{{seen_->marker}, add});
}

/// True if the click was for a pivot.
bool SpacePicker::click_for_pivot(const PointerFrame& frame) const {
  const auto& pick = frame.scene.session.selection().space().pick();
  const auto& source = pivot_source();
  if (!source) {
    frame.actions.emplace_back(
        action::Remark{"No surface is there to pick from. Esc ends the picking of a pivot."});
    return true;
  }
  const std::size_t wanted = pick->from == PivotFrom::nodes ? 2 : source->nodes.size();
  if (source->nodes.size() < wanted)
    frame.actions.emplace_back(action::PickPivot{pick->from, source->nodes.front()});
  else
    frame.actions.emplace_back(action::TakePivot{*source});
  return true;
}

/// Holds what is under the mouse, or releases what was held.
void SpacePicker::click_for_shape(bool add, const PointerFrame& frame) const {
  const Selection& selection = frame.scene.session.selection();
  const auto& before = selection.shape_edit().patch;
  if (held().empty()) {
    if (!add && before) frame.actions.emplace_back(action::SelectPatch{});
    return;
  }
  SurfacePatch patch;
  if (add && before) patch = *before;
  patch.nodes.insert(patch.nodes.end(), held().begin(), held().end());
  // A drag fades over the whole selection, or over this marker alone.
  patch.markers.push_back(surface_->marker);
  if (selection.contains(surface_->marker))
    patch.markers.insert(patch.markers.end(), selection.markers().begin(),
                         selection.markers().end());
  for (std::vector<Index>* list : {&patch.nodes, &patch.markers}) {
    std::ranges::sort(*list);
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  frame.actions.emplace_back(action::SelectPatch{std::move(patch)});
}

/// The place under the mouse, or a node close to it: beside the corner of a body, nothing is under
/// the mouse.
std::optional<RulerPoint> SpacePicker::ruler_point(const PointerFrame& frame) {
  constexpr double beside_node = 6;  // pixels
  if (!frame.pointer.over) return std::nullopt;
  const auto seen = seen_ ? seen_ : seen_near({}, beside_node, frame, [](const SeenPlace& place) {
    return place.node.has_value();
  });
  if (!seen) return std::nullopt;
  if (!seen->node || frame.pointer.shift) return RulerPoint{seen->point, {}, seen->normal};
  return RulerPoint{frame.scene.session.coordinates().xyz(*seen->node), seen->node, seen->normal};
}

PickedPlace SpacePicker::place_at(const ScreenPoint& at, const PointerFrame& frame) {
  PickedPlace place;
  const auto there = seen_at(at, frame);
  if (!there) return place;
  place.in_space = {there->point, there->normal};
  place.node = there->node;
  place.element = there->element;
  if (!on_surface(*there)) return place;
  place.markers = {there->marker};
  if (frame.scene.session.kind() == MeshKind::volume)
    place.face = face_at(frame.scene.session, *there);
  return place;
}

}  // namespace winslow::gui
