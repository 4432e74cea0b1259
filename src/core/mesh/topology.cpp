#include "core/mesh/topology.h"

#include "core/error.h"
#include "core/mesh/face_pairs.h"
#include "core/mesh/half_edge.h"
#include "core/mesh/node_stars.h"
#include "core/parallel/parallel_for.h"

namespace winslow {

/// Topology::build(), step by step in the order of its members.
class TopologyBuilder {
 public:
  explicit TopologyBuilder(const MeshData& data);
  std::shared_ptr<const Topology> build();

 private:
  void orient_elements();
  void make_polyhedra();
  void make_polygons();
  void build_surface();
  void build_volume();
  void make_markers();
  void list_marker_nodes();
  void find_interfaces(const std::vector<bool>& marked);
  void classify_nodes();

  const MeshData& data_;
  FacePairs pairs_;
  std::vector<bool> turned_;  // #elements
  std::shared_ptr<Topology> topology_;
};

namespace {

/// Index of the item with these sorted nodes in a list that is ordered by them.
template <typename List, typename Nodes, typename NodesOf>
std::optional<Index> find_sorted(const List& list, const Nodes& nodes, const NodesOf& nodes_of) {
  const auto it = std::lower_bound(
      list.begin(), list.end(), nodes,
      [&](const auto& item, const Nodes& wanted) { return nodes_of(item) < wanted; });
  if (it == list.end() || nodes_of(*it) != nodes) return std::nullopt;
  return static_cast<Index>(it - list.begin());
}

}  // namespace

Topology::Topology() = default;
Topology::~Topology() = default;

std::shared_ptr<const Topology> Topology::build(const MeshData& data) {
  return TopologyBuilder(data).build();
}

Index Topology::face_count() const {
  return static_cast<Index>(edges_.size() + volume_faces_.size());
}

Topology::SharedFace Topology::face(Index f) const {
  const auto i = static_cast<std::size_t>(f);
  if (kind_ == MeshKind::volume) return volume_faces_[i];
  return {Face(edges_[i].nodes[0], edges_[i].nodes[1]), edges_[i].elements};
}

std::optional<Index> Topology::find_face(const Face& nodes) const {
  if (kind_ == MeshKind::volume) {
    return find_sorted(volume_faces_, nodes.sorted(),
                       [](const SharedFace& face) { return face.nodes.sorted(); });
  }
  if (nodes.size() != 2) return std::nullopt;
  const std::array<Index, 2> ends{std::min(nodes[0], nodes[1]), std::max(nodes[0], nodes[1])};
  return find_sorted(edges_, ends, [](const Edge& edge) { return edge.nodes; });
}

void Topology::require_edges(const char* what) const {
  if (kind_ == MeshKind::volume) throw UsageError(std::string("a volume mesh has no ") + what);
}

std::span<const Topology::Edge> Topology::edges() const {
  require_edges("edges with two elements");
  return edges_;
}

const std::vector<std::vector<Index>>& Topology::boundary_loops() const {
  require_edges("boundary loops");
  return loops_;
}

const HalfEdgeMesh& Topology::half_edges() const {
  require_edges("half-edges");
  std::call_once(half_edges_made_,
                 [this] { half_edges_ = make_half_edges(elements_, edges_, node_count()); });
  return *half_edges_;
}

std::size_t Topology::bytes() const {
  std::size_t sum = bytes_of(types_, elements_, neighbours_, star_, on_boundary_, interior_nodes_,
                             edges_, volume_faces_, element_region_, own_shape_);
  for (const auto& polyhedron : polyhedra_) sum += polyhedron->bytes();
  for (const auto& polygon : polygons_) sum += polygon->bytes();
  for (const auto& loop : loops_) sum += bytes_of(loop);
  for (const Marker& marker : markers_) sum += bytes_of(marker.faces);
  for (const RegionInterface& meeting : interfaces_) sum += bytes_of(meeting.faces, meeting.nodes);
  return sum;
}

void require_kind(const Topology& topology, MeshKind kind, std::string_view what) {
  if (topology.kind() == kind) return;
  throw UsageError(std::string(what) + ": only for a " + std::string(words_of(kind).mesh) +
                   ", and this is a " + std::string(mesh_kind(topology)));
}

void require_volume(const Topology& topology, std::string_view found) {
  if (topology.cell_dimension() == 3) return;
  throw UsageError(std::string(found) + std::string(mesh_kind(topology)));
}

std::vector<Index> interface_nodes_inside(const Topology& topology) {
  std::vector<Index> nodes;
  for (const RegionInterface& meeting : topology.interfaces())
    for (const Index node : meeting.nodes)
      if (!topology.on_boundary(node)) nodes.push_back(node);
  sort_unique(nodes);
  return nodes;
}

std::vector<Face> node_link(const Topology& topology, Index node) {
  std::vector<Face> link;
  link.reserve(topology.star(node).size());
  for (const Index e : topology.star(node)) {
    const auto corners = topology.element(e);
    link.push_back(by_nodes(topology.shape(e).links[index_of(corners, node)], corners));
  }
  return link;
}

namespace {

/// Throws MeshError for a polyhedron without faces of its own, with a face that has fewer than
/// three nodes or one of them twice, or with one between other nodes than its corners.
void check_faces(const MeshData& data, Index e) {
  const std::string name = "element " + std::to_string(e) + ", a polyhedron, has ";
  std::vector<Index> corners(data.element(e).begin(), data.element(e).end());
  std::ranges::sort(corners);
  if (std::ranges::adjacent_find(corners) != corners.end())
    throw MeshError(MeshEntity::element, e, name + "a corner twice, expected distinct corners");
  if (data.polyhedron(e).empty())
    throw MeshError(MeshEntity::element, e, name + "no faces, expected four or more");
  for (const Face& face : data.polyhedron(e)) {
    if (face.size() < 3)
      throw MeshError(
          MeshEntity::element, e,
          name + "a face of " + std::to_string(face.size()) + " nodes, expected three or more");
    const Face sorted = face.sorted();
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      throw MeshError(MeshEntity::element, e,
                      name + "a face with a node twice: " + nodes_text(face));
    if (!std::includes(corners.begin(), corners.end(), sorted.begin(), sorted.end()))
      throw MeshError(
          MeshEntity::element, e,
          name + "a face with " + nodes_text(face) + ", expected nodes among its corners");
  }
}

/// Throws MeshError for a polygon in space, and for one with a number of corners that none has.
void check_polygon(const MeshData& data, Index e) {
  const std::size_t corners = data.element(e).size();
  if (corners < 3 || corners > most_polygon_corners) {
    throw MeshError(MeshEntity::element, e,
                    "element " + std::to_string(e) + ", a polygon, has " + std::to_string(corners) +
                        " corners, expected 3 to " + std::to_string(most_polygon_corners));
  }
  if (data.kind() == MeshKind::plane) return;
  const auto count = std::ranges::count(data.types, ElementType::polygon);
  throw MeshError(MeshEntity::element, e,
                  "element " + std::to_string(e) + " is a polygon of " + std::to_string(corners) +
                      " corners between points that do not lie in one plane (" +
                      std::to_string(count) + " of " + std::to_string(data.types.size()) +
                      " elements" + (count == 1 ? " is a polygon" : " are polygons") +
                      "): expected triangles and quadrilaterals of a surface mesh; cut its "
                      "polygons into triangles first");
}

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
  if (type == ElementType::polyhedron) return check_faces(data, e);
  if (type == ElementType::polygon) return check_polygon(data, e);
  if (corners != static_cast<std::size_t>(corner_count(type))) {
    throw MeshError(MeshEntity::element, e,
                    found + " with " + std::to_string(corners) + " corners, expected " +
                        std::to_string(corner_count(type)));
  }
}

void check_corners(const MeshData& data, Index e) {
  const Index nodes = data.node_count();
  const auto corners = data.element(e);
  const bool many = data.types[at(e)] == ElementType::polyhedron;  // check_faces() was here
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (corners[k] < 0 || corners[k] >= nodes) {
      throw MeshError(MeshEntity::element, e,
                      "element " + std::to_string(e) + " uses node " + std::to_string(corners[k]) +
                          ", expected 0 to " + std::to_string(nodes - 1));
    }
    for (std::size_t m = 0; m < (many ? 0 : k); ++m) {
      if (corners[m] == corners[k]) {
        throw MeshError(MeshEntity::element, e,
                        "element " + std::to_string(e) + " uses node " +
                            std::to_string(corners[k]) + " twice, expected distinct corners");
      }
    }
  }
}

/// Throws MeshError if there is no element. Throws MeshError naming an element with another
/// dimension than the first one or a higher one than the space; with another number of corners than
/// its type has; with a corner that is no node; or with a repeated corner.
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

/// The shape of a polyhedron, of which the faces are to be turned.
std::unique_ptr<const PolyhedronShape> polyhedron_of(const MeshData& data, Index e, bool turned) {
  const auto corners = data.element(e);
  std::vector<std::pair<Index, Index>> numbers;  // node, number of the corner
  std::vector<Vec3> places;
  for (const Index node : corners) {
    numbers.emplace_back(node, static_cast<Index>(numbers.size()));
    places.push_back(data.coordinates.xyz(node));
  }
  std::ranges::sort(numbers);
  std::vector<Face> faces;
  std::vector<Index> local;
  for (const Face& given : data.polyhedron(e)) {
    const Face face = turned ? given.reversed() : given;
    local.clear();
    for (const Index node : face)
      local.push_back(
          std::ranges::lower_bound(numbers, node, {}, &std::pair<Index, Index>::first)->second);
    faces.emplace_back(std::span<const Index>(local));
  }
  try {
    return std::make_unique<const PolyhedronShape>(faces, places);
  } catch (const PolyhedronFault& fault) {
    throw MeshError(MeshEntity::element, e,
                    "element " + std::to_string(e) + ", a polyhedron, " + fault.text);
  }
}

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

/// Faces that have a node in common are connected by edges, since the faces around a boundary node
/// are a single disc (check_volume_manifold).
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

/// The connected parts of the boundary as faces: of a plane or surface mesh the loops, in the order
/// of the loop; of a volume mesh surfaces of faces that are connected by edges, in the order of
/// their first faces.
std::vector<std::vector<Face>> boundary_parts(const Topology& topology) {
  if (topology.kind() != MeshKind::volume) return loop_edges(topology);
  std::vector<Face> faces;
  for_boundary_faces(topology, [&](Index, const auto& face) { faces.push_back(face.nodes); });
  return joined_surfaces(faces, topology.node_count());
}

[[noreturn]] void refuse_marker_face(const Topology& topology, std::size_t m, std::size_t k) {
  const Marker& marker = topology.markers()[m];
  const MeshWords& words = words_of(topology.kind());
  throw MeshError(MeshEntity::marker_face, static_cast<Index>(k),
                  std::string(words.face) + " " + std::to_string(k) + " of marker '" + marker.name +
                      "' " + std::string(words.has) + " " + nodes_text(marker.faces[k]) +
                      ", expected " + std::string(words.a_face) + " of an element",
                  static_cast<Index>(m));
}

}  // namespace

TopologyBuilder::TopologyBuilder(const MeshData& data)
    : data_(data), topology_(std::shared_ptr<Topology>(new Topology)) {}

std::shared_ptr<const Topology> TopologyBuilder::build() {
  check_elements(data_);
  pairs_ = pair_faces(data_);
  topology_->kind_ = data_.kind();
  topology_->space_dimension_ = data_.coordinates.dimension();
  topology_->types_ = data_.types;
  topology_->regions_ = data_.regions;
  topology_->element_region_ = data_.element_region;
  orient_elements();
  topology_->kind_ == MeshKind::volume ? build_volume() : build_surface();
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
  if (data_.has_polyhedra()) make_polyhedra();
  if (std::ranges::find(data_.types, ElementType::polygon) != data_.types.end()) make_polygons();
}

void TopologyBuilder::make_polyhedra() {
  std::vector<Index>& number = topology_->own_shape_;
  number.assign(at(data_.element_count()), -1);
  Index count = 0;
  for (Index e = 0; e < data_.element_count(); ++e)
    if (data_.types[at(e)] == ElementType::polyhedron) number[at(e)] = count++;
  topology_->polyhedra_.resize(at(count));
  parallel_for(0, data_.element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e)
      if (number[at(e)] >= 0)
        topology_->polyhedra_[at(number[at(e)])] = polyhedron_of(data_, e, turned_[at(e)]);
  });
}

void TopologyBuilder::make_polygons() {
  std::vector<unsigned char> at_boundary(at(data_.node_count()), 0);
  for (Index f = 0; f < pairs_.face_count(); ++f)
    if (pairs_.elements[at(f)][1] < 0)
      for (const Index node : first_face(data_, pairs_, f)) at_boundary[at(node)] = 1;
  const auto at_wall = [&](std::span<const Index> nodes) {
    const std::size_t n = nodes.size();
    std::vector<bool> list(n);
    for (std::size_t k = 0; k < n; ++k)
      list[k] = at_boundary[at(nodes[k])] + at_boundary[at(nodes[(k + 1) % n])] +
                    at_boundary[at(nodes[(k + n - 1) % n])] ==
                3;
    return list;
  };
  std::vector<PolygonCorners> of_element(at(data_.element_count()));
  parallel_for(0, data_.element_count(), [&](Index begin, Index end) {
    for (Index e = begin; e < end; ++e)
      if (data_.types[at(e)] == ElementType::polygon)
        of_element[at(e)] =
            corners_of_polygon(places_of(data_.coordinates, topology_->elements_[e]),
                               at_wall(topology_->elements_[e]));
  });
  std::vector<Index>& number = topology_->own_shape_;
  number.assign(of_element.size(), -1);
  std::map<PolygonCorners, Index> known;
  for (std::size_t e = 0; e < number.size(); ++e) {
    if (data_.types[e] != ElementType::polygon) continue;
    const auto [found, is_new] =
        known.try_emplace(of_element[e], static_cast<Index>(topology_->polygons_.size()));
    if (is_new) topology_->polygons_.push_back(std::make_unique<const PolygonShape>(found->first));
    number[e] = found->second;
  }
}

void TopologyBuilder::build_surface() {
  check_surface_manifold(data_, pairs_);
  topology_->edges_.reserve(pairs_.elements.size());
  for (Index f = 0; f < pairs_.face_count(); ++f) {
    const auto [a, b] = first_face(data_, pairs_, f).edge();
    topology_->edges_.push_back({{std::min(a, b), std::max(a, b)}, pairs_.elements[at(f)]});
  }
  pairs_ = {};  // frees memory for the half-edges
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
  const OrderedStars stars(data_, *topology_);
  topology_->neighbours_ = volume_neighbours(stars);
  check_volume_manifold(*topology_, stars, pairs_, turned_);
}

void TopologyBuilder::make_markers() {
  Markers& markers = topology_->markers_;
  markers.list_ = data_.markers;
  markers.from_file_ = !data_.markers.empty();
  if (markers.from_file_) return;
  const std::string name(words_of(topology_->kind()).boundary_part);
  for (auto& part : boundary_parts(*topology_)) {
    const auto number = static_cast<int>(markers.size()) + 1;
    markers.list_.push_back({name + std::to_string(number), number, std::move(part)});
  }
}

void TopologyBuilder::list_marker_nodes() {
  std::vector<bool> marked(at(topology_->face_count()), false);
  const std::vector<Marker>& markers = topology_->markers_.list_;
  for (std::size_t m = 0; m < markers.size(); ++m) {
    for (std::size_t k = 0; k < markers[m].faces.size(); ++k) {
      const Face& face = markers[m].faces[k];
      const auto found = topology_->find_face(face);
      if (!found) refuse_marker_face(*topology_, m, k);
      marked[at(*found)] = true;
    }
    topology_->markers_.add_nodes_of(markers[m]);
  }
  for_boundary_faces(*topology_, [&](Index f, const auto&) {
    if (!marked[at(f)]) ++topology_->markers_.unmarked_faces_;
  });
  find_interfaces(marked);
}

/// marked: whether a face belongs to a marker (#faces).
void TopologyBuilder::find_interfaces(const std::vector<bool>& marked) {
  const std::vector<Index>& of = topology_->element_region_;
  if (std::ranges::adjacent_find(of, std::ranges::not_equal_to()) == of.end()) return;
  // Elements without a region come last: as the largest number that there is.
  const auto number = [&](Index element) {
    const Index region = of[at(element)];
    return region < 0 ? std::numeric_limits<Index>::max() : region;
  };
  std::map<std::array<Index, 2>, RegionInterface> between;
  for (Index f = 0; f < topology_->face_count(); ++f) {
    const Topology::SharedFace face = topology_->face(f);
    const auto [a, b] = face.elements;
    if (b < 0 || of[at(a)] == of[at(b)] || marked[at(f)]) continue;
    between[{std::min(number(a), number(b)), std::max(number(a), number(b))}].faces.push_back(
        face.nodes);
  }
  for (auto& [regions, meeting] : between) {
    const auto count = static_cast<Index>(topology_->regions_.size());
    meeting.regions = {regions[0], regions[1] < count ? regions[1] : -1};
    for (const Face& face : meeting.faces)
      meeting.nodes.insert(meeting.nodes.end(), face.begin(), face.end());
    sort_unique(meeting.nodes);
    topology_->interfaces_.push_back(std::move(meeting));
  }
}

void TopologyBuilder::classify_nodes() {
  topology_->on_boundary_.assign(at(data_.node_count()), 0);
  for_boundary_faces(*topology_, [&](Index, const auto& face) {
    for (const Index node : face.nodes) topology_->on_boundary_[at(node)] = 1;
  });
  for (const Index node : topology_->markers_.nodes_.values) topology_->on_boundary_[at(node)] = 1;
  for (Index node = 0; node < data_.node_count(); ++node) {
    if (topology_->used(node) && !topology_->on_boundary(node)) {
      topology_->interior_nodes_.push_back(node);
    }
  }
}

std::string Topology::name_of(const RegionInterface& meeting) const {
  const auto name = [&](Index region) {
    return region < 0 ? std::string("no region") : regions_[at(region)].name;
  };
  return name(meeting.regions[0]) + " and " + name(meeting.regions[1]);
}

namespace {

using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

/// Makes half-edges edge by edge. OpenMesh's add_face() searches each half-edge around its vertex
/// and takes several times as long.
class Joiner {
 public:
  Joiner(const CompressedRows& elements, std::span<const Topology::Edge> edges, Index node_count)
      : elements_(elements),
        edges_(edges),
        mesh_(std::make_unique<HalfEdgeMesh>()),
        side_(elements.values.size()) {
    index_count(2 * edges.size(), "half-edges");
    mesh_->resize(at(node_count), edges.size(), at(elements.rows()));
  }

  std::unique_ptr<HalfEdgeMesh> join() {
    for (std::size_t f = 0; f < edges_.size(); ++f) add_edge(static_cast<Index>(f), edges_[f]);
    for (Index e = 0; e < elements_.rows(); ++e) add_element(e);
    for (const HalfedgeHandle h : boundary_)
      mesh_->set_halfedge_handle(mesh_->from_vertex_handle(h), h);
    for (const HalfedgeHandle h : boundary_)
      mesh_->set_next_halfedge_handle(h, mesh_->halfedge_handle(mesh_->to_vertex_handle(h)));
    return std::move(mesh_);
  }

 private:
  void add_edge(Index f, const Topology::Edge& edge) {
    const HalfedgeHandle up(2 * f), down(2 * f + 1);
    const VertexHandle low(edge.nodes[0]), high(edge.nodes[1]);
    mesh_->set_vertex_handle(up, high);
    mesh_->set_vertex_handle(down, low);
    // Edges are in the order of their nodes, so the first edge at a node leads to its lowest
    // neighbour.
    if (mesh_->is_isolated(low)) mesh_->set_halfedge_handle(low, up);
    if (mesh_->is_isolated(high)) mesh_->set_halfedge_handle(high, down);
    bool ascends = false;
    for (const Index e : edge.elements) {
      if (e < 0) {
        boundary_.push_back(ascends ? down : up);
      } else {
        ascends = add_side(e, edge.nodes, up, down);
      }
    }
  }

  /// Gives an element the half-edge of the edge with the direction of the element. True if it is
  /// `up`.
  bool add_side(Index e, const std::array<Index, 2>& nodes, HalfedgeHandle up,
                HalfedgeHandle down) {
    const auto corners = elements_[e];
    std::size_t k = corners.size() - 1;  // the side from the last corner to the first, or:
    bool ascends = corners[k] == nodes[0] && corners[0] == nodes[1];
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      const bool rises = corners[i] == nodes[0] && corners[i + 1] == nodes[1];
      if (!rises && !(corners[i] == nodes[1] && corners[i + 1] == nodes[0])) continue;
      k = i;
      ascends = rises;
    }
    const HalfedgeHandle h = ascends ? up : down;
    side_[at(elements_.offsets[at(e)]) + k] = h;
    mesh_->set_face_handle(h, OpenMesh::FaceHandle(e));
    return ascends;
  }

  void add_element(Index e) {
    const auto begin = at(elements_.offsets[at(e)]), end = at(elements_.offsets[at(e) + 1]);
    mesh_->set_halfedge_handle(OpenMesh::FaceHandle(e), side_[end - 1]);
    for (std::size_t k = begin; k < end; ++k)
      mesh_->set_next_halfedge_handle(side_[k == begin ? end - 1 : k - 1], side_[k]);
  }

  const CompressedRows& elements_;
  std::span<const Topology::Edge> edges_;
  std::unique_ptr<HalfEdgeMesh> mesh_;
  std::vector<HalfedgeHandle> side_;  // of each corner of an element: the one that leaves it there
  std::vector<HalfedgeHandle> boundary_;
};

}  // namespace

std::unique_ptr<HalfEdgeMesh> make_half_edges(const CompressedRows& elements,
                                              std::span<const Topology::Edge> edges,
                                              Index node_count) {
  return Joiner(elements, edges, node_count).join();
}

}  // namespace winslow
