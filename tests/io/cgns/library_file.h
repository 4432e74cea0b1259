#pragma once

#include <cgnslib.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "core/mesh/mesh_data.h"
#include "io/cgns/tree.h"
#include "io/support/samples.h"

/// CGNS files as other programs write them: by the upper layer of libcgns, which winslow does not
/// use.
namespace winslow::test {

using CgnsNumbers = std::vector<cgsize_t>;

inline void require_cgns(int error) {
  REQUIRE_MESSAGE(error == CG_OK, std::string(cg_get_error()));
}

/// A file that is being written; closed when it goes.
class LibraryFile {
 public:
  LibraryFile(const std::filesystem::path& path, int type, int cell_dimension = 2,
              int physical_dimension = 2) {
    require_cgns(cg_set_file_type(type));
    require_cgns(cg_open(path.c_str(), CG_MODE_WRITE, &file));
    require_cgns(cg_base_write(file, "Base", cell_dimension, physical_dimension, &base));
  }
  ~LibraryFile() { cg_close(file); }
  LibraryFile(const LibraryFile&) = delete;
  LibraryFile& operator=(const LibraryFile&) = delete;

  void start_zone(const std::string& name, Index vertices, Index cells) {
    const CgnsNumbers size{vertices, cells, 0};
    require_cgns(cg_zone_write(file, base, name.c_str(), size.data(), Unstructured, &zone));
  }
  void start_structured_zone(const std::string& name, Index ni, Index nj) {
    const CgnsNumbers size{ni, nj, ni - 1, nj - 1, 0, 0};
    require_cgns(cg_zone_write(file, base, name.c_str(), size.data(), Structured, &zone));
  }

  template <class Value>
  void coordinate(const char* name, const std::vector<Value>& values) {
    int number = 0;
    const auto type = sizeof(Value) == 4 ? RealSingle : RealDouble;
    require_cgns(cg_coord_write(file, base, zone, type, name, values.data(), &number));
  }
  template <class Value = double>
  void coordinates(const Coordinates& x) {
    for (int k = 0; k < 2; ++k) {
      std::vector<Value> values;
      for (Index i = 0; i < x.size(); ++i) values.push_back(static_cast<Value>(x.xy(i)[k]));
      coordinate(k == 0 ? "CoordinateX" : "CoordinateY", values);
    }
  }

  void section(const char* name, ElementType_t type, const CgnsNumbers& nodes, cgsize_t count) {
    int number = 0;
    require_cgns(cg_section_write(file, base, zone, name, type, next, next + count - 1, 0,
                                  nodes.data(), &number));
    next += count;
  }
  /// MIXED and NGON_n, with offsets.
  void poly_section(const char* name, ElementType_t type, const CgnsNumbers& nodes,
                    const CgnsNumbers& offsets) {
    int number = 0;
    const auto count = static_cast<cgsize_t>(offsets.size()) - 1;
    require_cgns(cg_poly_section_write(file, base, zone, name, type, next, next + count - 1, 0,
                                       nodes.data(), offsets.data(), &number));
    next += count;
  }
  void lines(const char* name, const std::vector<Face>& faces) {
    CgnsNumbers nodes;
    for (const Face& face : faces)
      for (const Index node : face) nodes.push_back(node + 1);
    section(name, BAR_2, nodes, static_cast<cgsize_t>(faces.size()));
  }

  /// points: the numbers of libcgns; indices: index directions of the zone.
  void condition(const char* name, BCType_t type, PointSetType_t set, const CgnsNumbers& points,
                 GridLocation_t location = GridLocationNull, const char* family = nullptr,
                 std::size_t indices = 1) {
    int number = 0;
    require_cgns(cg_boco_write(file, base, zone, name, type, set,
                               static_cast<cgsize_t>(points.size() / indices), points.data(),
                               &number));
    if (location != GridLocationNull)
      require_cgns(cg_boco_gridlocation_write(file, base, zone, number, location));
    if (family == nullptr) return;
    require_cgns(cg_goto(file, base, "Zone_t", zone, "ZoneBC_t", 1, "BC_t", number, "end"));
    require_cgns(cg_famname_write(family));
  }

  int file = 0, base = 0, zone = 0;
  cgsize_t next = 1;  ///< number of the next element
};

inline CgnsNumbers cgns_range(cgsize_t first, cgsize_t count) {
  CgnsNumbers numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

/// The elements of a mesh in their order, as one MIXED section.
inline void write_mixed(LibraryFile& file, const MeshData& data) {
  CgnsNumbers nodes, offsets{0};
  for (Index e = 0; e < data.element_count(); ++e) {
    nodes.push_back(data.types[at(e)] == ElementType::triangle ? TRI_3 : QUAD_4);
    for (const Index node : data.element(e)) nodes.push_back(node + 1);
    offsets.push_back(static_cast<cgsize_t>(nodes.size()));
  }
  file.poly_section("cells", MIXED, nodes, offsets);
}

/// A zone "blk" of a volume mesh with the places of its nodes.
inline void write_places(LibraryFile& file, const MeshData& data) {
  constexpr std::array names{"CoordinateX", "CoordinateY", "CoordinateZ"};
  file.start_zone("blk", data.node_count(), data.element_count());
  for (int k = 0; k < 3; ++k) {
    std::vector<double> values;
    for (Index i = 0; i < data.node_count(); ++i) values.push_back(data.coordinates.xyz(i)[k]);
    file.coordinate(names[at(k)], values);
  }
}

inline io::cgns::TreeFile tree_of(const std::filesystem::path& path) {
  io::Source source = io::Source::load(path);
  return io::cgns::read_tree(source);
}

inline const io::cgns::Node& node_at(const io::cgns::NodePtr& root, const std::string& path) {
  const io::cgns::Node* node = root.get();
  std::size_t begin = 1;
  while (begin <= path.size()) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const auto child = io::cgns::child_named(*node, path.substr(begin, end - begin));
    REQUIRE_MESSAGE(child, path);
    node = child.get();
    begin = end + 1;
  }
  return *node;
}

/// Changes one node of a file.
inline void edit_node(const std::filesystem::path& path, const std::string& place,
                      const std::function<void(io::cgns::Node&)>& edit) {
  const auto file = tree_of(path);
  const io::cgns::Node* old = &node_at(file.root, place);
  auto changed = std::make_shared<io::cgns::Node>(*old);
  edit(*changed);
  for (std::string above = place.substr(0, place.rfind('/')); !above.empty();
       above.resize(above.rfind('/'))) {
    const io::cgns::Node& holder = node_at(file.root, above);
    changed = io::cgns::with_child(holder, *old, changed);
    old = &holder;
  }
  const auto root = io::cgns::with_child(*file.root, *old, changed);
  write_text(path, io::cgns::write_tree(*root, file.container));
}

inline constexpr std::array cgns_containers{CG_FILE_HDF5, CG_FILE_ADF};

/// A square of triangles and quadrilaterals, with two markers.
inline MeshData cgns_square() {
  MeshData data = grid_with_holes(4, Cells::mixed, [](Index, Index) { return false; });
  mark_boundary(data, [](const Vec2& p) { return std::string(p.y() == 0 ? "wall" : "far"); });
  return data;
}

/// The square in a file of libcgns, with a section and a boundary condition for each marker.
inline void write_square(const std::filesystem::path& path, int container, const MeshData& data,
                         bool single = false) {
  LibraryFile file(path, container);
  file.start_zone("blk", data.node_count(), data.element_count());
  if (single) {
    file.coordinates<float>(data.coordinates);
  } else {
    file.coordinates(data.coordinates);
  }
  write_mixed(file, data);
  for (const Marker& marker : data.markers) {
    const cgsize_t first = file.next;
    file.lines(marker.name.c_str(), marker.faces);
    file.condition(("bc " + marker.name).c_str(), BCWallViscous, PointRange, {first, file.next - 1},
                   EdgeCenter, marker.name.c_str());
  }
}

/// Paths of the nodes that differ, or that one of the trees lacks.
inline void differences(const io::cgns::Node& a, const io::cgns::Node& b, const std::string& path,
                        std::vector<std::string>& found) {
  const bool same = a.name == b.name && a.label == b.label && a.type == b.type &&
                    a.dims == b.dims && a.data == b.data && a.link_path == b.link_path &&
                    a.children.size() == b.children.size();
  if (!same) found.push_back(path);
  for (std::size_t k = 0; k < std::min(a.children.size(), b.children.size()); ++k)
    differences(*a.children[k], *b.children[k], path + '/' + a.children[k]->name, found);
}
inline std::vector<std::string> differences(const io::cgns::NodePtr& a,
                                            const io::cgns::NodePtr& b) {
  std::vector<std::string> found;
  differences(*a, *b, "", found);
  return found;
}

inline const Marker& marker_named(const io::MeshFile& file, const std::string& name) {
  const auto found = file.mesh.topology->markers().find(name);
  REQUIRE_MESSAGE(found, name);
  return file.mesh.topology->markers()[at(*found)];
}

}  // namespace winslow::test
