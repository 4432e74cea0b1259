#include <utility>

#include "io/format/groups.h"
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

class MeshBuilder {
 public:
  MeshBuilder(const Source& source, const Grid& grid)
      : source_(source),
        grid_(grid),
        markers_(named_groups(grid.marker_names, "marker_")),
        regions_(named_groups(grid.region_names, "region_")) {
    mesh_.details = details_;
  }

  ParsedMesh build() {
    mesh_.where.nodes = grid_.point_places;
    set_planar_nodes(source_, grid_.points, mesh_);
    for (std::size_t c = 0; c < grid_.cell_count(); ++c) add_cell(c);
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
        details_->items.push_back({vertex, static_cast<Index>(details_->points.size())});
        details_->points.push_back(nodes[0]);
        return;
      case line:
        require_size(c, nodes, 2);
        return add_line(c, nodes[0], nodes[1]);
      case poly_line:
        for (std::size_t k = 1; k < nodes.size(); ++k) add_line(c, nodes[k - 1], nodes[k]);
        return;
      case triangle:
        require_size(c, nodes, 3);
        return add_element(c, nodes);
      case pixel:
        require_size(c, nodes, 4);
        std::swap(nodes[2], nodes[3]);
        return add_element(c, nodes);
      case quadrilateral:
        require_size(c, nodes, 4);
        return add_element(c, nodes);
      case polygon:
        if (nodes.size() != 3) require_size(c, nodes, 4);
        return add_element(c, nodes);
      default:
        refuse(c);
    }
  }

  [[noreturn]] void refuse(std::size_t c) const {
    const auto type = grid_.types[c];
    const bool solid = type >= 10 && type <= 16;
    const bool high_order = type >= 21 && type <= 81;
    source_.fail(grid_.cell_places[c],
                 "cell type " + std::to_string(type) +
                     (solid        ? " (a 3D mesh)"
                      : high_order ? " (second or higher order)"
                                   : ""),
                 "a line (3), triangle (5) or quadrilateral (9)");
  }

  void add_line(std::size_t c, Index a, Index b) {
    const auto index = static_cast<Index>(details_->lines.size());
    details_->items.push_back({line, index});
    details_->lines.push_back({a, b});
    const int tag = grid_.marker.empty() ? 0 : grid_.marker[c];
    if (tag == 0) {
      ++loose_lines_;
      return;
    }
    add_marker_line(markers_.find(tag), index, grid_.cell_places[c], *details_, mesh_);
  }

  void add_element(std::size_t c, const std::vector<Index>& nodes) {
    details_->items.push_back({triangle, mesh_.data.element_count()});
    mesh_.data.add_element(nodes.size() == 3 ? ElementType::triangle : ElementType::quadrilateral,
                           nodes);
    mesh_.where.elements.push_back(grid_.cell_places[c]);
    const int tag = grid_.region.empty() ? 0 : grid_.region[c];
    mesh_.data.element_region.push_back(tag == 0 ? -1 : static_cast<Index>(regions_.find(tag)));
  }

  void finish_groups() {
    make_markers(markers_.all(), *details_, mesh_);
    mesh_.data.regions = regions_.all();
    if (mesh_.data.regions.empty()) mesh_.data.element_region.clear();
    if (loose_lines_ > 0) {
      mesh_.warnings.push_back(std::to_string(loose_lines_) +
                               " line cells have no marker tag: they are kept, but are no marker");
    }
  }

  const Source& source_;
  const Grid& grid_;
  ParsedMesh mesh_;
  std::shared_ptr<Details> details_ = std::make_shared<Details>();
  GroupIndex markers_;
  GroupIndex regions_;
  Index loose_lines_ = 0;
};

}  // namespace

ParsedMesh to_mesh(const Source& source, const Grid& grid) {
  return MeshBuilder(source, grid).build();
}

}  // namespace winslow::io::vtk
