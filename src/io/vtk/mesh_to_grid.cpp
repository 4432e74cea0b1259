#include "io/format/groups.h"
#include "io/format/mesh_in_space.h"
#include "io/format/vtk_wedge.h"
#include "io/vtk/grid.h"

namespace winslow::io::vtk {
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
