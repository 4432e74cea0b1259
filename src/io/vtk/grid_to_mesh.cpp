#include <algorithm>
#include <utility>

#include "io/format/groups.h"
#include "io/format/vtk_wedge.h"
#include "io/vtk/grid.h"

namespace winslow::io::vtk {
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

/// 3 if there is a cell with a volume.
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
    details_->nodes = mesh_.data.node_count();
    details_->elements = mesh_.data.element_count();
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
    switch (grid_.types[c]) {
      case vertex:
        require_size(c, nodes, 1);
        details_->items.push_back({Item::Kind::point, static_cast<Index>(details_->points.size())});
        details_->points.push_back(nodes[0]);
        return;
      case line:
        require_size(c, nodes, 2);
        return add_side(c, {nodes[0], nodes[1]});
      case poly_line:
        for (std::size_t k = 1; k < nodes.size(); ++k) add_side(c, {nodes[k - 1], nodes[k]});
        return;
      case triangle:
        require_size(c, nodes, 3);
        return add_polygon(c, nodes);
      case pixel:
        require_size(c, nodes, 4);
        std::swap(nodes[2], nodes[3]);
        return add_polygon(c, nodes);
      case quadrilateral:
        require_size(c, nodes, 4);
        return add_polygon(c, nodes);
      case polygon:
        if (nodes.size() != 3) require_size(c, nodes, 4);
        return add_polygon(c, nodes);
      default:
        add_volume(c, nodes);
    }
  }

  void add_volume(std::size_t c, std::vector<Index>& nodes) {
    switch (grid_.types[c]) {
      case tetrahedron:
        require_size(c, nodes, 4);
        return add_element(c, ElementType::tetrahedron, nodes);
      case voxel:
        require_size(c, nodes, 8);
        std::swap(nodes[2], nodes[3]);
        std::swap(nodes[6], nodes[7]);
        return add_element(c, ElementType::hexahedron, nodes);
      case hexahedron:
        require_size(c, nodes, 8);
        return add_element(c, ElementType::hexahedron, nodes);
      case wedge:
        require_size(c, nodes, 6);
        mirror_prism(nodes);
        return add_element(c, ElementType::prism, nodes);
      case pyramid:
        require_size(c, nodes, 5);
        return add_element(c, ElementType::pyramid, nodes);
      default:
        refuse(c);
    }
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
                 "a line (3), triangle (5), quadrilateral (9), tetrahedron (10), hexahedron (12), "
                 "wedge (13) or pyramid (14)");
  }

  void add_polygon(std::size_t c, const std::vector<Index>& nodes) {
    if (dimension_ == 3) return add_side(c, Face(nodes));
    add_element(c, nodes.size() == 3 ? ElementType::triangle : ElementType::quadrilateral, nodes);
  }

  void add_side(std::size_t c, const Face& face) {
    const auto index = static_cast<Index>(details_->sides.size());
    details_->items.push_back({Item::Kind::side, index});
    details_->sides.push_back(face);
    const bool of_boundary = (face.size() == 2) == (dimension_ == 2);
    if (!of_boundary) return;
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

}  // namespace winslow::io::vtk
