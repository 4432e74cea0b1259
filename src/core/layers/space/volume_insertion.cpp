#include "core/layers/space/volume_insertion.h"

#include <set>

#include "core/error.h"

namespace winslow {

namespace {

class VolumeInserter {
 public:
  VolumeInserter(const Mesh& mesh, LayerStack plan)
      : old_(mesh), topology_(*mesh.topology), stack_(std::move(plan)) {}

  VolumeLayerInsertion insert() {
    require_valid();
    number_nodes();
    add_old_elements();
    find_walls();
    VolumeLayerInsertion result;
    result.outside = Topology::build(outside_data());
    add_layers();
    add_markers();
    result.mesh.topology = Topology::build(data_);
    result.ideal = std::move(data_.coordinates);
    lay_out(stack_, 1, result.ideal);
    result.share = collapse(result, result.mesh.coordinates);
    result.stack = std::move(stack_);
    return result;
  }

 private:
  void require_valid() {
    for (const ColumnFace& face : stack_.faces) {
      for (const std::size_t c : face.corners()) {
        if (stack_.columns[c].count() == stack_.columns[face.columns[0]].count()) continue;
        throw UsageError("the layers of volume meshes cannot end: node " +
                         std::to_string(stack_.columns[c].wall_node) +
                         " has another number of layers than its neighbours");
      }
    }
    before_ = check_validity(topology_, old_.coordinates);
    if (before_.inverted == 0) return;
    throw UsageError(std::to_string(before_.inverted) +
                     " elements of the mesh are inverted; layers need a valid mesh: smooth it "
                     "first");
  }

  void number_nodes() {
    data_.coordinates = old_.coordinates;
    column_of_.assign(at(topology_.node_count()), -1);
    bool any = false;
    for (std::size_t c = 0; c < stack_.columns.size(); ++c) {
      LayerColumn& column = stack_.columns[c];
      const Vec3 wall = old_.coordinates.xyz(column.wall_node);
      column_of_[at(column.wall_node)] = static_cast<Index>(c);
      column.nodes = {column.wall_node};
      for (std::size_t k = 0; k < column.count(); ++k) {
        column.nodes.push_back(data_.coordinates.size());
        data_.coordinates.push_xyz(wall);
      }
      any = any || column.count() > 0;
    }
    if (!any) throw UsageError("there is no room for layers at any of the walls");
  }

  const LayerColumn* column_at(Index node) const {
    return column_of_[at(node)] < 0 ? nullptr : &stack_.columns[at(column_of_[at(node)])];
  }
  /// The node that replaces a node in what lies outside the layers.
  Index rim(Index node) const {
    const LayerColumn* column = column_at(node);
    return column ? column->rim() : node;
  }
  Face rim(const Face& face) const {
    std::vector<Index> nodes;
    for (const Index node : face) nodes.push_back(rim(node));
    return Face(std::span<const Index>(nodes));
  }
  bool touches_wall(const Face& face) const {
    return std::ranges::any_of(face, [&](Index node) { return column_at(node) != nullptr; });
  }

  void add_old_elements() {
    data_.regions = topology_.regions();
    data_.element_region.assign(topology_.element_regions().begin(),
                                topology_.element_regions().end());
    std::vector<Index> corners;
    for (Index e = 0; e < topology_.element_count(); ++e) {
      const auto element = topology_.element(e);
      corners.clear();
      for (const Index node : element) corners.push_back(rim(node));
      if (topology_.element_type(e) != ElementType::polyhedron) {
        data_.add_element(topology_.element_type(e), corners);
        continue;
      }
      std::vector<Face> faces;
      for (const Face& face : topology_.shape(e).faces) faces.push_back(by_nodes(face, corners));
      data_.add_polyhedron(corners, faces);
    }
  }

  /// Finds the faces and the edges of the walls.
  void find_walls() {
    is_wall_.assign(at(topology_.face_count()), 0);
    for (const ColumnFace& face : stack_.faces) {
      std::vector<Index> nodes;
      for (const std::size_t c : face.corners()) nodes.push_back(stack_.columns[c].wall_node);
      const auto f = topology_.find_face(Face(std::span<const Index>(nodes)));
      if (!f) throw UsageError("the plan of the layers belongs to another mesh");
      is_wall_[at(*f)] = 1;
      wall_elements_.push_back(topology_.face(*f).elements[0]);
      for (std::size_t k = 0; k < nodes.size(); ++k)
        edges_.insert(std::minmax(nodes[k], nodes[(k + 1) % nodes.size()]));
    }
  }

  MeshData outside_data() const {
    MeshData outside = data_;
    if (!topology_.markers().from_file()) return outside;
    for (Marker marker : topology_.markers()) {
      std::vector<Face> faces;
      for (const Face& face : marker.faces) {
        const bool inside = topology_.face(*topology_.find_face(face)).elements[1] >= 0;
        if (!inside || !touches_wall(face)) faces.push_back(rim(face));
      }
      marker.faces = std::move(faces);
      outside.markers.push_back(std::move(marker));
    }
    return outside;
  }

  void add_layers() {
    stack_.layer_of_element.assign(at(data_.element_count()), -1);
    for (std::size_t f = 0; f < stack_.faces.size(); ++f) {
      const auto corners = stack_.faces[f].corners();
      const ElementType type = corners.size() == 3 ? ElementType::prism : ElementType::hexahedron;
      const std::size_t layers = stack_.columns[corners[0]].count();
      for (std::size_t layer = 0; layer < layers; ++layer) {
        std::vector<Index> nodes;
        for (const std::size_t level : {layer, layer + 1})
          for (const std::size_t c : corners) nodes.push_back(stack_.columns[c].nodes[level]);
        data_.add_element(type, nodes);
        stack_.layer_of_element.push_back(static_cast<int>(layer));
        if (!data_.element_region.empty())
          data_.element_region.push_back(topology_.element_regions()[at(wall_elements_[f])]);
      }
    }
  }

  /// Markers of walls stay; others go to the rim, with the sides of the layers.
  void add_markers() {
    if (!topology_.markers().from_file()) return;
    for (Marker marker : topology_.markers()) {
      std::vector<Face> faces, sides;
      std::set<std::pair<Index, Index>> done;
      for (const Face& face : marker.faces) {
        if (is_wall_[at(*topology_.find_face(face))] != 0) {
          faces.push_back(face);
          continue;
        }
        faces.push_back(rim(face));
        for (std::size_t k = 0; k < face.size(); ++k) {
          const Index a = face[k], b = face[(k + 1) % face.size()];
          if (!edges_.contains(std::minmax(a, b)) || !done.insert(std::minmax(a, b)).second)
            continue;
          // Turned as the face is, to which they are joined at the rim.
          const LayerColumn &p = *column_at(a), &q = *column_at(b);
          for (std::size_t i = 0; i < p.count(); ++i)
            sides.emplace_back(p.nodes[i], q.nodes[i], q.nodes[i + 1], p.nodes[i + 1]);
        }
      }
      faces.insert(faces.end(), sides.begin(), sides.end());
      marker.faces = std::move(faces);
      data_.markers.push_back(std::move(marker));
    }
  }

  /// Sets x to the columns at the largest share that VolumeLayerInsertion allows; returns it.
  double collapse(const VolumeLayerInsertion& result, Coordinates& x) const {
    constexpr int most_halvings = 40;
    constexpr double kept = 0.5;
    const Topology& topology = *result.mesh.topology;
    double share = 1;
    x = result.ideal;
    for (int halving = 0; halving < most_halvings; ++halving, share *= 0.5) {
      lay_out(stack_, share, x);
      if (check_validity(*result.outside, x).min_sine < kept * before_.min_sine) continue;
      if (check_validity(topology, x).inverted == 0) return share;
    }
    Index e = 0;
    while (e + 1 < topology.element_count() && !is_inverted(topology, x, e)) ++e;
    std::vector<Vec3> corners;
    for (const Index node : topology.element(e)) corners.push_back(x.xyz(node));
    throw UsageError("element " + std::to_string(e) + " at " + place_text(mean_of<3>(corners)) +
                     " leaves no room for layers, however thin: it is flat, or the wall folds "
                     "there; smooth the mesh first");
  }

  const Mesh& old_;
  const Topology& topology_;
  LayerStack stack_;
  Validity before_;
  MeshData data_;
  std::vector<Index> column_of_;             // #nodes of the mesh before; -1: on no wall
  std::vector<unsigned char> is_wall_;       // #faces of the topology
  std::vector<Index> wall_elements_;         // #faces of the stack
  std::set<std::pair<Index, Index>> edges_;  // of the walls
};

}  // namespace

VolumeLayerInsertion insert_volume_layers(const Mesh& mesh, LayerStack plan) {
  require_kind(*mesh.topology, MeshKind::volume, "layers in space");
  return VolumeInserter(mesh, std::move(plan)).insert();
}

}  // namespace winslow
