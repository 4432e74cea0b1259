#include "io/vtk/grid.h"

#include <cstdlib>

#include "io/format/foreign_formats.h"
#include "io/format/mesh_in_space.h"

namespace winslow::io::vtk {
namespace {

constexpr std::string_view marker_prefix = "marker:";
constexpr std::string_view region_prefix = "region:";

std::vector<int> to_tags(const Source& source, const Grid& grid, const std::vector<double>& values,
                         const char* name) {
  if (values.empty()) return {};
  if (values.size() != grid.cell_count()) {
    source.fail(source.text().size(),
                std::to_string(values.size()) + " values in cell array \"" + name + "\"",
                std::to_string(grid.cell_count()) + ", one for each cell");
  }
  std::vector<int> tags;
  tags.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool whole = std::abs(values[i]) <= std::numeric_limits<int>::max() &&
                       values[i] == std::trunc(values[i]);
    if (!whole) {
      source.fail(grid.cell_places[i],
                  "no integer in cell array \"" + std::string(name) + "\" for this cell", "a tag");
    }
    tags.push_back(static_cast<int>(values[i]));
  }
  return tags;
}

bool add_name(std::string_view name, std::string_view prefix, const std::vector<double>& values,
              std::vector<NamedTag>& names) {
  if (!name.starts_with(prefix) || values.size() != 1) return false;
  if (!(std::abs(values[0]) <= std::numeric_limits<int>::max())) return false;
  names.emplace_back(name.substr(prefix.size()), static_cast<int>(values[0]));
  return true;
}

}  // namespace

CellType cell_type_of(const Face& face) {
  return face.size() == 2 ? line : face.size() == 3 ? triangle : quadrilateral;
}

CellType cell_type_of(ElementType type) {
  static constexpr std::array<CellType, 6> types{triangle, quadrilateral, tetrahedron,
                                                 pyramid,  wedge,         hexahedron};
  return types[static_cast<std::size_t>(type)];
}

/// The element type of a cell of dimension 2 or 3; none if the cell type is not supported.
std::optional<ElementType> element_of(std::int64_t type, std::size_t corners) {
  if (type == polygon) type = corners == 3 ? triangle : quadrilateral;
  if (type == pixel) type = quadrilateral;
  if (type == voxel) type = hexahedron;
  for (const ElementType element : all_element_types)
    if (cell_type_of(element) == type) return element;
  return std::nullopt;
}

void Grid::add_cell(CellType type, std::span<const Index> nodes, int marker_tag, int region_tag) {
  types.push_back(type);
  connectivity.insert(connectivity.end(), nodes.begin(), nodes.end());
  offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  marker.push_back(marker_tag);
  region.push_back(region_tag);
}

void ArrayCollector::cell_array(std::string_view name, const std::vector<double>& values,
                                std::size_t components) {
  std::vector<double>* wanted = name == "marker"          ? &marker_
                                : name == "region"        ? &region_
                                : name == "gmsh:physical" ? &physical_
                                : name == "CellEntityIds" ? &entity_
                                                          : nullptr;
  if (wanted == nullptr || components != 1) {
    dropped_.emplace(name);
  } else {
    *wanted = values;
  }
}

void ArrayCollector::field_array(std::string_view name, const std::vector<double>& values) {
  const bool known = add_name(name, marker_prefix, values, marker_names_) ||
                     add_name(name, region_prefix, values, region_names_);
  if (!known) dropped_.emplace(name);
}

void ArrayCollector::finish(const Source& source, Grid& grid) {
  const bool ours = !marker_.empty() || !region_.empty();
  if (ours) {
    grid.marker = to_tags(source, grid, marker_, "marker");
    grid.region = to_tags(source, grid, region_, "region");
  } else if (!physical_.empty()) {
    grid.marker = grid.region = to_tags(source, grid, physical_, "gmsh:physical");
  } else if (!entity_.empty()) {
    grid.marker = to_tags(source, grid, entity_, "CellEntityIds");
    // In Gmsh a negative tag means that the group holds the reversed entity.
    for (int& tag : grid.marker) tag = std::abs(tag);
  }
  grid.marker_names = std::move(marker_names_);
  grid.region_names = std::move(region_names_);
  grid.dropped.merge(dropped_);
}

namespace {

GroupIndex named_groups(const std::vector<NamedTag>& names, const char* prefix) {
  GroupIndex groups(prefix);
  for (const auto& [name, tag] : names) {
    if (!groups.contains(tag)) groups.add(tag, name);
  }
  return groups;
}

/// The first few names: "Pressure, Velocity and 3 more".
std::string listed(const std::set<std::string>& names) {
  constexpr std::size_t few = 5;
  std::string text;
  std::size_t said = 0;
  for (const std::string& name : names) {
    if (said == few) break;
    text += (said++ == 0 ? "" : ", ") + (name.empty() ? "one without a name" : name);
  }
  if (names.size() > said) text += " and " + std::to_string(names.size() - said) + " more";
  return text;
}

using Item = Details::Item;

/// 3 if there is a volume cell, else 2.
int dimension_of(const Grid& grid) {
  const auto solid = [](std::int64_t type) { return type >= tetrahedron && type <= pyramid; };
  return std::ranges::any_of(grid.types, solid) ? 3 : 2;
}

class MeshBuilder {
 public:
  MeshBuilder(const Source& source, const Grid& grid)
      : source_(source),
        grid_(grid),
        dimension_(dimension_of(grid)),
        markers_(named_groups(grid.marker_names, "marker_")),
        regions_(named_groups(grid.region_names, "region_")) {
    mesh_.details = details_;
  }

  ParsedMesh build() {
    mesh_.where.nodes = grid_.point_places;
    for (std::size_t c = 0; c < grid_.cell_count(); ++c) add_cell(c);
    set_nodes(source_, grid_.points, mesh_);
    finish_groups();
    if (!grid_.dropped.empty()) {
      mesh_.warnings.push_back("data on points, cells and the field are not kept: " +
                               listed(grid_.dropped));
    }
    return std::move(mesh_);
  }

 private:
  std::vector<Index> corners(std::size_t c) const {
    const auto begin = grid_.offsets[c];
    const auto end = grid_.offsets[c + 1];
    std::vector<Index> nodes;
    nodes.reserve(static_cast<std::size_t>(end - begin));
    const auto count = static_cast<std::int64_t>(grid_.points.size() / 3);
    for (auto k = begin; k < end; ++k) {
      const auto node = grid_.connectivity[static_cast<std::size_t>(k)];
      if (node < 0 || node >= count) {
        source_.fail(grid_.cell_places[c], "node " + std::to_string(node),
                     "0 to " + std::to_string(count - 1));
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

  void add_cell(std::size_t c) {
    std::vector<Index> nodes = corners(c);
    const std::int64_t type = grid_.types[c];
    if (type == vertex) {
      require_size(c, nodes, 1);
      details_->items.push_back({Item::Kind::point, static_cast<Index>(details_->points.size())});
      details_->points.push_back(nodes[0]);
      return;
    }
    if (type == line || type == poly_line) {
      if (type == line) require_size(c, nodes, 2);
      for (std::size_t k = 1; k < nodes.size(); ++k) add_side(c, {nodes[k - 1], nodes[k]});
      return;
    }
    const auto element = element_of(type, nodes.size());
    if (!element) refuse(c);
    require_size(c, nodes, static_cast<std::size_t>(corner_count(*element)));
    if (type == pixel || type == voxel) std::swap(nodes[2], nodes[3]);
    if (type == voxel) std::swap(nodes[6], nodes[7]);
    if (type == wedge) mirror_prism(nodes);
    if (dimension_of(*element) < dimension_) return add_side(c, Face(nodes));
    add_element(c, *element, nodes);
  }

  [[noreturn]] void refuse(std::size_t c) const {
    const auto type = grid_.types[c];
    const bool other_solid = type == 15 || type == 16 || type == 41 || type == 42;
    const bool high_order = type >= 21 && type <= 81;
    source_.fail(grid_.cell_places[c],
                 "cell type " + std::to_string(type) +
                     (other_solid  ? " (a polyhedron)"
                      : high_order ? " (second or higher order)"
                                   : ""),
                 std::string("a line (3), triangle (5), quadrilateral (9), tetrahedron (10), "
                             "hexahedron (12), wedge (13) or pyramid (14)") +
                     (high_order && !other_solid ? first_order_hint(source_.name()) : ""));
  }

  void add_side(std::size_t c, const Face& face) {
    const auto index = static_cast<Index>(details_->sides.size());
    details_->items.push_back({Item::Kind::side, index});
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
    details_->items.push_back({Item::Kind::element, mesh_.data.element_count()});
    mesh_.data.add_element(type, nodes);
    mesh_.where.elements.push_back(grid_.cell_places[c]);
    const int tag = grid_.region.empty() ? 0 : grid_.region[c];
    mesh_.data.element_region.push_back(tag == 0 ? -1 : static_cast<Index>(regions_.find(tag)));
  }

  void finish_groups() {
    make_markers(markers_.all(), *details_, mesh_);
    mesh_.data.regions = regions_.all();
    if (mesh_.data.regions.empty()) mesh_.data.element_region.clear();
    if (loose_sides_ > 0) {
      mesh_.warnings.push_back(std::to_string(loose_sides_) +
                               (dimension_ == 2 ? " line" : " surface") +
                               " cells have no marker tag: they are kept, but are no marker");
    }
  }

  const Source& source_;
  const Grid& grid_;
  int dimension_;  // of the elements
  ParsedMesh mesh_;
  std::shared_ptr<Details> details_ = std::make_shared<Details>();
  GroupIndex markers_;
  GroupIndex regions_;
  Index loose_sides_ = 0;
};

}  // namespace

ParsedMesh to_mesh(const Source& source, const Grid& grid) {
  return MeshBuilder(source, grid).build();
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
    for (std::size_t m = 0; m < markers_.size(); ++m) {
      grid_.marker_names.emplace_back(topology_.markers()[m].name, markers_[m]);
    }
    for (std::size_t r = 0; r < regions_.size(); ++r) {
      grid_.region_names.emplace_back(topology_.regions()[r].name, regions_[r]);
    }
  }

  Grid in_order_of(const Details& details) {
    std::vector<int> tag_of_side(details.sides.size(), 0);
    for (std::size_t m = 0; m < details.marker_sides.size(); ++m) {
      for (const Index side : details.marker_sides[m]) {
        tag_of_side[static_cast<std::size_t>(side)] = markers_[m];
      }
    }
    for (const auto& item : details.items) {
      const auto i = static_cast<std::size_t>(item.index);
      if (item.kind == Details::Item::Kind::point) {
        grid_.add_cell(vertex, {&details.points[i], 1}, 0, 0);
      } else if (item.kind == Details::Item::Kind::side) {
        add_side(details.sides[i], tag_of_side[i]);
      } else {
        add_element(item.index);
      }
    }
    return std::move(grid_);
  }

  Grid elements_then_markers() {
    for (Index e = 0; e < topology_.element_count(); ++e) add_element(e);
    for (std::size_t m = 0; m < markers_.size(); ++m) {
      for (const Face& face : topology_.markers()[m].faces) add_side(face, markers_[m]);
    }
    return std::move(grid_);
  }

 private:
  void add_element(Index e) {
    const auto of = topology_.element_regions();
    const Index region = of.empty() ? -1 : of[static_cast<std::size_t>(e)];
    const ElementType type = topology_.element_type(e);
    FileCorners corners = space_.element(e);
    if (type == ElementType::prism) mirror_prism(corners.nodes);
    grid_.add_cell(cell_type_of(type), {corners.data(), corners.size()}, 0,
                   region < 0 ? 0 : regions_[static_cast<std::size_t>(region)]);
  }
  void add_side(const Face& face, int tag) {
    grid_.add_cell(cell_type_of(face), {face.begin(), face.size()}, tag, 0);
  }

  const Topology& topology_;
  MeshInSpace space_;
  std::vector<int> markers_;
  std::vector<int> regions_;
  Grid grid_;
};

}  // namespace

Grid to_grid(const Mesh& mesh, const FormatDetails* source, std::vector<std::string>& warnings) {
  GridBuilder builder(mesh, source, warnings);
  const auto* details = dynamic_cast<const Details*>(source);
  if (details != nullptr && details->fits(mesh)) return builder.in_order_of(*details);
  return builder.elements_then_markers();
}

}  // namespace winslow::io::vtk
