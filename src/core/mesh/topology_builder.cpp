#include "core/mesh/topology_builder.h"

#include "core/error.h"
#include "core/mesh/half_edge.h"
#include "core/mesh/index_sets.h"
#include "core/mesh/mesh_checks.h"
#include "core/mesh/node_stars.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

namespace {

[[noreturn]] void refuse_marker_face(const std::vector<Marker>& markers, std::size_t m,
                                     std::size_t k, int cell_dimension) {
  const bool edge = cell_dimension == 2;
  const std::string number = std::to_string(k) + " of marker '" + markers[m].name + "' ";
  throw MeshError(MeshEntity::marker_face, static_cast<Index>(k),
                  (edge ? "edge " + number + "joins " : "face " + number + "has ") +
                      nodes_text(markers[m].faces[k]) + ", expected " +
                      (edge ? "an edge" : "a face") + " of an element",
                  static_cast<Index>(m));
}

}  // namespace

TopologyBuilder::TopologyBuilder(const MeshData& data)
    : data_(data), topology_(std::shared_ptr<Topology>(new Topology)) {}

std::shared_ptr<const Topology> TopologyBuilder::build() {
  check_elements(data_);
  pairs_ = pair_faces(data_);
  topology_->space_dimension_ = data_.coordinates.dimension();
  topology_->types_ = data_.types;
  topology_->regions_ = data_.regions;
  topology_->element_region_ = data_.element_region;
  orient_elements();
  if (data_.cell_dimension() == 2) {
    build_surface();
  } else {
    build_volume();
  }
  make_markers();
  list_marker_nodes();
  classify_nodes();
  return topology_;
}

void TopologyBuilder::orient_elements() {
  turned_ = elements_to_turn(data_, pairs_);
  topology_->reversed_ = static_cast<Index>(std::count(turned_.begin(), turned_.end(), true));
  topology_->elements_.offsets = data_.element_offsets;
  topology_->elements_.values = turned_elements(data_, turned_);
}

void TopologyBuilder::build_surface() {
  check_surface_manifold(data_, pairs_);
  topology_->edges_.reserve(pairs_.elements.size());
  for (Index f = 0; f < pairs_.face_count(); ++f) {
    const auto [a, b] = first_face(data_, pairs_, f).edge();
    topology_->edges_.push_back({{std::min(a, b), std::max(a, b)}, pairs_.elements[at(f)]});
  }
  pairs_ = {};  // the half-edges need the room
  const auto mesh = make_half_edges(topology_->elements_, topology_->edges_, data_.node_count());
  NodeStars stars = surface_stars(*mesh, topology_->elements_);
  topology_->neighbours_ = std::move(stars.neighbours);
  topology_->star_ = std::move(stars.elements);
  topology_->loops_ = boundary_loops(*mesh);
}

void TopologyBuilder::build_volume() {
  topology_->volume_faces_.resize(pairs_.elements.size());
  parallel_for(0, pairs_.face_count(), [&](Index begin, Index end) {
    for (Index f = begin; f < end; ++f) {
      const auto& elements = pairs_.elements[at(f)];
      const Face face = first_face(data_, pairs_, f);
      topology_->volume_faces_[at(f)] = {turned_[at(elements[0])] ? face.reversed() : face,
                                         elements};
    }
  });
  check_matching_faces(*topology_);
  topology_->star_ = star_rows(topology_->elements_, data_.node_count());
  const OrderedStars stars(data_, topology_->elements_);
  topology_->neighbours_ = volume_neighbours(stars);
  check_volume_manifold(*topology_, stars);
}

void TopologyBuilder::make_markers() {
  Markers& markers = topology_->markers_;
  markers.list_ = data_.markers;
  markers.from_file_ = !data_.markers.empty();
  if (markers.from_file_) return;
  const std::string name = data_.cell_dimension() == 2 ? "loop_" : "boundary_";
  for (auto& part : boundary_parts(*topology_)) {
    const auto number = static_cast<int>(markers.size()) + 1;
    markers.list_.push_back({name + std::to_string(number), number, std::move(part)});
  }
}

void TopologyBuilder::list_marker_nodes() {
  std::vector<bool> marked(at(topology_->face_count()), false);
  const std::vector<Marker>& markers = topology_->markers_.list_;
  for (std::size_t m = 0; m < markers.size(); ++m) {
    std::vector<Index> nodes;
    for (std::size_t k = 0; k < markers[m].faces.size(); ++k) {
      const Face& face = markers[m].faces[k];
      const auto found = topology_->find_face(face);
      if (!found) refuse_marker_face(markers, m, k, data_.cell_dimension());
      marked[at(*found)] = true;
      nodes.insert(nodes.end(), face.begin(), face.end());
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    CompressedRows& rows = topology_->markers_.nodes_;
    rows.values.insert(rows.values.end(), nodes.begin(), nodes.end());
    rows.end_row();
  }
  for (Index f = 0; f < topology_->face_count(); ++f) {
    if (topology_->face(f).elements[1] < 0 && !marked[at(f)]) ++topology_->markers_.unmarked_faces_;
  }
}

void TopologyBuilder::classify_nodes() {
  topology_->on_boundary_.assign(at(data_.node_count()), 0);
  for (Index f = 0; f < topology_->face_count(); ++f) {
    const Topology::SharedFace face = topology_->face(f);
    if (face.elements[1] >= 0) continue;
    for (const Index node : face.nodes) topology_->on_boundary_[at(node)] = 1;
  }
  for (const Index node : topology_->markers_.nodes_.values) topology_->on_boundary_[at(node)] = 1;
  for (Index node = 0; node < data_.node_count(); ++node) {
    if (topology_->used(node) && !topology_->on_boundary(node)) {
      topology_->interior_nodes_.push_back(node);
    }
  }
}

namespace {

std::vector<std::vector<Face>> loop_edges(const Topology& topology) {
  std::vector<std::vector<Face>> parts;
  for (const auto& loop : topology.boundary_loops()) {
    auto& part = parts.emplace_back();
    for (std::size_t k = 0; k < loop.size(); ++k) {
      part.emplace_back(loop[k], loop[(k + 1) % loop.size()]);
    }
  }
  return parts;
}

/// Faces around one node of the boundary make up a single disc (check_volume_manifold), so faces
/// that have a node in common hang together by edges.
std::vector<std::vector<Face>> joined_surfaces(const std::vector<Face>& faces, Index node_count) {
  JoinedSets nodes(at(node_count));
  for (const Face& face : faces) {
    for (const Index node : face) nodes.join(face[0], node);
  }
  std::vector<std::vector<Face>> parts;
  std::vector<Index> part_of(at(node_count), -1);  // by the lowest node
  for (const Face& face : faces) {
    Index& part = part_of[at(nodes.find(face[0]))];
    if (part < 0) {
      part = static_cast<Index>(parts.size());
      parts.emplace_back();
    }
    parts[at(part)].push_back(face);
  }
  return parts;
}

}  // namespace

std::vector<std::vector<Face>> boundary_parts(const Topology& topology) {
  if (topology.cell_dimension() == 2) return loop_edges(topology);
  std::vector<Face> faces;
  for (Index f = 0; f < topology.face_count(); ++f) {
    const Topology::SharedFace face = topology.face(f);
    if (face.elements[1] < 0) faces.push_back(face.nodes);
  }
  return joined_surfaces(faces, topology.node_count());
}

namespace {

void check_type(const MeshData& data, Index e) {
  const ElementType type = data.types[static_cast<std::size_t>(e)];
  const std::string found =
      "element " + std::to_string(e) + " is a " + std::string(shape_of(type).name);
  if (dimension_of(type) != data.cell_dimension()) {
    throw MeshError(MeshEntity::element, e,
                    found + ", expected elements of dimension " +
                        std::to_string(data.cell_dimension()) + " as element 0 is");
  }
  const std::size_t corners = data.element(e).size();
  if (corners != static_cast<std::size_t>(corner_count(type))) {
    throw MeshError(MeshEntity::element, e,
                    found + " with " + std::to_string(corners) + " corners, expected " +
                        std::to_string(corner_count(type)));
  }
}

void check_corners(const MeshData& data, Index e) {
  const Index nodes = data.node_count();
  const auto corners = data.element(e);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (corners[k] < 0 || corners[k] >= nodes) {
      throw MeshError(MeshEntity::element, e,
                      "element " + std::to_string(e) + " uses node " + std::to_string(corners[k]) +
                          ", expected 0 to " + std::to_string(nodes - 1));
    }
    for (std::size_t m = 0; m < k; ++m) {
      if (corners[m] == corners[k]) {
        throw MeshError(MeshEntity::element, e,
                        "element " + std::to_string(e) + " uses node " +
                            std::to_string(corners[k]) + " twice, expected distinct corners");
      }
    }
  }
}

}  // namespace

void check_elements(const MeshData& data) {
  if (data.element_count() == 0) throw MeshError(MeshEntity::mesh, 0, "the mesh has no elements");
  if (data.cell_dimension() > data.coordinates.dimension()) {
    throw MeshError(MeshEntity::element, 0,
                    "element 0 is a " + std::string(shape_of(data.types.front()).name) +
                        " between points of the plane, expected points of space");
  }
  for (Index e = 0; e < data.element_count(); ++e) {
    check_type(data, e);
    check_corners(data, e);
  }
}

}  // namespace winslow
