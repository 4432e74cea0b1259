#include "core/mesh/mesh.h"

#include "core/error.h"
#include "core/mesh/mesh_checks.h"

namespace winslow {

namespace {

std::string turned_text(const Topology& topology) {
  const std::string count = std::to_string(topology.reversed_elements());
  if (topology.cell_dimension() == 3) {
    return count + " elements with mirrored corners were turned inside out";
  }
  return topology.space_dimension() == 2
             ? count + " clockwise elements were turned counter-clockwise"
             : count + " elements were turned to face as their neighbours do";
}

/// Faces where regions meet and whose nodes are not all held.
Index loose_region_faces(const Topology& topology) {
  const auto regions = topology.element_regions();
  if (regions.empty()) return 0;
  Index loose = 0;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const Topology::SharedFace face = topology.face(f);
    const auto [a, b] = face.elements;
    if (b < 0 || regions[at(a)] == regions[at(b)]) continue;
    loose +=
        std::ranges::all_of(face.nodes, [&](Index i) { return topology.on_boundary(i); }) ? 0 : 1;
  }
  return loose;
}

void add_warnings(const Topology& topology, std::vector<std::string>& warnings) {
  Index unused = 0;
  for (Index i = 0; i < topology.node_count(); ++i) unused += topology.used(i) ? 0 : 1;
  if (unused > 0) {
    warnings.push_back(std::to_string(unused) + " nodes belong to no element; they are kept");
  }
  if (topology.markers().unmarked_faces() > 0) {
    warnings.push_back(std::to_string(topology.markers().unmarked_faces()) + " boundary " +
                       (topology.cell_dimension() == 2 ? "edges" : "faces") +
                       " belong to no marker; their nodes stay where they are");
  }
  if (const Index loose = loose_region_faces(topology); loose > 0) {
    const char* face = topology.cell_dimension() == 2 ? " edges" : " faces";
    warnings.push_back(std::to_string(loose) + face +
                       " where regions meet belong to no marker: smoothing moves their nodes; give "
                       "them a marker to hold them");
  }
  if (topology.reversed_elements() > 0) warnings.push_back(turned_text(topology));
}

}  // namespace

Mesh make_mesh(const MeshData& data, std::vector<std::string>* warnings) {
  check_finite(data.coordinates);
  Mesh mesh{Topology::build(data), data.coordinates};
  check_isolated(*mesh.topology);
  const Index doubled = check_duplicates(mesh);
  check_extents(mesh);
  check_hanging(mesh);
  if (warnings) add_warnings(*mesh.topology, *warnings);
  if (warnings && doubled > 0) {
    warnings->push_back(std::to_string(doubled) +
                        " boundary nodes lie where others do: a crack or a baffle, or parts that "
                        "were not joined");
  }
  return mesh;
}

Bounds bounds(const Coordinates& coordinates, std::span<const Index> nodes) {
  if (nodes.empty()) throw UsageError("bounds of no nodes");
  Bounds box{coordinates.xy(nodes.front()), coordinates.xy(nodes.front())};
  for (const Index node : nodes) {
    box.min = box.min.cwiseMin(coordinates.xy(node));
    box.max = box.max.cwiseMax(coordinates.xy(node));
  }
  return box;
}

Bounds bounds(const Mesh& mesh) {
  require_plane(*mesh.topology, "bounds");
  std::vector<Index> used;
  for (Index i = 0; i < mesh.topology->node_count(); ++i) {
    if (mesh.topology->used(i)) used.push_back(i);
  }
  return bounds(mesh.coordinates, used);
}

Box<3> space_bounds(const Coordinates& coordinates, std::span<const Index> nodes) {
  if (nodes.empty()) throw UsageError("bounds of no nodes");
  const SpacePoints x(coordinates);
  Box<3> box = Box<3>::empty();
  for (const Index node : nodes) box.add(x[node]);
  return box;
}

Box<3> space_bounds(const Mesh& mesh) {
  const SpacePoints x(mesh.coordinates);
  Box<3> box = Box<3>::empty();
  bool any = false;
  for (Index i = 0; i < mesh.topology->node_count(); ++i) {
    if (!mesh.topology->used(i)) continue;
    box.add(x[i]);
    any = true;
  }
  if (!any) throw UsageError("bounds of no nodes");
  return box;
}

namespace {

template <int D>
Vec3 origin_of(const Box<D>& box) {
  constexpr double far = 16;
  const double extent = box.size().maxCoeff();
  const Vec<D> centre = box.centre();
  Vec3 origin(0, 0, 0);
  for (int axis = 0; axis < D; ++axis) {
    if (std::abs(centre[axis]) > far * extent) origin[axis] = centre[axis];
  }
  return origin;
}

template <int D>
void take_to_local(const LocalFrame& frame, Coordinates& x) {
  for (Index node = 0; node < x.size(); ++node) x.set<D>(node, frame.to_local(x.get<D>(node)));
}

template <int D>
void take_to_mesh(const LocalFrame& frame, Coordinates& x, const Coordinates& rest) {
  for (Index node = 0; node < x.size(); ++node) {
    const bool rests = node < rest.size() && x.get<D>(node) == frame.to_local(rest.get<D>(node));
    x.set<D>(node, rests ? rest.get<D>(node) : frame.to_mesh(x.get<D>(node)));
  }
}

}  // namespace

LocalFrame::LocalFrame(const Mesh& mesh)
    : origin_(mesh.topology->cell_dimension() == 3 ? origin_of(space_bounds(mesh))
                                                   : origin_of(bounds(mesh))) {}

Coordinates LocalFrame::to_local(Coordinates x) const {
  x.dimension() == 3 ? take_to_local<3>(*this, x) : take_to_local<2>(*this, x);
  return x;
}

Coordinates LocalFrame::to_mesh(Coordinates x, const Coordinates& rest) const {
  x.dimension() == 3 ? take_to_mesh<3>(*this, x, rest) : take_to_mesh<2>(*this, x, rest);
  return x;
}

}  // namespace winslow
