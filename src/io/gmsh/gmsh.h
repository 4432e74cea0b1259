#pragma once

#include "core/mesh/element_type.h"
#include "core/mesh/mesh.h"
#include "io/format/mesh_format.h"
#include "io/format/parsed_mesh.h"

/// Gmsh's MSH format, versions 2.2 and 4.1, ASCII and binary: Gmsh reference manual, "MSH file
/// format".
namespace winslow::io::gmsh {

struct PhysicalName {
  int dimension;
  int tag;
  std::string name;
};

/// Indexed by dimension: name of an entity, and how many numbers of Entity::box a file holds for
/// it.
constexpr std::array<const char*, 4> entity_names{"point", "curve", "surface", "volume"};
constexpr std::array<std::size_t, 4> box_numbers{3, 6, 6, 6};

/// Geometric entity of a 4.1 file. `box` is minimum x y z, maximum x y z; for a point only the
/// first three, its position.
struct Entity {
  int tag = 0;
  std::array<double, 6> box{};
  std::vector<int> physicals;  ///< negative: of the reversed entity
  std::vector<int> boundary;   ///< tags of the entities around it, negative when reversed
  /// Bounding box of its nodes when the file was read, to detect whether they have moved.
  std::optional<std::array<double, 6>> mesh_box;
};

struct NodeBlock {
  int dimension;
  int entity;
  Index count;
};

enum class Shape : std::uint8_t {
  point,
  line,
  triangle,
  quadrilateral,
  tetrahedron,
  hexahedron,
  prism,
  pyramid
};
/// Gmsh's data of a shape. Corners are numbered as in ElementShape.
struct ShapeInfo {
  int type;  ///< Gmsh's number
  int dimension;
  Index corners;
};
const ShapeInfo& info_of(Shape shape);
Shape element_shape(ElementType type);
/// The shape of an element of a marker.
Shape face_shape(const Face& face);
/// The element type of a shape of dimension 2 or 3.
ElementType element_of(Shape shape);

/// One line of $Elements.
struct Item {
  std::int64_t tag;
  /// Index into Details::points, or into Details::sides if the item's dimension is less than the
  /// mesh's; else the element of the mesh.
  Index index;
  int entity;    ///< tag of the geometric entity
  int physical;  ///< 2.2 only (0: none)
  Shape shape;
};

/// One entry of $Periodic: an entity and its master, of which it is the periodic image.
struct PeriodicLink {
  int dimension = 0;
  int entity = 0, master = 0;
  std::vector<double> affine;  ///< 4 by 4, row by row, from the master to the entity; may be empty
  std::vector<std::array<std::int64_t, 2>> nodes;  ///< tags: of the entity, of its master
  std::size_t offset = 0;                          ///< in the file
};

/// Content of an MSH file beyond a Mesh.
struct Details : BoundaryDetails {
  int dimension = 2;  ///< of the elements of the mesh
  bool version_4 = true;
  struct Section {
    std::string name;  ///< "Nodes", ...
    std::string raw;   ///< whole text of an unknown section; else empty
  };
  std::vector<Section> sections;  ///< all but $MeshFormat, in the order of the file
  std::vector<PhysicalName> physical_names;
  std::array<std::vector<Entity>, 4> entities;  ///< by dimension; 4.1 only
  /// Parts of entities in a partitioned file ($PartitionedEntities, which is kept as it is): their
  /// tags and physical groups.
  std::array<std::vector<Entity>, 4> parts;
  std::vector<NodeBlock> node_blocks;   ///< 4.1 only
  std::vector<std::int64_t> node_tags;  ///< empty: 1, 2, 3, ...
  std::vector<Item> items;
  std::vector<PeriodicLink> links;  ///< parsed from the raw text of $Periodic

  /// Nodes of an item that is a point or a side; empty if the item is an element of the mesh.
  std::span<const Index> nodes_beside(const Item& item) const;
};

/// Bounding boxes of the nodes of each entity (in its node blocks and its elements), by dimension
/// and in the order of `details.entities`; none for an entity without nodes.
using EntityBoxes = std::array<std::vector<std::optional<std::array<double, 6>>>, 4>;
EntityBoxes entity_boxes(const Details& details, const MeshData& data);
EntityBoxes entity_boxes(const Details& details, const Mesh& mesh);

extern const MeshFormat format;

ParsedMesh read(Source& source);

/// `source`: details of the file that the mesh came from, of this format or of another; may be
/// null.
std::vector<std::string> write(std::ostream& out, const Mesh& mesh, const FormatDetails* source,
                               const WriteOptions& options);

/// Makes markers and regions from the physical groups. offsets: byte offset of each of
/// Details::items.
void collect_groups(std::span<const std::size_t> offsets, Details& details, ParsedMesh& mesh);

/// Makes details for a mesh from another format: one curve entity per marker (surface entity in a
/// volume mesh) and one surface (volume) entity per region. Without regions all elements are in one
/// entity "domain", because Gmsh does not save elements without a physical group.
Details make_details(const Mesh& mesh, bool version_4, std::vector<std::string>& warnings);

}  // namespace winslow::io::gmsh
