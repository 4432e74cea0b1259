#include "core/strategy/sliding_bodies.h"

#include <set>

#include "core/error.h"
#include "core/mesh/coordinates.h"
#include "core/options/option.h"
#include "core/search/box_tree.h"

namespace winslow {

namespace {

std::string text_of(const Vec3& p, int dimension) {
  return dimension == 2 ? place_text(Vec2(p.head<2>())) : place_text(p);
}

/// A node of a body and one beside it that slides, on a face of the boundary.
struct Junction {
  Index moving, sliding;
  std::size_t part;
};

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
        if (const auto part = part_of.find(other); part != part_of.end())
          junctions.push_back({node, other, part->second});
    }
  }
  return junctions;
}

/// Along the whole motion the bodies' nodes are where the geometry has them.
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
      // A node on a feature line says nothing of the surfaces beside it.
      if (foot.frame.count() < dimension - 1) continue;
      const SlidingPart& part = parts[junction.part];
      Box<3> box = Box<3>::empty();
      for (const Index node : part.nodes) box.add(place_of(mesh.coordinates, node));
      const double off = (foot.point - place).norm();
      if (off <= share * (box.size().norm() + (place - rest).norm())) continue;
      throw UsageError("node " + std::to_string(junction.moving) + " at " +
                       text_of(rest, dimension) + " stands on \"" + part.marker +
                       "\", which slides (" + part.description +
                       "): expected a motion along it, and this one takes the node off it by " +
                       number_text(off));
    }
  }
}

}  // namespace

void let_bodies_slide(const Mesh& mesh, const Motion& motion, const NodeClasses& classes,
                      MovingBoundary& boundary) {
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

std::vector<Index> yielding_nodes(const MovingBoundary& boundary, const NodeClasses& classes) {
  std::vector<Index> nodes = boundary.yielding;
  for (const NodeImage& pair : classes.tied().images())
    nodes.insert(nodes.end(), {pair.node, pair.image});
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace winslow
