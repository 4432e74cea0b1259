#include "core/layers/layer_insertion.h"

#include <map>
#include <set>

#include "core/error.h"

namespace winslow {

namespace {

/// The range of the columns on one wall node, in the order along the wall.
struct Fan {
  std::size_t first = 0, last = 0;
  /// Between columns first + k and first + k + 1 the star of the node is split at an edge: its
  /// index among the neighbours of the node.
  std::vector<Index> spokes;
};

class Inserter {
 public:
  Inserter(const Mesh& mesh, LayerStack plan)
      : old_(mesh), topology_(*mesh.topology), stack_(std::move(plan)) {}

  LayerInsertion insert() {
    number_nodes();
    find_fans();
    LayerInsertion result;
    add_old_elements();
    add_fan_triangles();
    const Index outside_count = data_.element_count();
    data_.regions = topology_.regions();
    move_markers();
    MeshData outside = outside_data();
    for (const ColumnPair& pair : stack_.pairs) add_cells(pair);
    stack_.layer_of_element.assign(at(outside_count), -1);
    stack_.layer_of_element.insert(stack_.layer_of_element.end(), layers_.begin(), layers_.end());

    result.outside = Topology::build(outside);
    result.mesh.topology = Topology::build(data_);
    result.mesh.coordinates = data_.coordinates;
    lay_out(stack_, 1, result.mesh.coordinates);
    result.stack = std::move(stack_);
    return result;
  }

 private:
  void number_nodes() {
    data_.coordinates = old_.coordinates;
    bool any = false;
    for (LayerColumn& column : stack_.columns) {
      const Vec2 wall = old_.coordinates.xy(column.wall_node);
      column.nodes = {column.wall_node};
      for (std::size_t k = 0; k < column.count(); ++k) {
        column.nodes.push_back(data_.coordinates.size());
        data_.coordinates.push_xy(wall);
      }
      any = any || column.count() > 0;
    }
    if (!any) throw UsageError("there is no room for layers at any of the walls");
  }

  void find_fans() {
    for (std::size_t c = 0; c < stack_.columns.size(); ++c) {
      const auto [it, fresh] = fans_.try_emplace(stack_.columns[c].wall_node, Fan{c, c, {}});
      if (!fresh) it->second.last = c;
    }
    for (auto& [node, fan] : fans_) {
      for (std::size_t c = fan.first; c < fan.last; ++c) {
        const Vec2 between =
            stack_.columns[c].plane_direction() + stack_.columns[c + 1].plane_direction();
        fan.spokes.push_back(spoke_towards(node, between));
      }
    }
  }

  /// The interior edge of a wall node nearest to a direction.
  Index spoke_towards(Index node, const Vec2& direction) const {
    const auto row = topology_.neighbours(node);
    Index best = 1;
    double most = -2;
    for (std::size_t k = 1; k + 1 < row.size(); ++k) {
      const Vec2 edge = old_.coordinates.xy(row[k]) - old_.coordinates.xy(node);
      const double cosine = edge.dot(direction) / (edge.norm() * direction.norm());
      if (cosine <= most) continue;
      most = cosine;
      best = static_cast<Index>(k);
    }
    return best;
  }

  /// The node that replaces a wall node in an element outside the layers: the rim node of the
  /// column in whose sector the element lies.
  Index stand_in(Index node, Index element) const {
    const auto it = fans_.find(node);
    if (it == fans_.end()) return node;
    const Fan& fan = it->second;
    std::size_t column = fan.last;
    if (!fan.spokes.empty()) {
      const auto k = static_cast<Index>(index_of(topology_.star(node), element));
      // The star is counter-clockwise, from the next wall node to the previous one.
      for (const Index spoke : fan.spokes) column -= spoke <= k ? 1 : 0;
    }
    return stack_.columns[column].rim();
  }

  void add_element(std::span<const Index> corners, Index region) {
    add_element(corners.size() == 3 ? ElementType::triangle : ElementType::quadrilateral, corners,
                region);
  }
  void add_element(ElementType type, std::span<const Index> corners, Index region) {
    data_.add_element(type, corners);
    if (!topology_.element_regions().empty()) data_.element_region.push_back(region);
  }
  Index region_of(Index element) const {
    return topology_.element_regions().empty() ? -1 : topology_.element_regions()[at(element)];
  }

  void add_old_elements() {
    std::vector<Index> corners;
    for (Index e = 0; e < topology_.element_count(); ++e) {
      corners.clear();
      for (const Index node : topology_.element(e)) corners.push_back(stand_in(node, e));
      add_element(topology_.element_type(e), corners, region_of(e));
    }
  }

  void add_fan_triangles() {
    for (const auto& [node, fan] : fans_) {
      for (std::size_t k = 0; k < fan.spokes.size(); ++k) {
        const Index left = stack_.columns[fan.first + k].rim();
        const Index right = stack_.columns[fan.first + k + 1].rim();
        const Index spoke = topology_.neighbours(node)[at(fan.spokes[k])];
        const Index element = topology_.star(node)[at(fan.spokes[k])];
        // The other end of the spoke may be on another wall.
        const std::array<Index, 3> corners{left, right, stand_in(spoke, element)};
        add_element(corners, region_of(element));
      }
    }
  }

  /// The elements between two columns.
  void add_cells(const ColumnPair& pair) {
    const LayerColumn &a = stack_.columns[pair.left], &b = stack_.columns[pair.right];
    const std::size_t both = std::min(a.count(), b.count());
    const std::size_t most = std::max(a.count(), b.count());
    const Index region = region_of(topology_.star(a.wall_node).front());
    const auto add = [&](std::initializer_list<Index> corners, std::size_t layer) {
      add_element(std::vector<Index>(corners), region);
      layers_.push_back(static_cast<int>(layer));
    };
    for (std::size_t k = 0; k < both; ++k) {
      if (a.nodes[k] == b.nodes[k]) {
        add({a.nodes[k], b.nodes[k + 1], a.nodes[k + 1]}, k);
      } else {
        add({a.nodes[k], b.nodes[k], b.nodes[k + 1], a.nodes[k + 1]}, k);
      }
    }
    for (std::size_t k = both; k < most; ++k) {
      if (a.count() > b.count()) {
        add({a.nodes[k], b.rim(), a.nodes[k + 1]}, k);
      } else {
        add({a.rim(), b.nodes[k], b.nodes[k + 1]}, k);
      }
    }
  }

  /// Divides the boundary edges on which end columns lie, by the nodes of these columns.
  void move_markers() {
    std::map<std::array<Index, 2>, const LayerColumn*> divided;
    for (const LayerColumn& column : stack_.columns) {
      if (!column.along_boundary || column.count() == 0) continue;
      const auto row = topology_.neighbours(column.wall_node);
      // The column lies on that of the two boundary edges which points along it.
      const Vec2 p = old_.coordinates.xy(column.wall_node);
      const auto along = [&](Index node) {
        return (old_.coordinates.xy(node) - p).normalized().dot(column.plane_direction());
      };
      const Index other = along(row.front()) > along(row.back()) ? row.front() : row.back();
      divided[{column.wall_node, other}] = &column;
    }
    if (!topology_.markers().from_file()) return;
    // Nodes of the column that lies on the boundary edge and starts at `from`; if there is none,
    // only `from`.
    const auto up = [&](Index from, Index to) {
      const auto found = divided.find({from, to});
      return found == divided.end() ? std::vector<Index>{from} : found->second->nodes;
    };
    for (Marker marker : topology_.markers()) {
      std::vector<Face> edges;
      for (const Face& edge : marker.faces) {
        const auto [a, b] = edge.edge();
        std::vector<Index> path = up(a, b);
        const std::vector<Index> back = up(b, a);
        path.insert(path.end(), back.rbegin(), back.rend());
        for (std::size_t k = 0; k + 1 < path.size(); ++k) edges.emplace_back(path[k], path[k + 1]);
      }
      marker.faces = std::move(edges);
      data_.markers.push_back(std::move(marker));
    }
  }

  /// The elements outside the layers, with the interior edges of markers, whose nodes are held in
  /// this mesh, too.
  MeshData outside_data() const {
    MeshData outside = data_;
    outside.markers.clear();
    std::set<Index> inside;  // edges, by their index in the topology
    for (const Marker& marker : topology_.markers()) {
      for (const Face& face : marker.faces) {
        const Index f = *topology_.find_face(face);
        const auto& [nodes, elements] = topology_.edges()[at(f)];
        const bool at_wall = fans_.contains(nodes[0]) || fans_.contains(nodes[1]);
        if (elements[1] >= 0 && !at_wall) inside.insert(f);
      }
    }
    if (inside.empty()) return outside;
    Marker& held = outside.markers.emplace_back(Marker{"inside", 1, {}});
    for (const Index f : inside) {
      const auto [a, b] = topology_.edges()[at(f)].nodes;
      held.faces.emplace_back(a, b);
    }
    return outside;
  }

  const Mesh& old_;
  const Topology& topology_;
  LayerStack stack_;
  std::map<Index, Fan> fans_;  // of all wall nodes
  MeshData data_;
  std::vector<int> layers_;  // of the elements that add_cells adds
};

}  // namespace

LayerInsertion insert_layers(const Mesh& mesh, LayerStack plan) {
  require_plane(*mesh.topology, "layers");
  return Inserter(mesh, std::move(plan)).insert();
}

}  // namespace winslow
