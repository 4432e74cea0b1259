#include "io/vtk/grid.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

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
    // Gmsh marks with the sign that the group holds the reversed entity.
    for (int& tag : grid.marker) tag = std::abs(tag);
  }
  grid.marker_names = std::move(marker_names_);
  grid.region_names = std::move(region_names_);
  grid.dropped.merge(dropped_);
}

}  // namespace winslow::io::vtk
