#include "core/strategy/sliding.h"

#include <iterator>
#include <set>

#include "core/error.h"
#include "core/mesh/coordinates.h"
#include "core/mesh/element_type.h"
#include "core/mesh/index_sets.h"
#include "core/mesh/surface_faces.h"
#include "core/options/option.h"
#include "core/quality/quality.h"
#include "core/quality/wall_measures.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

/// The length of an element along one of its faces divided by its height there.
double flatness(const Mesh& mesh, const Face& face, Index element) {
  const Topology& topology = *mesh.topology;
  const Coordinates& x = mesh.coordinates;
  const bool plane = x.dimension() == 2;
  const ElementType type = topology.element_type(element);
  const auto corners = topology.element(element);
  const double measure =
      plane ? std::abs(signed_area2(x, corners)) / 2
            : std::abs(signed_volume6(x, topology.shape(element), corners, x.xyz(face[0]))) / 6;
  const double area =
      plane ? (x.xy(face[1]) - x.xy(face[0])).norm() : area_vector(SpacePoints(x), face).norm();
  const bool pointed = plane ? type == ElementType::triangle
                             : type == ElementType::tetrahedron || type == ElementType::pyramid;
  const double height = (pointed ? x.dimension() : 1) * measure / area;
  return (plane ? area : std::sqrt(area)) / height;
}

bool is_flat(const Mesh& mesh, const Marker& marker) {
  constexpr double least = 3;
  std::vector<double> ratios;
  for (const Face& face : marker.faces) {
    const auto found = mesh.topology->find_face(face);
    if (!found) continue;
    const auto shared = mesh.topology->face(*found);
    ratios.push_back(flatness(mesh, face, shared.elements[0]));
  }
  if (ratios.empty()) return false;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::ranges::nth_element(ratios, middle);
  return *middle >= least;
}

class RowMotion final : public Motion {
 public:
  RowMotion(const Motion& motion, CurveRows rows) : motion_(motion), rows_(std::move(rows)) {
    nodes_.assign(motion.nodes().begin(), motion.nodes().end());
    for (const auto& row : rows_)
      nodes_.insert(nodes_.end(), row->between().begin(), row->between().end());
    std::ranges::sort(nodes_);
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  }

  std::span<const Index> nodes() const override { return nodes_; }
  const Motion& of_bodies() const override { return motion_; }
  void apply(const Coordinates& rest, double fraction, Coordinates& out) const override {
    motion_.apply(rest, fraction, out);
    for (const auto& row : rows_) {
      const auto places = row->places(place_of(out, row->first()), place_of(out, row->last()));
      for (std::size_t k = 0; k < places.between.size(); ++k)
        set_place(out, row->between()[k], places.between[k].point);
    }
  }
  std::vector<TakenNode> taken(const Coordinates& x) const override {
    std::vector<TakenNode> all = motion_.taken(x);
    for (const auto& row : rows_) {
      // The ends stay on the curve.
      const auto places = row->places(place_of(x, row->first()), place_of(x, row->last()));
      for (std::size_t k = 0; k < places.between.size(); ++k) {
        const double part = row->part_of_last(k);
        const Vec3& tangent = places.between[k].tangent;
        all.push_back({row->between()[k],
                       {{row->first(), (1 - part) * tangent * places.first.tangent.transpose()},
                        {row->last(), part * tangent * places.last.tangent.transpose()}}});
      }
    }
    return all;
  }

 private:
  const Motion& motion_;
  CurveRows rows_;
  std::vector<Index> nodes_;
};

/// The parts whose spacing is held.
std::vector<SlidingPart*> held_parts(const SlideOptions& slide, const Mesh& mesh,
                                     std::vector<SlidingPart>& parts) {
  std::vector<SlidingPart*> held;
  std::map<std::string, bool> walls;
  for (SlidingPart& part : parts) {
    // A curve with a node in hold_nodes slides freely on both sides of this node, and so does what
    // is of no marker.
    if (!part.row || part.of_regions || std::ranges::any_of(slide.hold_nodes, [&](Index node) {
          return std::ranges::find(part.row->nodes(), node) != part.row->nodes().end();
        }))
      continue;
    bool holds = slide.spacing == SlideSpacing::held ||
                 std::ranges::find(slide.held_markers, part.marker) != slide.held_markers.end();
    if (!holds && slide.spacing == SlideSpacing::automatic) {
      const auto [place, is_new] = walls.try_emplace(part.marker, false);
      if (is_new) place->second = is_wall(mesh, part.marker);
      holds = place->second;
    }
    if (holds) held.push_back(&part);
  }
  return held;
}

/// Fixes the sliding ends of a row if the row cannot move because one of its nodes is held for
/// another reason, or if a body moves the other end.
void hold_ends(const CurveRow& row, NodeClasses& classes) {
  const bool whole = std::ranges::all_of(
      row.between(), [&](Index node) { return classes[node] == NodeClass::on_curve; });
  for (const Index end : {row.first(), row.last()}) {
    const Index other = end == row.first() ? row.last() : row.first();
    if (classes.moves(end) && (!whole || classes[other] == NodeClass::prescribed))
      classes.set_fixed({&end, 1});
  }
}

/// The spacing of the nodes between the ends. Ends slide along the row itself only if it is closed
/// or lies between periodic corners.
Spacing spacing_of(const CurveRow& row, const NodeClasses& classes) {
  const bool moves = classes.moves(row.first()) || classes.moves(row.last());
  const bool taken =
      classes[row.first()] == NodeClass::prescribed || classes[row.last()] == NodeClass::prescribed;
  if (!row.can_move() || !(moves || taken)) return Spacing::stays;
  return row.closed() ? Spacing::turns : Spacing::ends;
}

}  // namespace

bool is_wall(const Mesh& mesh, const std::string& marker) {
  const auto& markers = mesh.topology->markers();
  const std::vector<std::string> names{marker};
  markers.nodes_of(names);  // throws with a list of the markers if one is unknown
  if (mesh.coordinates.dimension() == 2)
    for (const Wall& wall : find_walls(mesh))
      if (std::ranges::find(wall.markers, marker) != wall.markers.end()) return true;
  return is_flat(mesh, markers[at(*markers.find(marker))]);
}

CurveRows hold_spacing(const SlideOptions& slide, const Mesh& mesh, MovingBoundary& boundary,
                       NodeClasses& classes) {
  CurveRows with_motion;
  const std::vector<SlidingPart*> held = held_parts(slide, mesh, boundary.sliding);
  for (const SlidingPart* part : held) hold_ends(*part->row, classes);
  for (SlidingPart* part : held) {
    const auto& row = part->row;
    part->spacing = spacing_of(*row, classes);
    const bool taken = !classes.moves(row->first()) && !classes.moves(row->last());
    if (part->spacing == Spacing::stays) {
      classes.set_fixed(row->between());
    } else if (taken) {
      classes.set_prescribed(row->between());
      with_motion.push_back(row);
    } else {
      classes.set_following(row);
    }
  }
  return with_motion;
}

std::unique_ptr<const Motion> with_rows(const Motion& motion, const CurveRows& rows) {
  return std::make_unique<RowMotion>(motion, rows);
}

namespace {

bool contains(std::span<const std::string> names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

std::vector<Index> shared_nodes(const Topology& topology, const std::string& marker,
                                std::span<const Index> ascending) {
  const auto nodes = topology.markers().nodes(*topology.markers().find(marker));
  std::vector<Index> shared;
  std::ranges::set_intersection(nodes, ascending, std::back_inserter(shared));
  return shared;
}

/// The moving markers that have the nodes: "slat, main".
std::string bodies_with(const Topology& topology, std::span<const Index> moving,
                        std::vector<Index> nodes) {
  std::string text;
  while (!nodes.empty()) {
    const std::string name = body_with(topology, moving, nodes.front());
    nodes.erase(nodes.begin());
    if (name.empty()) continue;
    text += (text.empty() ? "" : ", ") + name;
    const auto of_body = topology.markers().nodes(*topology.markers().find(name));
    std::erase_if(nodes, [&](Index node) { return std::ranges::binary_search(of_body, node); });
  }
  return text;
}

/// Nodes that do not slide on footholds: they are held, or have a class already.
std::vector<unsigned char> taken_nodes(const SlideOptions& slide, const NodeClasses& classes) {
  std::vector<unsigned char> taken(at(classes.topology().node_count()), 0);
  for (const Index node : slide.hold_nodes) taken[at(node)] = 1;
  for (Index node = 0; node < classes.topology().node_count(); ++node)
    if (classes.slides(node) || classes.tied().partner(node)) taken[at(node)] = 1;
  return taken;
}

/// The markers that may give way to the bodies; `held_footholds` receives the others.
std::vector<std::string> markers_that_yield(const SlideOptions& slide, const std::string& held_by,
                                            const Topology& topology, const BodyNodes& bodies,
                                            MovingBoundary& boundary) {
  std::vector<std::string> names;
  for (const std::string& name : markers_underfoot(topology, bodies.all, bodies.standing)) {
    const bool paired = std::ranges::any_of(boundary.periodic, [&](const PeriodicPairs& pairs) {
      return pairs.first == name || pairs.second == name;
    });
    if (paired || contains(slide.markers, name)) continue;
    const bool fixed = contains(slide.fixed, name);
    if (!fixed && held_by.empty()) {
      names.push_back(name);
      continue;
    }
    const std::vector<Index> nodes = shared_nodes(topology, name, bodies.standing);
    boundary.held_footholds.push_back({bodies_with(topology, bodies.all, nodes), name, nodes.size(),
                                       fixed ? "--fixed " + name : held_by});
  }
  return names;
}

}  // namespace

void let_footholds_slide(const SlideOptions& slide, const std::string& held_by, const Mesh& mesh,
                         const BodyNodes& bodies, MovingBoundary& boundary, NodeClasses& classes) {
  const Topology& topology = *mesh.topology;
  if (bodies.standing.empty()) return;
  FootholdQuery query;
  query.markers = markers_that_yield(slide, held_by, topology, bodies, boundary);
  if (slide.reference.empty())  // else they slide on other shapes than those of the mesh
    for (const std::string& name : slide.markers)
      if (!shared_nodes(topology, name, bodies.standing).empty()) query.sliding.push_back(name);
  if (query.markers.empty() && query.sliding.empty()) return;
  query.moving = bodies.all;
  query.standing = bodies.standing;
  query.taken = taken_nodes(slide, classes);
  query.angle = slide.feature_angle;
  Footholds found = find_footholds(topology, mesh.coordinates, query);
  for (SlidingPart& part : found.sliding.parts) {
    classes.set_sliding(part.nodes, found.sliding.geometry, mesh.coordinates);
    part.gives_way = true;
    boundary.sliding.push_back(std::move(part));
  }
  for (Foothold& foothold : found.all)
    foothold.body = bodies_with(topology, bodies.all, foothold.nodes);
  boundary.footholds = std::move(found.all);
}

std::vector<Foothold> footholds_of(const SlideOptions& slide, const std::string& held_by,
                                   const Mesh& mesh, const BodyNodes& bodies) {
  if (bodies.standing.empty()) return {};
  const Topology& topology = *mesh.topology;
  MovingBoundary none;
  FootholdQuery query;
  query.markers = markers_that_yield(slide, held_by, topology, bodies, none);
  for (const std::string& name : markers_underfoot(topology, bodies.all, bodies.standing))
    if (contains(slide.markers, name) && slide.reference.empty()) query.markers.push_back(name);
  if (query.markers.empty()) return {};
  query.moving = bodies.all;
  query.standing = bodies.standing;
  query.angle = slide.feature_angle;
  return find_footholds(topology, mesh.coordinates, query).all;
}

std::string what_holds_footholds(const SmoothOptions& options) {
  if (options.formulation != Formulation::variational)
    return "the pointwise form knows no geometry of the boundary";
  if (options.untangle == Untangle::picard)
    return "the fixed point knows no geometry of the boundary";
  return {};
}

namespace {

[[noreturn]] void refuse_foothold(const Foothold& foothold, const std::string& why,
                                  const std::string& expected) {
  std::string names, flags;
  for (const std::string& name : foothold.markers) {
    names += (names.empty() ? "" : " and ") + name;
    flags += (flags.empty() ? "" : " ") + ("--fixed " + name);
  }
  const bool several = foothold.body.find(',') != std::string::npos;
  throw UsageError((foothold.body.empty() ? "what moves" : foothold.body) +
                   (several ? " share " : " shares ") + std::to_string(foothold.nodes.size()) +
                   (foothold.nodes.size() == 1 ? " node" : " nodes") + " with " + foothold.name() +
                   " (" + foothold.description + "), " + why + ": expected " + expected +
                   "; move " + names + " as well, or name " +
                   (foothold.markers.size() > 1 ? "them" : "it") + " in fixed (" + flags +
                   "): its other nodes then stay");
}

}  // namespace

BodyNodes body_nodes(const Motion& motion, const Coordinates& rest) {
  constexpr double round_off = 1e-12;
  BodyNodes nodes{{motion.nodes().begin(), motion.nodes().end()}, {}};
  const double least = round_off * body_box(rest, nodes.all).size().norm();
  std::vector<unsigned char> moves(nodes.all.size(), 0);
  Coordinates x = rest;
  for (const double fraction : {1.0, 0.5, 0.25}) {
    motion.apply(rest, fraction, x);
    for (std::size_t i = 0; i < nodes.all.size(); ++i)
      if ((place_of(x, nodes.all[i]) - place_of(rest, nodes.all[i])).norm() > least) moves[i] = 1;
  }
  for (std::size_t i = 0; i < nodes.all.size(); ++i)
    if (moves[i] != 0) nodes.standing.push_back(nodes.all[i]);
  return nodes;
}

namespace {

/// Whether all nodes of a face are in a set.
bool within(const Face& face, std::span<const Index> ascending) {
  return std::ranges::all_of(
      face, [&](Index node) { return std::ranges::binary_search(ascending, node); });
}

}  // namespace

std::vector<std::string> markers_moved_by(const Topology& topology, std::span<const Index> nodes) {
  const Markers& markers = topology.markers();
  std::vector<Index> of_bodies;
  std::vector<bool> moves(markers.size(), false);
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const auto own = markers.nodes(static_cast<Index>(m));
    moves[m] = !own.empty() && std::ranges::includes(nodes, own);
    if (moves[m]) of_bodies.insert(of_bodies.end(), own.begin(), own.end());
  }
  sort_unique(of_bodies);
  std::vector<std::string> names;
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const auto is_moved = [&](const Face& face) {
      return within(face, nodes) && !within(face, of_bodies);
    };
    if (moves[m] || std::ranges::any_of(markers[m].faces, is_moved))
      names.push_back(markers[m].name);
  }
  return names;
}

BodyNodes body_nodes_of_table(const Motion& motion, const Mesh& rest) {
  BodyNodes nodes = body_nodes(motion, rest.coordinates);
  const std::vector<std::string> moved = markers_moved_by(*rest.topology, nodes.all);
  std::vector<Index> of_others, of_faces;  // the latter move as a whole
  for (const Marker& marker : rest.topology->markers()) {
    const bool other = !contains(moved, marker.name);
    for (const Face& face : marker.faces) {
      if (other) of_others.insert(of_others.end(), face.begin(), face.end());
      if (within(face, nodes.all)) of_faces.insert(of_faces.end(), face.begin(), face.end());
    }
  }
  for (std::vector<Index>* set : {&of_others, &of_faces}) {
    sort_unique(*set);
    std::vector<Index> kept;
    std::ranges::set_intersection(nodes.standing, *set, std::back_inserter(kept));
    nodes.standing = std::move(kept);
  }
  return nodes;
}

namespace {

/// The node that is taken farthest off a foothold; of a foothold that is known only at its nodes,
/// the one that moves farthest.
struct Departure {
  Index node = -1;  ///< -1: none
  double off = 0;
};

Departure farthest_off(const Foothold& foothold, const Coordinates& rest, const Coordinates& x,
                       double least) {
  constexpr double share = 1e-6;  // of the way of a node
  Departure farthest;
  const auto distance = [&](const Vec3& p) { return (foothold.nearest(p) - p).norm(); };
  for (const Index node : foothold.nodes) {
    const Vec3 from = place_of(rest, node), to = place_of(x, node);
    const double moved = (to - from).norm();
    const double off = foothold.goes_on ? distance(to) - distance(from) : moved;
    if (off > std::max(least + share * moved, farthest.off)) farthest = {node, off};
  }
  return farthest;
}

}  // namespace

void require_on_footholds(const Mesh& mesh, const Motion& motion,
                          std::span<const Foothold> footholds) {
  if (footholds.empty()) return;
  constexpr double share = 1e-6;  // of the bodies
  const int dimension = mesh.coordinates.dimension();
  const double least = share * body_box(mesh.coordinates, motion.nodes()).size().norm();
  Coordinates x = mesh.coordinates;
  for (const double fraction : {1.0, 0.5, 0.25}) {
    motion.apply(mesh.coordinates, fraction, x);
    for (const Foothold& foothold : footholds) {
      const Departure farthest = farthest_off(foothold, mesh.coordinates, x, least);
      if (farthest.node < 0) continue;
      const std::string where = "node " + std::to_string(farthest.node) + " at " +
                                place_text(place_of(mesh.coordinates, farthest.node), dimension);
      if (foothold.goes_on)
        refuse_foothold(
            foothold,
            "and the motion takes them off it, " + where + " by " + number_text(farthest.off),
            "a motion along it");
      const bool line = dimension == 2 || foothold.edge;
      refuse_foothold(foothold,
                      std::string("which is no ") +
                          (line ? "straight line or circle" : "plane, cylinder or sphere") +
                          " there and cannot give way, and the motion takes " + where + " along",
                      "a motion that leaves these nodes where they are");
    }
  }
}

namespace {

/// A node of a body and an adjacent sliding node, on a face of the boundary.
struct Junction {
  Index moving, sliding;
  std::size_t part;
};

/// Whether a node is on the marker of a part. It is not where a face of a periodic side joins it to
/// a sliding corner of that side.
bool stands_on(const Topology& topology, Index node, const SlidingPart& part) {
  const auto marker = topology.markers().find(part.marker);
  return !marker || std::ranges::binary_search(topology.markers().nodes(*marker), node);
}

std::vector<Junction> find_junctions(const Topology& topology, std::span<const Index> moving,
                                     const std::vector<SlidingPart>& parts) {
  std::vector<bool> moves(at(topology.node_count()), false);
  for (const Index node : moving) moves[at(node)] = true;
  std::map<Index, std::size_t> part_of;
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const Index node : parts[p].nodes) part_of[node] = p;
  std::vector<Junction> junctions;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const auto face = topology.face(f);
    if (face.elements[1] >= 0) continue;
    for (const Index node : face.nodes) {
      if (!moves[at(node)]) continue;
      for (const Index other : face.nodes)
        if (const auto part = part_of.find(other);
            part != part_of.end() && stands_on(topology, node, parts[part->second]))
          junctions.push_back({node, other, part->second});
    }
  }
  return junctions;
}

/// Checks that the bodies' nodes stay on the geometry along the whole motion.
void require_along(const Mesh& mesh, const Motion& motion, const std::vector<SlidingPart>& parts,
                   std::span<const Junction> junctions, const NodeClasses& classes) {
  const int dimension = mesh.coordinates.dimension();
  constexpr double share = 1e-6;
  for (const double fraction : {1.0, 0.5, 0.25}) {
    Coordinates x = mesh.coordinates;
    motion.apply(mesh.coordinates, fraction, x);
    for (const Junction& junction : junctions) {
      const Vec3 rest = place_of(mesh.coordinates, junction.moving);
      const Vec3 place = place_of(x, junction.moving);
      const Foot foot = classes.foot(junction.sliding, place);
      // A node on a feature line does not determine the adjacent surfaces.
      if (foot.frame.count() < dimension - 1) continue;
      const SlidingPart& part = parts[junction.part];
      Box<3> box = Box<3>::empty();
      for (const Index node : part.nodes) box.add(place_of(mesh.coordinates, node));
      const double off = (foot.point - place).norm();
      if (off <= share * (box.size().norm() + (place - rest).norm())) continue;
      throw UsageError("node " + std::to_string(junction.moving) + " at " +
                       place_text(rest, dimension) + " stands on \"" + part.marker +
                       "\", which slides (" + part.description +
                       "): expected a motion along it, and this one takes the node off it by " +
                       number_text(off));
    }
  }
}

}  // namespace

void let_bodies_slide(const Mesh& mesh, const Motion& motion, const NodeClasses& classes,
                      MovingBoundary& boundary) {
  require_on_footholds(mesh, motion, boundary.footholds);
  if (boundary.sliding.empty()) return;
  const std::vector<Junction> junctions =
      find_junctions(*mesh.topology, motion.nodes(), boundary.sliding);
  if (junctions.empty()) return;
  require_along(mesh, motion, boundary.sliding, junctions, classes);
  std::set<std::size_t> attached;
  for (const Junction& junction : junctions) attached.insert(junction.part);
  for (const std::size_t part : attached) {
    const std::vector<Index>& nodes = boundary.sliding[part].nodes;
    boundary.yielding.insert(boundary.yielding.end(), nodes.begin(), nodes.end());
  }
}

std::string fixed_marker_at(const Topology& topology, const Damage& damage,
                            std::span<const std::string> moving, const SlideOptions& slide) {
  std::vector<Index> nodes;
  if (damage.element)
    nodes.assign(topology.element(*damage.element).begin(),
                 topology.element(*damage.element).end());
  if (damage.node) nodes.push_back(*damage.node);
  const Markers& markers = topology.markers();
  std::vector<Index> taken;
  for (const std::string& name : moving)
    if (const auto m = markers.find(name))
      taken.insert(taken.end(), markers.nodes(*m).begin(), markers.nodes(*m).end());
  sort_unique(taken);
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const std::string& name = markers[m].name;
    if (contains(moving, name) || contains(slide.markers, name) || contains(slide.periodic, name))
      continue;
    const auto of_marker = markers.nodes(static_cast<Index>(m));
    const auto in = [](std::span<const Index> ascending) {
      return [ascending](Index node) { return std::ranges::binary_search(ascending, node); };
    };
    if (std::ranges::any_of(nodes, in(of_marker)) && !std::ranges::any_of(of_marker, in(taken)))
      return name;
  }
  return {};
}

std::vector<Index> yielding_nodes(const MovingBoundary& boundary, const NodeClasses& classes) {
  std::vector<Index> nodes = boundary.yielding;
  for (const NodeImage& pair : classes.tied().images())
    nodes.insert(nodes.end(), {pair.node, pair.image});
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

ReferenceStart put_on_reference(const ResolvedSlide& slide, const MeshState& state,
                                const Coordinates* start) {
  if (slide.markers.empty())
    throw UsageError(slide.reference +
                     ": a reference surface is for nodes that slide: name their markers");
  const Topology& topology = *state.mesh.topology;
  const SlidingBoundary boundary =
      SlidingBoundary::find(topology, state.mesh.coordinates, slide.markers, feature_rules(slide),
                            slide.files().reference.get());
  ReferenceStart out{state, std::nullopt};
  out.state.mesh.coordinates = put_on(boundary, std::move(out.state.mesh.coordinates));
  if (start == nullptr) return out;
  out.start = *start;
  // The run refuses a start of another kind.
  if (!start->alike(state.mesh.coordinates)) return out;
  out.start = put_on(boundary, std::move(*out.start));
  if (check_validity(topology, *out.start).inverted > check_validity(topology, *start).inverted)
    out.start.reset();
  return out;
}

void require_no_more_inverted(const SlideOptions& slide, const Mesh& before, const Mesh& placed) {
  const Index had = check_validity(*before.topology, before.coordinates).inverted;
  const Index has = check_validity(*placed.topology, placed.coordinates).inverted;
  if (has > had)
    throw UsageError(slide.reference + ": with their nodes put onto this surface " +
                     std::to_string(has) + " elements are inverted: smooth the mesh on it first");
}

}  // namespace winslow
