#include "io/gmsh/gmsh.h"

#include <cstdlib>
#include <unordered_map>

#include "core/types.h"
#include "io/format/mesh_in_space.h"

namespace winslow::io::gmsh {

const ShapeInfo& info_of(Shape shape) {
  static constexpr std::array<ShapeInfo, 8> shapes{
      {{15, 0, 1}, {1, 1, 2}, {2, 2, 3}, {3, 2, 4}, {4, 3, 4}, {5, 3, 8}, {6, 3, 6}, {7, 3, 5}}};
  return shapes[static_cast<std::size_t>(shape)];
}

Shape element_shape(ElementType type) {
  static constexpr std::array<Shape, 6> shapes{Shape::triangle,    Shape::quadrilateral,
                                               Shape::tetrahedron, Shape::pyramid,
                                               Shape::prism,       Shape::hexahedron};
  return shapes[static_cast<std::size_t>(type)];
}

Shape face_shape(const Face& face) {
  return face.size() == 2 ? Shape::line : face.size() == 3 ? Shape::triangle : Shape::quadrilateral;
}

ElementType element_of(Shape shape) {
  for (const ElementType type : fixed_element_types) {
    if (element_shape(type) == shape) return type;
  }
  return ElementType::triangle;
}

const MeshFormat format{
    .name = "msh",
    .title = "Gmsh",
    .versions = "2.2 and 4.1",
    .encodings = "text, binary",
    .markers = "yes, name and tag",
    .keeps_periodic = true,
    .has_binary = true,
    .recognise =
        [](const Content& content) {
          const std::string_view first = content.first_line;
          return signature_if(first == "$MeshFormat" || first == "$NOD" || first == "$Comments");
        },
    .read = read,
    .write = write};

std::span<const Index> Details::nodes_beside(const Item& item) const {
  const int of_item = info_of(item.shape).dimension;
  if (of_item == dimension) return {};
  if (of_item == 0) return {&points[at(item.index)], 1};
  const Face& side = sides[at(item.index)];
  return {side.begin(), side.end()};
}

namespace {

/// Physical groups of one dimension: those with a name first, as $PhysicalNames lists them, then
/// the others in the order of their first use.
GroupIndex groups_of(const Details& details, int dimension) {
  GroupIndex groups{std::string(entity_names[at(dimension)]) + '_'};
  for (const PhysicalName& name : details.physical_names) {
    if (name.dimension == dimension) groups.add(name.tag, name.name);
  }
  return groups;
}

/// Tag without sign: a negative tag means that the group holds the reversed entity.
int group_tag(int signed_tag) {
  return signed_tag == std::numeric_limits<int>::min() ? 0 : std::abs(signed_tag);
}

/// Physical tags of entities by dimension and tag.
using Physicals = std::array<std::unordered_map<int, const std::vector<int>*>, 4>;

Physicals physicals_by_entity(const Details& details) {
  Physicals physicals;
  for (std::size_t d = 0; d < 4; ++d) {
    for (const Entity& entity : details.entities[d]) physicals[d][entity.tag] = &entity.physicals;
    for (const Entity& part : details.parts[d]) physicals[d][part.tag] = &part.physicals;
  }
  return physicals;
}

/// Makes the entities of the elements their regions, if there are several: in a file without
/// physical groups of elements nothing else tells the parts of the mesh from one another.
void regions_from_entities(const Details& details, ParsedMesh& mesh) {
  GroupIndex regions{std::string(entity_names[at(details.dimension)]) + "_entity_"};
  auto& element_region = mesh.data.element_region;
  for (const Item& item : details.items)
    if (info_of(item.shape).dimension == details.dimension)
      element_region[at(item.index)] = static_cast<Index>(regions.find(item.entity));
  if (regions.all().size() > 1)
    mesh.data.regions = regions.all();
  else
    element_region.clear();
}

}  // namespace

void collect_groups(std::span<const std::size_t> offsets, Details& details, ParsedMesh& mesh) {
  const int side = details.dimension - 1;
  GroupIndex markers = groups_of(details, side);
  GroupIndex regions = groups_of(details, details.dimension);
  const Physicals physicals = physicals_by_entity(details);
  auto& element_region = mesh.data.element_region;
  element_region.assign(mesh.data.types.size(), -1);
  Index loose_sides = 0;
  for (std::size_t i = 0; i < details.items.size(); ++i) {
    const Item& item = details.items[i];
    const int dimension = info_of(item.shape).dimension;
    if (dimension < side) continue;
    const bool is_side = dimension == side;
    std::span<const int> tags;
    if (!details.version_4) {
      if (item.physical != 0) tags = {&item.physical, 1};
    } else if (const auto& of = physicals[at(dimension)]; of.contains(item.entity)) {
      tags = *of.at(item.entity);
    }
    if (is_side && tags.empty()) ++loose_sides;
    for (const int tag : tags) {
      if (is_side) {
        // In 2.2 the nodes of the element already have the order of the group.
        const bool reversed = details.version_4 && tag < 0;
        add_marker_side(markers.find(group_tag(tag)), reversed ? ~item.index : item.index,
                        offsets[i], details, mesh);
      } else {
        auto& region = element_region[static_cast<std::size_t>(item.index)];
        const auto found = static_cast<Index>(regions.find(group_tag(tag)));
        if (region < 0) region = found;
      }
    }
  }
  make_markers(markers.all(), details, mesh);
  mesh.data.regions = regions.all();
  if (mesh.data.regions.empty()) regions_from_entities(details, mesh);
  if (loose_sides > 0) {
    mesh.warnings.push_back(std::to_string(loose_sides) + (side == 1 ? " line" : " surface") +
                            " elements are in no physical group: they are kept, but are no "
                            "marker");
  }
}

namespace {

using Box = std::array<double, 6>;

/// Extends the boxes of entities, which are found by dimension and tag.
class BoxCollector {
 public:
  BoxCollector(const Details& details, const Coordinates& coordinates)
      : details_(details), coordinates_(coordinates) {
    for (std::size_t d = 0; d < 4; ++d) {
      const auto& entities = details.entities[d];
      boxes_[d].resize(entities.size());
      for (std::size_t i = 0; i < entities.size(); ++i) index_[d].emplace(entities[i].tag, i);
    }
  }

  void add(int dimension, int entity, Index node) {
    const auto d = static_cast<std::size_t>(dimension);
    const auto found = index_[d].find(entity);
    if (found == index_[d].end()) return;
    auto& box = boxes_[d][found->second];
    const Vec3 xyz = place_in_space(&details_, coordinates_, node);
    if (!box) box = Box{xyz[0], xyz[1], xyz[2], xyz[0], xyz[1], xyz[2]};
    for (std::size_t k = 0; k < 3; ++k) {
      const double coordinate = xyz[static_cast<Eigen::Index>(k)];
      (*box)[k] = std::min((*box)[k], coordinate);
      (*box)[k + 3] = std::max((*box)[k + 3], coordinate);
    }
  }

  EntityBoxes take() { return std::move(boxes_); }

 private:
  const Details& details_;
  const Coordinates& coordinates_;
  std::array<std::unordered_map<int, std::size_t>, 4> index_;
  EntityBoxes boxes_;
};

template <class CornersOf>
EntityBoxes collect_boxes(const Details& details, const Coordinates& coordinates,
                          CornersOf&& corners_of) {
  BoxCollector boxes(details, coordinates);
  Index node = 0;
  for (const NodeBlock& block : details.node_blocks) {
    for (Index i = 0; i < block.count; ++i) boxes.add(block.dimension, block.entity, node++);
  }
  for (const Item& item : details.items) {
    const int dimension = info_of(item.shape).dimension;
    std::span<const Index> nodes = details.nodes_beside(item);
    if (nodes.empty()) nodes = corners_of(item.index);
    for (const Index n : nodes) boxes.add(dimension, item.entity, n);
  }
  return boxes.take();
}

std::string safe_name(const std::string& name, std::vector<std::string>& warnings) {
  std::string safe = within_line(name, "\"");
  if (safe != name) {
    warnings.push_back("group \"" + name + "\" is written as \"" + safe +
                       "\": Gmsh allows no such name");
  }
  return safe;
}

/// Adds the entity, the physical group and the elements of each marker.
void add_markers(const Mesh& mesh, Details& details, std::vector<std::string>& warnings) {
  const auto& markers = mesh.topology->markers();
  const auto tags = usable_tags(tags_of(markers.list()), "markers", warnings);
  const int dimension = details.dimension - 1;
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const int entity = static_cast<int>(m) + 1;
    details.entities[at(dimension)].push_back({entity, {}, {tags[m]}, {}, {}});
    details.physical_names.push_back({dimension, tags[m], safe_name(markers[m].name, warnings)});
    for (const Face& face : markers[m].faces) {
      const auto number = static_cast<std::int64_t>(details.items.size()) + 1;
      const auto index = static_cast<Index>(details.sides.size());
      details.items.push_back({number, index, entity, tags[m], face_shape(face)});
      details.sides.push_back(face);
    }
  }
}

/// Adds the entities and physical groups of regions. Returns entity and physical tag of
/// each region, and those of elements without region at the end.
std::vector<std::array<int, 2>> add_regions(const Topology& topology, Details& details,
                                            std::vector<std::string>& warnings) {
  const auto& regions = topology.regions();
  const auto tags = usable_tags(tags_of(regions), "regions", warnings);
  const int dimension = details.dimension;
  std::vector<std::array<int, 2>> entities;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const int entity = static_cast<int>(r) + 1;
    details.entities[at(dimension)].push_back({entity, {}, {tags[r]}, {}, {}});
    details.physical_names.push_back({dimension, tags[r], safe_name(regions[r].name, warnings)});
    entities.push_back({entity, tags[r]});
  }
  const int rest = static_cast<int>(regions.size()) + 1;
  if (!regions.empty()) {
    const auto of = topology.element_regions();
    if (std::find(of.begin(), of.end(), -1) != of.end()) {
      details.entities[at(dimension)].push_back({rest, {}, {}, {}, {}});
    }
    entities.push_back({rest, 0});
    return entities;
  }
  // Tags are unique only per dimension. A tag that no marker uses helps readers that ignore this.
  int tag = 1;
  for (const PhysicalName& name : details.physical_names) tag = std::max(tag, name.tag + 1);
  details.entities[at(dimension)].push_back({rest, {}, {tag}, {}, {}});
  details.physical_names.push_back({dimension, tag, "domain"});
  entities.push_back({rest, tag});
  return entities;
}

}  // namespace

EntityBoxes entity_boxes(const Details& details, const MeshData& data) {
  return collect_boxes(details, data.coordinates, [&](Index e) { return data.element(e); });
}

EntityBoxes entity_boxes(const Details& details, const Mesh& mesh) {
  return collect_boxes(details, mesh.coordinates,
                       [&](Index e) { return mesh.topology->element(e); });
}

Details make_details(const Mesh& mesh, bool version_4, std::vector<std::string>& warnings) {
  const Topology& topology = *mesh.topology;
  Details details;
  details.version_4 = version_4;
  details.dimension = topology.cell_dimension();
  details.sections = {{"PhysicalNames", {}}};
  if (version_4) details.sections.push_back({"Entities", {}});
  details.sections.push_back({"Nodes", {}});
  details.sections.push_back({"Elements", {}});
  if (topology.markers().from_file()) add_markers(mesh, details, warnings);
  const auto entities = add_regions(topology, details, warnings);
  const auto regions = topology.element_regions();
  for (Index e = 0; e < topology.element_count(); ++e) {
    const Index region = regions.empty() ? -1 : regions[static_cast<std::size_t>(e)];
    const auto& entity = region < 0 ? entities.back() : entities[static_cast<std::size_t>(region)];
    const auto number = static_cast<std::int64_t>(details.items.size()) + 1;
    const Shape shape = element_shape(topology.element_type(e));
    details.items.push_back({number, e, entity[0], entity[1], shape});
  }
  details.node_blocks.push_back({details.dimension, 1, topology.node_count()});
  return details;
}

}  // namespace winslow::io::gmsh
