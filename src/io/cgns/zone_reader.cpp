#include "core/error.h"
#include "io/cgns/cgns.h"
#include "io/cgns/structured.h"
#include "io/cgns/zone_markers.h"
#include "io/cgns/zones.h"
#include "io/format/cell_of_faces.h"

namespace winslow::io::cgns {

namespace {

/// Some programs list elements without declaring it. The numbers cannot be vertices if the zone has
/// no vertices of these numbers.
bool means_elements(const PointSet& set, const ZoneSides& sides, std::int64_t vertices) {
  if (!set.of_vertices()) return true;
  if (!set.location.empty() || set.values.empty()) return false;
  const auto is_side = [&](std::int64_t n) {
    return sides.numbers.find(n).kind == ElementPlace::Kind::side;
  };
  return *std::max_element(set.values.begin(), set.values.end()) > vertices &&
         std::all_of(set.values.begin(), set.values.end(), is_side);
}

/// Boundary faces of an unstructured zone: sides by the numbers of their elements, or boundary
/// faces by their vertices. The constructor's arguments must outlive it.
class UnstructuredBoundary : public ZoneBoundary {
 public:
  UnstructuredBoundary(const MeshData& mesh, const ZoneSides& sides, const ZoneHead& head)
      : sides_(sides),
        vertices_(head.vertex_count),
        dimension_(head.cell_dimension),
        by_nodes_(mesh) {}

  std::vector<Face> faces_of(const PointSet& set,
                             std::vector<std::string>& warnings) const override {
    const std::string owner = "\"" + set.view.path() + "\"";
    if (!means_elements(set, sides_, vertices_)) {
      std::vector<bool> nodes(static_cast<std::size_t>(vertices_), false);
      set.for_each_number([&](std::int64_t vertex) {
        if (vertex < 1 || vertex > vertices_) {
          set.view.fail("vertex " + std::to_string(vertex), "1 to " + std::to_string(vertices_));
        }
        nodes[static_cast<std::size_t>(vertex - 1)] = true;
      });
      return by_nodes_.faces_between(nodes);
    }
    if (set.of_vertices()) {
      warnings.push_back(owner + " has numbers that no vertex has: taken for elements");
    }
    std::vector<Face> faces;
    std::int64_t others = 0;
    set.for_each_number([&](std::int64_t number) {
      const ElementPlace place = sides_.numbers.find(number);
      if (place.kind == ElementPlace::Kind::none) {
        set.view.fail(
            "element " + std::to_string(number),
            "1 to " + std::to_string(sides_.numbers.last()) + ", as the sections have them");
      }
      if (place.kind == ElementPlace::Kind::side) {
        faces.push_back(sides_.faces[at(place.index)]);
      } else {
        ++others;
      }
    });
    if (others > 0) {
      constexpr std::array sides{"", "", "edges (BAR_2)", "faces (TRI_3, QUAD_4)"};
      warnings.push_back(owner + " names " + std::to_string(others) + " elements that are no " +
                         sides[at(dimension_)] + ": they are in no marker");
    }
    return faces;
  }

 private:
  const ZoneSides& sides_;
  std::int64_t vertices_;
  int dimension_;  // of the cells
  BoundaryByNodes by_nodes_;
};

/// The vertex that gives each node its position: the first of those joined into the node.
std::vector<std::size_t> first_vertices(const Lattice& lattice) {
  std::vector<std::size_t> vertices;
  for (std::size_t v = 0; v < lattice.node_of_vertex.size(); ++v) {
    if (lattice.node_of_vertex[v] == static_cast<Index>(vertices.size())) vertices.push_back(v);
  }
  return vertices;
}

class ZoneReader {
 public:
  ZoneReader(const ZonePlace& place, std::shared_ptr<Details> details)
      : place_(place), zone_(place.zone), head_(read_head(place)), details_(std::move(details)) {
    mesh_.details = details_;
  }

  ParsedMesh read() {
    const NodeView grid = find_grid(zone_);
    const VertexPlaces places = read_places(grid, head_);
    if (head_.structured) {
      read_structured(grid, places);
    } else {
      const ZoneSides sides = read_sections(zone_, head_, mesh_.data);
      place_nodes(grid, places, {});
      warn_of_turned_cells(sides.turned_cells);
      give_faces_to_flat_cells(mesh_);
      const UnstructuredBoundary boundary(mesh_.data, sides, head_);
      make_markers(place_, head_, boundary, sides, {}, mesh_, *details_);
      read_periodic(boundary, [&](const NodeView& connection) {
        return listed_pairs(connection, head_.vertex_count);
      });
      read_regions(zone_, sides.numbers, mesh_.data, mesh_.warnings);
    }
    warn_of_other_grids();
    details_->markers = mesh_.data.markers;
    zone_.set_part();
    return std::move(mesh_);
  }

 private:
  void read_structured(const NodeView& grid, const VertexPlaces& places) {
    std::vector<std::string> joined;
    const Lattice lattice = make_lattice(zone_, head_, places, joined, mesh_.warnings);
    add_cells(lattice, places, mesh_.data);
    place_nodes(grid, places, first_vertices(lattice));
    if (!joined.empty()) details_->node_of_vertex = lattice.node_of_vertex;
    const StructuredBoundary boundary(lattice, mesh_.data);
    make_markers(place_, head_, boundary, {}, joined, mesh_, *details_);
    read_periodic(boundary,
                  [&](const NodeView& connection) { return lattice_pairs(connection, lattice); });
  }

  void read_periodic(const ZoneBoundary& boundary, const VertexPairs& pairs_of) {
    details_->periodic = std::make_shared<GivenPeriodicity>();
    details_->periodic->pairs =
        cgns::periodic_pairs(zone_, head_, boundary, pairs_of, mesh_.data, mesh_.warnings);
    details_->roles.pairs_move = !details_->periodic->pairs.empty();
  }

  /// vertices: the vertex of each node; empty: the nodes are the vertices.
  void place_nodes(const NodeView& grid, const VertexPlaces& places,
                   const std::vector<std::size_t>& vertices) {
    const auto& [x, y, z] = places.of;
    const std::size_t count = vertices.empty() ? x.size() : vertices.size();
    std::vector<double> xyz;
    xyz.reserve(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t v = vertices.empty() ? i : vertices[i];
      xyz.insert(xyz.end(), {x[v], y[v], z.empty() ? 0.0 : z[v]});
    }
    mesh_.where.nodes.assign(count, 0);
    grid.set_part();
    const bool volume = mesh_.data.cell_dimension() == 3;
    (volume ? set_space_nodes : set_planar_nodes)(zone_.source(), xyz, mesh_);
  }

  void warn_of_turned_cells(Index count) {
    if (count == 0) return;
    mesh_.warnings.push_back(
        std::to_string(count) + (count == 1 ? " cell has" : " cells have") +
        " faces of which the signs (NFACE_n) or the parents contradict each other: they were "
        "turned alike");
  }

  void warn_of_other_grids() {
    for (const NodeView& grid : zone_.children("GridCoordinates_t")) {
      if (grid.name() == "GridCoordinates") continue;
      mesh_.warnings.push_back("the zone has a second grid, \"" + grid.name() +
                               "\": it stays as it is");
    }
  }

  ZonePlace place_;
  NodeView zone_;
  ZoneHead head_;
  std::shared_ptr<Details> details_;
  ParsedMesh mesh_;
};

/// A file whose tree has been read.
class ZoneFile {
 public:
  explicit ZoneFile(Source& source) {
    source.set_part("/");
    file_ = read_tree(source);
    zones_ = find_zones(NodeView(source, file_.root));
    for (std::size_t z = 0; z < zones_.size() && zones_.size() > 1; ++z)
      numbers_.push_back(static_cast<int>(z) + 1);
  }

  const std::vector<ZonePlace>& zones() const { return zones_; }

  ParsedMesh read(std::size_t chosen) const {
    const ZonePlace& place = zones_[chosen];
    auto details = std::make_shared<Details>();
    details->root = file_.root;
    details->container = file_.container;
    details->base_name = place.base.name();
    details->zone_name = place.zone.name();
    details->zone = static_cast<int>(chosen) + 1;
    details->zones = numbers_;
    try {
      return ZoneReader(place, std::move(details)).read();
    } catch (const InputError& error) {
      if (zones_.size() == 1) throw;
      throw InputError(std::string(error.what()) + " (zone " + std::to_string(chosen + 1) + " of " +
                       std::to_string(zones_.size()) + "; --zone N reads another one alone)");
    }
  }

 private:
  TreeFile file_;
  std::vector<ZonePlace> zones_;
  std::vector<int> numbers_;  // of the zones; empty: there is one
};

}  // namespace

ParsedMesh read_zone(Source& source, int number) {
  const ZoneFile file(source);
  return file.read(choose_zone(file.zones(), number));
}

void read_zones(Source& source, const TakeZone& take) {
  const ZoneFile file(source);
  for (std::size_t z = 0; z < file.zones().size(); ++z) take(file.read(z));
}

}  // namespace winslow::io::cgns
