#include "core/strategy/surface_shape.h"

#include <set>

#include "core/error.h"
#include "core/geometry/sliding_boundary.h"
#include "core/mesh/index_sets.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

/// Whether two surfaces are equal, even if read separately.
bool same_surface(const ReferenceSurface* a, const ReferenceSurface* b) {
  return a == b || (a && b && a->points == b->points && a->faces == b->faces);
}

}  // namespace

std::shared_ptr<const SurfaceShape> surface_shape(const MeshState& state,
                                                  const ResolvedSlide& options) {
  if (options.given())
    throw UsageError(
        "sliding markers and periodic pairs: not for a surface mesh, all nodes of which slide");
  const SurfaceShape* known = state.surface.get();
  FeatureRules rules = feature_rules(options);
  rules.interfaces = interfaces_in(options.interfaces, false);
  const auto& reference = options.files().reference;
  if (known && known->rules == rules && same_surface(known->reference.get(), reference.get()))
    return state.surface;
  auto shape = std::make_shared<SurfaceShape>();
  shape->given = known ? known->given : state.mesh.coordinates;
  shape->rules = rules;
  shape->reference = reference;
  shape->boundary =
      SlidingBoundary::find(*state.mesh.topology, shape->given, {}, rules, reference.get());
  shape->normals =
      std::make_shared<const ElementNormals>(state.mesh.topology, shape->given, shape->boundary);
  return shape;
}

std::shared_ptr<const SurfaceShape> own_shape(const Mesh& mesh) {
  if (!is_surface(*mesh.topology)) return nullptr;
  try {
    return surface_shape(MeshState{mesh}, {});
  } catch (const UsageError&) {
    return nullptr;
  }
}

std::vector<Vec3> reference_normals(const MeshState& state, const Coordinates& x) {
  return state.surface ? state.surface->normals->of_elements(x, 0) : std::vector<Vec3>();
}

namespace {

/// A connected part of a surface mesh.
struct Part {
  std::vector<Index> nodes, held;  // all nodes; the fixed ones of them
  Index characteristic = 0;        // Euler characteristic, with each border closed by an element
};

std::map<Index, Part> find_parts(const Topology& topology, const std::vector<bool>& slides) {
  JoinedSets sets(at(topology.node_count()));
  for (const Topology::Edge& edge : topology.edges()) sets.join(edge.nodes[0], edge.nodes[1]);
  std::map<Index, Part> parts;
  for (Index node = 0; node < topology.node_count(); ++node) {
    if (!topology.used(node)) continue;
    Part& part = parts[sets.find(node)];
    part.nodes.push_back(node);
    ++part.characteristic;
    if (!slides[at(node)]) part.held.push_back(node);
  }
  for (const Topology::Edge& edge : topology.edges())
    --parts[sets.find(edge.nodes[0])].characteristic;
  for (Index e = 0; e < topology.element_count(); ++e)
    ++parts[sets.find(topology.element(e)[0])].characteristic;
  for (const auto& loop : topology.boundary_loops())
    ++parts[sets.find(loop.front())].characteristic;
  return parts;
}

/// Chooses nodes successively, each as far as possible from the previous ones.
class FarApart {
 public:
  FarApart(const SpacePoints& x, std::span<const Index> nodes) : x_(x) {
    for (const Index node : nodes) around_.add(x[node]);
  }
  Index count() const { return static_cast<Index>(chosen_.size()); }

  /// The next of some nodes; -1 if none is far from the previous ones.
  Index next(std::span<const Index> nodes) {
    constexpr double far = 0.2;  // of the extent
    Index best = -1;
    double farthest = far * around_.size().norm();
    for (const Index node : nodes) {
      double distance = 2 * around_.size().norm();
      for (const Index other : chosen_)
        distance = std::min(distance, (x_[node] - x_[other]).norm());
      if (distance <= farthest) continue;
      farthest = distance;
      best = node;
    }
    if (best >= 0) chosen_.push_back(best);
    return best;
  }

 private:
  const SpacePoints& x_;
  Box<3> around_ = Box<3>::empty();
  std::vector<Index> chosen_;
};

}  // namespace

std::vector<Index> nodes_to_hold(const Topology& topology, const Coordinates& coordinates,
                                 const std::vector<bool>& slides) {
  const SpacePoints x(coordinates);
  std::vector<Index> hold;
  for (const auto& [lowest, part] : find_parts(topology, slides)) {
    const Index needed = part.characteristic == 2 ? 3 : part.characteristic == 0 ? 1 : 0;
    FarApart chosen(x, part.nodes);
    while (chosen.count() < needed && chosen.next(part.held) >= 0) {
    }
    while (chosen.count() < needed) {
      const Index node = chosen.next(part.nodes);
      if (node < 0) break;
      hold.push_back(node);
    }
  }
  return hold;
}

void slide_on_surface(const SurfaceShape& shape, const Coordinates& x, NodeClasses& classes) {
  const Topology& topology = classes.topology();
  const auto geometry =
      std::make_shared<const RememberedFeet>(shape.boundary.geometry, topology.node_count());
  classes.set_fixed(topology.interior_nodes());
  std::vector<bool> slides(at(topology.node_count()), false);
  for (const SlidingPart& part : shape.boundary.parts) {
    classes.set_sliding(part.nodes, geometry, x);
    for (const Index node : part.nodes) slides[at(node)] = true;
  }
  classes.set_fixed(nodes_to_hold(topology, x, slides));
  classes.set_element_normals(
      std::make_shared<const ElementNormals>(shape.normals->with_geometry(geometry)));
}

InterfaceReport interfaces_of_surface(const SurfaceShape& shape, const NodeClasses& classes) {
  const Topology& topology = classes.topology();
  InterfaceReport report;
  std::set<Index> counted;
  const auto count = [&](Index node, InterfaceNodes& sum) {
    (shape.rules.interfaces == Interfaces::free ? sum.free
     : classes.slides(node)                     ? sum.sliding
                                                : sum.held) += 1;
  };
  for (const RegionInterface& meeting : topology.interfaces()) {
    InterfaceNodes sum{topology.name_of(meeting)};
    for (const Index node : meeting.nodes) {
      if (shape.rules.interfaces == Interfaces::free && !classes.slides(node)) continue;
      count(node, sum);
      if (!counted.insert(node).second) continue;
      count(node, report.all);
      if (shape.rules.interfaces != Interfaces::free && !classes.slides(node))
        report.held.push_back(node);
    }
    if (sum.count() > 0) report.each.push_back(std::move(sum));
  }
  std::ranges::sort(report.held);
  return report;
}

}  // namespace winslow
