#include "io/vtk/grid.h"

#include <cstdlib>

#include "io/format/cell_of_faces.h"
#include "io/format/foreign_formats.h"
#include "io/format/mesh_in_space.h"
#include "io/vtk/face_stream.h"

namespace winslow::io::vtk {

CellType cell_type_of(const Face& face) {
  if (face.size() > 4) return polygon;
  return face.size() == 2 ? line : face.size() == 3 ? triangle : quadrilateral;
}

CellType cell_type_of(ElementType type) {
  if (type == ElementType::polygon) return polygon;
  static constexpr std::array<CellType, 6> types{triangle, quadrilateral, tetrahedron,
                                                 pyramid,  wedge,         hexahedron};
  return types[static_cast<std::size_t>(type)];
}

int dimension_of_cell(std::int64_t type) {
  if (type == vertex || type == poly_vertex) return 0;
  if (type == line || type == poly_line) return 1;
  return (type >= tetrahedron && type <= hexagonal_prism) || type == polyhedron ? 3 : 2;
}

std::optional<ElementType> element_of(std::int64_t type, std::size_t corners) {
  if (type == polygon) return corners == 3 ? ElementType::triangle : ElementType::polygon;
  if (type == pixel) type = quadrilateral;
  if (type == voxel) type = hexahedron;
  for (const ElementType element : fixed_element_types)
    if (cell_type_of(element) == type) return element;
  return std::nullopt;
}

void Grid::add_cell(CellType type, std::span<const Index> nodes) {
  types.push_back(type);
  connectivity.insert(connectivity.end(), nodes.begin(), nodes.end());
  offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  if (!face_offsets.empty()) face_offsets.push_back(face_offsets.back());
}

void Grid::add_polyhedron(std::span<const Index> nodes, std::span<const Face> of_cell) {
  if (face_offsets.empty()) face_offsets.assign(offsets.size(), 0);
  add_cell(polyhedron, nodes);
  append_face_stream(of_cell, faces);
  face_offsets.back() = static_cast<std::int64_t>(faces.size());
}

namespace {

GroupIndex named_groups(const std::vector<NamedTag>& names, const char* prefix) {
  GroupIndex groups(prefix);
  for (const auto& [name, tag] : names) {
    if (!groups.contains(tag)) groups.add(tag, name);
  }
  return groups;
}

std::vector<Index> sorted(std::vector<Index> nodes) {
  std::ranges::sort(nodes);
  return nodes;
}

/// The nodes of some faces, each once, ascending.
std::vector<Index> distinct_nodes(const std::vector<Face>& faces) {
  std::vector<Index> nodes;
  for (const Face& face : faces) nodes.insert(nodes.end(), face.begin(), face.end());
  sort_unique(nodes);
  return nodes;
}

/// The faces of a prism over a polygon: its two ends, then its sides.
std::vector<Face> faces_of_prism(const std::vector<Index>& nodes) {
  const std::size_t n = nodes.size() / 2;
  const auto ends = std::span(nodes);
  std::vector<Face> faces{Face(ends.first(n)).reversed(), Face(ends.last(n))};
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n;
    faces.emplace_back(nodes[k], nodes[next], nodes[n + next], nodes[n + k]);
  }
  return faces;
}

/// 3 if there is a volume cell, else 2.
int dimension_of(const Grid& grid) {
  const auto solid = [](std::int64_t type) { return dimension_of_cell(type) == 3; };
  return std::ranges::any_of(grid.types, solid) ? 3 : 2;
}

class MeshBuilder {
 public:
  MeshBuilder(const Source& source, Grid grid)
      : source_(source),
        grid_(std::move(grid)),
        dimension_(dimension_of(grid_)),
        markers_(named_groups(grid_.marker_names, "marker_")),
        regions_(named_groups(grid_.region_names, "region_")) {
    mesh_.details = details_;
  }

  ParsedMesh build() {
    mesh_.where.nodes = grid_.point_places;
    for (std::size_t c = 0; c < grid_.cell_count(); ++c) add_cell(c);
    set_nodes(source_, grid_.points, mesh_);
    give_faces_to_flat_cells(mesh_);
    finish_groups();
    keep_file();
    return std::move(mesh_);
  }

 private:
  std::vector<Index> corners(std::size_t c) const {
    return known_nodes(grid_.nodes(c), grid_.cell_places[c]);
  }

  std::vector<Index> known_nodes(std::span<const std::int64_t> given, std::size_t place) const {
    std::vector<Index> nodes;
    nodes.reserve(given.size());
    const auto count = static_cast<std::int64_t>(grid_.points.size() / 3);
    for (const std::int64_t node : given) {
      if (node < 0 || node >= count) {
        source_.fail(place, "node " + std::to_string(node), "0 to " + std::to_string(count - 1));
      }
      nodes.push_back(static_cast<Index>(node));
    }
    return nodes;
  }

  void require_size(std::size_t c, const std::vector<Index>& nodes, std::size_t size) const {
    if (nodes.size() == size) return;
    source_.fail(
        grid_.cell_places[c],
        std::to_string(nodes.size()) + " nodes in a cell of type " + std::to_string(grid_.types[c]),
        std::to_string(size));
  }

  void require_polygon(std::size_t c, const std::vector<Index>& nodes) const {
    if (nodes.size() >= 3 && nodes.size() <= most_polygon_corners) return;
    source_.fail(grid_.cell_places[c], std::to_string(nodes.size()) + " nodes in a polygon (7)",
                 "3 to " + std::to_string(most_polygon_corners));
  }

  void add_cell(std::size_t c) {
    std::vector<Index> nodes = corners(c);
    const std::int64_t type = grid_.types[c];
    if (type == vertex || type == poly_vertex) {
      if (type == vertex) require_size(c, nodes, 1);
      details_->points.insert(details_->points.end(), nodes.begin(), nodes.end());
      return;
    }
    if (type == line || type == poly_line) {
      if (type == line) require_size(c, nodes, 2);
      for (std::size_t k = 1; k < nodes.size(); ++k) add_side(c, {nodes[k - 1], nodes[k]});
      return;
    }
    if (type == polyhedron) return add_polyhedron(c, nodes, faces_of(c));
    if (type == pentagonal_prism || type == hexagonal_prism) {
      const std::size_t sides = type == pentagonal_prism ? 5 : 6;
      require_size(c, nodes, 2 * sides);
      return add_polyhedron(c, nodes, faces_of_prism(nodes));
    }
    if (type == polygon && dimension_ == 3 && nodes.size() > 4) return add_side(c, Face(nodes));
    const auto element = element_of(type, nodes.size());
    if (!element) refuse(c);
    if (*element == ElementType::polygon)
      require_polygon(c, nodes);
    else
      require_size(c, nodes, static_cast<std::size_t>(corner_count(*element)));
    if (type == pixel || type == voxel) std::swap(nodes[2], nodes[3]);
    if (type == voxel) std::swap(nodes[6], nodes[7]);
    if (type == wedge) mirror_prism(nodes);
    if (dimension_of(*element) < dimension_) return add_side(c, Face(nodes));
    add_element(c, *element, nodes);
  }

  [[noreturn]] void refuse(std::size_t c) const {
    const auto type = grid_.types[c];
    const bool other_solid = type == 41;
    const bool high_order = type >= 21 && type <= 81;
    source_.fail(
        grid_.cell_places[c],
        "cell type " + std::to_string(type) +
            (other_solid  ? " (a convex set of points)"
             : high_order ? " (second or higher order)"
                          : ""),
        std::string(
            "a line (3), triangle (5), polygon (7), quadrilateral (9), "
            "tetrahedron (10), hexahedron (12), wedge (13), pyramid (14) or polyhedron (42)") +
            (high_order && !other_solid ? first_order_hint(source_.name()) : ""));
  }

  void add_side(std::size_t c, const Face& face) {
    const auto index = static_cast<Index>(details_->sides.size());
    details_->sides.push_back(face);
    if (!is_side(face, dimension_)) return;
    const int tag = grid_.marker.empty() ? 0 : grid_.marker[c];
    if (tag == 0) {
      ++loose_sides_;
      return;
    }
    add_marker_side(markers_.find(tag), index, grid_.cell_places[c], *details_, mesh_);
  }

  void add_element(std::size_t c, ElementType type, const std::vector<Index>& nodes) {
    mesh_.data.add_element(type, nodes);
    place_element(c);
  }

  /// The faces of a polyhedron, by its face stream.
  std::vector<Face> faces_of(std::size_t c) const {
    const std::size_t place = place_of_faces(c);
    const auto stream = grid_.face_stream(c);
    std::vector<Face> faces;
    const bool whole = for_each_face(stream, [&](std::span<const std::int64_t> nodes) {
      if (nodes.size() < 3) {
        source_.fail(place, "a face of " + std::to_string(nodes.size()) + " nodes in " + cell(c),
                     "three or more");
      }
      faces.emplace_back(known_nodes(nodes, place));
    });
    if (!whole) refuse_face_stream(source_, place, c, stream.size());
    return faces;
  }

  std::size_t place_of_faces(std::size_t c) const {
    return grid_.face_places.empty() ? grid_.cell_places[c] : grid_.face_places[c];
  }
  static std::string cell(std::size_t c) { return "cell " + std::to_string(c) + ", a polyhedron"; }

  /// Adds a cell by its faces. nodes: as the list of cells has them.
  void add_polyhedron(std::size_t c, const std::vector<Index>& nodes, std::vector<Face> faces) {
    try {
      turned_ += make_faces_alike(faces) > 0 ? 1 : 0;
    } catch (const FacesFault& fault) {
      source_.fail(place_of_faces(c), fault.found + " in " + cell(c), fault.expected);
    }
    // Where the list of cells has other nodes than the faces, these count.
    if (distinct_nodes(faces) == sorted(nodes))
      mesh_.data.add_polyhedron(nodes, faces);
    else
      mesh_.data.add_polyhedron(faces);
    place_element(c);
  }

  /// Sets where an element is in the file, and its region.
  void place_element(std::size_t c) {
    mesh_.where.elements.push_back(grid_.cell_places[c]);
    const bool none = grid_.region.empty() || (grid_.zero_is_none && grid_.region[c] == 0);
    mesh_.data.element_region.push_back(none ? -1
                                             : static_cast<Index>(regions_.find(grid_.region[c])));
  }

  void finish_groups() {
    make_markers(markers_.all(), *details_, mesh_);
    mesh_.data.regions = regions_.all();
    if (mesh_.data.regions.empty()) mesh_.data.element_region.clear();
    if (turned_ > 0) {
      mesh_.warnings.push_back(
          std::to_string(turned_) + (turned_ == 1 ? " polyhedron has" : " polyhedra have") +
          " some faces seen from inside and others from outside: they were turned alike");
    }
    if (loose_sides_ > 0) {
      mesh_.warnings.push_back(std::to_string(loose_sides_) +
                               (dimension_ == 2 ? " line" : " surface") +
                               " cells have no marker tag: they are kept, but are no marker");
    }
  }

  /// Moves what is to be written again into the details.
  void keep_file() {
    Details& kept = *details_;
    kept.connectivity.assign(grid_.connectivity.begin(), grid_.connectivity.end());
    index_count(grid_.connectivity.size(), "corners of cells");
    kept.offsets.assign(grid_.offsets.begin(), grid_.offsets.end());
    kept.types.assign(grid_.types.begin(), grid_.types.end());
    index_count(grid_.faces.size(), "nodes of faces of cells");
    kept.faces.assign(grid_.faces.begin(), grid_.faces.end());
    kept.face_offsets.assign(grid_.face_offsets.begin(), grid_.face_offsets.end());
    kept.face_tables = std::move(grid_.face_tables);
    kept.list_types = grid_.list_types;
    kept.points_name = grid_.points_name;
    kept.data = std::move(grid_.data);
    kept.markers = markers_.all();
    kept.regions = regions_.all();
    kept.regions_array = grid_.regions_array;
  }

  const Source& source_;
  Grid grid_;
  int dimension_;  // of the elements
  ParsedMesh mesh_;
  std::shared_ptr<Details> details_ = std::make_shared<Details>();
  GroupIndex markers_;
  GroupIndex regions_;
  Index loose_sides_ = 0;
  Index turned_ = 0;  // polyhedra of which faces were turned
};

}  // namespace

ParsedMesh to_mesh(const Source& source, Grid grid) {
  return MeshBuilder(source, std::move(grid)).build();
}

std::vector<Index> Details::nodes_of(std::size_t cell) const {
  std::vector<Index> nodes;
  if (types[cell] == polyhedron) {
    for_each_face(
        std::span(faces).subspan(at(face_offsets[cell]),
                                 at(face_offsets[cell + 1] - face_offsets[cell])),
        [&](std::span<const Index> face) { nodes.insert(nodes.end(), face.begin(), face.end()); });
    sort_unique(nodes);
    return nodes;
  }
  nodes.assign(connectivity.begin() + offsets[cell], connectivity.begin() + offsets[cell + 1]);
  std::ranges::sort(nodes);
  return nodes;
}

bool Details::fits(const Mesh& mesh) const {
  if (!BoundaryDetails::fits(mesh)) return false;
  const Topology& topology = *mesh.topology;
  const auto same = [](const auto& a, const Region& b) {
    return a.name == b.name && a.tag == b.tag;
  };
  if (topology.markers().from_file() &&
      !std::ranges::equal(topology.markers().list(), markers, same))
    return false;
  if (!std::ranges::equal(topology.regions(), regions, same)) return false;
  std::vector<Index> of_file, of_mesh;
  Index element = 0;
  for (std::size_t c = 0; c < types.size(); ++c) {
    if (dimension_of_cell(types[c]) != topology.cell_dimension()) continue;
    of_file = nodes_of(c);
    if (element == topology.element_count()) return false;
    const auto corners = topology.element(element++);
    of_mesh.assign(corners.begin(), corners.end());
    std::ranges::sort(of_mesh);
    if (of_file != of_mesh) return false;
  }
  return element == topology.element_count();
}

namespace {

class GridBuilder {
 public:
  GridBuilder(const Mesh& mesh, const FormatDetails* source, std::vector<std::string>& warnings)
      : topology_(*mesh.topology), space_(mesh, source) {
    if (topology_.markers().from_file()) {
      markers_ = usable_tags(tags_of(topology_.markers().list()), "markers", warnings);
    }
    regions_ = usable_tags(tags_of(topology_.regions()), "regions", warnings);
    const Index n = mesh.coordinates.size();
    grid_.points.reserve(3 * static_cast<std::size_t>(n));
    for (Index i = 0; i < n; ++i) {
      const Vec3 p = space_.node(i);
      grid_.points.insert(grid_.points.end(), {p.x(), p.y(), p.z()});
    }
  }

  /// The cells and arrays of the source, with the nodes where they are now.
  Grid as_read(const Details& details) {
    grid_.connectivity.assign(details.connectivity.begin(), details.connectivity.end());
    grid_.offsets.assign(details.offsets.begin(), details.offsets.end());
    grid_.types.assign(details.types.begin(), details.types.end());
    grid_.faces.assign(details.faces.begin(), details.faces.end());
    grid_.face_offsets.assign(details.face_offsets.begin(), details.face_offsets.end());
    grid_.face_tables = details.face_tables;
    grid_.data = details.data;
    grid_.list_types = details.list_types;
    grid_.points_name = details.points_name;
    return std::move(grid_);
  }

  Grid elements_then_markers() {
    for (Index e = 0; e < topology_.element_count(); ++e) add_element(e);
    for (std::size_t m = 0; m < markers_.size(); ++m) {
      for (const Face& face : topology_.markers()[m].faces) add_side(face, markers_[m]);
    }
    for (std::size_t m = 0; m < markers_.size(); ++m)
      add_name("marker:" + topology_.markers()[m].name, markers_[m]);
    for (std::size_t r = 0; r < regions_.size(); ++r)
      add_name("region:" + topology_.regions()[r].name, regions_[r]);
    if (!markers_.empty()) grid_.data.cells.push_back(integer_array("marker", grid_.marker));
    if (!regions_.empty()) grid_.data.cells.push_back(integer_array("region", grid_.region));
    return std::move(grid_);
  }

 private:
  void add_name(std::string name, int tag) {
    DataArray array = integer_array(std::move(name), {tag});
    array.attributes = {{"NumberOfTuples", "1"}};
    grid_.data.field.push_back(std::move(array));
  }
  void add_element(Index e) {
    const auto of = topology_.element_regions();
    const Index region = of.empty() ? -1 : of[static_cast<std::size_t>(e)];
    const ElementType type = topology_.element_type(e);
    if (type == ElementType::polyhedron) {
      const auto corners = topology_.element(e);
      std::vector<Face> faces;
      for (const Face& face : topology_.shape(e).faces) faces.push_back(by_nodes(face, corners));
      grid_.add_polyhedron(corners, faces);
    } else {
      FileCorners corners = space_.element(e);
      if (type == ElementType::prism) mirror_prism(corners.span());
      grid_.add_cell(cell_type_of(type), {corners.data(), corners.size()});
    }
    grid_.marker.push_back(0);
    grid_.region.push_back(region < 0 ? 0 : regions_[static_cast<std::size_t>(region)]);
  }
  void add_side(const Face& face, int tag) {
    grid_.add_cell(cell_type_of(face), {face.begin(), face.size()});
    grid_.marker.push_back(tag);
    grid_.region.push_back(0);
  }

  const Topology& topology_;
  MeshInSpace space_;
  std::vector<int> markers_;
  std::vector<int> regions_;
  Grid grid_;
};

}  // namespace

Grid to_grid(const Mesh& mesh, const FormatDetails* source, std::vector<std::string>& warnings) {
  const auto* details = dynamic_cast<const Details*>(source);
  if (details != nullptr && details->fits(mesh)) {
    std::vector<std::string> not_needed;  // the tags of the file are not written anew
    return GridBuilder(mesh, source, not_needed).as_read(*details);
  }
  if (details != nullptr && !details->data.empty()) {
    warnings.push_back(
        "the mesh is no longer that of the file: the data on its points, cells and field are not "
        "written: " +
        details->data.names());
  }
  return GridBuilder(mesh, source, warnings).elements_then_markers();
}

}  // namespace winslow::io::vtk
