#include "gui/view/tools/space_picker.h"

#include "core/mesh/element_type.h"
#include "core/mesh/surface_faces.h"
#include "gui/view/tools/pivot_picker.h"

namespace winslow::gui {

namespace {

/// What lies at a place of the screen.
std::optional<SeenPlace> seen_at(const ScreenPoint& at, const PointerFrame& frame) {
  const ViewportScene& scene = frame.scene;
  const auto hit = scene.picture.pick(frame.view, at);
  // One aims at a line from beside it, too.
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

/// What lies at a place; if it is not what is wanted, the first of eight places around it that is:
/// one aims at the rim of a body from beside it, too. reach: pixels.
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

/// The face of the boundary at a place that is seen; none: a part of a cut or of an element within.
std::optional<Index> face_at(const Session& session, const SeenPlace& seen) {
  const Topology& topology = *session.topology();
  const SpacePoints x(session.coordinates());
  std::optional<Index> best;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Face& side : shape_of(topology.element_type(seen.element)).faces) {
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

/// What the tools would do with what is under the mouse.
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

/// What is in the middle of the view, or of the mesh.
Vec3 SpacePicker::middle(const PointerFrame& frame) const {
  const VolumeView& picture = frame.scene.picture;
  const ScreenBox box = frame.view.viewport();
  if (const auto hit = picture.pick(frame.view, box.centre())) return hit->point;
  Vec3 centre = frame.view.looked_at().centre;
  if (!picture.mesh()) return centre;
  Vec3 middle = picture.scenes()->parts.front()->extent.centre();
  return box.contains(frame.view.project(middle).at) ? middle : centre;
}

/// A node of the boundary, and what is held together with it.
std::optional<Vec3> SpacePicker::take(const PointerFrame& frame) {
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

/// Holds what is under the mouse, or lets go of what was held.
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
  // A drag fades over all of what is selected, or over the marker alone.
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

/// What is under the mouse, or a node so near to it that it is meant: a corner of a body has
/// nothing beside it to be under the mouse.
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
