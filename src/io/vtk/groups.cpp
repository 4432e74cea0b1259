#include <cstdlib>

#include "core/error.h"
#include "io/vtk/grid.h"

namespace winslow::io::vtk {
namespace {

constexpr std::string_view marker_prefix = "marker:";
constexpr std::string_view region_prefix = "region:";

/// An array in which some program writes the regions of a mesh.
struct KnownArray {
  std::string_view name;  ///< in lower case
  bool zero_is_none;      ///< cells with 0 are in no region
  bool integers = false;  ///< must be of an integer type: the name is that of many other things
};

/// In the order in which they are looked for: groups that a user named come before the parts of a
/// geometry.
constexpr std::array<KnownArray, 22> known_arrays{{
    {"gmsh:physical", true},     // meshio
    {"medit:ref", true},         // meshio
    {"materialids", false},      // OpenGeoSys
    {"materialid", false},       //
    {"material_ids", false},     //
    {"material_id", false},      //
    {"material", false},         // MFEM, meshio
    {"materials", false},        //
    {"attribute", false},        // MFEM
    {"attributes", false},       //
    {"subdomains", false},       // FEniCS
    {"subdomain", false},        //
    {"cell_tags", false},        // DOLFINx
    {"celltags", false},         //
    {"region", false},           //
    {"regions", false},          //
    {"regionid", false},         //
    {"region_id", false},        //
    {"cellregions", false},      // TetGen
    {"f", false, true},          // FEniCS: the name that a mesh function has by default
    {"gmsh:geometrical", true},  // meshio
    {"cellentityids", true},     // Gmsh
}};

bool is_whole(double value) {
  return std::abs(value) <= std::numeric_limits<int>::max() && value == std::trunc(value);
}

bool is_number(const DataArray& array) {
  return array.type.kind != ValueKind::text && array.type.kind != ValueKind::bit;
}

/// True if an array has one number for each cell, each of them whole.
bool has_tags(const DataArray& array, std::size_t cells) {
  if (array.components != 1 || !is_number(array) || array.value_count() != cells) return false;
  for (std::size_t i = 0; i < cells; ++i)
    if (!is_whole(array.number(i))) return false;
  return true;
}

std::vector<int> tags_in(const DataArray& array) {
  std::vector<int> tags;
  tags.reserve(array.value_count());
  for (std::size_t i = 0; i < array.value_count(); ++i)
    tags.push_back(static_cast<int>(array.number(i)));
  return tags;
}

std::vector<NamedTag> names_in(const std::vector<DataArray>& field, std::string_view prefix) {
  std::vector<NamedTag> names;
  for (const DataArray& array : field) {
    const bool one = is_number(array) && array.name.starts_with(prefix) && array.value_count() == 1;
    if (!one || !is_whole(array.number(0))) continue;
    names.emplace_back(array.name.substr(prefix.size()), static_cast<int>(array.number(0)));
  }
  return names;
}

class GroupFinder {
 public:
  GroupFinder(const Source& source, Grid& grid)
      : source_(source), grid_(grid), dimension_(highest_dimension(grid)) {}

  void find(std::string_view wanted) {
    grid_.marker_names = names_in(grid_.data.field, marker_prefix);
    grid_.region_names = names_in(grid_.data.field, region_prefix);
    const DataArray* own_marker = own("marker");
    const DataArray* own_region = own("region");
    if (own_marker != nullptr) grid_.marker = tags_in(*own_marker);
    if (!wanted.empty()) {
      take(named(wanted), false);
    } else if (own_region != nullptr && (own_marker || !grid_.region_names.empty())) {
      take(*own_region, true);
    } else {
      take_known();
    }
  }

 private:
  static int highest_dimension(const Grid& grid) {
    int highest = 2;
    for (const auto type : grid.types) highest = std::max(highest, dimension_of_cell(type));
    return highest;
  }

  bool is_element(std::size_t cell) const {
    return dimension_of_cell(grid_.types[cell]) == dimension_;
  }

  /// An array of winslow's own name; null if there is none of whole numbers.
  const DataArray* own(std::string_view name) const {
    for (const DataArray& array : grid_.data.cells)
      if (array.name == name && has_tags(array, grid_.cell_count())) return &array;
    return nullptr;
  }

  const DataArray& named(std::string_view wanted) const {
    for (const DataArray& array : grid_.data.cells) {
      if (array.name != wanted) continue;
      require_tags(array);
      return array;
    }
    std::string others =
        list_of(grid_.data.cells, [](const DataArray& array) { return array.name; });
    throw UsageError(source_.name() + ": no cell array \"" + std::string(wanted) +
                     "\" for --regions; " +
                     (others.empty() ? "the file has no cell arrays" : "the file has " + others));
  }

  void require_tags(const DataArray& array) const {
    const std::string what = "cell array \"" + array.name + "\"";
    if (array.components != 1 || !is_number(array))
      throw UsageError(source_.name() + ": " + what + " cannot hold regions: found " +
                       std::to_string(array.components) + " components of the type " +
                       xml_name(array.type) + ", expected one whole number for each cell");
    for (std::size_t i = 0; i < grid_.cell_count(); ++i)
      if (!is_whole(array.number(i)))
        source_.fail(grid_.cell_places[i], "no integer in " + what + " for this cell", "a tag");
  }

  /// The known array that says most: the first with a tag other than 0 on an element; else the
  /// first.
  void take_known() {
    const DataArray* first = nullptr;
    const KnownArray* of_first = nullptr;
    for (const KnownArray& known : known_arrays) {
      for (const DataArray& array : grid_.data.cells) {
        if (lower_case(array.name) != known.name) continue;
        if (known.integers && !array.type.whole()) continue;
        if (!has_tags(array, grid_.cell_count())) continue;
        if (tells_elements_apart(array)) return take(array, known.zero_is_none);
        if (first == nullptr) {
          first = &array;
          of_first = &known;
        }
      }
    }
    if (first != nullptr) take(*first, of_first->zero_is_none);
  }

  bool tells_elements_apart(const DataArray& array) const {
    for (std::size_t c = 0; c < grid_.cell_count(); ++c)
      if (is_element(c) && array.number(c) != 0) return true;
    return false;
  }

  void take(const DataArray& array, bool zero_is_none) {
    grid_.region = tags_in(array);
    grid_.zero_is_none = zero_is_none;
    grid_.regions_array = array.name;
    if (array.name != "region") grid_.region_names.clear();
    if (!grid_.marker.empty()) return;
    // In Gmsh a negative tag means that the group holds the reversed entity.
    const bool reverses = lower_case(array.name) == "cellentityids";
    grid_.marker = grid_.region;
    if (!reverses) return;
    for (auto* tags : {&grid_.marker, &grid_.region})
      for (int& tag : *tags) tag = std::abs(tag);
  }

  const Source& source_;
  Grid& grid_;
  int dimension_;  // of the elements
};

}  // namespace

void find_groups(const Source& source, Grid& grid, std::string_view wanted) {
  GroupFinder(source, grid).find(wanted);
}

}  // namespace winslow::io::vtk
